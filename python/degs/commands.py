# SPDX-License-Identifier: Apache-2.0
"""The other commands of the program as functions: their options are arguments, their JSON is a report."""

import json
import tempfile
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Dict, Iterable, Iterator, List, Mapping, Optional, Sequence, Tuple, Union

import pandas

from .design import Design, flat, text_of
from .process import Error, PathLike, call, configurations
from .process import near as near_names
from .report import Report, changed, options_of
from .studies import Designs, designs_of, joined, processors

Texts = Union[None, str, Sequence[str]]
Keys = Optional[Mapping[str, Any]]
MEMORIES = "memory"  # the folder of shipped memories


def table_of(rows: Iterable[Mapping[str, Any]]) -> pandas.DataFrame:
    """Objects of JSON as rows of a data frame; parts have dotted names, and "inf" is infinity."""
    def number(value: Any) -> Any:
        return float(value) if value in ("inf", "-inf") else value

    return pandas.DataFrame([{name: number(value) for name, value in flat(row)} for row in rows])


def sets(keys: Keys) -> List[str]:
    """Values of keys as options."""
    return options_of(set=[f"{path}={text_of(value)}" for path, value in (keys or {}).items()])


def named(designs: Designs) -> Tuple[List[str], List[str]]:
    """Designs as NAME=FILE, and their changes as options."""
    files, options = [], []
    for design in designs_of(designs):
        name, file = design.pop("name"), design.pop("include")
        files.append(f"{name}={file}")
        options += sets({f"{name}:{path}": value for path, value in flat(design)})
    return files, options


@contextmanager
def results(out: Optional[PathLike]) -> Iterator[Path]:
    """The folder of the results: `out`, or one that is removed afterwards."""
    if out is not None:
        yield Path(out)
        return
    with tempfile.TemporaryDirectory(prefix="degs-") as folder:
        yield Path(folder)


def document(folder: Path, name: str) -> Any:
    """A file of JSON among the results."""
    return json.loads((folder / name).read_text(encoding="utf-8"))


def kept(out: Optional[PathLike]) -> Optional[Path]:
    """The folder that the report names."""
    return None if out is None else Path(out)


def memory_file(config: PathLike) -> str:
    """The file of a memory: a path, or a shipped name such as "lpddr5-6400x256"."""
    name = str(config)
    if Path(name).name != name or Path(name).suffix or Path(name).is_file():
        return name
    folder = configurations() / MEMORIES
    if not (folder / f"{name}.yaml").is_file():
        names = sorted(path.stem for path in folder.glob("*.yaml"))
        raise Error(near_names(name, names, f"There is no memory '{name}', neither shipped nor as a file"))
    return str(folder / f"{name}.yaml")


def memory(config: PathLike, *, pattern: Optional[str] = None, request_bytes: Optional[int] = None,
           stride_bytes: Optional[int] = None, reads_per_write: Optional[int] = None, seed: Optional[int] = None,
           requests: Optional[int] = None, curve: bool = True, trace: Optional[PathLike] = None,
           trace_ghz: Optional[float] = None, keys: Keys = None, out: Optional[PathLike] = None) -> Report:
    """Measures a memory alone, as `degs memory` does: the report is memory.json, its table the load and the latencies.

    `config` is a file, or the name of a shipped memory. `keys` changes its keys."""
    words = options_of(pattern=pattern, request_bytes=request_bytes, stride_bytes=stride_bytes,
                       reads_per_write=reads_per_write, seed=seed, requests=requests,
                       no_curve=not curve, trace=trace, trace_ghz=trace_ghz)
    with results(out) as folder:
        printed = call(["memory", memory_file(config), *words, *sets(keys), "--out", str(folder)])
        values = document(folder, "memory.json")
    return Report(values, None, kept(out), printed, {"curve": table_of(values["curve"])})


