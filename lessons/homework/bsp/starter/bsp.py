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
    # TODO: build the tree: emit.node(…), emit.plane(…) for the first piece of the list,
    #       emit.vertex_side(…), emit.side(…) for each of the others,
    #       emit.add(…) or emit.cut(…) and emit.part(…) for some; then the same
    #       of those in front, and of those behind
    # TODO: go through the tree: emit.eye_side(…) at each node; the far side; emit.draw(…) and emit.paint(…) for each
    #       piece of the node; the near side


main()
