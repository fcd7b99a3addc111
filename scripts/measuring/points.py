# SPDX-License-Identifier: Apache-2.0
"""Points: single calls of the program whose results tables share.

A point says what is simulated. Two tables that ask for the same point share its result. measuring/scenes.py says how
scenes and camera files are named, measuring/options.py which options of a run are ours."""
import csv
import dataclasses
import functools
import hashlib
import json
import pathlib
import resource
import subprocess
import tempfile
import time

import yaml

from .options import for_program, path_of
from .scenes import ROOT, files_of, scene_file
from degs.design import Design, texts_of
from degs.process import call, program
from degs.report import Report

FIVE = ("flowers", "guitar", "seal", "skull", "st-peter")  # scenes of most means
HEIGHTS = {"720p": 720, "1080p": 1080, "2k": 1440, "4k": 2160, "8k": 4320}
TINY_PATH = "tests/random/cameras.json:2"
# Of a report: what a probe keeps, if it is there.
PROBED = ("timing.cycles", "timing.throughput_fps", "timing.preprocessing_cycles", "slots.useful", "slots.boundary",
          "slots.terminated", "slots.conflict", "slots.starved", "slots.blocked", "dram.bytes_read",
          "dram.bytes_written", "dram.row_hit_rate", "energy.nj_per_frame", "area.mm2", "workload.tile_pairs",
          "workload.fragments", "image.psnr_db")
# Of a row of a study, and of a view.
PROBED_ROW = ("cycles", "preprocessing_cycles", "slots.utilization", "slots.conflict", "dram.bytes_read",
              "dram.bytes_written", "energy.nj_per_frame", "area_mm2")
PROBED_VIEW = ("visible", "tile_pairs", "fragments_per_pixel", "fragments_per_splat", "terminated_share")


@dataclasses.dataclass(frozen=True)
class Point:
    """One call: `kind` is run, view, accuracy or sweep. `source` is a design of configs or a study of configs/studies;
    `runs` is how often it runs, one after the other and alone, where its times count."""

    kind: str
    source: str
    scene: str = ""
    options: tuple = ()
    keys: tuple = ()
    runs: int = 0

    def words(self):
        """The command line behind the program, without a place for its results."""
        scene = ["--scene", scene_file(self.scene)] if self.scene else []
        keys = [word for key in self.keys for word in ("--set", key)]
        if self.kind == "run":
            reference = [] if "--reference" in self.options else ["--no-reference"]
            options = [str(ROOT / word) if word.startswith("configs/") else word for word in self.options
                       if word != "--reference"]
            return ["run", design_file(self.source), *scene, *options, *keys, *reference]
        if self.kind == "view":
            return ["scene", "info", *scene[1:], *self.options, "--json"]
        if self.kind == "accuracy":
            return ["accuracy", *scene, *self.options, "--no-error-images"]
        return ["sweep", str(ROOT / f"configs/studies/{self.source}.yaml"), *scene, *self.options, *keys]

    def designs(self):
        """Designs and changed keys whose values the result depends on."""
        if self.kind == "run":
            return [(design_file(self.source), self.keys)]
        return [(file, ()) for file in study_designs(self.source)] if self.kind == "sweep" else []

    def key(self):
        """What names the point in files."""
        return hashlib.sha256(json.dumps(dataclasses.astuple(self)).encode()).hexdigest()[:20]

    def quick(self):
        """A small point in its place, which shows that a table can be made. A study keeps its cameras and the heights
        of its images, which tables ask for."""
        sized = ("--resolution", "--width", "--height", "--camera", "--frames", "--crop")
        if self.kind == "sweep":
            sized = ("--resolution", "--frames")
        options, skip = [], False
        for word in self.options:
            if not skip and word not in sized:
                options.append(word)
            skip = word in sized
        if self.kind == "accuracy":
            options += ["--resolution", "720p"]
        if self.kind in ("run", "view"):
            options += ["--width", "160", "--camera", "1"]
        if self.kind == "sweep":
            named = dict(zip(self.options, self.options[1:])).get("--resolution", study_resolutions(self.source))
            options += ["--resolution", ",".join(f"32x{HEIGHTS[name]}" for name in named.split(","))]
        if "--frames" in self.options and self.kind != "view":
            options += ["--frames", "3"]
        scene = "synthetic:object,gaussians=500" if self.scene else ""
        if "--path" in options:
            options[options.index("--path") + 1] = TINY_PATH
            scene = f"{self.scene.split(',')[0]},gaussians=20000"
        return dataclasses.replace(self, scene=scene, options=tuple(options), runs=min(self.runs, 1))


