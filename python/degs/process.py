# SPDX-License-Identifier: Apache-2.0
"""Finds the program, calls it, and turns what it says into results, warnings and errors."""

import difflib
import functools
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import warnings
from contextvars import ContextVar
from pathlib import Path
from typing import IO, Any, Callable, Dict, List, NamedTuple, Optional, Protocol, Sequence, Union

PathLike = Union[str, "os.PathLike[str]"]

PREFIX = re.compile(r"^degs( [a-z]+)*: ")
PROGRESS = re.compile(r"^(\d+) of (\d+) \w+ (done|failed)\b")
HERE = Path(__file__).resolve().parent


class Error(Exception):
    """A mistake, with the one sentence that the program says about it.

    `code` is the exit code of the program (docs/report.md#exit-codes) or None if it did not run, `command` what was
    called, and `results` the data frame of the points that did finish, where a study failed in part."""

    def __init__(self, sentence: str, code: Optional[int] = None, command: Sequence[str] = ()) -> None:
        super().__init__(sentence)
        self.code = code
        self.command = list(command)
        self.results: Any = None

    def _render_traceback_(self) -> List[str]:
        """IPython shows this in place of a traceback, which would be about this package and not about the mistake."""
        return [f"degs.Error: {self}"]


class Missing(Error, AttributeError, KeyError):
    """A key of a design or a number of a report that does not exist; the sentence names those that are near."""

    def __str__(self) -> str:
        return str(self.args[0])


class DegsWarning(UserWarning):
    """A warning of the program, for instance of a key without effect."""


def near(name: str, names: Sequence[str], what: str) -> str:
    """A sentence that says what is missing, and what there is instead."""
    close = difflib.get_close_matches(name, names, 3)
    if close:
        return f"{what}, did you mean {' or '.join(repr(each) for each in close)}?"
    return f"{what}; there are: {', '.join(names)}." if names else f"{what}, which has no parts."


def program() -> str:
    """The path of the program: DEGS_PROGRAM, or beside the package in a build tree or an installation, or on PATH.

    In a session it is that of the session. Raises Error if there is none."""
    server = SERVER.get()
    if server:
        return server.program
    named = os.environ.get("DEGS_PROGRAM")
    if named:
        if not os.access(named, os.X_OK) or os.path.isdir(named):
            raise Error(f"DEGS_PROGRAM is '{named}', which is not a program.")
        return os.path.abspath(named)
    found = shutil.which("degs")
    for candidate in [*beside_package(HERE), *([Path(found)] if found else [])]:
        if os.access(candidate, os.X_OK) and candidate.is_file():
            return str(candidate)
    raise Error("There is no program degs beside this package or on PATH; build it, or set DEGS_PROGRAM to its path.")


def beside_package(package: Path) -> List[Path]:
    """Places of the program for a package in PREFIX/share/degs/python/degs or in python/degs of a source tree."""
    builds = package.parents[1] / "build"
    return [package.parents[3] / "bin" / "degs", builds / "release" / "sim" / "degs",
            *sorted(builds.glob("*/sim/degs"))]


def configurations() -> Path:
    """The folder of the shipped configurations, beside the program or the package. Raises Error if there is none."""
    called = Path(program()).resolve()
    places = [called.parents[1] / "share" / "degs" / "configs", *(parent / "configs" for parent in called.parents),
              HERE.parents[1] / "configs", HERE.parents[0] / "configs"]
    for place in places:
        if (place / "degs-64.yaml").is_file():
            return place
    raise Error(f"There are no shipped configurations beside the program '{called}'; name a file.")


def shipped() -> List[str]:
    """The names of the shipped designs."""
    return sorted(path.stem for path in configurations().glob("*.yaml"))


def version() -> str:
    """The version of the program."""
    return call(["--version"]).split()[-1]


class Ended(NamedTuple):
    """What a command has left: its exit code, what it printed, and the lines of stderr that were not taken."""

    code: int
    printed: str
    said: List[str]


class Server(Protocol):
    """What runs commands without a process start each."""

    program: str

    def command(self, arguments: Sequence[str], take: Callable[[str], bool]) -> Ended:
        """Runs a command; `take` is called with each line of stderr, and says whether it takes it."""


SERVER: "ContextVar[Optional[Server]]" = ContextVar("degs.SERVER", default=None)
"""The server that calls of this thread go to; None: each is a process."""


