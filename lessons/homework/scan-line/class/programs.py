"""The programs of the class that make_class.py makes."""
PROGRAM = "scanline.py"

# (name of the mistake, text of the solution, the text that replaces it)
CLASS = [
    ("right", "", ""),
    ("plane_d_sign", "-(a * x + b * y + c * z)", "a * x + b * y + c * z"),
    ("other-plane_sums_negative", "(z_0 - z_1) * (x_0 + x_1)", "(z_1 - z_0) * (x_0 + x_1)"),
    ("slope_inverted", "dx_dy = (b[1] - a[1]) / (b[2] - a[2])",
     "dx_dy = (b[2] - a[2]) / (b[1] - a[1] or 1e9)"),
    ("slope_whole", "dx_dy = (b[1] - a[1]) / (b[2] - a[2])", "dx_dy = (b[1] - a[1]) // (b[2] - a[2])"),
    ("right", "", ""),
    ("z_slope_of_x", "dz_dy = (b[3] - a[3])", "dz_dy = (b[1] - a[1])"),
    ("z_not_swapped", "a, b = b, a", "a, b = (*b[:3], a[3]), (*a[:3], b[3])"),
    ("ends_one_late", "min(height, math.ceil(b[2]))\n", "min(height, math.ceil(b[2]) + 1)\n"),
    ("starts_one_early", "math.ceil(a[2])), min", "math.floor(a[2])), min"),
    ("x_at_vertex", "            move_to(edge, first)\n", '            edge["x"], edge["z"] = a[1], a[3]\n'),
    ("horizontal_inserted", '                emit.skip_edge(a[0], b[0], "horizontal")\n                continue\n',
     '                b = (b[0], b[1], b[2] + 1, b[3])\n'),
    ("right", "", ""),
    ("other-retired_one_late", 'if edge["end"] == y', 'if edge["end"] + 1 == y'),
    ("never_retired", 'if edge["end"] == y]', 'if edge["end"] == -1]'),
    ("not_sorted", "while i > 0 and", "while False and"),
    ("other-entered_in_front", "active.insert(place, edge)", "active.insert(0, edge)"),
    ("flag_missed", "        inside = []",
     "        active = [e for i, e in enumerate(active)\n"
     "                  if i == 0 or (e[\"x\"], e[\"polygon\"]) !=\n"
     "                  (active[i - 1][\"x\"], active[i - 1][\"polygon\"])]\n"
     "        inside = []"),
    ("right_end_included", "math.ceil(right))) - 1", "math.floor(right) + 1)) - 1"),
    ("left_end_excluded", "math.ceil(left))", "math.floor(left) + 1)"),
    ("right", "", ""),
    ("wrong_of_two", "depths[polygon] = self.depth(polygon, x, y)\n"
     "                emit.depth(polygon, x, y, depths[polygon])",
     "depths[polygon] = -self.depth(polygon, x, y)\n                emit.depth(polygon, x, y, -depths[polygon])"),
    ("other-first_of_two", "min(inside, key=", "min(inside[:1], key="),
    ("implied_edge_missed", "if d_1 < -TIE:", "if False:"),
    ("z_kept_along_span", "emit.paint(x, y, self.depth(polygon, x, y)",
     "emit.paint(x, y, self.depth(polygon, first, y)"),
    ("other-depth_of_line_above", "emit.paint(x, y, self.depth(polygon, x, y)",
     "emit.paint(x, y, self.depth(polygon, x, y - 1)"),
    ("other-colour_of_first", "self.depth(polygon, x, y), polygon)", "self.depth(polygon, x, y), 0)"),
    ("slope_inverted", "dx_dy = (b[1] - a[1]) / (b[2] - a[2])",
     "dx_dy = (b[2] - a[2]) / (b[1] - a[1] or 1e9)"),
    ("crashes", "            self.paint(inside[0], y, first, last)\n",
     "            self.paint(inside[1], y, first, last)\n"),
    ("prints-nothing", "\n\nmain()\n", "\n"),
]
