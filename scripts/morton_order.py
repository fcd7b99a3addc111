#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# morton_order.py IN.ply OUT.ply: sorts the Gaussians of a scene (binary little-endian PLY, all
# values float) by the Morton code of their positions, so that neighbours in space are neighbours in
# memory. docs/memory.md says what it saves.
import struct
import sys

AXIS_BITS = 21


def read(path):
    try:
        with open(path, "rb") as file:
            data = file.read()
    except OSError as error:
        sys.exit(f"{path}: {error.strerror}")
    end = data.find(b"end_header\n")
    if end < 0:
        sys.exit(f"{path}: not a PLY file: no line 'end_header'")
    lines = data[:end].decode("ascii", "replace").split("\n")
    kinds = [line.split()[1:] for line in lines if line.startswith("property")]
    if "format binary_little_endian 1.0" not in lines or any(kind[0] != "float" for kind in kinds):
        sys.exit(f"{path}: only binary little-endian PLY files whose values are all float can be sorted")
    names = [kind[1] for kind in kinds]
    if not {"x", "y", "z"} <= set(names):
        sys.exit(f"{path}: has no positions x, y and z")
    header, body = data[: end + len(b"end_header\n")], data[end + len(b"end_header\n"):]
    counts = [int(line.split()[2]) for line in lines if line.startswith("element")]
    if len(counts) != 1 or counts[0] == 0 or len(body) != counts[0] * 4 * len(names):
        sys.exit(f"{path}: must have one element with as many records as its header says, and at least one")
    return header, body, names


def code(cell):
    return sum((cell[axis] >> bit & 1) << (3 * bit + axis) for bit in range(AXIS_BITS) for axis in range(3))


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: morton_order.py IN.ply OUT.ply")
    header, body, names = read(sys.argv[1])
    size = 4 * len(names)
    records = [body[at:at + size] for at in range(0, len(body), size)]
    offsets = [4 * names.index(axis) for axis in "xyz"]
    places = [[struct.unpack_from("<f", record, offset)[0] for offset in offsets] for record in records]
    low = [min(place[axis] for place in places) for axis in range(3)]
    side = max(max(place[axis] for place in places) - low[axis] for axis in range(3)) or 1
    scale = ((1 << AXIS_BITS) - 1) / side
    codes = [code([int((place[axis] - low[axis]) * scale) for axis in range(3)]) for place in places]
    order = sorted(range(len(records)), key=codes.__getitem__)
    with open(sys.argv[2], "wb") as file:
        file.write(header + b"".join(records[i] for i in order))


main()
