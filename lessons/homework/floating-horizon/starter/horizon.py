"""The floating horizon: the curves of a surface y = f(x, z), from the nearest to the farthest.

usage: python3 horizon.py SCENE.txt > SCENE.jsonl

What is marked TODO is yours. handout.md says what each step is; emit.py writes it down.
"""
import math
import sys

import emit


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


def main():
    width, height, rows, view, lens = read_scene(sys.argv[1])
    emit.clear(math.inf)
    # TODO: each sample: emit.view_vertex(…), emit.project(…), emit.to_viewport(…)
    upper, lower = [math.inf] * width, [-math.inf] * width
    # TODO: the horizons of each column: emit.clear_horizons(…) twice
    # TODO: each curve, from the nearest to the farthest: emit.curve(…)
    # TODO: from sample to sample: emit.segment(…)
    # TODO: at each column in between: emit.test(…)
    # TODO: what is visible since the column before, from or up to where it crosses a horizon: emit.cross(…)
    # TODO: for each pixel that is drawn: emit.draw(…)
    # TODO: where the curve is visible here, the horizons move: emit.move(…)


main()
