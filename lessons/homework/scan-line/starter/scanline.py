"""The scan-line method: one edge table for all polygons, and an in/out flag for each polygon.

usage: python3 scanline.py SCENE.txt > SCENE.jsonl

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
    emit.clear(math.inf)
    emit.tables(len(polygons))
    for polygon, vertices in enumerate(polygons):
        emit.polygon(polygon, polygon)
        emit.make(polygon, polygon, -1)
        # TODO: the polygon's plane: emit.plane(…)
    # TODO: the edge table of all polygons: emit.insert_edge(…) or emit.skip_edge(…) for each edge
    # TODO: for each scan line: emit.scan_line(y)
    # TODO: its active edges: emit.retire_edge(…), emit.step_edge(…), emit.swap_edges(…), emit.enter_edge(…)
    # TODO: for each active edge: emit.flip(…), and up to the next one emit.flags(…)
    # TODO: where several flags are in: emit.depth(…), emit.implied_edge(…)
    # TODO: what is seen: emit.winner(…)
    # TODO: for each of its pixels: emit.paint(…)


main()
