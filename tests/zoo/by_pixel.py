"""A dictionary of pixels, and no scan lines: what is inside is decided in fractions, and depths come from the plane.

usage: python3 by_pixel.py TASKS     (triangles only)
"""
import math
from fractions import Fraction

from tools import each_task, say


def edge_functions(corners):
    """For each side a function that is greater than 0 inside; at 0 the side's own rule decides."""
    p = [(Fraction(x), Fraction(y)) for x, y, _ in corners]
    if (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) < (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]):
        p.reverse()
    for (x_0, y_0), (x_1, y_1) in zip(p, p[1:] + p[:1]):
        a, b = y_0 - y_1, x_1 - x_0
        yield a, b, -a * x_0 - b * y_0, a > 0 or (a == 0 and b > 0)


def plane(corners):
    """z = a x + b y + c, by Cramer's rule."""
    (x_0, y_0, z_0), (x_1, y_1, z_1), (x_2, y_2, z_2) = corners
    u, v = (x_1 - x_0, y_1 - y_0, z_1 - z_0), (x_2 - x_0, y_2 - y_0, z_2 - z_0)
    area = u[0] * v[1] - u[1] * v[0]
    a, b = (u[2] * v[1] - u[1] * v[2]) / area, (u[0] * v[2] - u[2] * v[0]) / area
    return a, b, z_0 - a * x_0 - b * y_0


def inside(sides, x, y):
    for a, b, c, on_side in sides:
        at = a * x + b * y + c
        if at < 0 or (at == 0 and not on_side):
            return False
    return True


def box(corners, axis, end):
    along = [corner[axis] for corner in corners]
    return range(max(0, math.ceil(min(along))), min(end, math.floor(max(along)) + 1))


def draw(width, height, points, polygons):
    depth, frame = {}, {}
    say("clear", z=math.inf)
    for number, polygon in enumerate(polygons):
        corners = [points[corner] for corner in polygon]
        sides = list(edge_functions(corners))
        if not any(a or b for a, b, _, _ in sides):
            continue
        columns, rows = box(corners, 0, width), box(corners, 1, height)
        covered = [(x, y) for x in columns for y in rows if inside(sides, x, y)]
        if not covered:
            continue
        a, b, c = plane(corners)
        say("polygon", polygon=number, facet=number)
        for pixel in covered:
            x, y = pixel
            z = a * x + b * y + c
            nearer = pixel not in depth or z < depth[pixel]
            say("compare", x=x, y=y, z=z, nearer=nearer)
            if nearer:
                depth[pixel], frame[pixel] = z, number
                say("write_depth", x=x, y=y, z=z)
                say("write_pixel", x=x, y=y, polygon=number)


each_task(draw)
