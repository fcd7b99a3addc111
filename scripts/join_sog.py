#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""join_sog.py FOLDER OUT: makes one scene of the .sog files in FOLDER, which are parts of one and the same.

OUT must not exist yet. It gets copies of the parts, the camera file of FOLDER and a lod-meta.json that names each part
as a leaf with one level of detail, as a streamed SOG scene does. `degs scene info OUT/lod-meta.json` reads it, and
`degs scene convert OUT/lod-meta.json scene.ply` writes it as one file."""
import json
import pathlib
import shutil
import sys
import zipfile


def gaussians_of(part):
    """As its meta.json says it: version 1 has the number in the shape of the positions."""
    with zipfile.ZipFile(part) as archive:
        meta = json.loads(archive.read("meta.json"))
    return meta["count"] if "count" in meta else meta["means"]["shape"][0]


def join(folder, out):
    """Returns the name of the index."""
    folder, out = pathlib.Path(folder), pathlib.Path(out)
    parts = sorted(folder.glob("*.sog"))
    if not parts:
        sys.exit(f"join_sog.py: there are no .sog files in {folder}.")
    out.mkdir(parents=True)
    counts = [gaussians_of(part) for part in parts]
    for file in [*parts, *folder.glob("cameras.json")]:
        shutil.copyfile(file, out / file.name)
    leaves = [{"lods": {"0": {"file": number, "offset": 0, "count": count}}} for number, count in enumerate(counts)]
    index = {"version": 1, "count": sum(counts), "counts": [sum(counts)], "lodLevels": 1,
             "filenames": [part.name for part in parts], "tree": {"children": leaves}}
    # The program takes a folder with .sog files for a sequence, so the index is what is named.
    (out / "lod-meta.json").write_text(json.dumps(index, indent=1) + "\n", encoding="utf-8")
    return str(out / "lod-meta.json")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: join_sog.py FOLDER OUT")
    print(join(sys.argv[1], sys.argv[2]))