def run(design, scene, options="", *keys, runs=0):
    """A run of a design; without --reference among the options, no image is compared. Its result is a degs.Report."""
    return Point("run", design, scene, tuple(options.split()), keys, runs)


def view(scene, options=""):
    """What is to be drawn in a view: `degs scene info --json`."""
    return Point("view", "", scene, tuple(options.split()))


def accuracy(scene, options):
    """Errors of images in several --numbers: the entries of accuracy.json."""
    return Point("accuracy", "", scene, tuple(options.split()))


def sweep(study, scene="", options="", *keys):
    """All points of a study: the rows of its results.csv."""
    return Point("sweep", study, scene, tuple(options.split()), keys)


@functools.lru_cache(maxsize=None)
def design_file(name):
    """The file of a design: a path, a name of configs, or FAMILY@PES of the family of an accelerator."""
    if "@" in name:
        family, pes = name.split("@")
        return str(Design(family, int(pes)).file)
    return name if name.endswith(".yaml") else str(ROOT / f"configs/{name}.yaml")


def study_of(name):
    """(file, content) of a study."""
    file = ROOT / f"configs/studies/{name}.yaml"
    return file, yaml.safe_load(file.read_text(encoding="utf-8"))


def study_designs(name):
    """Files that the designs of a study include."""
    file, study = study_of(name)
    return [str((file.parent / design["include"]).resolve()) for design in study["designs"]]


def included(node):
    """Files that something in a study includes."""
    if isinstance(node, dict):
        for key, value in node.items():
            yield from [value] if key == "include" else included(value)
    elif isinstance(node, list):
        for each in node:
            yield from included(each)


def study_resolutions(name):
    """Names of the resolutions of a study, as an option has them."""
    named = study_of(name)[1].get("resolutions", "720p")
    return named if isinstance(named, str) else ",".join(named)


@functools.lru_cache(maxsize=None)
def content(file):
    """Digest of a file."""
    digest = hashlib.blake2b(digest_size=16)
    with open(file, "rb") as stream:
        while block := stream.read(1 << 22):
            digest.update(block)
    return digest.hexdigest()


@functools.lru_cache(maxsize=None)
def values_of(file, keys):
    """All keys of a design with their values, as the program resolves them; not what it says of their meaning."""
    changes = [word for key in keys for word in ("--set", key)]
    return json.dumps(texts_of(call(["config", file, *changes, "--format", "yaml"], warn=False)), sort_keys=True)


def depends_on(point):
    """Texts of all that the result depends on but the program: values of keys, the scene, and the words."""
    if point.scene:
        yield from map(content, files_of(point.scene))
    if "--path" in point.options:
        yield content(path_of(point.options)[0])
    if point.kind == "sweep":
        file, study = study_of(point.source)
        yield json.dumps(study, sort_keys=True)
        designs = {design["include"] for design in study["designs"]}
        for name in sorted(set(included(study)) - designs):
            yield json.dumps(yaml.safe_load((file.parent / name).read_text(encoding="utf-8")), sort_keys=True)
    for design in point.designs():
        yield values_of(*design)
    for word in point.options:
        if word.startswith("configs/"):
            yield content(str(ROOT / word))
    yield json.dumps([point.kind, point.scene, point.options, point.keys if point.kind == "sweep" else (), point.runs])


def measured(point, jobs=1):
    """Calls the program: the values of the result, and the seconds that it took. Where times count, `runs` has the
    section `host` of each run, with the seconds of all processors as `processor_s`."""
    began = time.monotonic()
    values = once(point, jobs)
    if point.runs:
        values["runs"] = [values["host"], *(once(point, jobs)["host"] for _ in range(point.runs - 1))]
    return values, time.monotonic() - began


