#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bench_table.py BENCH.json REPORT.json TYPESCRIPT [--print]: the results of scripts/bench.sh as Markdown, written into
docs/performance.md between the lines `<!-- benchmarks -->` and `<!-- end of benchmarks -->`, or printed.

BENCH.json is the output of degs_bench, the other two are of the large frame: its report, and what the program wrote to
its terminal. Exit code 1 if the large frame takes more memory than its limit, or some seconds without progress."""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/performance.md"
BEGIN, END = "<!-- benchmarks -->", "<!-- end of benchmarks -->"
MOST_BYTES = 6 << 30
SILENT_S = 8  # the program shows the progress of a step that takes more than two seconds
# Counters that are shown beside ratio and limit, and what they mean.
DETAILS = {"ns/fragment": "{:.1f} ns per fragment", "both processors": "{:.3g} with the functional model",
           "of the bus s": "{:.2f} s with the bus", "M accesses": "{:.2f} M accesses",
           "M requests/s": "{:.2f} M requests/s",
           "M lines/s": "{:.0f} M lines/s copied", "first s": "{:.2f} s", "second s": "{:.3f} s the second time"}


def machine():
    """The processor as Linux names it, and how many of them there are."""
    names = re.findall(r"^model name\s*: (.*)$", pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.M)
    return f"{len(names)} x {names[0]}" if names else "unknown"


def commit():
    """Short hash of the sources that were measured; says so if they were not committed."""
    text = subprocess.run(["git", "describe", "--always", "--dirty=, changed since", "--exclude=*"], cwd=ROOT, check=True,
                          capture_output=True, text=True).stdout
    return text.strip()


def bench_rows(results):
    """Lines of the table: name, ratio, limit, details."""
    for result in results["benchmarks"]:
        name = re.sub(r"/(iterations|manual_time|min_time).*", "", result["name"])
        if result.get("error_occurred"):
            yield name, "", "", "**failed**: " + result["error_message"].split("\n")[0]
            continue
        details = [form.format(result[key]) for key, form in DETAILS.items() if key in result]
        if "ratio" not in result:
            if "items_per_second" in result:
                details.append(f"{1e-6 * result['items_per_second']:.2f} M requests/s")
            yield name, "", "", ", ".join(details)
            continue
        above = "" if result["ratio"] <= result["limit"] else " **above**"
        yield name, f"{result['ratio']:.3g}", f"{result['limit']:.3g}{above}", ", ".join(details)


def large_frame(report, terminal):
    """The sentence on the large frame, and whether all is well."""
    host, camera, work = report["host"], report["camera"], report["workload"]
    shown = len(re.findall(r"\d+ % · ", terminal))
    fits = host["peak_rss_bytes"] <= MOST_BYTES
    sentence = (f"One frame of {work['gaussians']:,} Gaussians at {camera['width']} x {camera['height']} on `degs-64` in "
                f"`exact` with its reference: {host['peak_rss_bytes'] / 2**30:.2f} GiB of the {MOST_BYTES >> 30} GiB "
                f"allowed, {host['sim_s']:.1f} s of simulation, {host['wall_s']:.1f} s in all; the terminal showed "
                f"progress {shown} times.")
    return sentence, fits and (shown > 0 or host["wall_s"] < SILENT_S)


def lines_of(options):
    """The text between the markers, and whether the large frame kept its limits."""
    read = lambda path: json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    sentence, good = large_frame(read(options.report), pathlib.Path(options.typescript).read_text(encoding="utf-8"))
    results = read(options.bench)
    load = results["context"]["load_avg"][0]  # processes that wanted a processor, before the first benchmark
    table = ["| benchmark | ratio | limit | measured |", "| --- | ---: | ---: | --- |"]
    table += ["| " + " | ".join(row) + " |" for row in bench_rows(results)]
    conditions = f"Machine: {machine()}, load average {load:.1f} at the start. Commit: {commit()}."
    return [conditions, "", *table, "", textwrap.fill(sentence, 120)], good


def main():
    """Writes or prints."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("bench", "report", "typescript"):
        parser.add_argument(name)
    parser.add_argument("--print", action="store_true", dest="only_print")
    options = parser.parse_args()
    lines, good = lines_of(options)
    if options.only_print:
        print("\n".join(lines))
    else:
        before, rest = PAGE.read_text(encoding="utf-8").split(BEGIN + "\n")
        _, after = rest.split(END)
        PAGE.write_text(before + BEGIN + "\n\n" + "\n".join(lines) + "\n\n" + END + after, encoding="utf-8")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
