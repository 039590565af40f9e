"""A class of thirty to try the homework with: the solution, right or with something made wrong in it.

usage: python3 make_class.py FOLDER

makes FOLDER/01-right/horizon.py, FOLDER/02-depth_axis_reversed/horizon.py … Each folder is named after its mistake;
"other-" begins those for which zstep has no name.
"""
import pathlib
import shutil
import sys

# (name, the right line of the solution, the wrong one)
CLASS = [
    ("right", "", ""),
    ("depth_axis_reversed", "    emit.view_vertex(", "    z_v = -z_v\n    emit.view_vertex("),
    ("z_v_for_depth", "(far + near - 2 * far * near / z_v) / (far - near)", "z_v"),
    ("no_divide", "d * x_v / z_v, d * y_v / z_v", "d * x_v, d * y_v"),
    ("divide_twice", "d * x_v / z_v, d * y_v / z_v", "d * x_v / z_v / z_v, d * y_v / z_v / z_v"),
    ("right", "", ""),
    ("y_upside_down", "(window_y - y_p)", "(window_y + y_p)"),
    ("centres_half_off", "* width - 0.5\n    y_s = (window_y - y_p) / (2 * window_y) * height - 0.5",
     "* width\n    y_s = (window_y - y_p) / (2 * window_y) * height"),
    ("other-square_window", "window_y * width / height", "window_y"),
    ("other-eye_at_origin", "world + [1]", "world + [0]"),
    ("other-whole_window", "(2 * window_x)", "window_x"),
    ("other-sign_of_pseudodepth", "far + near - 2", "far + near + 2"),
    ("right", "", ""),
    ("farthest_first", "if view[2][1] < 0", "if view[2][1] > 0"),
    ("not_interpolated", "a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0])", "a[1]"),
    ("only_upper", '"below" if y >= lower else "hidden"', '"hidden"'),
    ("lower_never_moves", "if y > lower:", "if False:"),
    ("other-upper_never_moves", "if y < upper:", "if False:"),
    ("other-moved_when_lower", "if y < upper:", "if y > upper:"),
    ("other-horizons_begin_at_0", "self.upper, self.lower = [math.inf] * width, [-math.inf] * width",
     "self.upper, self.lower = [0.0] * width, [0.0] * width"),
    ("right", "", ""),
    ("other-begins_a_column_early", "math.ceil(a[0]) if step", "math.floor(a[0]) if step"),
    ("other-curves_joined", "self.before = self.dot = None", "self.dot = None"),
    ("crossing_from_end", "t = d_0 / (d_0 - d_1)", "t = d_1 / (d_1 - d_0)"),
    ("other-crosses_other_horizon", 'which = 2 if where == "above" else 3', 'which = 3 if where == "above" else 2'),
    ("one_ink", '"below": (213, 94, 0)', '"below": (0, 0, 0)'),
    ("other-pixels_truncated", " + 0.5) for a, c in zip(begin, along)", ") for a, c in zip(begin, along)"),
    ("other-gaps_in_steep_lines", "math.ceil(max(abs(along[0]), abs(along[1])))", "math.ceil(abs(along[0]))"),
    ("crashes", "        if self.before is None:\n", "        if y > 2 * upper:\n"),
    ("prints-nothing", "\n\nmain()\n", "\n"),
]


def main():
    right_one = pathlib.Path(__file__).parent.parent / "solution"
    solution = (right_one / "horizon.py").read_text()
    for number, (name, right, wrong) in enumerate(CLASS, 1):
        assert right == "" or solution.count(right) == 1, f"{name}: no line of the solution, or several, have {right!r}"
        folder = pathlib.Path(sys.argv[1]) / f"{number:02}-{name}"
        folder.mkdir(parents=True)
        (folder / "horizon.py").write_text(solution.replace(right, wrong) if right else solution)
        shutil.copy(right_one / "emit.py", folder)


main()
