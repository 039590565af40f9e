"""Depth sort: of a list of polygons, the farthest first, each is painted once no other one must come before it.

usage: python3 depthsort.py SCENE.txt > SCENE.jsonl
"""
import math
import sys

import emit

TIE = 1e-9
AXES = {"x": 0, "y": 1, "z": 2}


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


def sides(outline):
    """Each vertex with the next one, and the last with the first."""
    return zip(outline, outline[1:] + outline[:1])


def between(p, q, t):
    return [a + t * (b - a) for a, b in zip(p, q)]


def middle_of(outline):
    return [sum(axis) / len(outline) for axis in zip(*outline)]


def common_part(shape, other):
    """What two convex outlines have in common on the screen: of one, what is inside each edge of the other."""
    middle = middle_of(other)
    for a, b in sides(other):
        def beside(p):
            return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
        inside = 1 if beside(middle) > 0 else -1
        kept = []
        for p, q in sides(shape):
            d_0, d_1 = inside * beside(p), inside * beside(q)
            if d_0 >= 0:
                kept.append(p)
            if d_0 * d_1 < 0:
                kept.append(between(p, q, d_0 / (d_0 - d_1)))
        shape = kept
    return shape


def area_of(outline):
    return abs(sum(p[0] * q[1] - q[0] * p[1] for p, q in sides(outline))) / 2


class Piece:
    def __init__(self, polygon, corners, plane, points):
        self.polygon, self.corners, self.plane = polygon, corners, plane
        self.outline = [points[corner] for corner in corners]
        self.low = [min(axis) for axis in zip(*self.outline)]
        self.high = [max(axis) for axis in zip(*self.outline)]


