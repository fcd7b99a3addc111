# SPDX-License-Identifier: Apache-2.0
"""The sentences of the paper that can fail, tried on our scenes, with a verdict on each.

The claims are the rows 'Claims' of docs/published.csv, each tried on every scene. A claim `holds` if it holds at every
point. If it fails somewhere, it `holds on` the scenes at all points of which it holds; else it `does not hold`."""
import collections

from measuring.points import sweep
from measuring.tables import csv_text, markdown, table

from tables import figures
from tables.figures import HEIGHTS, SIZES, Mistake

PAGE = "docs/reproduction.md"
SCENES = {"flowers": "flowers", "garden-crop": "garden-crop", "garden": "synthetic:garden",
          "interior": "synthetic:interior", "landscape": "synthetic:landscape,gaussians=3000000"}
CAMERA = "2"
CLOSE, LARGE = ("flowers", "garden-crop"), ("garden", "interior", "landscape")
# Study, scene, resolutions (fewer of large scenes), and frames of a path: three give a throughput.
RUNS = [*(run for scene in CLOSE for run in
          (("claims", scene, "720p,1080p,2k,4k", 3), ("scaling", scene, "720p,1080p,2k,4k", 1),
           ("banks", scene, "1080p", 1), ("segment-length", scene, "720p,1080p,2k", 1))),
        *(run for scene in LARGE for run in
          (("claims", scene, "1080p", 3), ("scaling", scene, "4k", 1), ("banks", scene, "1080p", 1),
           ("segment-length", scene, "720p,1080p", 1))),
        *((study, scene, resolution, 1) for scene in SCENES for study, resolution in
          (("real-time", "4k"), ("8k", "8k")))]
COLUMNS = {"pes": "pes", "useful": "slots.utilization", "ended": "slots.terminated", "latency_ms": "latency_ms",
           "preprocessing": "preprocessing_cycles / cycles", "throughput_fps": "throughput_fps",
           "nj_per_frame": "energy.nj_per_frame", "area_mm2": "area_mm2"}
AXES = {"banks": "scheduler.banks", "segment-length": "scheduler.segment_length"}
KEYS = ("study", "scene", "height", "design", "axis")
BASELINES = ("gscore", "gbu", "gcc")
BANKS = {"16": "4", "64": "8", "256": "16", "1024": "32"}  # of the design itself
NAMES = {height: name for name, height in HEIGHTS.items()}

Point = collections.namedtuple("Point", "scene label value")


class Data:
    """Rows of docs/claims.csv."""

    def __init__(self, rows):
        self.rows = {tuple(row[key] for key in KEYS): row for row in rows}

    def get(self, measure, study, scene, height, design, axis=""):
        """A number, or a mistake if it was not measured."""
        row = self.rows.get((study, scene, height, design, axis))
        if row is None or not row[measure]:
            raise Mistake(f"docs/claims.csv lacks {measure} of {design} in {scene} at {height}.")
        return float(row[measure])

    def grid(self, study, measure="latency_ms"):
        """All pairs of scene and height that a study has with this measure."""
        return list(dict.fromkeys((row["scene"], row["height"]) for row in self.rows.values()
                                  if row["study"] == study and row[measure]))


def place(scene, height, more):
    return f"{scene} {NAMES[height]}, {more}"


def best(study, measure, sign, area=False):
    """DeGS over the best of the baselines at each size and resolution; with `sign` -1 less is better."""
    def points(data):
        for scene, height in data.grid(study, measure):
            for pes in SIZES:
                def value(name):
                    design = f"{name}-{pes}"
                    number = data.get(measure, study, scene, height, design) ** sign
                    return number / (data.get("area_mm2", study, scene, height, design) if area else 1)
                other = max(BASELINES, key=value)
                yield Point(scene, place(scene, height, f"{other}-{pes}"), value("degs") / value(other))
    return points


def utilization_of_degs(data):
    for scene, height in data.grid("scaling"):
        if height == "2160":
            for pes in SIZES:
                yield Point(scene, place(scene, height, f"{pes} PEs"),
                            data.get("useful", "scaling", scene, height, f"degs-{pes}"))


def graceful(data):
    """What DeGS keeps of its utilization from 16 to 1024 PEs over what the best baseline keeps."""
    for scene, height in data.grid("scaling"):
        def kept(name):
            return (data.get("useful", "scaling", scene, height, f"{name}-1024") /
                    data.get("useful", "scaling", scene, height, f"{name}-16"))
        other = max(BASELINES, key=kept)
        yield Point(scene, place(scene, height, other), kept("degs") / kept(other))


