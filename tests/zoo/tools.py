"""What the Python programs of the zoo share: reading tasks, and printing a step as JSON.

A task: width, height, how many points and polygons, and the mistake to make, if any; then the points, then the
polygons' corners, a line each. A file has many of them, as starting an interpreter takes longer than a run; an empty
line ends each run.
"""
import math
import sys

_mistake = ""


def mistake():
    return _mistake


def each_task(draw):
    """Calls draw(width, height, points, polygons) for each task; a polygon is a list of numbers of points."""
    global _mistake
    with open(sys.argv[1]) as tasks:
        for first in tasks:
            width, height, points, polygons, *wrong = first.split()
            _mistake = "".join(wrong)
            vertices = [tuple(float(word) for word in next(tasks).split()) for _ in range(int(points))]
            outlines = [[int(word) for word in next(tasks).split()] for _ in range(int(polygons))]
            draw(int(width), int(height), vertices, outlines)
            print()


def value(of):
    if isinstance(of, bool):
        return "true" if of else "false"
    if isinstance(of, str):
        return '"%s"' % of
    return '"inf"' if of == math.inf else repr(of)


def say(step, **fields):
    parts = ['"%s":%s' % (key, value(of)) for key, of in dict(step=step, **fields).items()]
    print("{" + ",".join(parts) + "}")