class DepthSort:
    def __init__(self, points, polygons):
        self.points, self.pieces = list(points), []
        self.list, self.marked = [], 0  # the first `marked` pieces of the list have a mark
        emit.tables(len(polygons))
        for number, corners in enumerate(polygons):
            emit.polygon(number, number)
            self.add_piece(number, corners, plane_of(*[points[corner] for corner in corners[:3]]), -1)
        for piece in range(len(polygons)):
            self.put_in(piece, emit.insert)

    def add_piece(self, polygon, corners, plane, parent):
        number, piece = len(self.pieces), Piece(polygon, corners, plane, self.points)
        self.pieces.append(piece)
        for vertex in corners:
            emit.outline(vertex)
        (emit.make if parent < 0 else emit.part)(number, polygon, parent)
        emit.plane(number, *plane)
        low, high = piece.low, piece.high
        emit.extent(number, low[0], high[0], low[1], high[1], low[2], high[2])
        return number

    # The list

    def farther(self, a, b):
        """Does piece a stand before piece b? Of equal depths the first polygon of the scene is painted last."""
        one, other = self.pieces[a], self.pieces[b]
        if one.high[2] != other.high[2]:
            return one.high[2] > other.high[2]
        return (one.polygon, a) > (other.polygon, b)

    def put_in(self, piece, step):
        place = self.marked
        while place < len(self.list) and self.farther(self.list[place], piece):
            place += 1
        step(piece, place)
        self.list.insert(place, piece)

    def take_first(self, step):
        step(self.list.pop(0))
        self.marked = max(0, self.marked - 1)

    def move_to_front(self, place):
        piece = self.list.pop(place)
        emit.take_out(piece)
        self.list.insert(0, piece)
        emit.move(piece, 0)
        self.marked += 1
        emit.mark(piece)

    # The tests

    def extents_overlap(self, step, p, q, axis):
        one, other, k = self.pieces[p], self.pieces[q], AXES[axis]
        overlap = one.low[k] < other.high[k] and other.low[k] < one.high[k]
        step(p, q, axis, one.low[k], one.high[k], other.low[k], other.high[k], overlap)
        return overlap

    def side_of(self, piece, plane_of):
        """The least and greatest value of the other one's plane, and the side. The eye is where values are < 0."""
        plane = self.pieces[plane_of].plane
        turn = 1 if plane[2] > 0 else -1
        values = [turn * value_at(plane, point) for point in self.pieces[piece].outline]
        least, greatest = min(values), max(values)
        if least < -TIE and greatest > TIE:
            return least, greatest, "crossing"
        return least, greatest, "front" if least < -TIE else "behind" if greatest > TIE else "on"

    def is_behind(self, step, piece, plane_of):
        least, greatest, side = self.side_of(piece, plane_of)
        step(piece, plane_of, least, greatest, side)
        return side == "behind" or side == "on" and self.pieces[piece].polygon >= self.pieces[plane_of].polygon

    def is_in_front(self, step, piece, plane_of):
        least, greatest, side = self.side_of(piece, plane_of)
        step(piece, plane_of, least, greatest, side)
        return side == "front" or side == "on" and self.pieces[plane_of].polygon >= self.pieces[piece].polygon

    def projections_overlap(self, p, q):
        common = common_part(self.pieces[p].outline, self.pieces[q].outline)
        overlap = area_of(common) > TIE
        x, y = middle_of(common)[:2] if overlap else (math.nan, math.nan)
        emit.test_5(p, q, overlap, x, y)
        return overlap

    def may_come_before(self, p, q):
        """Does one of the five tests say that p may be painted before q?"""
        return (not self.extents_overlap(emit.test_1, p, q, "x")
                or not self.extents_overlap(emit.test_2, p, q, "y")
                or self.is_behind(emit.test_3, p, q)
                or self.is_in_front(emit.test_4, q, p)
                or not self.projections_overlap(p, q))

    def first_is_next(self):
        """May the first of the list be painted now? If not, another piece has become the first."""
        p = self.list[0]
        for place in range(1, len(self.list)):
            q, marked = self.list[place], place < self.marked
            emit.pair(p, q)
            if self.pieces[q].high[2] < self.pieces[p].low[2]:
                self.extents_overlap(emit.z_extents, p, q, "z")
                if not marked:
                    return True
            elif not self.may_come_before(p, q):
                if not marked and (self.is_behind(emit.test_3_swapped, q, p)
                                   or self.is_in_front(emit.test_4_swapped, p, q)):
                    self.move_to_front(place)
                    return False
                if self.split_one(place):
                    return False
        return True

    # Splitting

    def split_one(self, place):
        """Splits P, or Q at this place, or else any piece that stands between them."""
        places = range(place + 1)
        for whole, other in [(0, place), (place, 0)] + [(i, j) for i in places for j in places]:
            least, greatest, side = self.side_of(self.list[whole], self.list[other])
            if side == "crossing":
                emit.split(self.list[whole], self.list[other], least, greatest, side)
                parts = self.cut(self.list[whole], self.list[other])
                moved = self.list[:whole]
                for _ in range(whole + 1):
                    self.take_first(emit.remove)
                for piece in moved + parts:
                    self.put_in(piece, emit.insert_part)
                return True
        return False

    def new_vertex(self, start, end, t):
        point = between(self.points[start], self.points[end], t)
        self.points.append(point)
        emit.cut(start, end, t, len(self.points) - 1, "raster", *point)
        return len(self.points) - 1

    def cut(self, piece, other):
        """The two parts of a piece, on the positive side of the other one's plane and on the negative side."""
        whole, plane = self.pieces[piece], self.pieces[other].plane
        positive, negative = [], []
        for here, after in sides(whole.corners):
            d_0, d_1 = value_at(plane, self.points[here]), value_at(plane, self.points[after])
            if d_0 >= -TIE:
                positive.append(here)
            if d_0 <= TIE:
                negative.append(here)
            if min(d_0, d_1) < -TIE and max(d_0, d_1) > TIE:
                # Always from the positive vertex to the negative one.
                made = self.new_vertex(here, after, d_0 / (d_0 - d_1)) if d_0 > 0 else \
                    self.new_vertex(after, here, d_1 / (d_1 - d_0))
                positive.append(made)
                negative.append(made)
        return [self.add_piece(whole.polygon, corners, whole.plane, piece) for corners in (positive, negative)]

    # The picture

    def draw(self, width, height):
        while self.list:
            if self.first_is_next():
                piece = self.list[0]
                emit.draw(piece, self.pieces[piece].polygon)
                self.paint(self.pieces[piece], width, height)
                self.take_first(emit.drawn)

    def paint(self, piece, width, height):
        a, b, c, d = piece.plane
        for y in range(height):
            crossed = sorted(p[0] + (q[0] - p[0]) * (y - p[1]) / (q[1] - p[1])
                             for p, q in sides(piece.outline) if (p[1] <= y) != (q[1] <= y))
            for left, right in zip(crossed[::2], crossed[1::2]):
                for x in range(max(0, math.ceil(left)), min(width, math.ceil(right))):
                    emit.paint(x, y, -(a * x + b * y + d) / c, piece.polygon)


def main():
    width, height, points, polygons = read_scene(sys.argv[1])
    emit.clear(math.inf)
    DepthSort(points, polygons).draw(width, height)


main()
