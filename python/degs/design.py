# SPDX-License-Identifier: Apache-2.0
"""Designs: a file of the program and what is changed in it. Keys come from the description that the program prints."""

import functools
import json
import math
import os
import re
import tempfile
from pathlib import Path
from typing import Any, Dict, Iterator, List, Mapping, Optional, Tuple, Union

import pandas
import yaml

from .process import Error, Missing, PathLike, call, configurations, near, program, shipped


def text_of(value: Any) -> str:
    """A value as it is written behind --set and in files."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(float(value)) if isinstance(value, float) else str(value)


def flat(values: Mapping[str, Any], path: str = "") -> Iterator[Tuple[str, Any]]:
    """(dotted name, value) of everything in nested mappings."""
    for name, value in values.items():
        if isinstance(value, Mapping):
            yield from flat(value, f"{path}{name}.")
        else:
            yield f"{path}{name}", value


@functools.lru_cache(maxsize=8)
def schema_of(called: str, modified: float) -> Dict[str, Any]:
    """The JSON Schema of designs that a program prints."""
    del called, modified  # They say which program it is.
    described: Dict[str, Any] = json.loads(call(["config", "--schema", "design"]))
    return described


def schema() -> Dict[str, Any]:
    """The JSON Schema of designs, of the program as it is now."""
    called = program()
    return schema_of(called, os.stat(called).st_mtime)


def resolved(node: Mapping[str, Any]) -> Mapping[str, Any]:
    """A part of the schema, behind its references."""
    while "$ref" in node:
        node = schema()["$defs"][node["$ref"].rsplit("/", 1)[-1]]
    return node


def entries(node: Mapping[str, Any]) -> Dict[str, Mapping[str, Any]]:
    """The keys and sections of a section, without those that only files with several accelerators have."""
    inside = {name: resolved(each) for name, each in node.get("properties", {}).items() if name != "include"}
    return {name: each for name, each in inside.items() if "properties" in each or "default" in each}


def allows(key: Mapping[str, Any], value: Any) -> bool:
    """Whether the schema of a key allows a value. A number with a unit is allowed if the unit fits."""
    if "enum" in key:
        return bool(value in key["enum"])
    kinds = key["type"] if isinstance(key["type"], list) else [key["type"]]
    if isinstance(value, bool):
        return "boolean" in kinds
    if isinstance(value, str):
        return "string" in kinds and re.match(key.get("pattern", ""), value) is not None
    if not isinstance(value, (int, float)) or not math.isfinite(value):
        return False
    if "number" not in kinds and not ("integer" in kinds and value == int(value)):
        return False
    return bool(key.get("minimum", -math.inf) <= value <= key.get("maximum", math.inf))


def texts_of(text: str) -> Dict[str, Any]:
    """A file of the program, its values as texts: what type they have is said by the schema."""
    tree: Dict[str, Any] = yaml.load(text, getattr(yaml, "CBaseLoader", yaml.BaseLoader))
    return tree


def read(key: Mapping[str, Any], text: str) -> Any:
    """The value of a key from its text, by the type that the schema states."""
    kinds = key.get("type", "string")
    kinds = kinds if isinstance(kinds, list) else [kinds]
    if kinds[0] == "boolean":
        return text == "true"
    if kinds[0] == "integer":
        return int(text)
    return float(text) if kinds[0] == "number" else text


class Section:
    """A section of a design: keys and further sections are attributes, and assigning to a key changes the design."""

    def __init__(self, design: "Design", path: str, node: Mapping[str, Any]) -> None:
        object.__setattr__(self, "_at", (design, path, node))

    _at: Tuple["Design", str, Mapping[str, Any]]

    def _child(self, name: str) -> Tuple["Design", str, Optional[Mapping[str, Any]]]:
        design, path, node = self._at
        return design, f"{path}.{name}" if path else name, entries(node).get(name)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        design, path, node = self._child(name)
        if node is None:
            raise design.refusal(path, 0)
        return Section(design, path, node) if "properties" in node else design[path]

    def __setattr__(self, name: str, value: Any) -> None:
        design, path, _ = self._child(name)
        design[path] = value

    def __dir__(self) -> List[str]:
        return list(entries(self._at[2]))

    def __repr__(self) -> str:
        return "\n".join(f"{name}: {self._at[0][f'{self._at[1]}.{name}']}" for name, _ in keys_of(self._at[2]))

    def _repr_html_(self) -> str:
        design, path, node = self._at
        rows = [(name, design[f"{path}.{name}"], key.get("description", "")) for name, key in keys_of(node)]
        return str(pandas.DataFrame(rows, columns=["key", "value", "meaning"]).to_html(index=False))


def keys_of(node: Mapping[str, Any], path: str = "") -> Iterator[Tuple[str, Mapping[str, Any]]]:
    """(dotted name, schema) of every key of a section."""
    for name, inside in entries(node).items():
        if "properties" in inside:
            yield from keys_of(inside, f"{path}{name}.")
        else:
            yield f"{path}{name}", inside


class Design:
    """A design: a shipped name, a file, or an accelerator with a number of PEs; and changed keys.

        design = degs.Design("degs-64")
        design.span.count = 16
        design["memory.bandwidth_gb_per_s"] = 102.4

    Keys complete in notebooks. A value is checked when it is assigned; rules between keys, and ranges of numbers that
    have a unit ("8KB"), are checked by check(), by reading a key, and by every run. Numbers are in the unit of the key,
    which `degs.Design.describe` shows. Errors are those of the program."""

    def __init__(self, source: PathLike, pes: Optional[int] = None, *, keys: Optional[Mapping[str, Any]] = None,
                 **top_keys: Any) -> None:
        text: Optional[str] = None
        file: Optional[Path] = None
        name = str(source)
        if pes is not None:
            text = call(["config", name, "--pes", str(pes), "--format", "yaml"])
        elif name in schema()["$defs"]["degs"]["properties"]["accelerator"]["enum"]:
            text = f"accelerator: {name}\n"
        else:
            file = file_of(name)
        object.__setattr__(self, "_state", {"file": file, "text": text, "changes": {}, "values": None})
        object.__setattr__(self, "_accelerator", self._accelerator_of())
        self.update(keys, **top_keys)

    _state: Dict[str, Any]
    _accelerator: str

    def _accelerator_of(self) -> str:
        return str(texts_of(self.yaml())["accelerator"])

    @property
    def changes(self) -> Dict[str, Any]:
        """The keys that were changed."""
        return dict(self._state["changes"])

    def _node(self) -> Mapping[str, Any]:
        return resolved({"$ref": self._accelerator})

    def _key(self, path: str) -> Optional[Mapping[str, Any]]:
        node: Optional[Mapping[str, Any]] = self._node()
        for name in path.split("."):
            node = entries(node).get(name) if node else None
        return node

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(Section(self, "", self._node()), name)

    def __setattr__(self, name: str, value: Any) -> None:
        if name.startswith("_") or name in type(self).__dict__:
            raise AttributeError(f"'{name}' belongs to the design itself, and no key has this name")
        self[name] = value

    def __dir__(self) -> List[str]:
        methods = [name for name in object.__dir__(self) if not name.startswith("_")]
        return sorted({*methods, *dir(Section(self, "", self._node()))})

    def __getitem__(self, path: str) -> Any:
        key = self._key(path)
        if key is None:
            raise self.refusal(path, 0)
        if "properties" in key:
            return Section(self, path, key)
        values: Optional[Dict[str, str]] = self._state["values"]
        if values is None:
            values = self._state["values"] = dict(flat(texts_of(self.yaml())))
        if path not in values:  # Of a policy or a model that the design does not have.
            return self._state["changes"].get(path, key.get("default"))
        return read(key, values[path])

    def __setitem__(self, path: str, value: Any) -> None:
        value = value.item() if hasattr(value, "item") else value  # A number of numpy becomes one of Python.
        key = self._key(path)
        if key is not None and "properties" in key and isinstance(value, Mapping):
            self.update({f"{path}.{name}": each for name, each in value.items()})
            return
        if path == "accelerator" or key is None or "properties" in key or not allows(key, value):
            raise self.refusal(path, value)
        self._state["changes"][path] = value
        self._state["values"] = None

    def refusal(self, path: str, value: Any) -> Error:
        """What the program says about a key or value that the schema does not allow."""
        if path == "accelerator":
            return Error("A design keeps its accelerator; make another one with degs.Design(NAME).")
        try:
            call(["config", str(self.file), "--set", f"{path}={text_of(value)}", "--format", "yaml"], warn=False)
        except Error as said:
            return Missing(str(said), said.code, said.command) if self._key(path) is None else said
        return Error(f"key '{path}' cannot be {value!r}.")

    def update(self, keys: Optional[Mapping[str, Any]] = None, **top_keys: Any) -> None:
        """Changes several keys, all or, if one is refused, none; nested mappings are sections."""
        before = dict(self._state["changes"])
        try:
            for path, value in flat({**(keys or {}), **top_keys}):
                self[path] = value
        except Exception:
            self._state["changes"] = before
            raise

    def copy(self) -> "Design":
        """An independent copy."""
        other = object.__new__(Design)
        state = {**self._state, "changes": dict(self._state["changes"])}
        object.__setattr__(other, "_state", state)
        object.__setattr__(other, "_accelerator", self._accelerator)
        return other

    __copy__ = copy

    def __deepcopy__(self, memo: Any) -> "Design":
        return self.copy()

    def with_(self, keys: Optional[Mapping[str, Any]] = None, **top_keys: Any) -> "Design":
        """A copy with other values, given as for update(): design.with_({"span.count": 16}, clock_ghz=0.5)."""
        other = self.copy()
        other.update(keys, **top_keys)
        return other

    def with_settings(self, settings: str) -> "Design":
        """A copy with values as reports and --what-if write them: "span.count=16,memory.bandwidth_gb_per_s=51.2"."""
        values: Dict[str, Any] = {}
        for setting in settings.split(","):
            path, _, text = setting.partition("=")
            key = self._key(path)
            if key is None:
                raise self.refusal(path, text)
            try:
                value = read(key, text)
            except ValueError:  # It has a unit, or it is refused.
                value = text
            values[path] = text if isinstance(value, bool) and text not in ("true", "false") else value
        return self.with_(values)

    def options(self) -> List[str]:
        """The changes as options of the program."""
        pairs = [f"{path}={text_of(value)}" for path, value in self._state["changes"].items()]
        return [word for pair in pairs for word in ("--set", pair)]

    def yaml(self) -> str:
        """The complete file that reproduces the design. Raises Error if it cannot be built."""
        return call(["config", *self.arguments(), "--format", "yaml"], warn=False)

    def check(self) -> "Design":
        """Raises Error if the design cannot be built, as when a rule between keys is broken; returns the design."""
        call(["config", *self.arguments(), "--format", "yaml"])
        return self

    def blocks(self) -> pandas.DataFrame:
        """Area (mm2), power (W) and capacity (bytes) of every block, as `degs config --cost` prints them."""
        blocks = json.loads(call(["config", *self.arguments(), "--cost", "--format", "json"]))["area"]["blocks"]
        return pandas.DataFrame.from_dict(blocks, orient="index")

    def describe(self, path: str = "") -> pandas.DataFrame:
        """Keys below `path` with their values and meanings, which name the units."""
        node = self._key(path) if path else self._node()
        if node is None:
            raise self.refusal(path, 0)
        if "properties" not in node:
            path, node = path.rpartition(".")[0], {"properties": {path.rpartition(".")[2]: node}}
        below = keys_of(node, f"{path}." if path else "")
        rows = [(name, self[name], key.get("description", "")) for name, key in below]
        return pandas.DataFrame(rows, columns=["key", "value", "meaning"]).set_index("key")

    def diff(self, other: Union["Design", PathLike]) -> pandas.DataFrame:
        """The keys in which two designs differ, with both values as texts; '-' where one has no such key."""
        other = other if isinstance(other, Design) else Design(other)
        with tempfile.TemporaryDirectory(prefix="degs-") as folder:
            files = [Path(folder) / "one.yaml", Path(folder) / "other.yaml"]
            for file, design in zip(files, (self, other)):
                file.write_text(design.yaml(), encoding="utf-8")
            table = call(["config", "--diff", *map(str, files), "--format", "markdown"])
        rows = [[cell.strip().strip("`") for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
                for line in table.splitlines()[2:] if line.startswith("|")]
        return pandas.DataFrame(rows, columns=["key", "self", "other"]).set_index("key")

    def arguments(self) -> List[str]:
        """The design on the command line: its file and its changes."""
        return [str(self.file), *self.options()]

    @property
    def file(self) -> Path:
        """The file without the changes; one of a design that has none lives as long as this process."""
        file: Optional[Path] = self._state["file"]
        return file or kept_text(self._state["text"])

    def __repr__(self) -> str:
        name = self._state["file"].stem if self._state["file"] else self._accelerator
        return f"Design({name}{''.join(f', {key}={text_of(value)}' for key, value in self.changes.items())})"


KEPT = tempfile.TemporaryDirectory(prefix="degs-designs-")


@functools.lru_cache(maxsize=None)
def kept_text(text: str) -> Path:
    """A file with this text, which is removed when Python ends."""
    descriptor, name = tempfile.mkstemp(suffix=".yaml", dir=KEPT.name)
    with os.fdopen(descriptor, "w", encoding="utf-8") as file:
        file.write(text)
    return Path(name)


def file_of(name: str) -> Path:
    """The file of a design: a path, or a shipped name. A file of the current folder comes first."""
    path = Path(name).expanduser()
    if path.is_file():
        return path.resolve()
    if path.name == name and not name.endswith((".yaml", ".yml")):
        file = configurations() / f"{name}.yaml"
        if file.is_file():
            return file
        raise Error(near(name, shipped(), f"There is no design '{name}', neither shipped nor as a file"))
    call(["config", str(path)])  # The program says why it cannot be read.
    return path.resolve()
