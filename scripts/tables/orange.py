# SPDX-License-Identifier: Apache-2.0
"""Tables of docs/orange.md."""
import math
from statistics import geometric_mean

from measuring.points import FIVE, accuracy, run
from measuring.tables import markdown, table

PAGE = "docs/orange.md"
VIEWS = [(scene, camera) for scene in ("guitar", "skull", "seal") for camera in ("2", "1")]
MANY = [(scene, camera) for scene in FIVE for camera in ("2", "1")]


@table(PAGE)
def orange_images():
    """PSNR against double precision, by numbers and origin: the range over the scenes."""
    numbers, origins = ("fp32", "fp16"), ("tile", "image")
    found = yield {camera: {origin: [accuracy(scene, f"--camera {camera} --resolution 720p --tile-size 8 --numbers "
                                              f"{','.join(numbers)} --products {origin}")
                                     for scene, of in VIEWS if of == camera] for origin in origins}
                   for camera in ("2", "1")}
    rows = []
    for camera, by_origin in found.items():
        cells = []
        for number in numbers:
            for origin in origins:
                psnr = [row["psnr_db"] for rows in by_origin[origin] for row in rows if row["numbers"] == number]
                cells.append(f"{min(psnr):.0f} to {max(psnr):.0f}")
        rows.append([f"camera {camera}", *cells])
    return markdown(["PSNR in dB", "fp32, tile", "fp32, image", "FP16, tile", "FP16, image"], rows)


@table(PAGE)
def orange_throughput():
    """Frames per second of DeGS-64 over those of O-4, frames in sequence: least, mean and most over the views."""
    found = yield {rate: [[run(design, scene, f"--camera {camera} --resolution 720p --frames 3",
                               f"memory.bandwidth_gb_per_s={rate}") for design in ("degs-64", "orange-o4")]
                          for scene, camera in MANY] for rate in ("51.2", "204.8")}
    rows = []
    for rate, pairs in found.items():
        ratios = [degs.throughput_fps / orange.throughput_fps for degs, orange in pairs]
        rows.append([f"{rate} GB/s", f"{min(ratios):.2f}", f"{geometric_mean(ratios):.2f}", f"{max(ratios):.2f}"])
    return markdown(["DeGS-64 over O-4, frames per second", "least", "geometric mean", "most"], rows)


@table(PAGE)
def orange_arrays():
    """One core with a square array of 4 to 16 384 multipliers, array alone."""
    found = yield {side: run(f"orange@{side * side}", "guitar", "--camera 2 --resolution 720p --array-only")
                   for side in (2, 8, 32, 64, 128)}
    rows = []
    for side, report in found.items():
        slots = report.slots
        executed = slots.useful + slots.boundary + slots.terminated
        rows.append([f"{side} x {side}", side * side, f"{100 * 6 / (math.ceil(6 / side) * side):.2f}",
                     f"{100 * executed / (executed + slots.padding):.2f}", f"{100 * slots.useful / slots.total:.2f}",
                     f"{report.cycles / 1e6:.2f}"])
    return markdown(["array", "multipliers", "reduction alone %", "of busy cycles %", "useful %", "M cycles"], rows)
