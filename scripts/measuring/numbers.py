# SPDX-License-Identifier: Apache-2.0
"""What several tables compute and draw."""
import io


def beside(values, base, digits, form):
    """Cells of numbers, each with as many digits as `digits` says, and by how many percent they differ from `base`, if
    there is one."""
    cells = [f"{value:.{places}f}" for value, places in zip(values, digits)]
    return [f"{cell} ({100 * (value / before - 1):{form}} %)"
            for cell, value, before in zip(cells, values, base)] if base else cells


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
