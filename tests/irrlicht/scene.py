"""Random triangles before an eye at the origin, and the header of a run that draws them.

scene.py SEED WIDTH HEIGHT ZSTEP [plain]: writes triangles.txt (four rows of a projection matrix, then nine numbers a
line) and head.jsonl. The driver's viewport is three quarters of a pixel less wide and high than its picture
(buildNDCToDCMatrix in matrix4.h): the header's projection says so, but for "plain".
"""
import json
import random
import struct
import subprocess
import sys

seed, width, height, zstep = int(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
plain = len(sys.argv) > 5
near, far, up = 1.0, 20.0, 1.6
rng = random.Random(seed)


def in_float32(x):
    return struct.unpack("f", struct.pack("f", x))[0]


projection = [[up * height / width, 0, 0, 0], [0, up, 0, 0],
              [0, 0, far / (far - near), -near * far / (far - near)], [0, 0, 1, 0]]
triangles = []
while len(triangles) < 2 + seed % 6:
    triangle = []
    for _ in range(3):
        if triangles and rng.random() < 0.25:  # a vertex of another one
            triangle.append(rng.choice(rng.choice(triangles)))
            continue
        z = in_float32(rng.uniform(2.5, 15))
        triangle.append((in_float32(rng.uniform(-1.1, 1.1) * z * width / height / up),
                         in_float32(rng.uniform(-1.1, 1.1) * z / up), z))
    if len(set(triangle)) == 3:
        triangles.append(triangle)

with open("triangles.txt", "w") as file:
    for row in projection:
        file.write(" ".join(repr(in_float32(x)) for x in row) + "\n")
    for triangle in triangles:
        file.write(" ".join(repr(x) for point in triangle for x in point) + "\n")
with open("scene.toml", "w") as file:
    file.write(f"[raster]\nwidth = {width}\nheight = {height}\n[camera]\neye = [0, 0, -1]\ntarget = [0, 0, 0]\n"
               f"up = [0, 1, 0]\nnear = {near}\nfar = {far}\n")
    for triangle in triangles:
        file.write(f"[[polygon]]\npoints = {json.dumps(triangle)}\n")

# 1/w in float32, where the greater or an equal one wins, in a buffer that begins at 0; both faces are drawn.
header = json.loads(subprocess.run(
    [zstep, "header", "scene.toml", "--depth", "reciprocal", "--number-format", "float32", "--ties", "last",
     "--initial-depth", "0", "--no-cull"], capture_output=True, text=True, check=True).stdout)
camera = header["scene"]["camera"]
for key in ("d", "window", "eye", "rho", "theta", "phi"):
    camera.pop(key, None)
camera["view"] = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
less = 0 if plain else 0.75
camera["projection"] = [[x * (width - less) / width for x in projection[0]],
                        [x * (height - less) / height for x in projection[1]], projection[2], projection[3]]
with open("head.jsonl", "w") as file:
    json.dump(header, file)
    file.write("\n")
