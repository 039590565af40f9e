"""One scan line after another, all polygons on each: the depth buffer is a line long, and z comes by increments.

usage: python3 by_line.py TASKS
"""
import math

from tools import each_task, mistake, say


def spans(corners, y):
    """(x_L, z_L, x_R, z_R) of each span."""
    found = []
    for (x_0, y_0, z_0), (x_1, y_1, z_1) in zip(corners, corners[1:] + corners[:1]):
        if y_0 == y_1:
            continue
        if y_0 > y_1:
            x_0, y_0, z_0, x_1, y_1, z_1 = x_1, y_1, z_1, x_0, y_0, z_0
        if not (y_0 < y <= y_1 if mistake() == "last_line_in" else y_0 <= y < y_1):
            continue
        x = x_0 + (x_1 - x_0) / (y_1 - y_0) * (y - y_0)
        z = z_0 + (z_1 - z_0) / (y_1 - y_0) * (y - y_0)
        found.append((x, z))
    found.sort(key=lambda crossing: crossing[0])
    if mistake() == "unsorted":
        found.reverse()
        found = found[1:] + found[:1]
    return [found[i] + found[i + 1] for i in range(0, len(found) - 1, 2)]


def draw(width, height, vertices, polygons):
    outlines = [[vertices[corner] for corner in corners] for corners in polygons]
    say("clear", z=math.inf)
    buffer = [math.inf] * width
    for y in range(height):
        if mistake() != "buffer_of_line_before":
            buffer = [math.inf] * width
        for polygon, corners in enumerate(outlines):
            pieces = spans(corners, y)
            if not pieces:
                continue
            begun = False
            for x_left, z_left, x_right, z_right in pieces:
                if x_right <= x_left:
                    continue
                slope = (z_right - z_left) / (x_right - x_left)
                first = math.ceil(x_left)
                last = math.ceil(x_right) - 1
                if mistake() == "truncated":
                    first, last = int(x_left), int(x_right)
                z = z_left + slope * (first - x_left)
                if mistake() == "begins_at_edge":
                    z = z_left
                for x in range(first, last + 1):
                    if 0 <= x < width:
                        if not begun:
                            say("polygon", polygon=polygon, facet=polygon)
                            begun = True
                        nearer = z < buffer[x]
                        say("compare", x=x, y=y, z=z, nearer=nearer)
                        if nearer:
                            buffer[x] = z
                            say("wz", x=x, y=y, z=z)
                            say("wp", x=x, y=y, polygon=polygon)
                    z += slope


each_task(draw)
