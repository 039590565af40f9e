"""What the Python programs of the zoo share: reading a task, and printing a step as JSON.

A task: width, height, how many points and polygons; then the points, then the polygons' corners, a line each.
"""
import math
import sys


def mistake():
    return sys.argv[2] if len(sys.argv) > 2 else ""


def read_task():
    """(width, height, points, polygons); a polygon is a list of numbers of points."""
    with open(sys.argv[1]) as task:
        lines = [line.split() for line in task]
    width, height, points, polygons = (int(word) for word in lines[0])
    vertices = [tuple(float(word) for word in line) for line in lines[1 : 1 + points]]
    return width, height, vertices, [[int(word) for word in line] for line in lines[1 + points : 1 + points + polygons]]


def value(of):
    if isinstance(of, bool):
        return "true" if of else "false"
    if isinstance(of, str):
        return '"%s"' % of
    return '"inf"' if of == math.inf else repr(of)


def say(step, **fields):
    parts = ['"%s":%s' % (key, value(of)) for key, of in dict(step=step, **fields).items()]
    print("{" + ",".join(parts) + "}")
