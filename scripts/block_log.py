#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""block_log.py FILE [--kind NAME ...] [--count]: prints a log of `degs run --block-log` as text.

A line per event: cycle, kind, and the fields by name. The form of the file is that of docs/block-log.md; other
programs may import events() and header() from here.
"""

import argparse
import json
import sys
from collections import Counter


def header(data):
    """The description of a log, and the place at which its events begin."""
    end = data.find(b"\n")
    try:
        about = json.loads(data[:end])
    except ValueError:
        about = {}
    if end < 0 or about.get("format") != "degs-block-log":
        raise ValueError("it is not a log of degs run --block-log")
    if about["version"] != 1:
        raise ValueError(f"it has version {about['version']}, and this program reads version 1")
    if len(data) - end - 1 != about["bytes"]:
        raise ValueError(f"its events have {len(data) - end - 1} bytes, and its first line says {about['bytes']}")
    return about, end + 1


def numbers(data, place):
    """The whole numbers of the events: seven bits per byte, the lowest first, the sign in the lowest bit."""
    value = shift = 0
    for byte in memoryview(data)[place:]:
        value |= (byte & 0x7F) << shift
        shift += 7
        if byte < 0x80:
            yield value >> 1 ^ -(value & 1)
            value = shift = 0


def events(data):
    """(cycle, kind, fields) of every event; a list is a list of dictionaries."""
    about, place = header(data)
    stream, now = numbers(data, place), 0
    for kind in stream:
        described = about["events"][kind]
        now += next(stream)
        fields = {}
        for field in described["fields"]:
            if isinstance(field, str):
                fields[field] = next(stream)
            else:
                (name, parts), = field.items()
                fields[name] = [{part: next(stream) for part in parts} for _ in range(next(stream))]
        yield now, described["name"], fields


def text(value):
    if isinstance(value, list):
        return "[" + "; ".join(text(part) for part in value) + "]"
    if isinstance(value, dict):
        return " ".join(f"{name}={text(part)}" for name, part in value.items())
    return str(value)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("--kind", action="append", help="print these events only")
    parser.add_argument("--count", action="store_true", help="print how many events there are of each kind")
    options = parser.parse_args()
    try:
        with open(options.file, "rb") as log:
            data = log.read()
        about, _ = header(data)
        chosen = (event for event in events(data) if not options.kind or event[1] in options.kind)
        if options.count:
            print(f"{about['block']} of {about['design']}")
            for kind, count in Counter(event[1] for event in chosen).items():
                print(f"{count:9d} {kind}")
            return 0
        for now, kind, fields in chosen:
            print(now, kind, text(fields))
    except BrokenPipeError:
        sys.stderr.close()
    except (OSError, ValueError, StopIteration, RuntimeError, LookupError) as error:
        sys.exit(f"block_log.py: {options.file}: {error}.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
