#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""capture_poses.py CAMERAS [--per-second N]: the cameras of a cameras.json in the order of their images, N of them each
second (default 10), as recorded poses for `degs motion --poses`. Whoever took the pictures walked on a path that heads
may take, too. docs/motion.md uses it."""
import argparse
import json
import math


def quaternion(m):
    """w, x, y, z of a rotation matrix, by its largest component."""
    squares = [1 + m[0][0] + m[1][1] + m[2][2], 1 + m[0][0] - m[1][1] - m[2][2], 1 - m[0][0] + m[1][1] - m[2][2],
               1 - m[0][0] - m[1][1] + m[2][2]]
    most = squares.index(max(squares))
    s = 2 * math.sqrt(squares[most])
    turns = [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]]
    if most == 0:
        return [s / 4] + [turn / s for turn in turns]
    axis = most - 1
    sums = [(m[axis][other] + m[other][axis]) / s if other != axis else s / 4 for other in range(3)]
    return [turns[axis] / s] + sums


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("cameras", metavar="CAMERAS")
    parser.add_argument("--per-second", type=float, default=10)
    options = parser.parse_args()
    with open(options.cameras, encoding="utf-8") as file:
        cameras = sorted(json.load(file), key=lambda camera: camera["img_name"])
    print("time_s,x,y,z,qw,qx,qy,qz")
    for index, camera in enumerate(cameras):
        rotation = [[row[0], -row[1], -row[2]] for row in camera["rotation"]]  # y up, z back
        numbers = [index / options.per_second, *camera["position"], *quaternion(rotation)]
        print(",".join(f"{number:.9g}" for number in numbers))


if __name__ == "__main__":
    main()