def scale_of_best(data):
    """The number of PEs at which DeGS has most frames per second and mm2, over that number of each baseline."""
    for scene, height in data.grid("claims"):
        def scale(name):
            return int(max(SIZES, key=lambda pes: 1 / data.get("latency_ms", "claims", scene, height, f"{name}-{pes}") /
                           data.get("area_mm2", "claims", scene, height, f"{name}-{pes}")))
        for name in BASELINES:
            yield Point(scene, place(scene, height, name), scale("degs") / scale(name))


def in_space(data, *where):
    return 1 - data.get("useful", *where) - data.get("ended", *where)


def in_time(data, *where):
    return data.get("ended", *where)


def grown(redundancy):
    """Redundancy of a coupled array with 1024 over that with 16 PEs."""
    def points(data):
        for scene, height in data.grid("scaling"):
            for name in BASELINES:
                large, small = (redundancy(data, "scaling", scene, height, f"{name}-{n}") for n in (1024, 16))
                if small > 0:  # without a pixel that ends early, a view says nothing of redundancy in time
                    yield Point(scene, place(scene, height, name), large / small)
    return points


def lowest(data):
    """Utilization of GSCore over that of the lower of the others."""
    for scene, height in data.grid("scaling"):
        for pes in SIZES:
            gscore, *others = (data.get("useful", "scaling", scene, height, f"{name}-{pes}") for name in BASELINES)
            yield Point(scene, place(scene, height, f"{pes} PEs"), gscore / min(others))


def outdoors(data):
    """Latency per mm2 of a baseline over DeGS in a scene outdoors, over that in the flat."""
    def gain(scene, name):
        def cost(design):
            return (data.get("latency_ms", "claims", scene, "1080", design) *
                    data.get("area_mm2", "claims", scene, "1080", design))
        return cost(f"{name}-64") / cost("degs-64")
    for scene in ("garden", "landscape"):
        for name in BASELINES:
            yield Point(scene, f"{scene} over interior 1080p, {name}-64", gain(scene, name) / gain("interior", name))


def frame_rate(pes):
    def points(data):
        for scene, height in data.grid("real-time"):
            for speed in ("204.8", "51.2") if height == "2160" else ():
                yield Point(scene, place(scene, height, f"{speed} GB/s"),
                            1000 / data.get("latency_ms", "real-time", scene, height, f"degs-{pes}@{speed}"))
    return points


def preprocessing(data):
    """Time of preprocessing with the slow over that with the fast memory."""
    for scene, height in data.grid("real-time"):
        for pes in ("64", "256"):
            slow, fast = (data.get("preprocessing", "real-time", scene, height, f"degs-{pes}@{speed}") *
                          data.get("latency_ms", "real-time", scene, height, f"degs-{pes}@{speed}")
                          for speed in ("51.2", "204.8"))
            yield Point(scene, place(scene, height, f"{pes} PEs"), slow / fast)


def rendering_at_8k(data):
    for scene, height in data.grid("8k"):
        where = ("8k", scene, height, "degs-256@204.8")
        yield Point(scene, place(scene, height, f"{1000 / data.get('latency_ms', *where):.0f} fps"),
                    1 - data.get("preprocessing", *where))


def own_banks(data):
    for scene, height in data.grid("banks"):
        for pes in SIZES:
            yield Point(scene, place(scene, height, f"{pes} PEs"),
                        in_space(data, "banks", scene, height, f"degs-{pes}", BANKS[pes]))


def growth_with_banks(data):
    """How much more the redundancy in space grows when the banks are doubled than it does in the next smaller array."""
    for scene, height in data.grid("banks"):
        def growth(pes):
            few, many = (in_space(data, "banks", scene, height, f"degs-{pes}", banks)
                         for banks in (BANKS[pes], str(2 * int(BANKS[pes]))))
            return many - few
        for small, large in zip(SIZES, SIZES[1:]):
            yield Point(scene, place(scene, height, f"{large} over {small} PEs"), growth(large) - growth(small))