def once(point, jobs):
    if point.kind == "view":
        return json.loads(call(point.words(), warn=False))
    with tempfile.TemporaryDirectory(prefix="degs-measure-") as folder:
        if point.kind == "sweep":
            call([*point.words(), "--jobs", str(jobs), "--out", folder], progress=False, warn=False)
            return {"rows": rows_of(pathlib.Path(folder, "results.csv")),
                    "seconds": [float(row["host.sim_s"]) for row in rows_of(pathlib.Path(folder, "host.csv"))]}
        words = for_program(point.words(), folder)
        before = processor_s()
        call([*words, "--out", folder], warn=False)
        used = processor_s() - before
        if point.kind == "accuracy":
            return {"rows": json.loads(pathlib.Path(folder, "accuracy.json").read_text(encoding="utf-8"))}
        name = "analytic.json" if "analytic" in point.options else "report.json"
        values = json.loads(pathlib.Path(folder, name).read_text(encoding="utf-8"))
        if point.runs:
            values["host"]["processor_s"] = used
        return values


def processor_s():
    """Seconds of all processors that ended calls took; between two of them that of one call, if it was alone."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def rows_of(path):
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def shown(point, values):
    """The result as a table sees it."""
    return Report(values) if point.kind in ("run", "view") else values["rows"]


def probe_of(point, values, seconds):
    """(seconds, what to run, what it gives) of the cheapest part of a point; None if it has none."""
    if point.kind == "sweep":
        if not values["rows"]:
            return None
        cheapest = min(range(len(values["rows"])), key=lambda index: values["seconds"][index])
        row = values["rows"][cheapest]
        return values["seconds"][cheapest], {**fields(point), "row": row["point"]}, numbers(row, PROBED_ROW)
    if point.kind == "accuracy":
        return None
    return seconds / max(1, point.runs), fields(point), probed(point, values)


def fields(point):
    """A point as JSON has it, without what it does not say."""
    return {name: value for name, value in dataclasses.asdict(dataclasses.replace(point, runs=0)).items() if value}


def probed(point, values):
    report = Report(values["view"] if point.kind == "view" else values)
    names = PROBED_VIEW if point.kind == "view" else PROBED
    return numbers({name: report[name] for name in names if name in report}, names)


def numbers(values, names):
    """Counts as they are, and other numbers with six digits: more may depend on the compiler."""
    found = {name: float(values[name]) for name in names if values.get(name) not in (None, "")}
    return {name: int(value) if value.is_integer() else float(f"{value:.6g}")
            for name, value in found.items() if abs(value) < float("inf")}


def point_of(probe):
    words = {name: tuple(value) if isinstance(value, list) else value for name, value in probe.items() if name != "row"}
    return Point(**{"source": "", **words})


def small_probe(probe):
    """(seconds, what to run, what it gives) of the same design and keys on a tiny view, in place of a long probe."""
    small = fields(point_of(probe).quick())
    if "row" in probe:
        small["row"] = probe["row"]
    began = time.monotonic()
    values = probed_again(small)
    return time.monotonic() - began, small, values


def probed_again(probe):
    """What a probe gives now."""
    point = point_of(probe)
    if "row" not in probe:
        return probed(point, once(point, 1))
    with tempfile.TemporaryDirectory(prefix="degs-measure-") as folder:
        listed = call([*point.words(), "--list"], warn=False).splitlines()
        count = max(int(line.split()[0]) for line in listed if line.split()[:1] and line.split()[0].isdigit())
        call([*point.words(), "--shard", f"{probe['row']}/{count}", "--out", folder], progress=False, warn=False)
        subprocess.run([program(), *point.words(), "--collect", "--out", folder], check=False,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        rows = [row for row in rows_of(pathlib.Path(folder, "results.csv")) if row["point"] == probe["row"]]
    return numbers(rows[0], PROBED_ROW) if rows else {}
