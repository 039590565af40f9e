"""The scan-line method: one edge table for all polygons, and an in/out flag for each polygon.

usage: python3 scanline.py SCENE.txt > SCENE.jsonl
"""
import math
import sys

import emit

TIE = 1e-9  # depths, and places on a scan line, that are no further apart are equal


def read_scene(path):
    """(width, height, polygons); a polygon is a list of (number, x, y, z) of its vertices."""
    with open(path) as file:
        words = iter(file.read().split())
    width, height = int(next(words)), int(next(words))
    points = [tuple(float(next(words)) for _ in "xyz") for _ in range(int(next(words)))]
    polygons = []
    for _ in range(int(next(words))):
        corners = [int(next(words)) for _ in range(int(next(words)))]
        polygons.append([(corner, *points[corner]) for corner in corners])
    return width, height, polygons


def plane_of(vertices):
    """A, B, C, D by Newell's sums, so that concave polygons have theirs, too."""
    a = b = c = 0.0
    for (_, x_0, y_0, z_0), (_, x_1, y_1, z_1) in zip(vertices, vertices[1:] + vertices[:1]):
        a += (y_0 - y_1) * (z_0 + z_1)
        b += (z_0 - z_1) * (x_0 + x_1)
        c += (x_0 - x_1) * (y_0 + y_1)
    _, x, y, z = vertices[0]
    return a, b, c, -(a * x + b * y + c * z)


def edge_table(polygons, height):
    """The edges of all polygons, numbered in one go."""
    edges = []
    for polygon, vertices in enumerate(polygons):
        for a, b in zip(vertices, vertices[1:] + vertices[:1]):
            if a[2] == b[2]:
                emit.skip_edge(a[0], b[0], "horizontal")
                continue
            if a[2] > b[2]:
                a, b = b, a
            # A scan line at y crosses the edge if y_0 <= y < y_1: the lower end belongs to the next edge.
            first, end = max(0, math.ceil(a[2])), min(height, math.ceil(b[2]))
            if first >= end:
                emit.skip_edge(a[0], b[0], "between_rows" if math.ceil(a[2]) == math.ceil(b[2]) else "outside")
                continue
            dx_dy = (b[1] - a[1]) / (b[2] - a[2])
            dz_dy = (b[3] - a[3]) / (b[2] - a[2])
            edge = {"number": len(edges), "polygon": polygon, "a": a, "b": b, "first": first, "end": end,
                    "dx_dy": dx_dy}
            move_to(edge, first)
            emit.insert_edge(len(edges), polygon, a[0], b[0], first, end, edge["x"], dx_dy, edge["z"], dz_dy)
            edges.append(edge)
    return edges


def move_to(edge, y):
    """Where the edge crosses the scan line: the formula of the line, each time anew."""
    a, b = edge["a"], edge["b"]
    edge["x"] = a[1] + (b[1] - a[1]) * (y - a[2]) / (b[2] - a[2])
    edge["z"] = a[3] + (b[3] - a[3]) * (y - a[2]) / (b[2] - a[2])


def order(edge):
    return edge["x"], edge["dx_dy"]


def update(active, edges, y):
    """The active edges of scan line y, from left to right."""
    emit.scan_line(y)
    for edge in [edge for edge in active if edge["end"] == y]:
        active.remove(edge)
        emit.retire_edge(edge["number"])
    for edge in active:
        move_to(edge, y)
        emit.step_edge(edge["number"], edge["x"], edge["z"])
    for i in range(1, len(active)):
        while i > 0 and order(active[i]) < order(active[i - 1]):
            active[i - 1], active[i] = active[i], active[i - 1]
            i -= 1
            emit.swap_edges(i)
    for edge in edges:
        if edge["first"] == y:
            place = sum(1 for other in active if order(other) <= order(edge))
            active.insert(place, edge)
            emit.enter_edge(edge["number"], place)


class Picture:
    def __init__(self, polygons, width):
        self.planes, self.width = [plane_of(vertices) for vertices in polygons], width

    def depth(self, polygon, x, y):
        a, b, c, d = self.planes[polygon]
        return -(a * x + b * y + d) / c

    def sweep(self, active, y):
        inside = []  # the polygons whose flags are in
        for edge, following in zip(active, active[1:] + [None]):
            polygon = edge["polygon"]
            if polygon in inside:
                inside.remove(polygon)
            else:
                inside.append(polygon)
            emit.flip(edge["number"], polygon, polygon in inside)
            if following is None or edge["x"] == following["x"]:
                continue
            left, right = max(-0.5, edge["x"]), min(self.width - 0.5, following["x"])  # as far as the picture goes
            first = max(0, min(self.width, math.ceil(left)))
            last = max(-1, min(self.width, math.ceil(right))) - 1
            emit.flags(y, left, right, first, last, len(inside))
            if inside and first <= last:
                self.interval(inside, y, left, right, first, last)

    def interval(self, inside, y, left, right, first, last):
        """What is seen from one edge to the next."""
        if len(inside) == 1:
            self.paint(inside[0], y, first, last)
            return
        at_left, at_right = {}, {}
        for polygon in inside:
            for x, depths in (left, at_left), (right, at_right):
                depths[polygon] = self.depth(polygon, x, y)
                emit.depth(polygon, x, y, depths[polygon])
        seen = min(inside, key=lambda polygon: (round(at_left[polygon], 9), round(at_right[polygon], 9), polygon))
        while True:
            # Of those that are in front of it at the right end, the one that comes through first.
            others = []
            for polygon in inside:
                d_0, d_1 = max(0.0, at_left[polygon] - at_left[seen]), at_right[polygon] - at_right[seen]
                if d_1 < -TIE:
                    others.append((left + (right - left) * d_0 / (d_0 - d_1), at_right[polygon], polygon))
            if not others:
                break
            x, _, other = min(others)
            emit.implied_edge(seen, other, x, self.depth(seen, x, y))
            begin = math.ceil(x)
            if abs(x - round(x)) <= TIE:  # a centre on the implied edge: equal depths
                begin = round(x) + (seen < other)
            begin = max(first, min(begin, last + 1))
            self.paint(seen, y, first, begin - 1)
            first, seen = begin, other
        self.paint(seen, y, first, last)

    def paint(self, polygon, y, first, last):
        emit.winner(polygon, first, last)
        for x in range(first, last + 1):
            emit.paint(x, y, self.depth(polygon, x, y), polygon)


def main():
    width, height, polygons = read_scene(sys.argv[1])
    emit.clear(math.inf)
    emit.tables(len(polygons))
    picture = Picture(polygons, width)
    for polygon, plane in enumerate(picture.planes):
        emit.polygon(polygon, polygon)
        emit.make(polygon, polygon, -1)
        emit.plane(polygon, *plane)
    edges = edge_table(polygons, height)
    active = []
    for y in range(min((edge["first"] for edge in edges), default=0), max((edge["end"] for edge in edges), default=0)):
        update(active, edges, y)
        picture.sweep(active, y)
    for edge in active:
        emit.retire_edge(edge["number"])


main()
