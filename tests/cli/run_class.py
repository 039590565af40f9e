"""Runs a program of each student of a class on each scene, all in one process: starting Python takes longer than most
runs. What a student's program prints, up to where it fails, is in RUNS/STUDENT/SCENE.jsonl.

  python3 run_class.py CLASS PROGRAM RUNS SCENE.txt...
"""
import os
import runpy
import sys

folder, program, runs, *scenes = sys.argv[1:]
screen, errors, path, known = sys.stdout, sys.stderr, list(sys.path), set(sys.modules)
for student in sorted(os.listdir(folder)):
    home = os.path.join(folder, student)
    os.makedirs(os.path.join(runs, student))
    for scene in scenes:
        name = os.path.splitext(os.path.basename(scene))[0]
        with open(os.path.join(runs, student, name + ".jsonl"), "w") as out, open(os.devnull, "w") as nowhere:
            sys.stdout, sys.stderr, sys.path = out, nowhere, [home] + path
            sys.argv = [program, scene]
            try:
                runpy.run_path(os.path.join(home, program), run_name="__main__")
            except (Exception, SystemExit):
                pass
            sys.stdout, sys.stderr = screen, errors
        for module in set(sys.modules) - known:
            del sys.modules[module]
