# SPDX-License-Identifier: Apache-2.0
"""Studies: sweeps, searches and comparisons as data frames with the columns of the program's own tables."""

import copy
import json
import os
import tempfile
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Dict, Iterator, List, Mapping, Optional, Sequence, Union

import pandas
import yaml

from .design import Design, file_of, keys_of, schema
from .process import Error, PathLike, call
from .report import changed, options_of, run

Axes = Mapping[str, Any]
Designs = Union[Design, PathLike, Sequence[Union[Design, PathLike]], Mapping[str, Union[Design, PathLike]]]


def statistics(design: Union[Design, PathLike, None] = None, of: str = "run") -> pandas.DataFrame:
    """`unit` and `meaning` of every statistic: of a run of `design` (default degs-64), or with of="compare" the columns
    of studies and comparisons, or with of="memory" those of `degs memory`."""
    words: List[str] = []
    if of == "run":
        words = (design if isinstance(design, Design) else Design("degs-64" if design is None else design)).arguments()
    table = call(["config", *words, "--stats", "--of", of, "--format", "markdown"], warn=False)
    cells = [[cell.strip() for cell in line.strip("|\n ").split("|", 2)] for line in table.splitlines()[2:]]
    rows = [(name.strip("`"), unit, meaning) for name, unit, meaning in (row for row in cells if len(row) == 3)]
    return pandas.DataFrame(rows, columns=["key", "unit", "meaning"]).set_index("key")


def table(file: Path, attributes: Mapping[str, Any]) -> pandas.DataFrame:
    """A table of the program; numbers are numbers, and what does not exist is NaN.

    attrs["units"] has the units of measures, attrs["meanings"] the descriptions of varied keys, which name theirs."""
    frame = pandas.read_csv(file, keep_default_na=False, na_values=[""], float_precision="round_trip")
    known = statistics(of="compare")["unit"]
    units = {name: known[name] for name in frame.columns if known.get(name)}
    units.update({name: "share" for name in frame.columns if name.startswith("stages.") and name.endswith(".busy")})
    units.update({name: "px" for name in ("width", "height", "tile_size") if name in frame.columns})
    meanings = {name: key["description"] for accelerator in frame.get("accelerator", pandas.Series(["degs"])).unique()
                for name, key in keys_of(schema()["$defs"][accelerator]) if name in frame.columns}
    frame.attrs.update({"units": units, "meanings": meanings, **attributes})
    return frame


@contextmanager
def folder_of(out: Optional[PathLike]) -> Iterator[Path]:
    """The folder of results: `out`, or one that is removed afterwards."""
    if out is not None:
        yield Path(out)
        return
    with tempfile.TemporaryDirectory(prefix="degs-") as folder:
        yield Path(folder) / "results"


