# SPDX-License-Identifier: Apache-2.0
"""Records of measured tables, in docs/tables.json: what each depended on, its text, and its probe.

A table is stale when it has no record, when a value of a key, a scene, a study or the list of its points differs, when
its text was changed by hand, or when its probe gives other numbers than it did. A probe is the cheapest of a table's points; where that takes
long, it is the same design with the same keys on a tiny view."""
import concurrent.futures
import hashlib
import json

from . import points
from .probes import probe_of, probed_again, small_probe
from .scenes import ROOT, Missing

FILE = ROOT / "docs/tables.json"
LONG_S = 0.5  # a probe that takes longer gets a tiny view, so that all of them take seconds


def digest(texts):
    return hashlib.sha256("\n".join(sorted(set(texts))).encode()).hexdigest()[:16]


def dependence(asked, without=""):
    """Digest of all that the points of a table depend on but the program, and but for a key."""
    return digest(text for point in asked for text in points.depends_on(point, without))


def read():
    return json.loads(FILE.read_text(encoding="utf-8")) if FILE.exists() else {"probes": [], "tables": {}}


def write(kept):
    """Probes that no table has go; each entry is a line."""
    used = {entry["probe"] for entry in kept["tables"].values()}
    lines = ['{"probes": [']
    lines += [",\n".join(json.dumps(probe) for probe in kept["probes"] if probe["name"] in used)]
    lines += ['], "tables": {']
    lines += [",\n".join(f"{json.dumps(name)}: {json.dumps(entry)}" for name, entry in sorted(kept["tables"].items()))]
    FILE.write_text("\n".join([*lines, "}}"]) + "\n", encoding="utf-8")


def name_of(probe, values):
    """A probe that gives other values is another one, so that a table measured before stays stale."""
    return digest([json.dumps([probe, values], sort_keys=True)])[:10]


def add(table, asked, results):
    """Keeps the record of a table that was written; `results` are values and seconds of its points. A probe that
    another table has is taken if it costs at most half a second more than the cheapest."""
    kept = read()
    found = [probe for probe in (probe_of(point, *results[point]) for point in asked) if probe]
    name = ""
    if found:
        cheapest = min(seconds for seconds, *_ in found)
        names = {probe["name"] for probe in kept["probes"]}
        cost, probe, values = min(found, key=lambda each: (each[0] > cheapest + LONG_S or name_of(*each[1:]) not in names,
                                                           each[0]))
        if cost > LONG_S:
            cost, probe, values = small_probe(probe)
        name = name_of(probe, values)
        kept["probes"] = [each for each in kept["probes"] if each["name"] != name]
        kept["probes"].append({"name": name, "seconds": round(cost, 2), "point": probe, "values": values})
        kept["probes"].sort(key=lambda each: each["name"])
    kept["tables"][table.name] = {"place": table.place, "depends": dependence(asked), "text": digest([table.text()]),
                                  "probe": name}
    write(kept)


def take_in(tables, key):
    """A key was added with which nothing else changes: records that are right without it have it from now on. Returns
    the names of the others. Whether results are what they were, the probes say."""
    kept, others = read(), []
    for name, entry in kept["tables"].items():
        if name in tables and dependence(tables[name].points(), key) == entry["depends"]:
            entry["depends"] = dependence(tables[name].points())
        else:
            others.append(name)
    write(kept)
    return others


def differences(probe):
    """Sentences on the numbers of a probe that are not what they were; `Missing` if its scene is not there."""
    now = probed_again(probe["point"])
    return [f"{name} was {value} and is {now[name]}" if name in now else f"{name} was {value} and is gone"
            for name, value in probe["values"].items() if now.get(name) != value]


def check(tables, jobs):
    """(what is stale, what could not be tried) of some tables: sentences."""
    kept, stale, untried = read(), [], []
    entries = {name: kept["tables"][name] for name in tables if name in kept["tables"]}
    used = {entry["probe"] for entry in entries.values()}
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        depends = {name: pool.submit(lambda table: dependence(table.points()), table)
                   for name, table in tables.items() if name in entries}
        probes = {probe["name"]: pool.submit(differences, probe) for probe in kept["probes"] if probe["name"] in used}
        for name, entry in entries.items():
            try:
                reasons = probes[entry["probe"]].result() if entry["probe"] else []
                if depends[name].result() != entry["depends"]:
                    reasons = ["its points, the values of their keys or their scenes are not what they were", *reasons]
            except Missing as missing:
                untried.append(f"{name}: {missing}")
                reasons = []
            if tables[name].place != entry["place"] or digest([tables[name].text() or ""]) != entry["text"]:
                reasons = ["its text is not what was measured", *reasons]
            if reasons:
                stale.append(f"{entry['place']}: the table {name} is stale: {'; '.join(reasons[:3])}. "
                             f"Measure it anew: scripts/measure.py {name}")
    stale += [f"{table.place}: the table {name} is stale: no record says what it was measured from. "
              f"Measure it anew: scripts/measure.py {name}" for name, table in tables.items() if name not in entries]
    return stale, untried