def soc(design: Union[Design, PathLike], scene: PathLike, *, camera: Optional[int] = None,
        camera_file: Optional[PathLike] = None, width: Optional[int] = None, height: Optional[int] = None,
        resolution: Optional[str] = None, crop: Optional[str] = None, eyes: Optional[float] = None,
        units_per_metre: Optional[float] = None, views: Optional[Sequence[int]] = None,
        foveation: Optional[str] = None, memory: Optional[PathLike] = None,
        accelerator: Sequence[PathLike] = (), rate: Union[None, float, Sequence[float]] = None,
        qos: Union[None, int, Sequence[int]] = None, frames: Optional[int] = None, deadline: Optional[float] = None,
        load: Union[None, float, Sequence[float]] = None, cores: Optional[int] = None, pattern: Optional[str] = None,
        cores_qos: Optional[int] = None, display_qos: Optional[int] = None,
        reads_per_write: Optional[int] = None, refresh: Optional[float] = None, trace: Optional[PathLike] = None,
        trace_step: Optional[int] = None, keys: Keys = None, out: Optional[PathLike] = None,
        **top_keys: Any) -> Report:
    """Runs a design on a platform whose cores and display, and other accelerators, use the memory as well, as
    `degs soc` does: the report is soc.json, its table has a row for each load and rate. Views of a frame and keys of
    the design are given as for degs.run(); `accelerator` names or files of the others."""
    chosen = changed(design, keys, top_keys, soc)
    words = options_of(scene=scene, camera=camera, camera_file=camera_file, width=width, height=height,
                       resolution=resolution, crop=crop, eyes=eyes, units_per_metre=units_per_metre,
                       views=joined(views), foveation=foveation, memory=None if memory is None else memory_file(memory),
                       load=load, cores=cores, pattern=pattern, reads_per_write=reads_per_write, refresh=refresh,
                       accelerator=[str(Design(other).file) for other in accelerator] or None, rate=rate, qos=qos, frames=frames,
                       deadline=deadline, cores_qos=cores_qos, display_qos=display_qos, trace=trace,
                       trace_step=trace_step)
    with results(out) as folder:
        printed = call(["soc", *chosen.arguments(), *words, "--out", str(folder)])
        values = document(folder, "soc.json")
    return Report(values, None, kept(out), printed, {"points": table_of(values["points"])})


def scene(action: str, scene: PathLike, *, camera: Optional[int] = None, camera_file: Optional[PathLike] = None,
          width: Optional[int] = None, resolution: Optional[str] = None, preview: Optional[PathLike] = None,
          near: Optional[float] = None, projection: Optional[str] = None, lens: Optional[str] = None,
          gaussians: Optional[int] = None, seed: Optional[int] = None, copies: Optional[str] = None,
          out: Optional[PathLike] = None) -> Report:
    """`degs scene ACTION`: "info" reports what a scene, and with `camera` a view, has, and "cameras" its views, as a
    table, too. "generate" (a name such as "object"), "convert" and "tile" write the file `out`, which the report
    names."""
    words = options_of(camera=camera, camera_file=camera_file, width=width, resolution=resolution, preview=preview,
                       near=near, projection=projection, lens=lens, gaussians=gaussians, seed=seed, copies=copies)
    if action == "info":
        values = json.loads(call(["scene", action, str(scene), *words, *options_of(out=out), "--json"]))
        return Report(values, tables={"cameras": table_of(values["cameras"])})
    if action != "cameras":
        printed = call(["scene", action, str(scene), *words, *options_of(out=out)])
        return Report({"file": str(out)}, printed=printed)
    with tempfile.TemporaryDirectory(prefix="degs-") as folder:
        file = Path(folder) / "cameras.json" if out is None else Path(out)
        printed = call(["scene", action, str(scene), *words, "--out", str(file)])
        cameras = document(file.parent, file.name)
    return Report({"cameras": cameras}, printed=printed, tables={"cameras": table_of(cameras)})


def workload(action: str, designs: Designs, scene: Optional[PathLike] = None, *, camera: Optional[int] = None,
             camera_file: Optional[PathLike] = None, width: Optional[int] = None, height: Optional[int] = None,
             resolution: Optional[str] = None, crop: Optional[str] = None, workload: Optional[PathLike] = None,
             cache: bool = True, reference: bool = True, memory: Optional[PathLike] = None, keys: Keys = None,
             out: Optional[PathLike] = None) -> Report:
    """`degs workload ACTION`: "export" reports what the array of one design has to do, with the tables "lists" and
    "rows"; "pack" writes a view for several designs into the file `out`, which the report names.

    `keys` changes keys of the design, or of all."""
    words = options_of(scene=scene, camera=camera, camera_file=camera_file, width=width, height=height,
                       resolution=resolution, crop=crop, workload=workload, no_cache=not cache,
                       no_reference=not reference, memory=None if memory is None else memory_file(memory))
    if action != "export":
        files, changes = named(designs)
        printed = call(["workload", action, *files, *words, *changes, *sets(keys), *options_of(out=out)])
        return Report({"file": str(out)}, printed=printed)
    if not isinstance(designs, (str, Path, Design)):
        raise Error("A workload is exported for one design.")
    with results(out) as folder:
        design = designs if isinstance(designs, Design) else Design(designs)
        printed = call(["workload", action, *design.arguments(), *words, *sets(keys), "--out", str(folder)])
        values = document(folder, "workload.json")
        tables = {name: pandas.read_csv(folder / f"{name}.csv") for name in ("lists", "rows")}
    return Report(values, None, kept(out), printed, tables)


