"""The programs of the class that make_class.py makes."""
PROGRAM = "zbuffer.py"

COLUMNS = 'max(0, math.ceil(left["x"])), min(width, math.ceil(right["x"]))'
BUFFER = "    depth = [[math.inf] * width for _ in range(height)]\n"

# (name of the mistake, text of the solution, the text that replaces it)
CLASS = [
    ("right", "", ""),
    ("compare_reversed", "nearer = z < depth[y][x]", "nearer = z > depth[y][x]"),
    ("equal_wins", "nearer = z < depth[y][x]", "nearer = z <= depth[y][x]"),
    ("right", "", ""),
    ("slope_inverted", "dx_dy = (b[1] - a[1]) / (b[2] - a[2])", "dx_dy = (b[2] - a[2]) / (b[1] - a[1] or 1e9)"),
    ("slope_whole", "dx_dy = (b[1] - a[1]) / (b[2] - a[2])", "dx_dy = (b[1] - a[1]) // (b[2] - a[2])"),
    ("z_slope_of_x", "dz_dy = (b[3] - a[3])", "dz_dy = (b[1] - a[1])"),
    ("z_not_swapped", "a, b = b, a", "a, b = (*b[:3], a[3]), (*a[:3], b[3])"),
    ("right", "", ""),
    ("ends_one_late", "min(height, math.ceil(b[2]))", "min(height, math.ceil(b[2]) + 1)"),
    ("starts_one_early", "max(0, math.ceil(a[2]))", "max(0, math.floor(a[2]))"),
    ("retired_one_late", 'if edge["end"] == y', 'if edge["end"] + 1 == y'),
    ("never_retired", 'if edge["end"] == y', 'if edge["end"] == -1'),
    ("right", "", ""),
    ("right_end_included", 'min(width, math.ceil(right["x"])) - 1',
     'min(width - 1, math.floor(right["x"]) + (1 if right["x"] > left["x"] else -1))'),
    ("left_end_excluded", 'max(0, math.ceil(left["x"]))', 'max(0, math.floor(left["x"]) + 1)'),
    ("ends_truncated", COLUMNS, 'max(0, int(left["x"])), min(width, int(right["x"]))'),
    ("ends_rounded", COLUMNS, 'max(0, math.floor(left["x"] + 0.5)), min(width, math.floor(right["x"] + 0.5))'),
    ("right", "", ""),
    ("z_not_to_centre", '(x - left["x"]) / across', "(x - first) / across"),
    ("z_stepped_before_use", '(x - left["x"]) / across', '(x + 1 - left["x"]) / across'),
    ("depth_not_written", "            depth[y][x] = z\n            emit.write_depth(x, y, z)\n", ""),
    ("colour_always", "            emit.write_pixel(x, y, polygon)", "        emit.write_pixel(x, y, polygon)"),
    ("x_y_exchanged", "emit.write_pixel(x, y, polygon)", "emit.write_pixel(y, x, polygon)"),
    ("buffer_reset", "        buckets = edge_table(", "    " + BUFFER + "        buckets = edge_table("),
    ("buffer_begins_at_0", BUFFER + "    emit.clear(math.inf)",
     BUFFER.replace("math.inf", "0.0") + "    emit.clear(0.0)"),
    ("buffer_of_one_line", BUFFER, "    depth = [[math.inf] * width] * height\n"),
    ("slope_inverted", "dx_dy = (b[1] - a[1]) / (b[2] - a[2])", "dx_dy = (b[2] - a[2]) / (b[1] - a[1] or 1e9)"),
    ("crashes", "    emit.clear(math.inf)", "    emit.clear(math.inf)\n    emit.polygon(0, 0)\n    depth[-1][width]"),
    ("prints-nothing", "\n\nmain()\n", "\n"),
]
