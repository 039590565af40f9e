"""The programs of the class that make_class.py makes."""
PROGRAM = "bsp.py"

CUT = """                before, behind = self.cut(piece, root)
                front.append(before)
                back.append(behind)
"""
DOWN = """        node["front"] = self.build(front, number, True)
        node["back"] = self.build(back, number, False)
"""
COLUMNS = "max(0, math.ceil(left)), min(width, math.ceil(right))"

# (name of the mistake, text of the solution, the text that replaces it)
CLASS = [
    ("right", "", ""),
    ("other-d_sign", "-(a * p[0] + b * p[1] + c * p[2])", "a * p[0] + b * p[1] + c * p[2]"),
    ("other-normal_turned", "for other in (q, r)", "for other in (r, q)"),
    ("other-d_forgotten", "-(a * p[0] + b * p[1] + c * p[2])", "0.0"),
    ("right", "", ""),
    ("spanning_not_split", 'elif side == "crossing":', "elif False:"),
    ("spanning_not_split", CUT, "                front.append(piece)\n"),
    ("near_side_first", '(node["back"], node["front"]) if eye_in_front',
     '(node["back"], node["front"]) if not eye_in_front'),
    ("right", "", ""),
    ("other-eye_turned_round", "eye_in_front = value > 0", "eye_in_front = value < 0"),
    ("side_by_normal", 'value = -self.pieces[node["pieces"][0]]', 'value = self.pieces[node["pieces"][0]]'),
    ("other-sides_exchanged", '(front if side == "front" else back)', '(back if side == "front" else front)'),
    ("right", "", ""),
    ("other-in_plane_to_back", 'if side == "on":', "if False:"),
    ("other-first_in_plane_first", "key=lambda piece: -self", "key=lambda piece: self"),
    ("other-back_first", DOWN, "".join(reversed(DOWN.splitlines(True)))),
    ("other-part_behind_lost", CUT, "".join(CUT.splitlines(True)[:2])),
    ("right", "", ""),
    ("other-t_from_other_end", "made = self.new_vertex(here, after, d_0 / (d_0 - d_1))",
     "made = self.new_vertex(here, after, d_1 / (d_1 - d_0))"),
    ("other-parts_exchanged", "before, behind = self.cut", "behind, before = self.cut"),
    ("other-last_vertex_forgotten", 'in self.pieces[piece]["corners"]:', 'in self.pieces[piece]["corners"][:-1]:'),
    ("other-side_of_first_vertex", "side = side_of(min(values), max(values))", "side = side_of(values[0], values[0])"),
    ("other-list_turned", "for piece in pieces[1:]:", "for piece in reversed(pieces[1:]):"),
    ("other-a_pixel_more", COLUMNS, COLUMNS.replace("math.ceil(right)", "math.ceil(right) + 1")),
    ("other-ends_truncated", COLUMNS, COLUMNS.replace("math.ceil", "int")),
    ("other-depth_sign", "-(a * x + b * y + d) / c", "(a * x + b * y + d) / c"),
    ("other-depth_kept_along_span", "-(a * x + b * y + d) / c", "-(a * math.ceil(left) + b * y + d) / c"),
    ("other-all_in_one_colour", '-(a * x + b * y + d) / c, piece["polygon"]', "-(a * x + b * y + d) / c, 0"),
    ("crashes", "self.paint(self.pieces[piece], ", "self.paint(self.pieces[len(self.pieces)], "),
    ("prints-nothing", "\n\nmain()\n", "\n"),
]