def call(arguments: Sequence[str], progress: Optional[bool] = None, warn: bool = True) -> str:
    """Calls the program and returns what it prints.

    Lines of progress become a bar (`progress`: None shows one in notebooks and terminals), warnings become DegsWarning
    unless `warn` is false. Raises Error with the program's sentence. An interrupt ends the program, too; its folder
    then holds what had finished."""
    server = SERVER.get()
    command = [program(), *arguments]
    for word in command:
        if "\0" in word:
            raise Error(f"A name or value cannot hold a zero, as {word!r} does.", command=command)
    bar = Progress(progress)
    try:
        ended = server.command(arguments, bar.line) if server else run_process(command, bar.line)
    finally:
        bar.close()
    if ended.code:
        raise Error(sentence_of(ended.said, ended.code), ended.code, command)
    for line in ended.said if warn else []:
        warnings.warn(PREFIX.sub("", line).replace("warning: ", "", 1), DegsWarning, stacklevel=outside())
    return ended.printed


def environment() -> Dict[str, str]:
    """The environment of the program, which prints UTF-8."""
    return {**os.environ, "LC_ALL": "C.UTF-8"}


def start(command: Sequence[str], **streams: Any) -> "subprocess.Popen[str]":
    """Starts the program. Raises Error if that is not possible."""
    try:
        return subprocess.Popen(command, encoding="utf-8", errors="replace", env=environment(), **streams)
    except OSError as problem:
        raise Error(f"The program '{command[0]}' does not start: {problem.strerror}.", command=command) from None


def run_process(command: Sequence[str], take: Callable[[str], bool]) -> Ended:
    """Runs the program in a process of its own."""
    with tempfile.TemporaryFile("w+", encoding="utf-8") as printed:
        process = start(command, stdin=subprocess.DEVNULL, stdout=printed, stderr=subprocess.PIPE)
        said = listen(process, take)
        printed.seek(0)
        return Ended(process.returncode, printed.read(), said)


def listen(process: "subprocess.Popen[str]", take: Callable[[str], bool]) -> List[str]:
    """The lines of stderr that are not taken, when the process has ended."""
    said: List[str] = []
    assert process.stderr is not None
    reader = threading.Thread(target=read_lines, args=(process.stderr, said, take), daemon=True)
    reader.start()
    try:
        process.wait()
        reader.join()
    except BaseException:
        # The terminal sends Ctrl-C to both, a notebook only to Python.
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
            try:
                process.wait(30)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        raise
    return said


def read_lines(stream: IO[str], said: List[str], take: Callable[[str], bool]) -> None:
    """Reads a stream to its end; lines that `take` does not take are kept."""
    with stream:
        for line in stream:
            line = line.rstrip("\n")
            if line and not take(line):
                said.append(line)


def sentence_of(said: Sequence[str], code: int) -> str:
    """The sentence with which the program failed."""
    for line in reversed(said):
        if PREFIX.match(line) and "warning: " not in line:
            return PREFIX.sub("", line)
    if code < 0:
        return f"The program was ended by the signal {signal.Signals(-code).name}."
    return said[-1] if said else f"The program failed with the exit code {code}."


def outside() -> int:
    """The stack level of the first caller outside of this package, to which a warning belongs."""
    level, frame = 1, sys._getframe(1)
    while frame.f_back and Path(frame.f_code.co_filename).parent == HERE:
        level, frame = level + 1, frame.f_back
    return level


class Progress:
    """A bar of the points that have finished, of tqdm if it is there, else the program's own lines."""

    def __init__(self, wanted: Optional[bool]) -> None:
        self.wanted = (sys.stderr.isatty() or "ipykernel" in sys.modules) if wanted is None else wanted
        self.bar: Any = None

    def line(self, line: str) -> bool:
        """Takes a line if it is one of progress."""
        found = PROGRESS.match(line)
        if not found:
            return False
        if self.wanted:
            self.show(int(found[1]), int(found[2]), line)
        return True

    def show(self, done: int, total: int, line: str) -> None:
        """Draws the bar anew. A search has several totals, one for each size of images, and so several bars."""
        bars = tqdm()
        if bars is None:
            print(line, file=sys.stderr)
            return
        if self.bar is not None and self.bar.total != total:
            self.close()
        if self.bar is None:
            self.bar = bars(total=total, unit="point", file=sys.stderr)
        self.bar.update(done - self.bar.n)

    def close(self) -> None:
        """Ends the bar, which stays on the screen."""
        if self.bar is not None:
            self.bar.close()
            self.bar = None


@functools.lru_cache(maxsize=None)
def tqdm() -> Any:
    """The class of bars, or None."""
    try:
        import tqdm as package
    except ImportError:
        return None
    return package.tqdm
