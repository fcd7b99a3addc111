# SPDX-License-Identifier: Apache-2.0
"""Where the scenes and camera files of points come from.

A scene is the name of a folder of DEGS_SCENES (default ../shared/scenes) or of DEGS_SCENES_LARGE (default
../shared/scenes-large), where it may come in parts; or synthetic:NAME,..., or ply:synthetic:NAME,..., which is written
to a file and read from there. A camera file is a name in DEGS_CAMERAS (default ../shared/cameras-real) without its
ending, or a path of the repository."""
import functools
import os
import pathlib
import re
import sys
import tempfile
import threading

from join_sog import join

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from degs.process import call  # noqa: E402

SCENES = pathlib.Path(os.environ.get("DEGS_SCENES", ROOT / "../shared/scenes"))
LARGE = pathlib.Path(os.environ.get("DEGS_SCENES_LARGE", ROOT / "../shared/scenes-large"))
CAMERAS = pathlib.Path(os.environ.get("DEGS_CAMERAS", ROOT / "../shared/cameras-real"))
MAKING = threading.Lock()


class Missing(Exception):
    """A scene or a camera file that is not there."""


@functools.lru_cache(maxsize=None)
def made_scenes():
    """A folder of scenes that goes with this process."""
    return tempfile.TemporaryDirectory(prefix="degs-scenes-")


def files_of(scene):
    """The files whose contents say what a scene is: one, or parts and cameras; a name alone says what a synthetic one
    is."""
    if "synthetic:" in scene:
        return []
    file, folder = SCENES / scene / "scene.ply", LARGE / scene
    parts = sorted(folder.glob("*.sog"))
    if not file.exists() and not parts:
        raise Missing(f"there is no scene {file}, and none in parts in {folder}")
    return [str(part) for part in ([file] if file.exists() else [*parts, folder / "cameras.json"])]


def scene_file(name):
    """What the program is given for a scene."""
    if name.startswith("synthetic:"):
        return name
    if name.startswith("ply:"):
        return made(name, "scene.ply", lambda out: write_ply(name[len("ply:"):], out))
    file, *more = files_of(name)
    return made(name, "lod-meta.json", lambda out: join(LARGE / name, out.parent)) if more else file


def made(name, file, make):
    """A file of a scene that is made when it is first asked for."""
    with MAKING:
        out = pathlib.Path(made_scenes().name, re.sub(r"\W", "-", name), file)
        if not out.exists():
            make(out)
    return str(out)


def write_ply(scene, out):
    out.parent.mkdir()
    call(["scene", "convert", scene, str(out)], warn=False)


def camera_file(name):
    file = ROOT / name if "/" in name else CAMERAS / f"{name}.json"
    if not file.exists():
        raise Missing(f"there is no camera file {file}")
    return str(file)
