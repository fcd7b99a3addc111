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
import tempfile
import time

import yaml

from .options import for_program, path_of
from .scenes import ROOT, files_of, scene_file
from degs.design import Design, texts_of
from degs.process import call
from degs.report import Report

FIVE = ("flowers", "guitar", "seal", "skull", "st-peter")  # scenes of most means
HEIGHTS = {"720p": 720, "1080p": 1080, "2k": 1440, "4k": 2160, "8k": 4320}
TINY_SCENE = "synthetic:object,gaussians=500"
TINY_PATH = "tests/random/cameras.json:2"


@dataclasses.dataclass(frozen=True)
class Point:
    """One call: `kind` is run, view, accuracy, speed, sweep or search. `source` is a design of configs or a study of
    configs/studies; `runs` is how often a run is repeated, one after the other, where its times count."""

    kind: str
    source: str
    scene: str = ""
    options: tuple = ()
    keys: tuple = ()
    runs: int = 0

    def is_timed(self):
        """Times of the result count, so nothing else may run beside it."""
        return self.runs > 0 or self.kind == "speed"

    def is_parallel(self):
        """It has processes of its own, one for each processor."""
        return self.kind in ("sweep", "search")

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
        if self.kind == "speed":
            return ["accuracy", *scene, *self.options, *keys, "--speed", design_file(self.source)]
        command = "explore" if self.kind == "search" else "sweep"
        return [command, str(ROOT / f"configs/studies/{self.source}.yaml"), *scene, *self.options, *keys]

    def designs(self):
        """Designs and changed keys whose values the result depends on."""
        if self.kind in ("run", "speed"):
            return [(design_file(self.source), self.keys)]
        return [(file, ()) for file in study_designs(self.source)] if self.is_parallel() else []

    def key(self):
        """What names the point in files."""
        return hashlib.sha256(json.dumps(dataclasses.astuple(self)).encode()).hexdigest()[:20]

    def quick(self):
        """A small point in its place, which shows that a table can be made. A study keeps its cameras and the heights
        of its images, which tables ask for."""
        sized = ("--resolution", "--width", "--height", "--camera", "--frames", "--crop")
        if self.kind == "sweep":
            sized = ("--resolution", "--frames")
        if self.kind == "search":
            sized = (*sized, "--scene")
        options, skip = [], False
        for word in self.options:
            if not skip and word not in sized:
                options.append(word)
            skip = word in sized
        if self.kind == "accuracy":
            options += ["--resolution", "720p"]
        if self.kind in ("run", "view", "speed", "search"):
            options += ["--width", "160", "--camera", "1"]
        if self.kind == "search":
            options += ["--scene", TINY_SCENE]
        if self.kind == "sweep":
            named = dict(zip(self.options, self.options[1:])).get("--resolution", study_resolutions(self.source))
            options += ["--resolution", ",".join(f"32x{HEIGHTS[name]}" for name in named.split(","))]
        if "--frames" in self.options and self.kind != "view":
            options += ["--frames", "3"]
        scene = TINY_SCENE if self.scene else ""
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


def speed(design, scene, options, *keys):
    """Runs of a design in several fidelities and number sets, with their times and errors: speed.json."""
    return Point("speed", design, scene, tuple(options.split()), keys)


def search(study, options):
    """Designs that `degs explore` finds in a study: explore.json. Scenes are options, as there may be several; all are
    synthetic."""
    return Point("search", study, "", tuple(options.split()))


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
def values_of(file, keys, without=""):
    """All keys of a design with their values, as the program resolves them; not what it says of their meaning."""
    changes = [word for key in keys for word in ("--set", key)]
    values = texts_of(call(["config", file, *changes, "--format", "yaml"], warn=False))
    *sections, name = without.split(".")
    section = values
    for each in sections:
        section = section.get(each, {})
    section.pop(name, None)
    return json.dumps(values, sort_keys=True)


def depends_on(point, without=""):
    """Texts of all that the result depends on but the program: values of keys, but for one of them, the scene, and the
    words."""
    if point.scene:
        yield from map(content, files_of(point.scene))
    if "--path" in point.options:
        yield content(path_of(point.options)[0])
    if point.is_parallel():
        file, study = study_of(point.source)
        yield json.dumps(study, sort_keys=True)
        designs = {design["include"] for design in study["designs"]}
        for name in sorted(set(included(study)) - designs):
            yield json.dumps(yaml.safe_load((file.parent / name).read_text(encoding="utf-8")), sort_keys=True)
    for design in point.designs():
        yield values_of(*design, without)
    for word in point.options:
        if word.startswith("configs/"):
            yield content(str(ROOT / word))
    yield json.dumps([point.kind, point.scene, point.options, point.keys if point.is_parallel() else (), point.runs])


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
        if point.kind == "search":
            call([*point.words(), "--jobs", str(jobs), "--out", folder], progress=False, warn=False)
            return json.loads(pathlib.Path(folder, "explore.json").read_text(encoding="utf-8"))
        words = for_program(point.words(), folder)
        before = processor_s()
        call([*words, "--out", folder], warn=False)
        used = processor_s() - before
        if point.kind == "accuracy":
            return {"rows": json.loads(pathlib.Path(folder, "accuracy.json").read_text(encoding="utf-8"))}
        name = "analytic.json" if "analytic" in point.options else "report.json"
        if point.kind == "speed":
            name = "speed.json"
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
    if point.kind in ("accuracy", "sweep"):
        return values["rows"]
    return Report(values) if point.kind in ("run", "view") else values
