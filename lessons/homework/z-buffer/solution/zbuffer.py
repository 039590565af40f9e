"""The Z-buffer with edge table and active edge list.

usage: python3 zbuffer.py SCENE.txt > SCENE.jsonl
"""
import math
import sys

import emit


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


def edge_table(polygon, vertices, height):
    """The polygon's edges, each in the bucket of its first scan line."""
    buckets = {}
    number = 0
    for a, b in zip(vertices, vertices[1:] + vertices[:1]):
        if a[2] == b[2]:
            emit.skip_edge(a[0], b[0], "horizontal")
            continue
        if a[2] > b[2]:
            a, b = b, a
        # A scan line at y crosses the edge if y_0 <= y < y_1: the upper end belongs to the next edge.
        first, end = max(0, math.ceil(a[2])), min(height, math.ceil(b[2]))
        if first >= end:
            emit.skip_edge(a[0], b[0], "between_rows" if math.ceil(a[2]) == math.ceil(b[2]) else "outside")
            continue
        dx_dy = (b[1] - a[1]) / (b[2] - a[2])
        dz_dy = (b[3] - a[3]) / (b[2] - a[2])
        edge = {"number": number, "a": a, "b": b, "end": end, "dx_dy": dx_dy, "dz_dy": dz_dy}
        move_to(edge, first)
        emit.insert_edge(number, polygon, a[0], b[0], first, end, edge["x"], dx_dy, edge["z"], dz_dy)
        buckets.setdefault(first, []).append(edge)
        number += 1
    return buckets


def move_to(edge, y):
    """Where the edge crosses the scan line: the formula of the line, each time anew."""
    a, b = edge["a"], edge["b"]
    edge["x"] = a[1] + (b[1] - a[1]) * (y - a[2]) / (b[2] - a[2])
    edge["z"] = a[3] + (b[3] - a[3]) * (y - a[2]) / (b[2] - a[2])


def draw_span(polygon, left, right, y, width, depth):
    # A pixel is inside if x_L <= x < x_R.
    first, last = max(0, math.ceil(left["x"])), min(width, math.ceil(right["x"])) - 1
    if first > last:
        return  # no pixel lies between the two edges
    across = right["x"] - left["x"]
    dz_dx = (right["z"] - left["z"]) / across
    emit.span(left["number"], right["number"], y, first, last, left["x"], left["z"], right["x"], right["z"], dz_dx)
    for x in range(first, last + 1):
        z = left["z"] + (right["z"] - left["z"]) * (x - left["x"]) / across
        emit.interpolate_z(x, y, z)
        nearer = z < depth[y][x]
        emit.compare(x, y, z, nearer)
        if nearer:
            depth[y][x] = z
            emit.write_depth(x, y, z)
            emit.write_pixel(x, y, polygon)


def main():
    width, height, polygons = read_scene(sys.argv[1])
    depth = [[math.inf] * width for _ in range(height)]
    emit.clear(math.inf)
    for polygon, vertices in enumerate(polygons):
        emit.polygon(polygon, polygon)
        buckets = edge_table(polygon, vertices, height)
        active = []
        for y in range(min(buckets, default=height), height):
            emit.scan_line(y)
            for edge in [edge for edge in active if edge["end"] == y]:
                active.remove(edge)
                emit.retire_edge(edge["number"])
            for edge in active:
                move_to(edge, y)
                emit.step_edge(edge["number"], edge["x"], edge["z"])
            for edge in buckets.get(y, []):
                place = sum(1 for other in active if (other["x"], other["dx_dy"]) <= (edge["x"], edge["dx_dy"]))
                active.insert(place, edge)
                emit.enter_edge(edge["number"], place)
            active.sort(key=lambda edge: edge["x"])
            for left, right in zip(active[::2], active[1::2]):
                draw_span(polygon, left, right, y, width, depth)
            if not active and y >= max(buckets):
                break
        for edge in [edge for edge in active if edge["end"] == height]:  # they end with the picture
            emit.retire_edge(edge["number"])


main()
