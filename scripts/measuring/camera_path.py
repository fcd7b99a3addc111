# SPDX-License-Identifier: Apache-2.0
"""Views of a real camera file, moved into a synthetic scene.

The rule has three steps. The point nearest to all view axes goes to the middle of the scene's open
space. The mean of the downward axes becomes the vertical. The median distance of the cameras from
that point becomes 0.35 of the shorter side of the space."""
import json
import math
import statistics

# Middle of the open space at the height at which the cameras look, and its shorter side; y points
# down. The numbers are those of the walls in src/scene/synthetic.
SPACES = {"interior": ((0, -1.0, 0), 5.2), "garden": ((0, -1.0, 0), 10)}
SHARE = 0.35


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def scaled(a, factor):
    return [factor * x for x in a]


def unit(a):
    return scaled(a, 1 / math.sqrt(dot(a, a)))


def column(camera, index):
    """An axis of the view in world space: 0 right, 1 down, 2 forward."""
    return [row[index] for row in camera["rotation"]]


def focus_of(cameras):
    """The point with the least sum of squared distances from the view axes, by Cramer's rule."""
    rows, right = [[0.0] * 3 for _ in range(3)], [0.0] * 3
    for camera in cameras:
        axis = column(camera, 2)
        for i in range(3):
            across = [(i == j) - axis[i] * axis[j] for j in range(3)]
            rows[i] = [a + b for a, b in zip(rows[i], across)]
            right[i] += dot(across, camera["position"])
    normals = [cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])]
    return [sum(normals[i][k] * right[i] for i in range(3)) / dot(rows[0], normals[0]) for k in range(3)]


def upright(down):
    """The rotation with least roll whose second row is the direction `down`."""
    side = unit(cross(down, [0, 0, 1] if abs(down[2]) < 0.9 else [1, 0, 0]))
    return [side, down, cross(side, down)]


def moved_path(file, scene, views):
    """Evenly taken views of a camera file in the order of its images, as cameras of the scene."""
    with open(file, encoding="utf-8") as text:
        cameras = sorted(json.load(text), key=lambda camera: camera.get("img_name", ""))
    focus = focus_of(cameras)
    median = statistics.median(math.dist(camera["position"], focus) for camera in cameras)
    down = unit([statistics.mean(column(camera, 1)[i] for camera in cameras) for i in range(3)])
    turn = upright(down)
    middle, side = SPACES[scene]
    result = []
    for index in range(min(views, len(cameras))):
        camera = dict(cameras[index * len(cameras) // views])
        offset = scaled([p - f for p, f in zip(camera["position"], focus)], SHARE * side / median)
        camera["position"] = [m + dot(row, offset) for m, row in zip(middle, turn)]
        axes = [[dot(row, column(camera, k)) for row in turn] for k in range(3)]
        camera["rotation"] = [[axes[k][i] for k in range(3)] for i in range(3)]
        result.append(camera)
    return result
