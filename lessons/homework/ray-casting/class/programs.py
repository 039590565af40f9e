"""The programs of the class that make_class.py makes."""
PROGRAM = "raycast.py"

RAY = "[a + x * b + y * c for a, b, c in zip(*rays[which])]"
KEPT = "nearer = within and t < least"
SIDES = "zip(polygon, polygon[1:] + polygon[:1]):\n        if (a[v]"

# (name of the mistake, text of the solution, the text that replaces it)
CLASS = [
    ("right", "", ""),
    ("nearest_by_index", KEPT, "nearer = within"),
    ("negative_t", 'if not rays["least"] <= t <= rays["most"]', 'if not t <= rays["most"]'),
    ("other-d_sign", "return normal, -dot(", "return normal, dot("),
    ("other-d_forgotten", "-(dot(normal, start) + d)", "-dot(normal, start)"),
    ("right", "", ""),
    ("other-numerator_sign", "-(dot(normal, start) + d)", "dot(normal, start) + d"),
    ("other-fraction_turned", "t = numerator / denominator if denominator", "t = denominator / numerator if denominator"),
    ("other-normal_of_two_corners", "normal[2] += (a[0] - b[0]) * (a[1] + b[1])", "normal[2] += (a[0] - b[0]) * a[1]"),
    ("other-through_corners", RAY, RAY.replace("x * b + y * c", "(x - 0.5) * b + (y - 0.5) * c")),
    ("other-rows_for_columns", RAY, RAY.replace("x * b + y * c", "y * b + x * c")),
    ("other-first_row_at_bottom", RAY, RAY.replace("y * c", "(height - 1 - y) * c")),
    ("right", "", ""),
    ("other-counted_by_columns", "number = y * width + x", "number = x * height + y"),
    ("other-point_from_origin", "[a + t * b for a, b in zip(start, along)]", "[t * b for b in along]"),
    ("other-always_without_z", "drop = max(range(3), key=lambda axis: abs(normal[axis]))", "drop = 2"),
    ("other-without_widest", "drop = max(range(3)", "drop = min(range(3)"),
    ("other-once_inside_always", "within = not within", "within = True"),
    ("other-last_side_forgotten", SIDES, SIDES.replace(" + polygon[:1]", "")),
    ("right", "", ""),
    ("other-plane_is_enough", KEPT, "nearer = t < least"),
    ("other-farther_than_infinity", KEPT, "nearer = within and t > least"),
    ("other-first_kept", KEPT, "nearer = within and nearest < 0"),
    ("other-far_plane_forgotten", 'if not rays["least"] <= t <= rays["most"]', 'if not rays["least"] <= t'),
    ("other-depth_is_t", "return ((most + least) - 2 * most * least / t) / (most - least)", "return t"),
    ("other-depth_sign", "(most + least) - 2 *", "(most + least) + 2 *"),
    ("other-colours_to_255", "*(c / 255 for c in color)", "*color"),
    ("other-hits_counted", "len(polygons), *(", "int(nearest >= 0), *("),
    ("crashes", "                if nearer:\n", "                if least < min([]):\n"),
    ("prints-nothing", "\n\nmain()\n", "\n"),
]
