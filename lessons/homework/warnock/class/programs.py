"""The programs of the class that make_class.py makes."""
PROGRAM = "warnock.py"

QUARTERS = """            for quarter in ((left, top, middle, half), (middle, top, right, half),
                            (left, half, middle, bottom), (middle, half, right, bottom)):
"""
UNCHECKED = "        elif right - left == 1 and bottom - top == 1:\n"
SURROUNDED = """            emit.front_surrounder(number, "front_surrounder", around[0])
            self.fill(around[0], area)
"""
CORNERS = "((left, top), (right, top), (left, bottom), (right, bottom)):"
DEPTH = "-(a * x + b * y + d) / c"
ONE = """            self.fill_part(partly[0], area)
        elif len"""

# (name of the mistake, text of the solution, the text that replaces it)
CLASS = [
    ("right", "", ""),
    ("plane_d_sign", "-(a * x + b * y + c * z)", "a * x + b * y + c * z"),
    ("other-sum_negative", "(z_0 - z_1) * (x_0 + x_1)", "(z_1 - z_0) * (x_0 + x_1)"),
    ("other-last_side_forgotten", "in zip(polygon, polygon[1:] + polygon[:1]):\n        a +=",
     "in zip(polygon, polygon[1:]):\n        a +="),
    ("right", "", ""),
    ("surrounding_unchecked", UNCHECKED, "        elif around:\n" + SURROUNDED + UNCHECKED),
    ("stops_one_early", UNCHECKED, "        elif right - left <= 2 and bottom - top <= 2:\n"),
    ("quarters_overlap", QUARTERS,
     QUARTERS.replace("(left, top, middle, half)", "(left, top, min(middle + 1, right), half)")),
    ("right", "", ""),
    ("other-quarters_of_the_picture", "self.settle(quarter, number, partly", "self.settle(quarter, 0, partly"),
    ("other-three_quarters", QUARTERS, QUARTERS.replace(", (middle, half, right, bottom)", "")),
    ("right", QUARTERS, QUARTERS.replace("in ((", "in reversed(((").replace(")):", "))):")),
    ("right", "", ""),
    ("other-area_by_centres", "low, high = (left - 0.5, top - 0.5), (right - 0.5, bottom - 0.5)",
     "low, high = (left, top), (right - 1, bottom - 1)"),
    ("other-half_a_pixel_off", "low, high = (left - 0.5, top - 0.5), (right - 0.5, bottom - 0.5)",
     "low, high = (left, top), (right, bottom)"),
    ("other-edges_of_no_length", "return start <= end", "return start < end - 1"),
    ("right", "", ""),
    ("other-surrounding_forgotten", '"surrounding" if corners > 0 else "disjoint"', '"disjoint"'),
    ("other-contained_is_intersecting", 'name = "contained"', 'name = "intersecting"'),
    ("other-around_not_handed_on", "self.settle(quarter, number, partly, around)",
     "self.settle(quarter, number, partly, [])"),
    ("other-last_at_centre", "best, least = piece, z", "best, least = piece, math.inf"),
    ("other-last_of_equals", "piece < other if", "piece > other if"),
    ("other-three_corners", CORNERS, CORNERS.replace(", (right, bottom)", "")),
    ("other-one_corner_is_enough", "return all(in_front(z, front, other_z, other)",
     "return any(in_front(z, front, other_z, other)"),
    ("other-corners_at_centres", "[side - 0.5 for side in area]", "area"),
    ("other-depth_sign", DEPTH, DEPTH[1:]),
    ("other-whole_area_filled", ONE, ONE.replace("fill_part", "fill")),
    ("other-all_in_one_colour", "self.depth(piece, x, y), piece)", "self.depth(piece, x, y), 0)"),
    ("crashes", "self.fill(around[0], area)", "self.fill(around[1], area)"),
    ("prints-nothing", "\n\nmain()\n", "\n"),
]
