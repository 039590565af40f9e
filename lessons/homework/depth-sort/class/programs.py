"""The programs of the class that make_class.py makes."""
PROGRAM = "depthsort.py"

D = "-(a * p[0] + b * p[1] + c * p[2])"
FARTHER = """        if one.high[2] != other.high[2]:
            return one.high[2] > other.high[2]
"""
BY_MIDDLE = """        z, other_z = middle_of(one.outline)[2], middle_of(other.outline)[2]
        if z != other_z:
            return z > other_z
"""
TIES = "return (one.polygon, a) > (other.polygon, b)"
PUT_BACK = """                for piece in moved + parts:
                    self.put_in(piece, emit.insert_part)
"""
AT_END = """                for piece in moved + parts:
                    emit.insert_part(piece, len(self.list))
                    self.list.append(piece)
"""
TESTS = """                or self.is_behind(emit.test_3, p, q)
                or self.is_in_front(emit.test_4, q, p)
"""
EXCHANGED = """                or self.is_in_front(emit.test_3, p, q)
                or self.is_behind(emit.test_4, q, p)
"""
BEHIND = 'return side == "behind" or side == "on" and self.pieces[piece].polygon >= self.pieces[plane_of].polygon'
IN_FRONT = 'return side == "front" or side == "on" and self.pieces[plane_of].polygon >= self.pieces[piece].polygon'
BETWEEN = """

    def is_in_front(self, step, piece, plane_of):
        least, greatest, side = self.side_of(piece, plane_of)
        step(piece, plane_of, least, greatest, side)
        """
SWAPPED = """(self.is_behind(emit.test_3_swapped, q, p)
                                   or self.is_in_front(emit.test_4_swapped, p, q))"""

# (name of the mistake, text of the solution, the text that replaces it)
CLASS = [
    ("right", "", ""),
    ("plane_d_sign", D, D[2:-1]),
    ("other-d_forgotten", D, "0.0"),
    ("other-normal_turned", "for other in (q, r)", "for other in (r, q)"),
    ("right", "return a, b, c, " + D, "return a / 2, b / 2, c / 2, " + D + " / 2"),
    ("sorted_by_nearest", FARTHER, FARTHER.replace("high", "low")),
    ("other-sorted_by_middle", FARTHER, BY_MIDDLE),
    ("other-nearest_first", FARTHER, FARTHER.replace(">", "<")),
    ("ties_unstable", TIES, TIES.replace(">", "<")),
    ("ties_unstable", TIES, "return True"),
    ("right", "middle_of(common)[:2]", "common[0][:2]"),
    ("tests_3_4_swapped", TESTS, EXCHANGED),
    ("tests_3_4_swapped", BEHIND + BETWEEN + IN_FRONT, IN_FRONT + BETWEEN + BEHIND),
    ("other-test_5_forgotten", "                or not self.projections_overlap(p, q))", "                )"),
    ("other-plane_not_turned", "turn = 1 if plane[2] > 0 else -1", "turn = 1"),
    ("other-turned_away", "turn = 1 if plane[2] > 0 else -1", "turn = -1 if plane[2] > 0 else 1"),
    ("right", "", ""),
    ("pieces_lost", "in moved + parts:", "in moved:"),
    ("pieces_lost", PUT_BACK, ""),
    ("other-one_part_lost", "in moved + parts:", "in moved + parts[:1]:"),
    ("other-put_back_at_end", PUT_BACK, AT_END),
    ("other-split_at_once", "if not marked and " + SWAPPED, "if False"),
    ("other-moved_unasked", "if not marked and " + SWAPPED, "if not marked"),
    ("other-painters_algorithm", "if self.first_is_next():", "if True:"),
    ("other-in_plane_is_no", BEHIND, 'return side == "behind"'),
    ("other-last_vertex_forgotten", "min(axis) for axis in zip(*self.outline)",
     "min(axis) for axis in zip(*self.outline[:-1])"),
    ("other-t_from_other_end", "made = self.new_vertex(here, after, d_0 / (d_0 - d_1))",
     "made = self.new_vertex(here, after, d_1 / (d_1 - d_0))"),
    ("other-depth_kept_along_span", "-(a * x + b * y + d) / c", "-(a * math.ceil(left) + b * y + d) / c"),
    ("crashes", "self.paint(self.pieces[piece], ", "self.paint(self.pieces[len(self.pieces)], "),
    ("prints-nothing", "\n\nmain()\n", "\n"),
]
