# SPDX-License-Identifier: Apache-2.0
"""Fronts of points whose goals shall all be small, and how much of the space they reach."""


def beats(a, b):
    """Nowhere worse, and somewhere better."""
    return a != b and all(x <= y for x, y in zip(a, b))


def front_of(points):
    """The points that no other beats, each once."""
    return [point for point in set(points) if not any(beats(other, point) for other in points)]


def volume(points, worst):
    """Hypervolume of what is worse than one of the points and better than `worst`: slices along the last goal."""
    if len(worst) == 1:
        return max([worst[0] - point[0] for point in points] + [0])
    points = sorted((point for point in points if point[-1] < worst[-1]), key=lambda point: point[-1])
    ends = [point[-1] for point in points[1:]] + [worst[-1]]
    return sum((end - point[-1]) * volume([each[:-1] for each in points[:count]], worst[:-1])
               for count, (point, end) in enumerate(zip(points, ends), start=1))


def share_of_volume(points, all_points):
    """The hypervolume of points over that of all. Every goal goes from 0, its best value among all, to 1, its worst, and
    the volume ends at 1.1; a goal in which all are equal is 0."""
    lows = [min(values) for values in zip(*all_points)]
    highs = [max(values) for values in zip(*all_points)]

    def scaled(chosen):
        return [tuple((x - low) / (high - low or 1) for x, low, high in zip(point, lows, highs)) for point in chosen]

    worst = (1.1,) * len(lows)
    return volume(scaled(points), worst) / volume(scaled(all_points), worst)


def grown(points, first, count):
    """The places of `count` points: `first`, and one after the other the one that makes the hypervolume largest."""
    chosen = [first]
    while len(chosen) < min(count, len(points)):
        left = [place for place in range(len(points)) if place not in chosen]
        chosen.append(max(left, key=lambda place: share_of_volume([points[c] for c in [*chosen, place]], points)))
    return chosen
