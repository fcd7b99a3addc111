# SPDX-License-Identifier: Apache-2.0
"""A session: one server process that runs the commands of many calls."""

import functools
import json
import os
import queue
import subprocess
import tempfile
import threading
import weakref
from typing import IO, Any, Callable, Dict, List, Optional, Sequence, TypeVar, cast

from .commands import accuracy, memory, motion, scene, soc, workload
from .process import SERVER, Ended, Error, program, sentence_of, start, version
from .report import options_of, run
from .studies import bandwidth, buffers, compare, gains, processors, results, statistics, sweep

Function = TypeVar("Function", bound=Callable[..., Any])
Message = Dict[str, Any]
MOST_BYTES = 1 << 20  # of a line


class Answers:
    """The messages of a server, each for the call that waits for it."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._waiting: Dict[int, "queue.SimpleQueue[Optional[Message]]"] = {}
        self._last = 0
        self._over = False

    def expect(self) -> int:
        """The number of a new request."""
        with self._lock:
            self._last += 1
            self._waiting[self._last] = queue.SimpleQueue()
            if self._over:
                self._waiting[self._last].put(None)
            return self._last

    def next(self, number: int, seconds: Optional[float] = None) -> Optional[Message]:
        """The next message for a request; None when the server has ended. Raises queue.Empty after `seconds`."""
        return self._waiting[number].get(timeout=seconds)

    def forget(self, number: int) -> None:
        """Nobody waits for the request any more."""
        with self._lock:
            del self._waiting[number]

    def read(self, stream: IO[str]) -> None:
        """Hands out all messages of a server, until it ends."""
        with stream:
            for line in stream:
                message = json.loads(line)
                with self._lock:
                    if message["id"] in self._waiting:
                        self._waiting[message["id"]].put(message)
        with self._lock:
            self._over = True
            for waiting in self._waiting.values():
                waiting.put(None)


def line_of(request: Message) -> str:
    """A request as the server reads it. Raises Error for what no line holds."""
    try:
        line = json.dumps(request, ensure_ascii=False) + "\n"
        size = len(line.encode())
    except UnicodeEncodeError:
        raise Error("A session takes names and values in UTF-8, and one of these is not.") from None
    if size > MOST_BYTES:
        raise Error(f"The command has {size} bytes; a session takes {MOST_BYTES}.")
    return line


def end(process: "subprocess.Popen[str]") -> None:
    """Ends a server that has no more requests to run, as soon as those that run have ended."""
    assert process.stdin is not None
    try:
        process.stdin.close()
    except OSError:  # It has ended already.
        pass
    process.wait()


class Session:
    """One server process that runs the commands of many calls, without a process start each.

        with degs.Session() as session:
            for count in range(1, 33):
                print(session.run("degs-64", SCENE, fidelity="analytic", span={"count": count}).cycles)

    It has the functions of the module, with the same arguments, results and errors. Runs of one view find it in the
    memory of the server from the second on. Threads may call at once; `jobs` is the number of commands that run at a
    time, by default one for each processor. The server ends with the session, and with this process. A command that
    crashes is an Error of its call alone."""

    def __init__(self, jobs: Optional[int] = None) -> None:
        self.program = program()
        self.jobs = processors() if jobs is None else jobs
        self._errors = tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace")
        # In a group of its own: the terminal sends Ctrl-C to a group, and it is to end one call.
        self._process = start([self.program, "serve", *options_of(jobs=self.jobs)], stdin=subprocess.PIPE,
                              stdout=subprocess.PIPE, stderr=self._errors, start_new_session=True, bufsize=1)
        self._owner = os.getpid()
        self._writing = threading.Lock()
        self._closed = False
        self._answers = Answers()
        self._reader = threading.Thread(target=self._answers.read, args=(self._process.stdout,), daemon=True)
        self._reader.start()
        self._end = weakref.finalize(self, end, self._process)
        self.run = self._through(run)
        self.sweep = self._through(sweep)
        self.compare = self._through(compare)
        self.bandwidth = self._through(bandwidth)
        self.buffers = self._through(buffers)
        self.gains = self._through(gains)
        self.results = self._through(results)
        self.motion = self._through(motion)
        self.accuracy = self._through(accuracy)
        self.memory = self._through(memory)
        self.workload = self._through(workload)
        self.soc = self._through(soc)
        self.scene = self._through(scene)
        self.statistics = self._through(statistics)
        self.version = self._through(version)

    def _through(self, function: Function) -> Function:
        """The function, with its commands run by this server."""
        owner = weakref.ref(self)  # A session that nobody has any more ends its server.

        @functools.wraps(function)
        def called(*arguments: Any, **options: Any) -> Any:
            token = SERVER.set(owner())
            try:
                return function(*arguments, **options)
            finally:
                SERVER.reset(token)

        return cast(Function, called)

    def command(self, arguments: Sequence[str], take: Callable[[str], bool]) -> Ended:
        """Runs a command; `take` is called with each line of stderr, and says whether it takes it."""
        number = self._answers.expect()
        said: List[str] = []
        try:
            self._send({"id": number, "arguments": list(arguments), "folder": os.getcwd()})
            while True:
                message = self._answers.next(number)
                if message is None:
                    raise self._gone()
                if "code" in message:
                    return Ended(message["code"], message["printed"], said)
                if message["said"] and not take(message["said"]):
                    said.append(message["said"])
        except (Exception, KeyboardInterrupt) as problem:
            if not isinstance(problem, Error):
                self._stop(number)
            raise
        finally:
            self._answers.forget(number)

    def _send(self, request: Message) -> None:
        if self._closed or self._owner != os.getpid():
            raise Error("The session is closed." if self._closed else
                        "The session belongs to another process; begin one in each process.")
        line = line_of(request)
        with self._writing:
            try:
                assert self._process.stdin is not None
                self._process.stdin.write(line)
                self._process.stdin.flush()
            except OSError:
                raise self._gone() from None

    def _stop(self, number: int) -> None:
        """Ends a request as Ctrl-C does, and waits until what had finished is in its folder."""
        self._send({"id": number, "stop": True})
        try:
            message = self._answers.next(number, 30)
            while message is not None and "code" not in message:
                message = self._answers.next(number, 30)
        except queue.Empty:
            pass

    def _gone(self) -> Error:
        """Why the server does not answer."""
        code = self._process.wait()
        self._errors.seek(0)
        sentence = sentence_of(self._errors.read().splitlines(), code)
        return Error(f"The server of the session has ended: {sentence}", code)

    def close(self) -> None:
        """Ends the server when the calls of other threads have ended."""
        if self._owner == os.getpid():
            self._closed = True
            self._end()

    def __enter__(self) -> "Session":
        return self

    def __exit__(self, kind: Any, *_: Any) -> None:
        if kind is not None and not self._closed:
            self._process.terminate()
        self.close()

    def __repr__(self) -> str:
        return f"Session({'closed' if self._closed else self.program})"
