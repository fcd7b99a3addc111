# SPDX-License-Identifier: Apache-2.0
"""Results of points in a folder, so that a measurement that was stopped goes on, and tables share points.

A result belongs to the program that made it and to all that it depends on; another build makes it anew. What a point
took is kept for all builds: it says how long the rest will take."""
import gzip
import hashlib
import json
import os
import pathlib
import statistics

from . import points
from degs.process import program

GUESS = 5.0  # seconds of a point of which nothing is known


class Store:
    """A folder of results."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.build = points.content(program())
        self.times_file = self.folder / "seconds.json"
        self.times = json.loads(self.times_file.read_text()) if self.times_file.exists() else {}

    def file(self, point):
        text = "\n".join((self.build, *points.depends_on(point)))
        return self.folder / f"{hashlib.sha256(text.encode()).hexdigest()[:24]}.json.gz"

    def get(self, point):
        """(values, seconds), or None."""
        file = self.file(point)
        if not file.exists():
            return None
        with gzip.open(file, "rt", encoding="utf-8") as stream:
            kept = json.load(stream)
        return kept["values"], kept["seconds"]

    def put(self, point, values, seconds):
        """Keeps a result; a file has its name when it is complete."""
        file = self.file(point)
        part = file.with_suffix(f".{os.getpid()}")
        with gzip.open(part, "wt", encoding="utf-8", compresslevel=3) as stream:
            json.dump({"values": values, "seconds": seconds}, stream)
        part.replace(file)
        self.times[point.key()] = round(seconds, 2)
        self.times_file.write_text(json.dumps(self.times, indent=0), encoding="utf-8")

    def seconds(self, todo):
        """How long points will take: as before, else as others of the kind."""
        known = {}
        for point in todo:
            if point.key() in self.times:
                known.setdefault(point.kind, []).append(self.times[point.key()])
        usual = {kind: statistics.mean(times) for kind, times in known.items()}
        return {point: self.times.get(point.key(), usual.get(point.kind, GUESS)) for point in todo}