class Study:
    """A study: a file, or a mapping with the keys of docs/studies.md#keys-of-a-study.

    In a mapping, paths are relative to the current folder, and `designs` may have Designs and shipped names. `jobs` is
    the number of simulations at a time. With `out`, finished points are kept there: a call that was interrupted, even
    by kill -9, or a study with further values goes on. Every method raises Error with the program's sentence."""

    def __init__(self, source: Union[PathLike, Mapping[str, Any]]) -> None:
        self._file: Optional[Path] = None
        self._values: Dict[str, Any] = {}
        if isinstance(source, Mapping):
            self._values = absolute({**source, "designs": designs_of(source.get("designs", source.get("points", [])))})
            self._values.pop("points", None)
        else:
            self._file = Path(source).expanduser().absolute()

    def yaml(self) -> str:
        """The text of the study."""
        if self._file is not None:
            try:
                return self._file.read_text(encoding="utf-8")
            except OSError as problem:
                raise Error(f"The study '{self._file}' cannot be read: {problem.strerror}.") from None
        return str(yaml.safe_dump(self._values, sort_keys=False, allow_unicode=True, width=float("inf")))

    @contextmanager
    def _written(self) -> Iterator[str]:
        if self._file is not None:
            yield str(self._file)
            return
        with tempfile.TemporaryDirectory(prefix="degs-") as folder:
            file = Path(folder) / f"{self._values.get('study', 'study')}.yaml".replace(os.sep, "-")
            file.write_text(self.yaml(), encoding="utf-8")
            yield str(file)

    def points(self, **options: Any) -> List[str]:
        """The points, one line of text each; runs none of them."""
        with self._written() as file:
            return call(["sweep", file, *study_options(options), "--list"], warn=False).splitlines()

    def sweep(self, *, jobs: Optional[int] = None, out: Optional[PathLike] = None, progress: Optional[bool] = None,
              **options: Any) -> pandas.DataFrame:
        """Runs every point: a row for each, with the columns of results.csv (docs/studies.md#files).

        `options` are those of `degs sweep`, as scene=, camera=, width=, keys= (--set), quick=True, fidelity="analytic".
        attrs: `units`, `keys` (the varied ones), and `skipped`, the points that cannot be built, with the reason."""
        with self._written() as file, folder_of(out) as folder:
            with finished(folder / "results.csv", read_sweep):
                call(["sweep", file, *study_options(options), *options_of(jobs=jobs or processors(), out=folder)],
                     progress)
            return read_sweep(folder / "results.csv")

    def explore(self, goals: Union[None, str, Sequence[str]] = None, limits: Union[None, str, Sequence[str]] = None, *,
                jobs: Optional[int] = None, out: Optional[PathLike] = None, progress: Optional[bool] = None,
                **options: Any) -> pandas.DataFrame:
        """Searches the study for the designs that none beats: the rows of front.csv (docs/explore.md#files).

        `goals` and `limits` are texts such as "area_mm2" and "latency_ms<=2"; `on_front` and `baseline` are booleans.
        attrs: `units`, `goals`, `better` for each goal, `correlations` of estimates and simulations (None
        where nothing was estimated), `skipped`."""
        with self._written() as file, folder_of(out) as folder:
            words = options_of(goals=joined(goals), limits=joined(limits), jobs=jobs or processors(), out=folder)
            call(["explore", file, *study_options(options), *words], progress)
            said = json.loads((folder / "explore.json").read_text(encoding="utf-8"))
            frame = table(folder / "front.csv", {
                "goals": said["goals"], "better": said["better"], "skipped": said["skipped"],
                "correlations": said.get("estimates", {}).get("rank_correlation")})
            for name in ("on_front", "baseline"):
                frame[name] = frame[name].astype(bool)
            return frame

    def compare(self, *, jobs: Optional[int] = None, out: Optional[PathLike] = None, progress: Optional[bool] = None,
                **options: Any) -> pandas.DataFrame:
        """Compares the designs of a study without axes, as compare() does."""
        with self._written() as file:
            return compared([file], jobs, out, progress, options)

    def bandwidth(self, *, jobs: Optional[int] = None, out: Optional[PathLike] = None,
                  progress: Optional[bool] = None, **options: Any) -> pandas.DataFrame:
        """The bandwidth from which memory does not limit a design: a row for each design and view of a study without
        axes, with the keys of `thresholds` in bandwidth.json (docs/sizing.md)."""
        with self._written() as file, folder_of(out) as folder:
            words = options_of(jobs=jobs or processors(), out=folder)
            call(["bandwidth", file, *study_options(options), *words], progress)
            return pandas.DataFrame(json.loads((folder / "bandwidth.json").read_text(encoding="utf-8"))["thresholds"])

    def buffers(self, lose: Optional[float] = None, *, jobs: Optional[int] = None, out: Optional[PathLike] = None,
                progress: Optional[bool] = None, **options: Any) -> pandas.DataFrame:
        """The smallest buffers of a design that lose at most `lose` percent (1) on every view: a row for each buffer
        (docs/sizing.md). attrs: the other keys of buffers.json, such as `settings` for Design.with_()."""
        with self._written() as file, folder_of(out) as folder:
            words = options_of(lose=lose, jobs=jobs or processors(), out=folder)
            call(["buffers", file, *study_options(options), *words], progress)
            found = json.loads((folder / "buffers.json").read_text(encoding="utf-8"))
            frame = pandas.DataFrame(found.pop("buffers")).astype({"bytes": int, "smallest_bytes": int})
            pairs = [setting.split("=", 1) for setting in found["settings"]]
            found["settings"] = {key: int(count) for key, count in pairs}
            frame.attrs.update(found)
            return frame

    def __repr__(self) -> str:
        return f"Study({self._file or self._values.get('study', 'study')})"


def read_sweep(file: Path) -> pandas.DataFrame:
    """The results of a sweep."""
    said = json.loads(file.with_name("results.json").read_text(encoding="utf-8"))
    return table(file, {"keys": said["keys"], "skipped": said["skipped"], "failed": said["failed"]})


@contextmanager
def finished(file: Path, read: Any) -> Iterator[None]:
    """Gives an Error inside the points that did finish, as `results`."""
    before = file.stat().st_mtime_ns if file.is_file() else None
    try:
        yield
    except Error as error:
        if file.is_file() and file.stat().st_mtime_ns != before:
            error.results = read(file)
        raise


