"""A Z-buffer as a homework: two triangles on 14x12 pixels. One line is wrong. It prints its steps as a trace has them."""
import json
import math

WIDTH, HEIGHT = 14, 12
TRIANGLES = [
    [(1, 1, 0.25), (12.5, 4, 0.75), (4, 10.5, 0.5)],
    [(12, 1.5, 0.3), (12, 11, 0.3), (2.5, 6.5, 0.7)],
]


def step(name, **fields):
    print(json.dumps({"step": name, **fields}))


def ends(triangle, y):
    """(x, z) where scan line y meets the triangle, from left to right."""
    found = []
    for (x_0, y_0, z_0), (x_1, y_1, z_1) in zip(triangle, triangle[1:] + triangle[:1]):
        if min(y_0, y_1) <= y < max(y_0, y_1):
            t = (y - y_0) / (y_1 - y_0)
            found.append((x_0 + t * (x_1 - x_0), z_0 + t * (z_1 - z_0)))
    return sorted(found)


zbuffer = [[math.inf] * WIDTH for _ in range(HEIGHT)]
for polygon, triangle in enumerate(TRIANGLES):
    step("polygon", polygon=polygon, facet=polygon)
    for y in range(HEIGHT):
        span = ends(triangle, y)
        if not span or span[0][0] == span[1][0]:
            continue
        (x_left, z_left), (x_right, z_right) = span
        dz_dx = (z_right - z_left) / (x_right - x_left)
        z = z_left
        for x in range(math.ceil(x_left), math.ceil(x_right)):
            nearer = z < zbuffer[y][x]
            step("compare", x=x, y=y, z=z, nearer=nearer)
            if nearer:
                zbuffer[y][x] = z
                step("write_depth", x=x, y=y, z=z)
                step("write_pixel", x=x, y=y, polygon=polygon)
            z += dz_dx
