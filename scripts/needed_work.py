#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""needed_work.py: prints, as a table, what runs of degs-64 count on pairs of scenes that differ only in what nobody
needs: SH bands, empty tiles, culled Gaussians, a memory behind an array alone.

Runs DEGS_PROGRAM (default: degs of the search path, else build/release/sim/degs)."""
import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("DEGS_PROGRAM") or shutil.which("degs") or str(ROOT / "build/release/sim/degs")
HEADINGS = ["case", "Gaussians", "visible", "tiles with splats", "empty tiles", "bytes of SH", "bytes of the rest",
            "rows solved", "activations", "DRAM commands"]


def ball(x, y, z, opacity=0.0):
    """Position, logit of the opacity; all balls have one size."""
    return x, y, z, opacity


def write_scene(folder, balls, degree, width, height):
    """scene.ply, and one camera at the origin that looks along z with a focal length of 256 px."""
    rest = 3 * ((degree + 1) ** 2 - 1)
    names = ["x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", *(f"f_rest_{i}" for i in range(rest)), "opacity", "scale_0",
             "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"]
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(balls)}",
              *(f"property float {name}" for name in names), "end_header", ""]
    row = struct.Struct(f"<{len(names)}f")
    with open(folder / "scene.ply", "wb") as file:
        file.write("\n".join(header).encode())
        for x, y, z, opacity in balls:
            file.write(row.pack(x, y, z, 0.3, 0.3, 0.3, *[0.3] * rest, opacity, -4, -4, -4, 1, 0, 0, 0))
    camera = {"id": 0, "width": width, "height": height, "position": [0, 0, 0],
              "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "fx": 256, "fy": 256}
    (folder / "cameras.json").write_text(json.dumps([camera]), encoding="utf-8")


def row_of(name, balls, degree=0, size=(256, 192), arguments=()):
    """One line of the table."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        write_scene(folder, balls, degree, *size)
        subprocess.run([PROGRAM, "run", str(ROOT / "configs/degs-64.yaml"), "--scene", str(folder / "scene.ply"),
                        "--camera", "0", "--no-reference", "--no-cache", "--out", str(folder / "out"), *arguments],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        report = json.loads((folder / "out/report.json").read_text(encoding="utf-8"))
    work, dram = report["workload"], report["dram"]
    sh = dram["streams"].get("sh", {}).get("bytes_read", 0)
    commands = dram.get("channels", {}).get("commands", {})
    return [name, work["gaussians"], work["visible"], work["tiles"] - work["empty_tiles"], work["empty_tiles"], sh,
            dram["bytes_read"] + dram["bytes_written"] - sh, report["stages"]["span"]["rows"],
            report["host"]["activations"], sum(commands.values())]


def main():
    """Prints the table."""
    grid = [ball(0.03 * (i % 16 - 8), 0.03 * (i // 16 - 8), 1 + 0.001 * i) for i in range(256)]
    away = [ball(0, 0, -1), ball(0, 0, 2, -9.0), ball(50, 0, 2)]  # behind the camera, transparent, beside the image
    many = [away[i % 3] for i in range(1000000)]
    alone = ["--array-only"]
    lpddr5 = ["--set", "memory.model=lpddr5"]
    rows = [
        row_of("SH degree 3", grid, degree=3),
        row_of("SH degree 0", grid),
        row_of("array alone", grid, arguments=alone),
        row_of("array alone, more empty tiles", grid, size=(512, 384), arguments=alone),
        row_of("one splat", [ball(0, 0, 2)]),
        row_of("one splat and a million culled", [*many[:500000], ball(0, 0, 2), *many[500000:]]),
        row_of("memory `lpddr5`", grid, arguments=lpddr5),
        row_of("memory `lpddr5`, array alone", grid, arguments=alone + lpddr5),
    ]
    print("| " + " | ".join(HEADINGS) + " |")
    print("| --- |" + " ---: |" * (len(HEADINGS) - 1))
    for row in rows:
        print("| " + " | ".join(str(cell) if isinstance(cell, str) else f"{cell:,}".replace(",", " ") for cell in row)
              + " |")


if __name__ == "__main__":
    sys.exit(main())
