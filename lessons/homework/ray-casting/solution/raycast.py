"""Ray casting, polygon by polygon for each ray.

usage: python3 raycast.py SCENE.txt > SCENE.jsonl
"""
import math
import sys

import emit


def read_scene(path):
    """(width, height, polygons, background, colors, rays); a polygon is a list of (x, y, z) of its vertices."""
    with open(path) as file:
        words = iter(file.read().split())

    def triple(kind=float):
        return tuple(kind(next(words)) for _ in range(3))

    width, height = int(next(words)), int(next(words))
    points = [triple() for _ in range(int(next(words)))]
    polygons = [[points[int(next(words))] for _ in range(int(next(words)))] for _ in range(int(next(words)))]
    background = triple()
    colors = [triple() for _ in polygons]
    rays = {"from": [triple(), triple(), triple()], "along": [triple(), triple(), triple()],
            "least": float(next(words)), "most": float(next(words))}
    return width, height, polygons, background, colors, rays


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def plane_of(polygon):
    """A, B, C of length 1, and D; the normal by Newell's sums, so that concave polygons have theirs, too."""
    normal = [0.0, 0.0, 0.0]
    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
        normal[0] += (a[1] - b[1]) * (a[2] + b[2])
        normal[1] += (a[2] - b[2]) * (a[0] + b[0])
        normal[2] += (a[0] - b[0]) * (a[1] + b[1])
    length = math.sqrt(dot(normal, normal))
    normal = [n / length for n in normal]
    return normal, -dot(normal, polygon[0])


def inside(polygon, normal, point):
    """By the even-odd rule, without the coordinate in which the polygon's plane has least to say."""
    drop = max(range(3), key=lambda axis: abs(normal[axis]))
    u, v = [axis for axis in range(3) if axis != drop]
    within = False
    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
        if (a[v] <= point[v]) != (b[v] <= point[v]):
            if a[u] + (b[u] - a[u]) * (point[v] - a[v]) / (b[v] - a[v]) <= point[u]:
                within = not within
    return within


def depth_of(t, rays):
    """Pseudodepth: -1 at the least t, 1 at the greatest."""
    least, most = rays["least"], rays["most"]
    if any(rays["from"][1] + rays["from"][2]):  # they begin at different points: parallel rays
        return (2 * t - most - least) / (most - least)
    return ((most + least) - 2 * most * least / t) / (most - least)


def main():
    width, height, polygons, background, colors, rays = read_scene(sys.argv[1])
    planes = [plane_of(polygon) for polygon in polygons]
    emit.clear(math.inf)
    for y in range(height):
        for x in range(width):
            number = y * width + x
            start, along = ([a + x * b + y * c for a, b, c in zip(*rays[which])] for which in ("from", "along"))
            emit.ray(number, -1, "eye", x, y, *start, *along)
            nearest, least = -1, math.inf
            for i, (normal, d) in enumerate(planes):
                numerator, denominator = -(dot(normal, start) + d), dot(normal, along)
                t = numerator / denominator if denominator != 0 else math.nan
                emit.plane(i, numerator, denominator, t)
                if not rays["least"] <= t <= rays["most"]:
                    continue
                point = [a + t * b for a, b in zip(start, along)]
                within = inside(polygons[i], normal, point)
                nearer = within and t < least
                emit.hit(i, t, *point, within, nearer)
                if nearer:
                    nearest, least = i, t
            color = background if nearest < 0 else colors[nearest]
            emit.ray_end(number, nearest, least, len(polygons), *(c / 255 for c in color))
            if nearest >= 0:
                emit.paint(x, y, depth_of(least, rays), nearest)


main()