def gain_of_segments(data):
    """How much more redundancy half as long segments save at a resolution than at the next higher one."""
    grid = data.grid("segment-length")
    for scene in dict.fromkeys(scene for scene, _ in grid):
        heights = [height for height in ("720", "1080", "1440") if (scene, height) in grid]
        def gain(height, long):
            coarse, fine = (1 - data.get("useful", "segment-length", scene, height, "degs-64", str(length))
                            for length in (long, long // 2))
            return coarse - fine
        for low, high in zip(heights, heights[1:]):
            for long in (32, 16):
                yield Point(scene, place(scene, low, f"{long} to {long // 2} px"), gain(low, long) - gain(high, long))


# Names of docs/published.csv, and what gives the points.
CLAIMS = {
    "best PE utilisation (arrays alone)": best("scaling", "useful", 1),
    "best latency": best("claims", "latency_ms", -1),
    "best latency per mm²": best("claims", "latency_ms", -1, True),
    "best throughput": best("claims", "throughput_fps", 1),
    "best throughput per mm²": best("claims", "throughput_fps", 1, True),
    "least energy": best("claims", "nj_per_frame", -1),
    "least energy per mm²": best("claims", "nj_per_frame", -1, True),
    "utilisation of DeGS at 4K": utilization_of_degs,
    "utilisation kept from 16 to 1024 PEs": graceful,
    "latency per mm² best at more PEs": scale_of_best,
    "redundancy in space, 1024 over 16 PEs": grown(in_space),
    "redundancy in time, 1024 over 16 PEs": grown(in_time),
    "utilisation of GSCore, the lowest": lowest,
    "gain outdoors over gain indoors": outdoors,
    "frame rate at 4K, 64 PEs": frame_rate("64"),
    "frame rate at 4K, 256 PEs": frame_rate("256"),
    "preprocessing, 51.2 over 204.8 GB/s": preprocessing,
    "rendering's share at 8K, 256 PEs": rendering_at_8k,
    "redundancy in space, banks of Table III": own_banks,
    "growth with banks, more at more PEs": growth_with_banks,
    "gain of segments, more at low resolution": gain_of_segments,
}


def holds(value, text, unit):
    """Whether a number is on the side of its bound that a claim names."""
    bound = float(text[1:]) / (100 if unit == "%" else 1)
    return value < bound if text[0] == "<" else value > bound


def verdict(points, fails):
    """The rule of the page."""
    failed = {point.scene for point in fails}
    kept = [scene for scene in dict.fromkeys(point.scene for point in points) if scene not in failed]
    if not failed:
        return "holds"
    return f"holds on {', '.join(kept)}" if kept else "does not hold"


def tried(data, row):
    """The points of a claim, and those that fail."""
    points = list(CLAIMS[row["quantity"]](data))
    return points, [point for point in points if not holds(point.value, row["value"], row["unit"])]


def claims():
    return [row for row in figures.published() if row["figure"] == "Claims"]


def shown(point, unit):
    return f"{point.value:.3f}" if unit == "×" else f"{figures.shown(point.value, unit)} {unit}"


def kept(study, scene, row):
    """A line of docs/claims.csv from one of a study's results."""
    line = {"study": study, "scene": scene, "height": row["height"], "design": row["design"],
            "axis": row[AXES[study]] if study in AXES else ""}
    for name, measure in COLUMNS.items():
        present = measure not in row or row[measure]
        line[name] = f"{figures.evaluated(measure, row):.5g}" if present else ""
    return line


def asked():
    """The points of all runs."""
    return {each: sweep(each[0], SCENES[each[1]], f"--camera {CAMERA} --resolution {each[2]} --frames {each[3]}")
            for each in RUNS}


def rows_of(found):
    """Rows of docs/claims.csv from the results of all runs."""
    return [kept(study, scene, row) for (study, scene, *_), rows in found.items() for row in rows]


@table("docs/claims.csv", "claims-runs")
def claims_runs():
    """All runs that the claims are tried on."""
    rows = rows_of((yield asked()))
    return csv_text(list(rows[0]), [list(row.values()) for row in rows])


@table(PAGE, "claims")
def verdicts():
    """Claims, points and scenes at which they hold, and verdicts."""
    data, lines = Data(rows_of((yield asked()))), []
    for row in claims():
        points, fails = tried(data, row)
        scenes = {point.scene for point in points}
        whole = scenes - {point.scene for point in fails}
        worst = (max if row["value"][0] == "<" else min)(points, key=lambda point: point.value)
        lines.append([row["quantity"], figures.as_published(row["value"], row["unit"]),
                      f"{len(points) - len(fails)}/{len(points)}", f"{len(whole)}/{len(scenes)}",
                      f"{shown(worst, row['unit'])} ({worst.label})", verdict(points, fails)])
    head = ["claim", "published", "points", "scenes", "worst point", "verdict"]
    return markdown(head, lines, len(head))


@table("docs/failed-claims.csv", "claims-failed")
def failed():
    """Every point at which a claim does not hold."""
    data = Data(rows_of((yield asked())))
    return csv_text(["claim", "published", "ours", "point"],
                    [[row["quantity"], figures.as_published(row["value"], row["unit"]), shown(point, row["unit"]),
                      point.label] for row in claims() for point in tried(data, row)[1]])
