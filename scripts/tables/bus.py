# SPDX-License-Identifier: Apache-2.0
"""Table of docs/cost.md: energy of the memory by the model `bus` over that by `lpddr5`, both of 204.8 GB/s."""
from statistics import geometric_mean

from measuring.points import run
from measuring.tables import markdown, table

DESIGNS = ("degs-64", "gscore-64", "gbu-64", "gcc-64", "orange-o1")
VIEWS = [(scene, camera) for scene in ("flowers", "garden-crop", "guitar", "seal", "skull", "st-peter")
         for camera in ("1", "2")]


@table("docs/cost.md")
def bus_energy():
    """Mean, least and most over the views, and the energy of activations, which the bus cannot see."""
    found = yield {design: [[run(design, scene, f"--camera {camera} --width 640", f"memory.model={model}")
                             for model in ("bus", "lpddr5")] for scene, camera in VIEWS] for design in DESIGNS}
    rows, everything = [], []
    for design, pairs in found.items():
        ratios = [bus.energy.dram_nj / banks.energy.dram_nj for bus, banks in pairs]
        opened = [1e3 * banks.dram.energy_nj.activate / 8 / (banks.dram.bytes_read + banks.dram.bytes_written)
                  for _, banks in pairs]
        everything += ratios
        rows.append([f"`{design}`", f"{geometric_mean(ratios):.3f}", f"{min(ratios):.3f}", f"{max(ratios):.3f}",
                     f"{min(opened):.2f} to {max(opened):.2f}"])
    rows.append(["all", f"{geometric_mean(everything):.3f}", f"{min(everything):.3f}", f"{max(everything):.3f}", ""])
    return markdown(["energy of the bus over that of LPDDR5", "mean", "least", "most", "activations, pJ/bit"], rows)
