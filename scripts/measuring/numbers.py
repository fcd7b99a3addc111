# SPDX-License-Identifier: Apache-2.0
"""What several tables compute and draw."""
import io
import math


def geometric_mean(values):
    """Of numbers above 0."""
    return math.exp(sum(math.log(value) for value in values) / len(values))


def svg_of(draw, inches):
    """The SVG of a figure of matplotlib, the same from the same numbers."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    with pyplot.rc_context({"svg.hashsalt": "degs", "svg.fonttype": "none", "font.family": "sans-serif"}):
        figure = pyplot.figure(figsize=inches, layout="constrained")
        draw(figure)
        text = io.StringIO()
        figure.savefig(text, format="svg", metadata={"Date": None, "Creator": None})
        pyplot.close(figure)
    return "\n".join(line.rstrip() for line in text.getvalue().splitlines())
