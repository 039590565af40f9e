"""Depth sort: of a list of polygons, the farthest first, each is painted once no other one must come before it.

usage: python3 depthsort.py SCENE.txt > SCENE.jsonl

What is marked TODO is yours. handout.md says what each step is; emit.py writes it down.
"""
import math
import sys

import emit


def read_scene(path):
    """(width, height, points, polygons); a polygon is a list of the numbers of its vertices."""
    with open(path) as file:
        words = iter(file.read().split())
    width, height = int(next(words)), int(next(words))
    points = [tuple(float(next(words)) for _ in "xyz") for _ in range(int(next(words)))]
    polygons = [[int(next(words)) for _ in range(int(next(words)))] for _ in range(int(next(words)))]
    return width, height, points, polygons


def main():
    width, height, points, polygons = read_scene(sys.argv[1])
    emit.clear(math.inf)
    emit.tables(len(polygons))
    for polygon, corners in enumerate(polygons):
        emit.polygon(polygon, polygon)
        # TODO: it is a piece: emit.outline(…) for each vertex, and emit.make(…)
        # TODO: its plane and extent: emit.plane(…), emit.extent(…)
    # TODO: put each piece into the list: emit.insert(…)
    # TODO: until the list is empty: hold the first piece P against each other piece Q: emit.pair(…)
    # TODO: the tests, up to the first that says yes: emit.z_extents(…), or emit.test_1(…) to emit.test_5(…)
    # TODO: where none does: emit.test_3_swapped(…), emit.test_4_swapped(…)
    # TODO: if one of these says yes, Q is the new P: emit.take_out(…), emit.move(…), emit.mark(…)
    # TODO: if not, which one is cut? emit.split(…)
    # TODO: the cut: emit.cut(…), and for each part emit.outline(…) for each vertex, and emit.part(…)
    # TODO: the plane and extent of each part: emit.plane(…), emit.extent(…)
    # TODO: the list after it: emit.remove(…), emit.insert_part(…); and its first piece is P
    # TODO: where no Q is in the way: emit.draw(…)
    # TODO: for each pixel of it: emit.paint(…)
    # TODO: it leaves the list: emit.drawn(…)


main()
