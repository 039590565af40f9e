"""Ray casting, polygon by polygon for each ray.

usage: python3 raycast.py SCENE.txt > SCENE.jsonl

What is marked TODO is yours. handout.md says what each step is; emit.py writes it down.
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
    # X_0 and dX of pixel (0, 0), and how each changes by a column and by a row; then the least and the greatest t.
    rays = {"from": [triple(), triple(), triple()], "along": [triple(), triple(), triple()],
            "least": float(next(words)), "most": float(next(words))}
    return width, height, polygons, background, colors, rays


def main():
    width, height, polygons, background, colors, rays = read_scene(sys.argv[1])
    emit.clear(math.inf)
    for y in range(height):
        for x in range(width):
            # TODO: the ray through the pixel's centre: emit.ray(…)
            # TODO: for each polygon, where the ray meets its plane: emit.plane(…)
            # TODO: where t is within its limits: emit.hit(…)
            # TODO: the nearest: emit.ray_end(…)
            # TODO: where something was met: emit.paint(…)
            pass


main()
