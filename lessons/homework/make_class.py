"""A class of thirty to try the homework with: the solution, right or with something made wrong in it.

usage: python3 make_class.py FOLDER

makes FOLDER/01-right/PROGRAM and so on: one folder for each row of programs.py, named after its mistake. "other-"
begins those for which zstep has no name, or cannot tell it in the scenes of this homework.
"""
import pathlib
import shutil
import sys

from programs import CLASS, PROGRAM


def main():
    right_one = pathlib.Path(__file__).parent.parent / "solution"
    solution = (right_one / PROGRAM).read_text()
    for number, (name, right, wrong) in enumerate(CLASS, 1):
        assert right == "" or solution.count(right) == 1, f"{name}: no line of the solution, or several, have {right!r}"
        folder = pathlib.Path(sys.argv[1]) / f"{number:02}-{name}"
        folder.mkdir(parents=True)
        (folder / PROGRAM).write_text(solution.replace(right, wrong) if right else solution)
        shutil.copy(right_one / "emit.py", folder)


main()
