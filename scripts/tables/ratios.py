# SPDX-License-Identifier: Apache-2.0
"""Tables and a picture of docs/ratios.md: how the paper's ratios per area come about, from the shipped reading to the
joint one key by key, and its utilisation from 16 to 1024 PEs by resolution."""
import dataclasses
from statistics import geometric_mean

from measuring.numbers import svg_of
from measuring.points import run
from measuring.tables import markdown, table

PAGE = "docs/ratios.md"
SCENES = {"`landscape`": "synthetic:landscape,gaussians=3000000", "`garden`": "synthetic:garden",
          "`interior`": "synthetic:interior", "flowers": "flowers", "st-peter": "st-peter"}
BASELINES = {"gscore": "GSCore", "gbu": "GBU", "gcc": "GCC"}
ALL = ("degs", *BASELINES)
FRAMES = 4  # of a path: the steady state lies between the first and the last but one
MEMORY_SHARE = 0.05  # of its energy, with which the joint reading is consistent
# Of the paper, Sec. V-C: over GSCore, GBU and GCC.
PAPER = {"latency": (6.02, 2.44, 1.82), "throughput": (7.25, 2.36, 2.82), "energy": (4.42, 3.32, 1.59)}
SIZES, MEANS = (16, 1024), ("88.5", "73.6")  # percent: means of DeGS, Sec. V-C
RESOLUTIONS = {"720p": "720p", "1080p": "1080p", "2K": "2k", "4K": "4k", "8K": "8k"}
SPEEDUPS = {"gscore": ("GSCore", 6.28, 34.8, 7.1), "gbu": ("GBU", 8.47, 84.7, 18.7)}  # Sec. I, percent


@dataclasses.dataclass(frozen=True)
class Step:
    """A key that changes in one design, or in all; the steps before it stay."""

    key: str
    designs: tuple
    text: str


START = Step("pipeline.tiles=exact", ALL, "against: Sec. II-A pairs a Gaussian with the tiles of its 3σ box")
STEPS = (Step("array.subtile_skip=none", ("gscore",), "open: Sec. II-B has a fixed region in every cycle"),
         Step("slicing.rows=tile", ("degs",), "open: Sec. IV-A may mean the rows of a splat, or of its part in the tile"),
         Step("slicing.interleave=2", ("degs",), "open: Sec. III-B has tails that overlap, and no rule"),
         Step("span.rows=pool", ("degs",), "open: not said"),
         Step("pixel_buffer.release=bank", ("degs",), "open: not said"),
         Step("pipeline.span_ends=exact", ("degs",), "against: Eq. 15 rounds outward"),
         Step("scheduler.termination=pixel", ("degs",), "against: Sec. IV-B ends segments"))
JOINT = tuple(step.key for step in STEPS if "degs" in step.designs)


def readings():
    """Names of all readings in their order, with the keys of each design."""
    keys = {design: () for design in ALL}
    yield "exact lists", {design: (START.key,) for design in ALL}, START.text
    yield "**as shipped**", dict(keys), ""
    for step in STEPS:
        keys = {design: (*set_before, step.key) if design in step.designs else set_before
                for design, set_before in keys.items()}
        yield f"`{step.key}`", dict(keys), step.text


def points(options=""):
    """Runs of all readings by scene and design; designs share what a step leaves as it is."""
    view = f"--camera 2 --resolution 1080p {options}".strip()
    return {name: {scene: {design: run(f"{design}-64", file, view, *keys[design]) for design in ALL}
                   for scene, file in SCENES.items()} for name, keys, _ in readings()}


def energy_of(memory):
    """Energy of a frame with this share of that of the memory, nJ."""
    def energy(report):
        return report.energy.total_nj - (1 - memory) * report.energy.dram_nj
    return energy


def latency(report):
    return report.latency_ms


def interval(report):
    """Time from frame to frame in the steady state."""
    return 1000 / report.timing.throughput_fps


def ratios(reports, measure):
    """What each baseline takes times its area over that of DeGS."""
    def cost(design):
        return measure(reports[design]) * reports[design].area.mm2
    return [cost(name) / cost("degs") for name in BASELINES]


def means(scenes, measure):
    """(geometric mean, least, most) over the scenes for each baseline."""
    by_scene = [ratios(reports, measure) for reports in scenes.values()]
    return [(geometric_mean(values), min(values), max(values)) for values in zip(*by_scene)]


def shown(values):
    return [f"{mean:.2f} ({least:.2f} – {most:.2f})" for mean, least, most in values]


HEAD = ["key set from here on", "the text", *BASELINES.values()]


def waterfall(measure, paper, options):
    found = yield points(options)
    rows = [[name, text, *shown(means(found[name], measure))] for name, _, text in readings()]
    return markdown(HEAD, [*rows, ["**the paper**", "", *(f"{value:.2f}" for value in paper)]], 2)


table(PAGE, "ratios-latency", latency, PAPER["latency"], "")(waterfall)
table(PAGE, "ratios-throughput", interval, PAPER["throughput"], f"--frames {FRAMES}")(waterfall)


@table(PAGE)
def ratios_energy():
    """Energy of one frame alone, and what of the memory it counts."""
    found = yield points()
    *_, (last, _, _) = readings()
    rows = [[name, text, *shown(means(found[name], energy_of(1)))] for name, _, text in readings()]
    for words, share in ((f"memory × {MEMORY_SHARE:g}", MEMORY_SHARE), ("memory × 0", 0)):
        rows += [[f"{words}, {what}", "open: not said", *shown(means(found[name], energy_of(share)))]
                 for what, name in (("as shipped", "**as shipped**"), ("all keys", last))]
    return markdown(HEAD, [*rows, ["**the paper**", "", *(f"{value:.2f}" for value in PAPER["energy"])]], 2)