def sweep(design: Designs, axes: Axes, scenes: Union[PathLike, Sequence[PathLike]], *,
          cameras: Union[None, int, str, Sequence[int]] = None, width: Optional[int] = None,
          resolutions: Union[None, str, Sequence[str]] = None, combine: str = "product", name: str = "study",
          reference: bool = True, jobs: Optional[int] = None, out: Optional[PathLike] = None,
          progress: Optional[bool] = None, **study: Any) -> pandas.DataFrame:
    """Varies keys of one or several designs; a row for each point, as Study.sweep() returns it.

    `axes` has lists, ranges or linked keys as in docs/studies.md#axes: {"span.count": [4, 8, 16], "packing.bytes":
    "8KB..32KB x2"}. `study` has further keys of a study, such as camera_file, frames, eyes, views, crop, fidelity or
    baseline; cameras are the first of each scene by default."""
    views: Dict[str, Any] = {"cameras": cameras, "width": width, "resolutions": resolutions, **study}
    values = {"study": name, "designs": design, "axes": axes, "combine": combine, "scenes": scenes,
              "reference": reference, **{key: value for key, value in views.items() if value is not None}}
    return Study(values).sweep(jobs=jobs, out=out, progress=progress)


def compare(designs: Designs, scene: Union[None, PathLike, Sequence[PathLike]] = None, *, jobs: Optional[int] = None,
            out: Optional[PathLike] = None, progress: Optional[bool] = None, **options: Any) -> pandas.DataFrame:
    """Compares designs on the same frames with the first of them: a row for each run, with the columns of compare.csv
    (docs/compare.md#files). `options` are those of `degs compare`: camera=, width=, resolution=, frames=, eyes=, ...

    Names are those of the designs; a mapping from names to designs gives others."""
    views = {"scene": scene, **options}
    return Study({"designs": designs}).compare(jobs=jobs, out=out, progress=progress, **views)


def bandwidth(designs: Designs, scenes: Union[PathLike, Sequence[PathLike]], *, jobs: Optional[int] = None,
              out: Optional[PathLike] = None, progress: Optional[bool] = None, **views: Any) -> pandas.DataFrame:
    """Study.bandwidth() of designs on views such as camera=2, resolution="1080p"."""
    return Study({"designs": designs, "scenes": scenes}).bandwidth(jobs=jobs, out=out, progress=progress, **views)


def buffers(design: Designs, scenes: Union[PathLike, Sequence[PathLike]], lose: Optional[float] = None, *,
            jobs: Optional[int] = None, out: Optional[PathLike] = None, progress: Optional[bool] = None,
            **views: Any) -> pandas.DataFrame:
    """Study.buffers() of a design on views such as cameras=[0, 2], width=640."""
    return Study({"designs": design, "scenes": scenes}).buffers(lose, jobs=jobs, out=out, progress=progress, **views)


def results(folder: PathLike) -> pandas.DataFrame:
    """The runs that a sweep, a search, bandwidth() or buffers() kept in `out`, as Study.sweep() returns them. Of a call
    with several designs or views, bandwidth() names the folder of each as `runs`."""
    file = Path(folder) / "results.csv"
    if not file.is_file():
        raise Error(f"There are no results in the folder '{folder}': sweeps, searches, bandwidth and buffers keep them.")
    return read_sweep(file)


def gains(design: Union[Design, PathLike], scene: Union[None, PathLike] = None, *, jobs: Optional[int] = None,
          progress: Optional[bool] = None, keys: Optional[Mapping[str, Any]] = None, **view: Any) -> pandas.DataFrame:
    """What the largest losses of a design would gain, beside runs of the changed designs: a row for each of the `gains`
    of a report (docs/report.md#gains).

    `gain` is the named share of the cycles, with the interval `low` to `high`, and `measured` that of a run with the
    `change`. `view` are camera=, width= or resolution= and so on, as in both degs.run() and degs.compare().
    attrs["cycles"] has the cycles of the design as it is."""
    chosen = changed(design, keys, {}, gains)
    before = run(chosen, scene, reference=False, **view)
    named = before.to_dict().get("gains", [])
    changes = list(dict.fromkeys(each["change"] for each in named))
    after: Dict[str, float] = {}
    if changes:
        runs = compare([chosen.with_settings(change) for change in changes], scene, jobs=jobs, progress=progress,
                       reference=False, **view)
        after = dict(zip(changes, runs["cycles"]))
    rows = [(each["reason"], each["change"], each["gain"], *each["interval"], 1 - after[each["change"]] / before.cycles)
            for each in named]
    frame = pandas.DataFrame(rows, columns=["reason", "change", "gain", "low", "high", "measured"])
    frame.attrs["cycles"] = before.cycles
    return frame


