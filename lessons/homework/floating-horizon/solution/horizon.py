"""The floating horizon: the curves of a surface y = f(x, z), from the nearest to the farthest.

usage: python3 horizon.py SCENE.txt > SCENE.jsonl
"""
import math
import sys

import emit

INK = {"above": (0, 0, 0), "below": (213, 94, 0)}


def read_scene(path):
    """(width, height, rows, view, lens): rows of samples (x_w, y_w, z_w), the three rows of T_v, and d, w_y, n, f."""
    with open(path) as file:
        words = iter(file.read().split())

    def numbers(count):
        return [float(next(words)) for _ in range(count)]

    width, height = int(next(words)), int(next(words))
    row_count, column_count = int(next(words)), int(next(words))
    rows = [[numbers(3) for _ in range(column_count)] for _ in range(row_count)]
    return width, height, rows, [numbers(4) for _ in range(3)], numbers(4)


def to_screen(number, world, view, lens, width, height):
    """x_s and y_s of a sample: world, view, projection plane, raster."""
    d, window_y, near, far = lens
    x_v, y_v, z_v = (sum(t * w for t, w in zip(row, world + [1])) for row in view)
    emit.view_vertex(number, x_v, y_v, z_v)
    x_p, y_p = d * x_v / z_v, d * y_v / z_v
    emit.project(number, x_p, y_p, (far + near - 2 * far * near / z_v) / (far - near))
    window_x = window_y * width / height
    x_s = (x_p + window_x) / (2 * window_x) * width - 0.5
    y_s = (window_y - y_p) / (2 * window_y) * height - 0.5
    emit.to_viewport(number, x_s, y_s)
    return x_s, y_s


class Plot:
    def __init__(self, width):
        self.upper, self.lower = [math.inf] * width, [-math.inf] * width
        self.before = None  # the curve at the column before: x, y, the two horizons there, and where it was
        self.dot = None  # the pixel drawn last

    def line(self, begin, end, where):
        """One pixel a column or a row, whichever are more."""
        along = [b - a for a, b in zip(begin, end)]
        steps = math.ceil(max(abs(along[0]), abs(along[1])))
        for i in range(steps + 1):
            x, y = (math.floor(a + c * (i / steps if steps else 0) + 0.5) for a, c in zip(begin, along))
            if (x, y) != self.dot:
                emit.draw(x, y, *INK[where])
            self.dot = x, y

    def crossing(self, here, where):
        """Where the curve crosses a horizon since the column before; None where it does not."""
        which = 2 if where == "above" else 3
        d_0, d_1 = self.before[1] - self.before[which], here[1] - here[which]
        if not (math.isfinite(d_0) and math.isfinite(d_1)):
            return None
        t = d_0 / (d_0 - d_1)
        if not 0 <= t <= 1:
            return None
        x, y = (a + t * (b - a) for a, b in zip(self.before[:2], here[:2]))
        emit.cross(where == "above", x, y)
        return x, y

    def draw_to(self, here):
        """What is visible of the curve from the column before to this one."""
        before, was, now = self.before, self.before[4], here[4]
        if was == now:
            if now != "hidden":
                self.line(before[:2], here[:2], now)
            return
        if was != "hidden":
            self.line(before[:2], self.crossing(here, was) or before[:2], was)
        if now != "hidden":
            self.line(self.crossing(here, now) or here[:2], here[:2], now)

    def pass_column(self, x, y):
        upper, lower = self.upper[x], self.lower[x]
        where = "above" if y <= upper else "below" if y >= lower else "hidden"
        emit.test(x, y, where)
        here = (x, y, upper, lower, where)
        if self.before is None:
            self.before = here
        self.draw_to(here)
        if where != "hidden":
            if y < upper:
                self.upper[x] = y
                emit.move(x, True, y)
            if y > lower:
                self.lower[x] = y
                emit.move(x, False, y)
        self.before = here

    def curve(self, first, points):
        self.before = self.dot = None
        for number, (a, b) in enumerate(zip(points, points[1:]), first):
            emit.segment(number, number + 1)
            step = 1 if b[0] >= a[0] else -1
            x = math.ceil(a[0]) if step > 0 else math.floor(a[0])
            if x == a[0] and self.before:
                x += step  # the end of the segment before
            while (b[0] - x) * step >= 0:
                if 0 <= x < len(self.upper):
                    self.pass_column(x, a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]))
                x += step


def main():
    width, height, rows, view, lens = read_scene(sys.argv[1])
    emit.clear(math.inf)
    columns = len(rows[0])
    screen = [[to_screen(i * columns + j, world, view, lens, width, height) for j, world in enumerate(row)]
              for i, row in enumerate(rows)]
    plot = Plot(width)
    for x in range(width):
        emit.clear_horizons(x, True, math.inf)
        emit.clear_horizons(x, False, -math.inf)
    order = list(range(len(rows)))
    if view[2][1] < 0:  # z_v shrinks from row to row: the last one is the nearest
        order.reverse()
    for number, row in enumerate(order):
        emit.curve(number, row, False, rows[row][0][1])
        plot.curve(row * columns, screen[row])


main()
