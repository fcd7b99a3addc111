# SPDX-License-Identifier: Apache-2.0
"""Compares the reports and images of two builds of `degs`; same_results.sh says how to call it."""
import argparse
import filecmp
import json
import os
import pathlib
import subprocess
import sys
import tempfile

SCENES = ("flowers", "skull", "garden-crop", "fruit-drops", "guitar", "seal", "st-peter")
MOST_LINES = 20  # of one run


def configs_of(program):
    """The folder `configs` above a program."""
    for folder in program.resolve().parents:
        if (folder / "configs" / "degs-64.yaml").exists():
            return folder / "configs"
    sys.exit(f"There is no folder 'configs' above {program}.")


def cases(quick):
    """The options of every run, besides the configuration."""
    scenes = pathlib.Path(os.environ["DEGS_SCENES"])
    yield ["--scene", "synthetic:object,gaussians=3000", "--camera", "2", "--width", "320", "--frames", "2",
           "--set", "memory.model=lpddr5"]
    for name in ("flowers-small",) if quick else ("flowers-small", *SCENES):
        scene = scenes / name / "scene.ply"
        if scene.exists():
            yield ["--scene", str(scene), "--camera", "1", "--width", "480"]
        else:
            print(f"{scene} is not there and is left out")


def run(program, config, options, folder):
    """The report without what may differ; None and the message if the run fails."""
    command = [program, "run", config, *options, "--out", folder]
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        return {"exit code": done.returncode, "message": done.stderr.strip()}
    report = json.loads((folder / "report.json").read_text())
    report.pop("host", None)
    report.pop("tool", None)
    return report


def differences(old, new, path=""):
    """A line for every key whose value differs."""
    if isinstance(old, dict) and isinstance(new, dict):
        for key in {**old, **new}:
            yield from differences(old.get(key, "(absent)"), new.get(key, "(absent)"), f"{path}.{key}".lstrip("."))
    elif isinstance(old, list) and isinstance(new, list) and len(old) == len(new):
        for i, pair in enumerate(zip(old, new)):
            yield from differences(*pair, f"{path}[{i}]")
    elif old != new:
        yield f"{path}: {json.dumps(old)[:90]} -> {json.dumps(new)[:90]}"


def compare(old, new, name, options, folder):
    """The lines about one configuration on one scene."""
    reports = [run(program, configs_of(program) / name, options, folder / side)
               for program, side in ((old, "old"), (new, "new"))]
    lines = list(differences(*reports))
    for image in ("image.exr", "image.png"):
        files = [folder / side / image for side in ("old", "new")]
        if all(file.exists() for file in files) and not filecmp.cmp(*files, shallow=False):
            lines.append(f"{image}: the files differ")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("old", type=pathlib.Path)
    parser.add_argument("new", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true", help="one trained scene only")
    parser.add_argument("--configs", nargs="*", help="names of files in configs/; all of them by default")
    arguments = parser.parse_args()
    names = arguments.configs or sorted(file.name for file in configs_of(arguments.old).glob("*.yaml"))
    runs = different = 0
    for options in cases(arguments.quick):
        for name in names:
            runs += 1
            with tempfile.TemporaryDirectory() as folder:
                lines = compare(arguments.old, arguments.new, name, options, pathlib.Path(folder))
            if lines:
                different += 1
                print(f"configs/{name} {' '.join(options)}")
                print("".join(f"    {line}\n" for line in lines[:MOST_LINES]), end="")
                if len(lines) > MOST_LINES:
                    print(f"    and {len(lines) - MOST_LINES} more")
                sys.stdout.flush()
    print(f"{runs} runs, {different} differ")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