def compared(words: Sequence[str], jobs: Optional[int], out: Optional[PathLike], progress: Optional[bool],
             options: Mapping[str, Any]) -> pandas.DataFrame:
    """Calls `degs compare`."""
    with folder_of(out) as folder:
        with finished(folder / "compare.csv", lambda file: table(file, {})):
            last = options_of(jobs=jobs or processors(), out=folder)
            call(["compare", *words, *study_options(options), *last], progress)
        return table(folder / "compare.csv", {})


def processors() -> int:
    """Simulations at a time, where nothing is said: one for each processor that this process may use."""
    return min(256, len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1)


def joined(value: Any) -> Any:
    """Several values as the program takes them behind one option."""
    return ",".join(str(each) for each in value) if isinstance(value, (list, tuple)) else value


def study_options(options: Mapping[str, Any]) -> List[str]:
    """Options of sweep, explore and compare from arguments."""
    given = dict(options)
    if "reference" in given:
        given["no_reference"] = not given.pop("reference")
    keys = given.pop("keys", None) or {}
    for name in ("camera", "cameras", "resolution", "resolutions"):
        if name in given:
            given[name.rstrip("s")] = joined(given.pop(name))
    if "views" in given:
        given["views"] = joined(given.pop("views"))
    words = options_of(**{name: value for name, value in given.items() if value is not None})
    return words + options_of(set=[f"{path}={value}" for path, value in keys.items()])


def designs_of(designs: Any) -> List[Dict[str, Any]]:
    """The list of designs of a study from Designs, shipped names, files and mappings."""
    if isinstance(designs, Mapping) and "include" not in designs:
        return [{**design_of(each), "name": name} for name, each in designs.items()]
    if isinstance(designs, (Design, str, os.PathLike, Mapping)):
        designs = [designs]
    return unique([design_of(each) for each in designs])


def design_of(design: Any) -> Dict[str, Any]:
    """One design of a study: the file that it includes, and what is changed."""
    if isinstance(design, Mapping):
        return dict(design)
    design = design if isinstance(design, Design) else Design(design)
    entry: Dict[str, Any] = {"include": str(design.file), "name": str(design["name"])}
    for path, value in design.changes.items():
        if path == "name":
            continue
        *sections, key = path.split(".")
        inner = entry
        for section in sections:
            inner = inner.setdefault(section, {})
        inner[key] = value
    return entry


def unique(entries: Sequence[Dict[str, Any]]) -> List[Dict[str, Any]]:
    """Entries with names of their own: the second degs-64 becomes degs-64-2."""
    taken: List[str] = []
    for entry in entries:
        name, number = entry.get("name"), 1
        if name is None:
            continue
        while entry["name"] in taken:
            number += 1
            entry["name"] = f"{name}-{number}"
        taken.append(entry["name"])
    return list(entries)


def absolute(study: Mapping[str, Any]) -> Dict[str, Any]:
    """A study whose paths do not depend on where it is written, of values that YAML knows."""
    values: Dict[str, Any] = plain(study)
    for section in (values, values.get("quick") or {}):
        for name in ("scenes", "scene"):
            if name in section:
                section[name] = each_path(section[name], lambda text: text.startswith("synthetic:"))
        if "camera_file" in section:
            section["camera_file"] = each_path(section["camera_file"])
    for entry in values["designs"]:
        if "include" in entry:
            entry["include"] = [str(file_of(file)) for file in listed(entry["include"])]
        place_numbers(entry.get("pipeline"), "numbers")
    for axis in [values.get("axes"), *(values.get("axes") or {}).values()]:
        place_numbers(axis, "pipeline.numbers")
        place_numbers(axis.get("keys") if isinstance(axis, dict) else None, "pipeline.numbers")
    return values


def place_numbers(section: Any, key: str) -> None:
    """Makes number files in a value of a section, or in a list of them, absolute."""
    if not isinstance(section, dict) or isinstance(section.get(key), (dict, type(None))):
        return
    placed = []
    for text in map(str, listed(section[key])):
        name, colon, parts = text.partition(":")
        placed.append((each_path(name) if "." in name or "/" in name else name) + colon + parts)
    section[key] = placed if isinstance(section[key], list) else placed[0]


def listed(value: Any) -> List[Any]:
    """A value as a list."""
    return value if isinstance(value, list) else [value]


def each_path(value: Any, keep: Any = lambda text: False) -> Any:
    """Paths made absolute."""
    paths = [text if keep(text) else os.path.abspath(os.path.expanduser(text)) for text in listed(value)]
    return paths if isinstance(value, list) else paths[0]


def plain(value: Any) -> Any:
    """A copy of lists and mappings that YAML can write: no tuples, arrays, numbers of numpy or paths."""
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    if isinstance(value, Mapping):
        return {str(key): plain(each) for key, each in value.items()}
    if isinstance(value, (list, tuple, range)):
        return [plain(each) for each in value]
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    return copy.copy(value)
