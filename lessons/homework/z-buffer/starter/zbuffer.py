"""The Z-buffer with edge table and active edge list.

usage: python3 zbuffer.py SCENE.txt > SCENE.jsonl

What is marked TODO is yours. handout.md says what each step is; emit.py writes it down.
"""
import math
import sys

import emit


def read_scene(path):
    """(width, height, polygons); a polygon is a list of (number, x, y, z) of its vertices."""
    with open(path) as file:
        words = iter(file.read().split())
    width, height = int(next(words)), int(next(words))
    points = [tuple(float(next(words)) for _ in "xyz") for _ in range(int(next(words)))]
    polygons = []
    for _ in range(int(next(words))):
        corners = [int(next(words)) for _ in range(int(next(words)))]
        polygons.append([(corner, *points[corner]) for corner in corners])
    return width, height, polygons


def main():
    width, height, polygons = read_scene(sys.argv[1])
    depth = [[math.inf] * width for _ in range(height)]
    emit.clear(math.inf)
    for polygon, vertices in enumerate(polygons):
        emit.polygon(polygon, polygon)
        # TODO: the edge table: emit.insert_edge(…) for each edge of the polygon that meets a scan line
        # TODO: for each other edge: emit.skip_edge(…)
        # TODO: for each scan line: emit.scan_line(y)
        # TODO: its active edges: emit.retire_edge(…), emit.step_edge(…), emit.enter_edge(…)
        # TODO: for each pair of them: emit.span(…), and for each of its pixels emit.interpolate_z(…)
        # TODO: for each pixel: emit.compare(…)
        # TODO: where it is nearer: emit.write_depth(…), emit.write_pixel(…)


main()
