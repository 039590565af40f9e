"""The BSP tree: polygons divide space, and what is on the far side of each is drawn before it.

usage: python3 bsp.py SCENE.txt > SCENE.jsonl

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
        # TODO: it is a piece: emit.make(…)
    # TODO: build the tree: emit.node(…) for the first piece of the list
    # TODO: its plane: emit.plane(…)
    # TODO: the sides of the others: emit.vertex_side(…), emit.side(…)
    # TODO: where one lies in the plane: emit.add(…)
    # TODO: where one crosses it: emit.cut(…), emit.part(…)
    # TODO: then the same of those in front, and of those behind
    # TODO: go through the tree: first the far side, then the node, then the near side
    # TODO: which side is the far one? emit.eye_side(…); for each piece of the node: emit.draw(…)
    # TODO: for each pixel of the piece: emit.paint(…)


main()
