"""Warnock's algorithm: an area that is simple is drawn; any other is divided into its four quarters.

usage: python3 warnock.py SCENE.txt > SCENE.jsonl

What is marked TODO is yours. handout.md says what each step is; emit.py writes it down.
"""
import math
import sys

import emit


def read_scene(path):
    """(width, height, polygons); a polygon is a list of (x, y, z) of its vertices."""
    with open(path) as file:
        words = iter(file.read().split())
    width, height = int(next(words)), int(next(words))
    points = [tuple(float(next(words)) for _ in "xyz") for _ in range(int(next(words)))]
    polygons = [[points[int(next(words))] for _ in range(int(next(words)))] for _ in range(int(next(words)))]
    return width, height, polygons


def settle(left, top, right, bottom):
    # TODO: emit.area(…)
    # TODO: for each polygon that may be in the area: emit.disjoint(…), emit.contained(…) and so on
    # TODO: the depths by which it is decided: emit.corner_depth(…), emit.center_depth(…)
    # TODO: which case is it? emit.background(…), emit.one_polygon(…), emit.surrounded(…), emit.pixel(…),
    #       emit.front_surrounder(…) or emit.subdivide(…)
    # TODO: for each pixel that is drawn: emit.paint(…)
    # TODO: where the area is divided: settle(…) for each quarter
    pass


def main():
    width, height, polygons = read_scene(sys.argv[1])
    emit.clear(math.inf)
    emit.tables(len(polygons))
    for number, polygon in enumerate(polygons):
        emit.polygon(number, number)
        emit.make(number, number, -1)
        # TODO: the polygon's plane: emit.plane(…)
    settle(0, 0, width, height)


main()
