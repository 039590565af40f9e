"""Half-spaces, after Pineda: what three edge functions are at a corner of the box is computed once, and from pixel to
pixel they change by additions. Column by column, each from the bottom up. The depth is that of the first vertex and
what the two others add to it.

usage: python3 half_space.py TASKS     (triangles only)
"""
import math

from tools import each_task, mistake, say


class Side:
    """a (x - x_0) + b (y - y_0): greater than 0 where the triangle is."""

    def __init__(self, start, end, turn):
        self.start = start
        self.a, self.b = turn * (start[1] - end[1]), turn * (end[0] - start[0])
        self.owns_border = self.a > 0 or (self.a == 0 and self.b > 0)

    def at(self, x, y):
        if mistake() == "centres_half_off":
            x, y = x + 0.5, y + 0.5
        return self.a * (x - self.start[0]) + self.b * (y - self.start[1])

    def has(self, e):
        if e != 0:
            return e > 0
        return {"border_for_both": True, "border_for_nobody": False, "border_for_other_side": not self.owns_border}.get(
            mistake(), self.owns_border)


class Triangle:
    def __init__(self, corners):
        (x_0, y_0, _), (x_1, y_1, _), (x_2, y_2, _) = self.corners = corners
        self.twice_area = (x_1 - x_0) * (y_2 - y_0) - (x_2 - x_0) * (y_1 - y_0)
        turn = -1 if self.twice_area < 0 else 1
        # Each side stands against the vertex of its number.
        self.sides = [Side(corners[i - 2], corners[i - 1], turn) for i in range(3)]

    def covered(self, width, height):
        """(x, y, the edge functions there) for each pixel inside."""
        xs, ys = [x for x, _, _ in self.corners], [y for _, y, _ in self.corners]
        left, right = max(0, math.floor(min(xs))), min(width - 1, math.ceil(max(xs)))
        top, bottom = max(0, math.floor(min(ys))), min(height - 1, math.ceil(max(ys)))
        if mistake() == "box_too_small":
            right = min(width, math.floor(max(xs))) - 1
        if mistake() == "box_without_last_row":
            bottom = min(height, math.floor(max(ys))) - 1
        asked = self.sides[:2] if mistake() == "edge_not_asked" else self.sides
        begin = [side.at(left, bottom) for side in self.sides]
        if mistake() == "begins_at_vertices":
            begin = [side.at(min(xs), max(ys)) for side in self.sides]
        for x in range(left, right + 1):
            e = begin
            for y in range(bottom, top - 1, -1):
                if all(side.has(at) for side, at in zip(asked, e)):
                    yield x, y, e
                if mistake() == "stepped_downwards":
                    e = [at + side.b for side, at in zip(self.sides, e)]
                else:
                    e = [at - side.b for side, at in zip(self.sides, e)]
            if mistake() == "goes_on_from_top":
                begin = e
            begin = [at + side.a for side, at in zip(self.sides, begin)]

    def depth(self, e, twice_area):
        z_0, z_1, z_2 = (z for _, _, z in self.corners)
        area = abs(twice_area)
        if mistake() == "area_not_doubled":
            area /= 2
        if mistake() == "area_not_turned":
            area = twice_area
        _, w_1, w_2 = (at / area for at in e)
        if mistake() == "weights_exchanged":
            w_1, w_2 = w_2, w_1
        if mistake() == "depth_of_one_vertex":
            w_1 = w_2 = 0
        if mistake() == "term_left_out":
            w_2 = 0  # as if the third vertex had the first one's depth
        if mistake() == "weight_left_out":
            return w_1 * z_1 + w_2 * z_2
        if mistake() == "first_depth_left_out":
            return w_1 * (z_1 - z_0) + w_2 * (z_2 - z_0)
        if mistake() == "difference_turned":
            return z_0 + w_1 * (z_0 - z_1) + w_2 * (z_2 - z_0)
        return z_0 + w_1 * (z_1 - z_0) + w_2 * (z_2 - z_0)


class Picture:
    def __init__(self, width, height):
        self.width, self.height = width, height
        self.depths, self.colours = [math.inf] * (width * height), [None] * (width * height)
        say("clear", z=math.inf)

    def plot(self, x, y, z, number):
        if mistake() == "y_upside_down":
            y = self.height - 1 - y
        at = y * (self.height if mistake() == "stride_is_height" else self.width) + x
        nearer = z < self.depths[at]
        if mistake() == "equal_wins":
            nearer = z <= self.depths[at]
        if mistake() == "compare_reversed":
            nearer = z > self.depths[at]
        say("compare", x=x, y=y, z=z, nearer=nearer)
        if not nearer:
            return
        self.depths[at] = z
        say("wz", x=x, y=y, z=z)
        if mistake() == "colour_beside":
            x = min(x + 1, self.width - 1)
        self.colours[y * self.width + x] = number
        say("wp", x=x, y=y, polygon=number)


def draw(width, height, points, polygons):
    picture = Picture(width, height)
    twice_area = 0
    for number, corners in enumerate(polygons):
        triangle = Triangle([points[corner] for corner in corners])
        if triangle.twice_area == 0 or (mistake() == "one_winding_only" and triangle.twice_area < 0):
            continue
        if mistake() != "area_of_first" or twice_area == 0:
            twice_area = triangle.twice_area
        say("polygon", polygon=number, facet=number)
        for x, y, e in triangle.covered(width, height):
            picture.plot(x, y, triangle.depth(e, twice_area), number)


each_task(draw)