@table(PAGE)
def ratios_scenes():
    """The joint reading by scene: latency, throughput and energy without memory over each baseline."""
    *_, (last, _, _) = readings()
    alone, paths = yield [points()[last], points(f"--frames {FRAMES}")[last]]
    rows = [[scene, f"{100 * alone[scene]['degs'].slots.utilization:.1f}",
             *(" / ".join(f"{value:.2f}" for value in ratios(reports[scene], measure))
               for reports, measure in ((alone, latency), (paths, interval), (alone, energy_of(MEMORY_SHARE))))]
            for scene in SCENES]
    rows.append(["**the paper**", "", *(" / ".join(f"{value:.2f}" for value in values) for values in PAPER.values())])
    return markdown(["scene", "useful, %", "latency", f"throughput, {FRAMES} frames",
                     f"energy, memory × {MEMORY_SHARE:g}"], rows)


def keys_of(pes):
    """The joint keys; the one Slicing Unit of 16 PEs cannot serve two streams."""
    return [key for key in JOINT if pes > SIZES[0] or not key.startswith("slicing.interleave")]


def arrays():
    """The joint keys on arrays of both sizes, by size, scene and resolution."""
    return {pes: {scene: [run(f"degs-{pes}", file, f"--camera 2 --resolution {size} --array-only", *keys_of(pes))
                          for size in RESOLUTIONS.values()] for scene, file in SCENES.items()} for pes in SIZES}


def useful(report):
    return 100 * report.slots.utilization


@table(PAGE)
def ratios_utilization():
    """Useful slots by scene, and means over the scenes."""
    found, rows = (yield arrays()), []
    for pes in SIZES:
        by_scene = {scene: [useful(report) for report in reports] for scene, reports in found[pes].items()}
        by_scene["**mean**"] = [sum(values) / len(values) for values in zip(*by_scene.values())]
        rows += [[scene, pes, *(f"{value:.1f}" for value in values)] for scene, values in by_scene.items()]
    return markdown(["scene", "PEs", *RESOLUTIONS], rows)


@table(PAGE)
def ratios_means():
    """Means over scenes and some of the resolutions beside the paper's."""
    found = yield arrays()
    names = list(RESOLUTIONS)
    ways = {"720p to 8K": names, "720p to 4K": names[:4], "2K": names[2:3], "2K to 8K": names[2:],
            "4K and 8K": names[3:], "8K": names[4:]}
    rows = []
    for words, sizes in ways.items():
        cells = []
        for pes in SIZES:
            values = [useful(reports[names.index(size)]) for reports in found[pes].values() for size in sizes]
            cells.append(f"{sum(values) / len(values):.1f}")
        rows.append([words, *cells])
    return markdown(["mean over", *(f"{pes} PEs" for pes in SIZES)], [*rows, ["**the paper**", *MEANS]])


@table(PAGE)
def ratios_speedups():
    """Speed-up of two baselines from 16 to 1024 PEs at 2K, and the share of the small frame that does not scale."""
    small, large = SIZES[0], SIZES[-1]
    view = "--camera 2 --resolution 2k"
    found = yield {design: {scene: [[run(f"{design}-{pes}", file, f"{view} {options}".strip())
                                     for pes in (small, large)] for options in ("--array-only", "")]
                            for scene, file in SCENES.items()} for design in SPEEDUPS}
    rows = []
    for design, (title, published, *utilization) in SPEEDUPS.items():
        by_scene = {scene: [of_small.cycles / of_large.cycles for of_small, of_large in pairs]
                    for scene, pairs in found[design].items()}
        array = large / small * utilization[1] / utilization[0]
        by_scene["**the paper**"] = [array, published]
        rows += [[title, scene, f"{array:.2f}", f"{whole:.2f}", f"{100 * fixed(array, whole):.1f}"]
                 for scene, (array, whole) in by_scene.items()]
    return markdown(["design", "scene", "arrays", "whole frames", "share that does not scale, %"], rows, 2)


def fixed(array, whole):
    """The share of a frame that is as long with more PEs, if the rest is `array` times as fast and all `whole` times."""
    return (1 / whole - 1 / array) / (1 - 1 / array)


@table("docs/images/ratios.svg", "ratios-picture")
def picture():
    """Latency per mm² step by step: a panel for each baseline, with every scene and the paper's value."""
    found = yield points()
    names = [name for name, _, _ in readings()]
    labels = [name.strip("*`") for name in names]

    def draw(figure):
        panels = figure.subplots(1, len(BASELINES), sharey=True)
        for index, (panel, title) in enumerate(zip(panels, BASELINES.values())):
            steps = [means(found[name], latency)[index] for name in names]
            rows = range(len(names))
            panel.hlines(rows, [least for _, least, _ in steps], [most for *_, most in steps], color="#bbbbbb", lw=3)
            panel.plot([mean for mean, *_ in steps], rows, "o-", color="#2166ac", lw=1)
            panel.axvline(PAPER["latency"][index], color="#b2182b", ls="--", lw=1)
            panel.annotate("paper ", (PAPER["latency"][index], 0.6), color="#b2182b", fontsize=8, ha="right")
            panel.set(title=f"over {title}", xlabel="latency × area, over that of DeGS-64", xlim=(0, None))
            panel.set_yticks(list(rows), labels, fontsize=8)
        panels[0].invert_yaxis()
    return svg_of(draw, (10, 4.2))
