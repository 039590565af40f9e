"""The BSP tree: polygons divide space, and what is on the far side of each is drawn before it.

usage: python3 bsp.py SCENE.txt > SCENE.jsonl
"""
import math
import sys

import emit

TIE = 1e-9


def read_scene(path):
    """(width, height, points, polygons); a polygon is a list of the numbers of its vertices."""
    with open(path) as file:
        words = iter(file.read().split())
    width, height = int(next(words)), int(next(words))
    points = [tuple(float(next(words)) for _ in "xyz") for _ in range(int(next(words)))]
    polygons = [[int(next(words)) for _ in range(int(next(words)))] for _ in range(int(next(words)))]
    return width, height, points, polygons


def plane_of(p, q, r):
    """A, B, C, D of the plane through three points."""
    u, v = [[b - a for a, b in zip(p, other)] for other in (q, r)]
    a, b, c = u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]
    return a, b, c, -(a * p[0] + b * p[1] + c * p[2])


def value_at(plane, point):
    a, b, c, d = plane
    return a * point[0] + b * point[1] + c * point[2] + d


def side_of(least, greatest):
    if least < -TIE and greatest > TIE:
        return "crossing"
    return "behind" if least < -TIE else "front" if greatest > TIE else "on"


class Tree:
    def __init__(self, points, polygons):
        self.points, self.pieces, self.nodes = list(points), [], []
        for number, corners in enumerate(polygons):
            emit.polygon(number, number)
            plane = plane_of(*[points[corner] for corner in corners[:3]])
            self.add_piece(number, corners, plane, -1)
        self.root = self.build(list(range(len(polygons))), -1, False)

    def add_piece(self, polygon, corners, plane, parent):
        piece = len(self.pieces)
        self.pieces.append({"polygon": polygon, "corners": corners, "plane": plane})
        if parent < 0:
            emit.make(piece, polygon, parent)
        else:
            emit.part(piece, polygon, parent)
        return piece

    def side(self, piece, root):
        """On which side of the root's plane a piece lies."""
        values = []
        for vertex in self.pieces[piece]["corners"]:
            value = value_at(self.pieces[root]["plane"], self.points[vertex])
            emit.vertex_side(vertex, root, value, side_of(value, value))
            values.append(value)
        side = side_of(min(values), max(values))
        emit.side(piece, root, min(values), max(values), side)
        return side

    def new_vertex(self, start, end, t):
        """A vertex between two others."""
        a, b = self.points[start], self.points[end]
        point = [p + t * (q - p) for p, q in zip(a, b)]
        self.points.append(point)
        emit.cut(start, end, t, len(self.points) - 1, "raster", *point)
        return len(self.points) - 1

    def cut(self, piece, root):
        """The two parts of a piece, in front of the root's plane and behind it."""
        whole, plane = self.pieces[piece], self.pieces[root]["plane"]
        corners, front, back = whole["corners"], [], []
        for here, after in zip(corners, corners[1:] + corners[:1]):
            d_0, d_1 = value_at(plane, self.points[here]), value_at(plane, self.points[after])
            if d_0 >= -TIE:
                front.append(here)
            if d_0 <= TIE:
                back.append(here)
            if side_of(min(d_0, d_1), max(d_0, d_1)) == "crossing":
                # Always from the vertex in front to the one behind.
                made = self.new_vertex(here, after, d_0 / (d_0 - d_1)) if d_0 > 0 else \
                    self.new_vertex(after, here, d_1 / (d_1 - d_0))
                front.append(made)
                back.append(made)
        parts = []
        for outline in (front, back):
            parts.append(self.add_piece(whole["polygon"], outline, whole["plane"], piece))
        return parts

    def build(self, pieces, parent, in_front):
        """A node for the first of these pieces, and what is below it; None for no pieces."""
        if not pieces:
            return None
        number, root = len(self.nodes), pieces[0]
        node = {"number": number, "pieces": [root]}
        self.nodes.append(node)
        emit.node(number, parent, in_front, root)
        emit.plane(root, *self.pieces[root]["plane"])
        front, back = [], []
        for piece in pieces[1:]:
            side = self.side(piece, root)
            if side == "on":
                node["pieces"].append(piece)
                emit.add(number, piece)
            elif side == "crossing":
                before, behind = self.cut(piece, root)
                front.append(before)
                back.append(behind)
            else:
                (front if side == "front" else back).append(piece)
        node["front"] = self.build(front, number, True)
        node["back"] = self.build(back, number, False)
        return node

    def draw(self, node, width, height):
        if node is None:
            return
        value = -self.pieces[node["pieces"][0]]["plane"][2]
        eye_in_front = value > 0
        emit.eye_side(node["number"], value, eye_in_front)
        far, near = (node["back"], node["front"]) if eye_in_front else (node["front"], node["back"])
        self.draw(far, width, height)
        # In one plane the first polygon of the scene is to be seen, so it comes last.
        for piece in sorted(node["pieces"], key=lambda piece: -self.pieces[piece]["polygon"]):
            emit.draw(piece, self.pieces[piece]["polygon"])
            self.paint(self.pieces[piece], width, height)
        self.draw(near, width, height)

    def paint(self, piece, width, height):
        corners = [self.points[vertex] for vertex in piece["corners"]]
        a, b, c, d = piece["plane"]
        for y in range(height):
            crossed = sorted(p[0] + (q[0] - p[0]) * (y - p[1]) / (q[1] - p[1])
                             for p, q in zip(corners, corners[1:] + corners[:1]) if (p[1] <= y) != (q[1] <= y))
            for left, right in zip(crossed[::2], crossed[1::2]):
                for x in range(max(0, math.ceil(left)), min(width, math.ceil(right))):
                    emit.paint(x, y, -(a * x + b * y + d) / c, piece["polygon"])


def main():
    width, height, points, polygons = read_scene(sys.argv[1])
    emit.clear(math.inf)
    emit.tables(len(polygons))
    tree = Tree(points, polygons)
    tree.draw(tree.root, width, height)


main()
