#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""schema_test.py PROGRAM ROOT [FOLDER]: the JSON Schemas that the program prints accept every shipped file, refuse
files with one mistake each, and name the key of the mistake, which the program refuses and names as well. FOLDER has
the schemas as the build wrote them, which must be what the program prints. Exit code 1 if anything differs."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import jsonschema
import yaml


class Loader(yaml.SafeLoader):
    """YAML 1.2, as the program and the language server of editors read it; PyYAML alone takes `on` for true."""


Loader.yaml_implicit_resolvers = {}
Loader.add_implicit_resolver("tag:yaml.org,2002:null", re.compile(r"^(null|~|)$"), ["n", "~", ""])
Loader.add_implicit_resolver("tag:yaml.org,2002:bool", re.compile(r"^(true|false)$"), list("tf"))
Loader.add_implicit_resolver("tag:yaml.org,2002:int", re.compile(r"^-?[0-9]+$"), list("-0123456789"))
FLOAT = re.compile(r"^-?([0-9]+\.[0-9]*|\.[0-9]+|[0-9]+)([eE][-+]?[0-9]+)?$")
Loader.add_implicit_resolver("tag:yaml.org,2002:float", FLOAT, list("-.0123456789"))

# The kind of file, the key that is wrong, the mistake, and the text; ROOT: shipped files.
STUDY = "designs: [{ include: ROOT/degs-64.yaml, name: a }]\nscenes: synthetic:single\nwidth: 64\n"
WRONG = [
    ("design", "scheduler.bank", "unknown key", "scheduler: { bank: 4 }"),
    ("design", "schedular", "unknown section", "schedular: { banks: 4 }"),
    ("design", "accelerator", "unknown accelerator", "accelerator: gpu"),
    ("design", "packing.bytes", "word in place of a number", "packing: { bytes: many }"),
    ("design", "packing.bytes", "unit of another dimension", "packing: { bytes: 8MHz }"),
    ("design", "clock_ghz", "list in place of a number", "clock_ghz: [1, 2]"),
    ("design", "scheduler.banks", "above the range", "scheduler: { banks: 100000 }"),
    ("design", "gaussian_buffer.sort_share", "below the range", "gaussian_buffer: { sort_share: -0.5 }"),
    ("design", "scheduler.scan", "unknown word", "scheduler: { scan: newest }"),
    ("design", "slicing.skip_dead_rows", "no boolean", "slicing: { skip_dead_rows: maybe }"),
    ("design", "scheduler.banks", "real in place of an integer", "scheduler: { banks: 4.5 }"),
    ("design", "scheduler", "value in place of a section", "scheduler: 4"),
    ("design", "name", "no value", "name:"),
    ("design", "array.subtile_skip", "key of GSCore in a DeGS", "accelerator: degs\narray: { subtile_skip: none }"),
    ("design", "scheduler", "section of DeGS in GSCore", "accelerator: gscore\nscheduler: { banks: 4 }"),
    ("design", "dataflow", "key of another behind an include", "include: ROOT/gcc-64.yaml\narray: { dataflow: none }"),
    ("design", "x", "row of an accelerator that is not chosen", "accelerator: gscore\ncost: { degs: { x: 1 } }"),
    *(("numbers", "colour", "no number format", f"base: tuned\ncolour: {name}")
      for name in ("banana", "''", "fp33", "16", "true", "e9m3", "e1m3", "e4m24", "q8", "q8.", "xfp16", "uuq1.1")),
    ("design", "include", "no file", "include: [[]]\nname: a"),
    ("study", "baselines", "unknown key", STUDY + "baselines: a"),
    ("study", "combine", "unknown word", STUDY + "combine: all"),
    ("study", "frames", "below the range", STUDY + "frames: 0"),
    ("study", "resolutions", "unknown name", STUDY.replace("width: 64", "resolutions: [720p, 9k]")),
    ("study", "path_step", "key that 'quick' does not have", STUDY + "quick: { path_step: 1 }"),
    ("study", "name", "design without a name", "designs: [{ clock_ghz: 1 }]\nscenes: synthetic:single"),
    ("study", "packing.bites", "axis over no key", STUDY + "axes: { packing.bites: [1, 2] }"),
    ("study", "packing.bytes", "axis with a unit of another dimension", STUDY + "axes: { packing.bytes: [8MHz] }"),
    ("study", "packing.bytes", "range without a step", STUDY + "axes: { packing.bytes: 8KB..16KB }"),
    ("study", "scheduler.scan", "axis over an unknown word", STUDY + "axes: { scheduler.scan: [newest, oldest] }"),
    ("study", "pipeline.numbers", "axis over no number set", STUDY + "axes: { pipeline.numbers: [fp32, papr] }"),
    ("study", "valves", "unknown key in an axis", STUDY + "axes: { a: { keys: [packing.bytes], valves: [1] } }"),
    ("study", "packing.bites", "joint axis over no key", STUDY + "axes: { a: { keys: { packing.bites: [1, 2] } } }"),
    ("study", "designs", "no list", "designs: a\nscenes: synthetic:single"),
    ("study", "scheduler.bank", "unknown key of a design", STUDY.replace("name: a", "name: a, scheduler: { bank: 2 }")),
    ("memory", "chanels", "unknown key", "chanels: 4"),
    ("memory", "channels", "above the range", "channels: 1000"),
    ("memory", "refresh", "unknown word", "controller: { refresh: never }"),
    ("technology", "nodes", "unknown key", "nodes: 7"),
    ("technology", "area_factor", "below the range", "area_factor: -1"),
    ("technology", "units", "word in a row", "degs: { projection: { units: few } }"),
    ("design", "numbers", "no number set", "pipeline: { numbers: banana }"),
    ("design", "numbers", "part without a value", "pipeline: { numbers: 'tuned:alpha' }"),
    ("design", "formats", "key that is no more", "pipeline: { formats: { alpha: fp16 } }"),
    ("numbers", "base", "no base", "alpha: fp16"),
    ("numbers", "base", "unknown base", "base: banana"),
    ("numbers", "colours", "unknown part", "base: tuned\ncolours: fp16"),
    ("numbers", "entries", "above the range", "base: tuned\nexp: { entries: 5000 }"),
]
# What shipped files do not use, and both accept.
RIGHT = [
    ("design", "packing: { bytes: 8KB }\nclock_ghz: 750MHz\nname: 64\nslicing:"),
    ("design", "include: [ROOT/gscore-64.yaml, ROOT/gscore-64.yaml]\narray: { subtile_skip: none }"),
    ("design", "accelerator: gscore\ncost: { include: ROOT/cost/28nm.yaml, degs: { packing_scheduler: { units: 4 } } }"),
    ("study", STUDY),
    ("study", STUDY.replace("width: 64", "resolutions: [720p, 4K]\ncameras: 0")),
    ("study", STUDY + "axes: { packing.bytes: x1/2..x2 x2 }"),
    ("study", STUDY + "axes: { s: { random: 2, seed: 7, keys: { memory.latency_ns: 20..200 log } } }"),
    ("study", STUDY + "axes: { pipeline.numbers: [fp32, 'paper:alpha=uq1.15'] }"),
    ("study", STUDY + "axes: { b: { keys: [packing.bytes, span_buffer.bytes], values: x1..x2 x2 } }"),
    ("study", STUDY + "axes: { array.writeback_cycles: 2..8 +1, scheduler.termination: [segment, pixel] }"),
    ("memory", "channels: 8\ncontroller_latency_ns: 20ns"),
    ("technology", "node: 7 nm\narea_factor: 0.1\ngscore: { sorting_share: 0.1 }"),
    ("design", "pipeline: { numbers: 'tuned:alpha=uq1.15:exp.entries=32' }"),
    ("numbers", "base: tuned\nalpha: uq1.15\nexp: { entries: 32 }\nq_mask: true"),
    ("numbers", "base: paper:records=tuned:guard=0.5"),
]


