"""Generators one in another: edges of a polygon, spans of its edges, pixels of a span. The depth buffer is a list of
lists of (depth, polygon) pairs.

usage: python3 generators.py TASKS
"""
import math
from typing import NamedTuple

from tools import each_task, say


class Edge(NamedTuple):
    number: int
    top: tuple
    bottom: tuple
    rows: range

    def at(self, y):
        """x and z where the edge crosses the scan line."""
        share = (y - self.top[1]) / (self.bottom[1] - self.top[1])
        return tuple(a + share * (b - a) for a, b in zip(self.top[::2], self.bottom[::2]))

    def slope(self):
        """Where two edges meet, the one that goes further to the left comes first."""
        return (self.bottom[0] - self.top[0]) / (self.bottom[1] - self.top[1])


def edges(number, polygon, points, height):
    count = 0
    for place, lower in enumerate(polygon):
        upper, lower = sorted((polygon[place - 1], lower), key=lambda vertex: points[vertex][1])
        top, bottom = points[upper], points[lower]
        rows = range(max(0, math.ceil(top[1])), min(height, math.ceil(bottom[1])))
        if not rows:
            why = "horizontal" if top[1] == bottom[1] else "between_rows"
            say("skip_edge", vertex_0=upper, vertex_1=lower, why=why)
            continue
        edge = Edge(count, top, bottom, rows)
        x, z = edge.at(rows[0])
        dx_dy, dz_dy = ((b - a) / (bottom[1] - top[1]) for a, b in zip(top[::2], bottom[::2]))
        say("insert_edge", edge=count, polygon=number, vertex_0=upper, vertex_1=lower, first_row=rows[0],
            end_row=rows[-1] + 1, x_edge=x, dx_dy=dx_dy, z_edge=z, dz_dy=dz_dy)
        yield edge
        count += 1


def spans(of, height, width):
    """((x, z) of its left end, (x, z) of its right end, y, pixels) for each span, line by line."""
    for y in range(height):
        met = sorted((edge for edge in of if y in edge.rows), key=lambda edge: (edge.at(y)[0], edge.slope()))
        crossings = [(*edge.at(y), edge.number) for edge in met]
        for left, right in zip(crossings[::2], crossings[1::2]):
            first, last = max(0, math.ceil(left[0])), min(width, math.ceil(right[0])) - 1
            if left[0] == right[0]:
                continue
            say("span", left_edge=left[2], right_edge=right[2], y=y, first=first, last=last, x_left=left[0],
                z_left=left[1], x_right=right[0], z_right=right[1], dz_dx=(right[1] - left[1]) / (right[0] - left[0]))
            yield left[:2], right[:2], y, range(first, last + 1)


def pixels(of):
    for (x_0, z_0), (x_1, z_1), y, columns in of:
        for x in columns:
            share = (x - x_0) / (x_1 - x_0)
            yield x, y, (1 - share) * z_0 + share * z_1


def draw(width, height, points, polygons):
    picture = [[(math.inf, None)] * width for _ in range(height)]
    say("clear", z=math.inf)
    for number, polygon in enumerate(polygons):
        say("polygon", polygon=number, facet=number)
        of = list(edges(number, polygon, points, height))
        for x, y, z in pixels(spans(of, height, width)):
            nearer = z < picture[y][x][0]
            say("interpolate_z", x=x, y=y, z=z)
            say("compare", x=x, y=y, z=z, nearer=nearer)
            if nearer:
                picture[y][x] = z, number
                say("write_pixel", x=x, y=y, polygon=number)
                say("write_depth", x=x, y=y, z=z)


each_task(draw)
