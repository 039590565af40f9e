"""All numbers in float32, by way of struct; depth and frame are flat arrays.

The picture is drawn from the last line up, each line with all polygons.

usage: python3 in_float32.py TASKS
"""
import math
import struct
from array import array

from tools import each_task, say


def f(number):
    return struct.unpack("<f", struct.pack("<f", number))[0]


def on_line(a_0, a_1, at, b_0, b_1):
    """a_0 + (a_1 - a_0)(at - b_0)/(b_1 - b_0), rounded after each operation."""
    return f(a_0 + f(f(f(a_1 - a_0) * f(at - b_0)) / f(b_1 - b_0)))


def crossings(outline, y):
    found = []
    for i, (x_1, y_1, z_1) in enumerate(outline):
        x_0, y_0, z_0 = outline[i - 1]
        if min(y_0, y_1) <= y < max(y_0, y_1):
            found.append((on_line(x_0, x_1, y, y_0, y_1), on_line(z_0, z_1, y, y_0, y_1)))
    found.sort()
    return found


def draw(width, height, points, polygons):
    points = [tuple(f(number) for number in point) for point in points]
    outlines = [[points[corner] for corner in polygon] for polygon in polygons]
    depth, frame = array("f", [math.inf] * (width * height)), array("i", [-1] * (width * height))
    say("clear", z=math.inf)
    for y in range(height - 1, -1, -1):
        for number, outline in enumerate(outlines):
            found = crossings(outline, y)
            begun = False
            for (x_0, z_0), (x_1, z_1) in zip(found[::2], found[1::2]):
                for x in range(max(0, math.ceil(x_0)), min(width, math.ceil(x_1))):
                    if not begun:
                        say("polygon", polygon=number, facet=number)
                        begun = True
                    z, pixel = on_line(z_0, z_1, x, x_0, x_1), y * width + x
                    nearer = z < depth[pixel]
                    say("compare", x=x, y=y, z=z, nearer=nearer)
                    if nearer:
                        depth[pixel], frame[pixel] = z, number
                        say("write_depth", x=x, y=y, z=z)
                        say("write_pixel", x=x, y=y, polygon=number)


each_task(draw)