def wrapped(kind, file):
    """The command with which the program reads a file, which it finds in a design where it is none itself."""
    if kind == "study":
        return ["sweep", str(file), "--list"]
    if kind == "design":
        return ["config", str(file)]
    design = file.with_name("design.yaml")
    section = {"memory": "memory: { model: lpddr5, lpddr5: { include: %s } }", "technology": "cost: { include: %s }",
               "numbers": "pipeline: { numbers: %s }"}
    design.write_text(section[kind] % file.name + "\n", encoding="utf-8")
    return ["config", str(design)]


def leaves(error):
    return [leaf for part in error.context for leaf in leaves(part)] if error.context else [error]


def names(error, key):
    """Whether an error is about a key: it lies there, or its sentence has the name."""
    last = key.split(".")[-1]
    words = {key, last}
    return any(words & {str(part) for part in leaf.absolute_path} or
               any(f"'{word}'" in leaf.message for word in words) for leaf in leaves(error))


def main():
    program, root = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    faults = 0

    def fault(text):
        nonlocal faults
        faults += 1
        print(text)

    validators = {}
    for kind in ("design", "study", "memory", "technology", "numbers"):
        text = subprocess.run([program, "config", "--schema", kind], check=True, capture_output=True, text=True).stdout
        schema = json.loads(text)
        jsonschema.Draft202012Validator.check_schema(schema)
        validators[kind] = jsonschema.Draft202012Validator(schema)
        if len(sys.argv) > 3 and (pathlib.Path(sys.argv[3]) / f"{kind}.json").read_text(encoding="utf-8") != text:
            fault(f"{kind}.json is not what the program prints")
    shipped = 0
    folders = {"design": ("", "readings"), "study": ("studies",), "memory": ("memory",), "technology": ("cost",)}
    for kind, places in folders.items():
        for file in sorted(file for place in places for file in (root / place).glob("*.yaml")):
            shipped += 1
            for error in validators[kind].iter_errors(yaml.load(file.read_text(encoding="utf-8"), Loader)):
                for leaf in leaves(error):
                    fault(f"{file}: {'.'.join(map(str, leaf.absolute_path))}: {leaf.message[:300]}")
    for accelerator in ("degs", "gscore", "gbu", "gcc", "orange"):  # complete files, with every key
        text = subprocess.run([program, "config", accelerator, "--format", "yaml"], check=True, capture_output=True,
                              text=True).stdout
        for error in validators["design"].iter_errors(yaml.load(text, Loader)):
            fault(f"all keys of {accelerator}: {list(error.absolute_path)}: {error.message[:300]}")
    with tempfile.TemporaryDirectory() as folder:
        for kind, text in RIGHT:
            file = pathlib.Path(folder) / "right.yaml"
            file.write_text(text.replace("ROOT", str(root)) + "\n", encoding="utf-8")
            for error in validators[kind].iter_errors(yaml.load(file.read_text(encoding="utf-8"), Loader)):
                fault(f"{kind}: the schema refuses {text!r}: {[leaf.message[:200] for leaf in leaves(error)][:4]}")
            run = subprocess.run([program, *wrapped(kind, file)], capture_output=True, text=True, check=False)
            if run.returncode != 0:
                fault(f"{kind}: the program refuses {text!r}: {run.stderr.strip()}")
        for kind, key, what, text in WRONG:
            file = pathlib.Path(folder) / "wrong.yaml"
            file.write_text(text.replace("ROOT", str(root)) + "\n", encoding="utf-8")
            errors = list(validators[kind].iter_errors(yaml.load(file.read_text(encoding="utf-8"), Loader)))
            if not errors:
                fault(f"{kind}, {what}: the schema accepts {text!r}")
            elif not all(names(error, key) for error in errors):
                told = [leaf.message[:150] for error in errors for leaf in leaves(error)]
                fault(f"{kind}, {what}: the schema does not name '{key}': {told[:6]}")
            run = subprocess.run([program, *wrapped(kind, file)], capture_output=True, text=True, check=False)
            if run.returncode == 0:
                fault(f"{kind}, {what}: the program accepts {text!r}")
            elif key not in run.stderr:
                fault(f"{kind}, {what}: the program does not name '{key}': {run.stderr.strip()}")
    print(f"{shipped} shipped files, {len(WRONG)} wrong ones, {faults} faults")
    sys.exit(faults != 0)


if __name__ == "__main__":
    main()
