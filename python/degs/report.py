# SPDX-License-Identifier: Apache-2.0
"""One run and its report: numbers as attributes, the picture as an array."""

import base64
import copy
import difflib
import html
import inspect
import io
import json
import tempfile
from pathlib import Path
from typing import Any, Callable, Dict, Iterator, List, Mapping, Optional, Sequence, Tuple, Union

import numpy
import pandas
from PIL import Image

from .design import Design, flat, text_of
from .process import Error, Missing, PathLike, call, near


class Node:
    """A section of a report. Keys are attributes and items; `node.a.b` is `node["a.b"]`.

    Units are those of docs/report.md, and `degs.statistics()` lists them. A number that does not exist is None."""

    def __init__(self, values: Mapping[str, Any], path: str = "") -> None:
        self._values = dict(values)
        self._path = path

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return self._get(name)

    def __getitem__(self, path: str) -> Any:
        if not isinstance(path, str):
            raise Missing(f"A part has a name, as in report['timing.cycles'], and {path!r} is none.")
        value: Any = self
        names = path.split(".")
        for index, name in enumerate(names):
            if not isinstance(value, Node):
                raise Missing(f"'{'.'.join(names[:index])}' has no parts, and so no '{name}'.")
            value = value._get(name)
        return value

    def _get(self, name: str) -> Any:
        if name not in self._values:
            where = f"'{self._path}'" if self._path else "the report"
            raise Missing(near(name, list(self._values), f"'{name}' does not exist in {where}")) from None
        return wrapped(self._values[name], f"{self._path}.{name}" if self._path else name)

    def __contains__(self, path: str) -> bool:
        try:
            self[path]
        except Missing:
            return False
        return True

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __dir__(self) -> List[str]:
        return sorted({*object.__dir__(self), *(name for name in self._values if name.isidentifier())})

    def __repr__(self) -> str:
        return "\n".join(f"{key}: {value}" for key, value in flat(self._values))

    def to_dict(self) -> Dict[str, Any]:
        """The section as the JSON has it."""
        return copy.deepcopy(self._values)

    def to_series(self) -> "pandas.Series[Any]":
        """Every number and text of the section, with dotted names."""
        return pandas.Series(dict(flat(self._values)), dtype=object)


def wrapped(value: Any, path: str) -> Any:
    """A value of the JSON: sections as nodes, "inf" as infinity."""
    if isinstance(value, dict):
        return Node(value, path)
    if isinstance(value, list):
        return [wrapped(each, f"{path}.{index}") for index, each in enumerate(value)]
    return float(value) if value in ("inf", "-inf") else value


class Report(Node):
    """The report of a run: the sections of report.json, and the keys of `timing` (`cycles`, `latency_ms`) directly.

    `image` is the picture; `folder` has all files of the run if `out` was given. Notebooks show the picture. Other
    commands have reports of the same type, with their tables as data frames in `tables`."""

    def __init__(self, values: Mapping[str, Any], png: Optional[bytes] = None, folder: Optional[Path] = None,
                 printed: str = "", tables: Optional[Mapping[str, pandas.DataFrame]] = None) -> None:
        super().__init__(values)
        self._png = png
        self.folder = folder
        self.printed = printed
        self.tables = dict(tables or {})

    def _get(self, name: str) -> Any:
        timing = self._values.get("timing", {})
        if name not in self._values and name in timing:
            return wrapped(timing[name], f"timing.{name}")
        if name not in self._values:
            names = [*self._values, *timing]
            raise Missing(near(name, names, f"'{name}' does not exist in the report")) from None
        return super()._get(name)

    def __dir__(self) -> List[str]:
        return sorted({*super().__dir__(), *self._values.get("timing", {})})

    @property
    def image(self) -> "numpy.ndarray[Any, numpy.dtype[numpy.uint8]]":
        """The picture, height x width x 3, 0 to 255, as image.png has it. Raises Error for an estimate."""
        if self._png is None:
            estimated = self._values.get("schema", {}).get("name") == "degs-analytic"
            raise Error("An estimate has no picture; run it with fidelity='exact'." if estimated else
                        "The report has no picture; only those of degs.run have one.")
        return numpy.asarray(Image.open(io.BytesIO(self._png)).convert("RGB"))

    @property
    def table(self) -> pandas.DataFrame:
        """The first of the tables. Raises Error if there is none."""
        for first in self.tables.values():
            return first
        raise Error("The report has no table.")

    @property
    def losses_frame(self) -> pandas.DataFrame:
        """Where PE-cycles were lost: `reason`, `share` (of PEs x cycles) and the `keys` that move it."""
        rows = [{**loss, "keys": " or ".join(loss["keys"])} for loss in self._values["losses"]]
        return pandas.DataFrame(rows, columns=["reason", "share", "keys"])

    def __repr__(self) -> str:
        return self.printed or super().__repr__()

    def _summary(self) -> List[Tuple[str, str]]:
        """The rows that a notebook shows: the lines of the program, of which the first word is the name."""
        lines = [line.split(None, 1) for line in self.printed.splitlines()]
        shown = ("scene", "design", "frame", "slots", "losses", "memory", "energy", "image")
        return [(line[0], line[1]) for line in lines if len(line) == 2 and line[0] in shown]

    def _repr_png_(self) -> Optional[bytes]:
        return self._png

    def _repr_html_(self) -> str:
        if self._png is None:
            return f"<pre>{html.escape(repr(self))}</pre>"
        picture = base64.b64encode(self._png).decode()
        rows = "".join(f'<tr><th style="text-align:left">{html.escape(name)}</th><td style="text-align:left">'
                       f"{html.escape(text)}</td></tr>" for name, text in self._summary())
        return f'<img src="data:image/png;base64,{picture}" alt="picture of the run"/><table>{rows}</table>'


