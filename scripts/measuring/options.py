# SPDX-License-Identifier: Apache-2.0
"""Options of points that the program does not have, and what it gets in their place.

    --field DEGREES    the camera gets this field of view, square pixels and the given size
    --path FILE:VIEWS  --camera is a number among so many views of a camera file, moved into the scene (camera_path.py)
    --packed           the design starts from a workload file, into which the view was packed for it

{out} in an option is the folder of the results."""
import json
import math
import pathlib

from .camera_path import moved_path
from .scenes import camera_file
from degs.process import call

VIEW = ("--scene", "--camera", "--width", "--height", "--resolution")  # what a workload file stands for


def for_program(words, folder):
    """A command line with the options of the program alone; the files that it needs are in the folder."""
    words = [word.replace("{out}", folder) for word in words]
    for change in (with_field, with_path, with_packed):
        words = change(words, pathlib.Path(folder))
    return words


def parted(words, names):
    """The options of these names with their values, and the other words."""
    mine, others = [], []
    for before, word in zip(["", *words], words):
        (mine if word in names or before in names else others).append(word)
    return mine, others


def valued(words):
    """The word behind each word: the values of options by their names."""
    return dict(zip(words, words[1:]))


def with_camera(words, names, camera, folder):
    """A command line with a file of one camera in place of the options of these names."""
    file = folder / "camera.json"
    file.write_text(json.dumps([camera]), encoding="utf-8")
    return [*parted(words, names)[1], "--camera-file", str(file)]


def with_field(words, folder):
    """The camera of a headset, at the place of one of the scene's."""
    if "--field" not in words:
        return words
    named, file = valued(words), folder / "cameras.json"
    call(["scene", "cameras", named["--scene"], "--out", str(file)], warn=False)
    camera = json.loads(file.read_text(encoding="utf-8"))[int(named["--camera"])]
    width = int(named["--width"])
    focal = width / 2 / math.tan(math.radians(float(named["--field"]) / 2))
    kept = {key: camera[key] for key in ("id", "img_name", "position", "rotation")}
    camera = {**kept, "width": width, "height": int(named.get("--height", width)), "fx": focal, "fy": focal}
    return with_camera(words, ("--field", "--camera", "--width", "--height"), camera, folder)


def path_of(words):
    """(camera file, number of views) of --path."""
    name, views = valued(words)["--path"].rsplit(":", 1)
    return camera_file(name), int(views)


def with_path(words, folder):
    """A camera of a real path at the place of the scene that the path was moved into."""
    if "--path" not in words:
        return words
    named, (file, views) = valued(words), path_of(words)
    place = named["--scene"].split(":")[1].split(",")[0]
    camera = moved_path(file, place, views)[int(named["--camera"])]
    return with_camera(words, ("--path", "--camera"), camera, folder)


def with_packed(words, folder):
    """A workload file of the design in place of the view."""
    if "--packed" not in words:
        return words
    file = str(folder / "frame.degsw")
    view, others = parted([word for word in words if word != "--packed"], VIEW)
    call(["workload", "pack", others[1], *view, *parted(others, ("--set",))[0], "--out", file], warn=False)
    return [*others, "--workload", file]