def motion(designs: Designs, scene: PathLike, *, camera: Optional[int] = None, camera_file: Optional[PathLike] = None,
           width: Optional[int] = None, height: Optional[int] = None, resolution: Optional[str] = None,
           crop: Optional[str] = None, poses: Optional[PathLike] = None, units_per_metre: Optional[float] = None,
           eyes: Optional[float] = None, in_scene: bool = False, between: Optional[int] = None,
           frames: Optional[int] = None, rates: Union[None, float, Sequence[float]] = None,
           fidelity: Optional[str] = None, array_only: bool = False, memory: Optional[PathLike] = None,
           keys: Keys = None, jobs: Optional[int] = None, out: Optional[PathLike] = None,
           progress: Optional[bool] = None) -> Report:
    """Latencies of designs along a path of the head, as `degs motion` does: the report is motion.json, and its tables
    are "displays", a row for each design and refresh rate, and "frames", a column of latencies for each design.

    `keys` changes keys of all designs, or of one as "NAME:span.count"."""
    files, changes = named(designs)
    words = options_of(scene=scene, camera=camera, camera_file=camera_file, width=width, height=height,
                       resolution=resolution, crop=crop, poses=poses, units_per_metre=units_per_metre, eyes=eyes,
                       in_scene=in_scene, between=between, frames=frames, rates=joined(rates), fidelity=fidelity,
                       array_only=array_only, memory=None if memory is None else memory_file(memory),
                       jobs=jobs or processors())
    with results(out) as folder:
        printed = call(["motion", *files, *words, *changes, *sets(keys), "--out", str(folder)], progress)
        values = document(folder, "motion.json")
        frame_table = pandas.read_csv(folder / "motion.csv")
    rows: List[Dict[str, Any]] = [
        {"design": design["name"], **{f"latency_ms.{name}": value for name, value in design["latency_ms"].items()},
         **display} for design in values["designs"] for display in design["displays"]]
    return Report(values, None, kept(out), printed, {"displays": pandas.DataFrame(rows), "frames": frame_table})


def accuracy(scene: Union[None, PathLike, Sequence[PathLike]] = None, *, numbers: Texts = None,
             camera: Optional[int] = None, camera_file: Optional[PathLike] = None, width: Optional[int] = None,
             height: Optional[int] = None, resolution: Texts = None, crop: Optional[str] = None,
             eyes: Optional[float] = None, units_per_metre: Optional[float] = None,
             views: Optional[Sequence[int]] = None, rules: Optional[str] = None, order: Optional[str] = None,
             antialiasing: Optional[str] = None, projection: Optional[str] = None, lens: Optional[str] = None,
             low_pass: Optional[float] = None, cut: Optional[float] = None, near: Optional[float] = None,
             span_ends: Optional[str] = None, tile_size: Optional[int] = None, products: Optional[str] = None,
             error_images: bool = True, single_gaussian: bool = False, splats: Optional[int] = None,
             seed: Optional[int] = None, hard_cases: bool = False, only: Texts = None,
             speed: Optional[Designs] = None, fidelities: Texts = None, seeds: Optional[int] = None,
             memory: Optional[PathLike] = None, keys: Keys = None, out: Optional[PathLike] = None) -> Report:
    """Measures number formats against double precision, as `degs accuracy` does: images of scenes, single Gaussians,
    `hard_cases`, or the `speed` of designs against their error. The table has a row for each measurement; `rows` (or
    `cases`) of the report are the objects of the JSON."""
    files, changes = ([], []) if speed is None else named(speed)
    words = options_of(scene=list(scene) if isinstance(scene, (list, tuple)) else scene, numbers=joined(numbers),
                       camera=camera, camera_file=camera_file, width=width, height=height,
                       resolution=joined(resolution), crop=crop, eyes=eyes, units_per_metre=units_per_metre,
                       views=joined(views), rules=rules, order=order, antialiasing=antialiasing,
                       projection=projection, lens=lens, low_pass=low_pass, cut=cut, near=near, span_ends=span_ends,
                       tile_size=tile_size, products=products, no_error_images=not error_images,
                       single_gaussian=single_gaussian, splats=splats, seed=seed, hard_cases=hard_cases,
                       only=joined(only), fidelities=joined(fidelities), seeds=seeds,
                       memory=None if memory is None else memory_file(memory))
    with results(out) as folder:
        printed = call(["accuracy", *(["--speed", *files] if files else []), *words, *changes, *sets(keys), "--out",
                        str(folder)])
        if files:
            values = document(folder, "speed.json")
            rows = values["rows"]
        elif hard_cases:
            values = {"cases": document(folder, "hard_cases.json")}
            rows = [{"case": case["case"], **measure} for case in values["cases"] for measure in case["measures"]]
        else:
            rows = document(folder, "accuracy.json")
            values = {"rows": rows}
    return Report(values, None, kept(out), printed, {"rows": table_of(rows)})
