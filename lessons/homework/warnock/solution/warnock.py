"""Warnock's algorithm: an area that is simple is drawn; any other is divided into its four quarters.

usage: python3 warnock.py SCENE.txt > SCENE.jsonl
"""
import math
import sys

import emit

TIE = 1e-12


def read_scene(path):
    """(width, height, polygons); a polygon is a list of (x, y, z) of its vertices."""
    with open(path) as file:
        words = iter(file.read().split())
    width, height = int(next(words)), int(next(words))
    points = [tuple(float(next(words)) for _ in "xyz") for _ in range(int(next(words)))]
    polygons = [[points[int(next(words))] for _ in range(int(next(words)))] for _ in range(int(next(words)))]
    return width, height, polygons


def plane_of(polygon):
    """A, B, C, D by Newell's sums, so that concave polygons have theirs, too."""
    a = b = c = 0.0
    for (x_0, y_0, z_0), (x_1, y_1, z_1) in zip(polygon, polygon[1:] + polygon[:1]):
        a += (y_0 - y_1) * (z_0 + z_1)
        b += (z_0 - z_1) * (x_0 + x_1)
        c += (x_0 - x_1) * (y_0 + y_1)
    x, y, z = polygon[0]
    return a, b, c, -(a * x + b * y + c * z)


def meets(p, q, low, high):
    """Does the edge from p to q meet the rectangle? Is anything of it left between the four sides?"""
    start, end = 0.0, 1.0
    for axis in (0, 1):
        along = q[axis] - p[axis]
        if along == 0:
            if not low[axis] <= p[axis] <= high[axis]:
                return False
            continue
        t_0, t_1 = sorted(((low[axis] - p[axis]) / along, (high[axis] - p[axis]) / along))
        start, end = max(start, t_0), min(end, t_1)
    return start <= end


def covers(polygon, x, y):
    """Is the point in the polygon? An edge counts where it is to the left, y_0 <= y < y_1."""
    inside = False
    for p, q in zip(polygon, polygon[1:] + polygon[:1]):
        if (p[1] <= y) != (q[1] <= y) and p[0] + (q[0] - p[0]) * (y - p[1]) / (q[1] - p[1]) <= x:
            inside = not inside
    return inside


def in_front(z, piece, other_z, other):
    """Of equal depths the first polygon of the scene is in front."""
    return piece < other if abs(z - other_z) <= TIE else z < other_z


class Warnock:
    def __init__(self, polygons):
        self.polygons, self.planes, self.areas = polygons, [], 0
        emit.tables(len(polygons))
        for number, polygon in enumerate(polygons):
            emit.polygon(number, number)
            emit.make(number, number, -1)
            self.planes.append(plane_of(polygon))
            emit.plane(number, *self.planes[-1])

    def depth(self, piece, x, y):
        a, b, c, d = self.planes[piece]
        return -(a * x + b * y + d) / c

    def bin_of(self, piece, area):
        """How the polygon lies to the area."""
        left, top, right, bottom = area
        low, high = (left - 0.5, top - 0.5), (right - 0.5, bottom - 0.5)
        polygon = self.polygons[piece]
        crossings = sum(meets(p, q, low, high) for p, q in zip(polygon, polygon[1:] + polygon[:1]))
        corners = sum(covers(polygon, x, y) for x in (low[0], high[0]) for y in (low[1], high[1]))
        if crossings == 0:
            corners = 4 if corners > 0 else 0
            name = "surrounding" if corners > 0 else "disjoint"
        elif all(low[0] <= x <= high[0] and low[1] <= y <= high[1] for x, y, _ in polygon):
            name = "contained"
        else:
            name = "intersecting"
        getattr(emit, name)(piece, crossings, corners, name, False)
        return name

    def paint(self, piece, x, y):
        emit.paint(x, y, self.depth(piece, x, y), piece)

    def fill(self, piece, area):
        left, top, right, bottom = area
        for y in range(top, bottom):
            for x in range(left, right):
                self.paint(piece, x, y)

    def fill_part(self, piece, area):
        left, top, right, bottom = area
        for y in range(top, bottom):
            for x in range(left, right):
                if covers(self.polygons[piece], x, y):
                    self.paint(piece, x, y)

    def nearest_at(self, x, y, pieces):
        """The polygon that is seen at a pixel's centre, or -1."""
        best, least = -1, math.inf
        for piece in pieces:
            if not covers(self.polygons[piece], x, y):
                continue
            z = self.depth(piece, x, y)
            emit.center_depth(piece, x, y, z)
            if best < 0 or in_front(z, piece, least, best):
                best, least = piece, z
        return best

    def corner_depths(self, piece, area):
        left, top, right, bottom = [side - 0.5 for side in area]
        depths = []
        for x, y in ((left, top), (right, top), (left, bottom), (right, bottom)):
            depths.append(self.depth(piece, x, y))
            emit.corner_depth(piece, x, y, depths[-1])
        return depths

    def front_surrounder(self, area, around, partly):
        """The polygon that surrounds the area and is in front of all others at its four corners, or -1."""
        if not around:
            return -1
        depths = {piece: self.corner_depths(piece, area) for piece in around}
        front = around[0]
        for piece in around[1:]:
            if in_front(depths[piece][0], piece, depths[front][0], front):
                front = piece

        def hides(other, others_depths):
            return all(in_front(z, front, other_z, other) for z, other_z in zip(depths[front], others_depths))

        if not all(hides(piece, depths[piece]) for piece in around if piece != front):
            return -1
        return front if all(hides(piece, self.corner_depths(piece, area)) for piece in partly) else -1

    def settle(self, area, parent, pieces, around):
        """`around`: what is known to surround the area; `pieces`: what else may be in it."""
        number = self.areas
        self.areas += 1
        left, top, right, bottom = area
        emit.area(number, parent, left, top, right, bottom)
        for piece in around:
            emit.still_surrounding(piece, 0, 4, "surrounding", False)
        around, partly = list(around), []
        for piece in pieces:
            name = self.bin_of(piece, area)
            if name != "disjoint":
                (around if name == "surrounding" else partly).append(piece)
        if not around and not partly:
            emit.background(number, "background", -1)
        elif not around and len(partly) == 1:
            emit.one_polygon(number, "one_polygon", partly[0])
            self.fill_part(partly[0], area)
        elif len(around) == 1 and not partly:
            emit.surrounded(number, "surrounded", around[0])
            self.fill(around[0], area)
        elif right - left == 1 and bottom - top == 1:
            piece = self.nearest_at(left, top, around + partly)
            emit.pixel(number, "pixel", piece)
            if piece >= 0:
                self.paint(piece, left, top)
        else:
            front = self.front_surrounder(area, around, partly)
            if front >= 0:
                emit.front_surrounder(number, "front_surrounder", front)
                self.fill(front, area)
                return
            emit.subdivide(number, "subdivide", -1)
            middle, half = left + (right - left) // 2, top + (bottom - top) // 2
            for quarter in ((left, top, middle, half), (middle, top, right, half),
                            (left, half, middle, bottom), (middle, half, right, bottom)):
                if quarter[0] < quarter[2] and quarter[1] < quarter[3]:
                    self.settle(quarter, number, partly, around)


def main():
    width, height, polygons = read_scene(sys.argv[1])
    emit.clear(math.inf)
    Warnock(polygons).settle((0, 0, width, height), -1, range(len(polygons)), [])


main()