def run(design: Union[Design, PathLike], scene: Optional[PathLike] = None, *, camera: Optional[int] = None,
        camera_file: Optional[PathLike] = None, width: Optional[int] = None, height: Optional[int] = None,
        resolution: Optional[str] = None, crop: Optional[str] = None, frames: Optional[int] = None,
        path_step: Optional[float] = None, eyes: Optional[float] = None, units_per_metre: Optional[float] = None,
        views: Optional[Sequence[int]] = None, foveation: Optional[str] = None, fidelity: Optional[str] = None,
        within: Optional[str] = None, seed: Optional[int] = None, memory: Optional[PathLike] = None,
        what_if: Union[str, Sequence[str]] = (), reference: bool = True, cache: bool = True, array_only: bool = False,
        trace: Optional[PathLike] = None, trace_step: Optional[int] = None, maps: Optional[PathLike] = None,
        memory_trace: Optional[PathLike] = None, block_log: Optional[Sequence[str]] = None,
        workload: Optional[PathLike] = None,
        keys: Optional[Mapping[str, Any]] = None, out: Optional[PathLike] = None, **top_keys: Any) -> Report:
    """Simulates a frame, or a path of `frames` frames, of `scene` on `design`; the options are those of `degs run`.

    `design` is a Design, a shipped name or a file, `camera` a position in the scene's list, `width` and `height` are in
    pixels, `path_step` in degrees, `eyes` in metres; `views` are positions of cameras that share a frame, `foveation` is
    a text such as "0.5,0.5:10:25". A `workload` file stands for a scene and its camera. `keys` changes keys of the
    design ({"span.count": 16}), as do keys without a dot as arguments (clock_ghz=0.5) and sections
    (span={"count": 16}). Without `out`, no files are kept. May run in several threads at once. Raises Error
    with the program's sentence."""
    chosen = changed(design, keys, top_keys, run)
    options = options_of(scene=scene, camera=camera, camera_file=camera_file, width=width, height=height,
                         resolution=resolution, crop=crop, frames=frames, path_step=path_step, fidelity=fidelity,
                         within=within, seed=seed, memory=memory, trace=trace, trace_step=trace_step, maps=maps,
                         memory_trace=memory_trace, what_if=what_if, no_reference=not reference, no_cache=not cache,
                         array_only=array_only, workload=workload)
    options += options_of(eyes=eyes, units_per_metre=units_per_metre, foveation=foveation,
                          views=None if views is None else ",".join(str(view) for view in views))
    if block_log is not None:
        options += ["--block-log", *(str(word) for word in block_log)]
    with tempfile.TemporaryDirectory(prefix="degs-") as temporary:
        folder = Path(temporary if out is None else out)
        printed = call(["run", *chosen.arguments(), *options, "--out", str(folder)])
        estimated = (fidelity or "").startswith("analytic")
        values = json.loads((folder / ("analytic.json" if estimated else "report.json")).read_text(encoding="utf-8"))
        png = None if estimated else (folder / "image.png").read_bytes()
    lines = printed if out is not None else printed.replace(f" · {folder}/image.exr", "")
    return Report(values, png, None if out is None else folder, lines)


def changed(design: Union[Design, PathLike], keys: Optional[Mapping[str, Any]], top_keys: Mapping[str, Any],
            function: Callable[..., Any]) -> Design:
    """The design with other values. Of an unknown key that was meant as an argument of `function`, the sentence says
    so."""
    design = design if isinstance(design, Design) else Design(design)
    try:
        return design.with_(keys, **top_keys)
    except Missing as missing:
        arguments = [name for name in inspect.signature(function).parameters if name not in ("design", "top_keys")]
        for name in top_keys:
            close = difflib.get_close_matches(name, arguments, 2)
            words = f"key '{name}' is unknown"
            if close and words in str(missing):
                advice = f"{words}; did you mean the argument {' or '.join(repr(each) for each in close)}?"
                raise Missing(str(missing).replace(words, advice, 1), missing.code, missing.command) from None
        raise


FLAGS = ("no_reference", "no_cache", "array_only", "quick", "equal_area", "explain", "list", "collect", "slurm",
         "no_curve", "in_scene", "no_error_images", "single_gaussian", "hard_cases")
"""Options that are there or not."""


def options_of(**options: Any) -> List[str]:
    """The options of a command: None and False are left out, lists repeat the option."""
    words: List[str] = []
    for name, value in options.items():
        if value is None or value is False:
            continue
        option = f"--{name.replace('_', '-')}"
        if value is True:
            if name not in FLAGS:
                raise Error(f"{name} is True, but needs a value.")
            words.append(option)
            continue
        for each in value if isinstance(value, (list, tuple)) else [value]:
            words += [option, text_of(each)]
    return words
