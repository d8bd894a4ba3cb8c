#!/usr/bin/env python3
"""Writes the contact of Hertz, a cylinder on a half-plane, as a scene with two meshes, into a folder.

  hertz.py --out hertz && talus run hertz/hertz.json --out hertz/result
  hertz.py --out hertz --cylinder 10 --block 7      triangles per half width of the contact, of either side

The right answer for these values, per metre of thickness, is a half width of 0.015451 m and a peak pressure of
41.2026 MPa. Both meshes are fine up to 1.3 half widths and grow from there on by a constant factor. What is drawn
of the cylinder is its lower part, 1.6 m wide up to the height of its centre: what is left out is too far away
to matter.
"""

import argparse
import json
import math
import pathlib

RADIUS, LOAD, YOUNG, POISSON = 1.0, 1e6, 1e10, 0.25  # m, N/m, Pa
STIFFNESS = 1e13  # Pa/m, of the contact
HALF_WIDTH = math.sqrt(8 * LOAD * RADIUS * (1 - POISSON**2) / (math.pi * YOUNG))
PEAK = 2 * LOAD / (math.pi * HALF_WIDTH)
FINE = 1.3  # of the half width
GROWTH = 1.45
PROBES = 65  # from the middle outwards


def steps_to(end, cell, fine):
    """From 0 to `end`: cells of one size up to `fine`, then growing ones, all stretched a little to fit."""
    at = [0.0]
    while at[-1] < fine * (1 - 1e-9):
        at.append(at[-1] + cell)
    size = cell
    while at[-1] < end:
        size *= GROWTH
        at.append(at[-1] + size)
    kept = [x for x in at if x <= fine * (1 + 1e-9)]
    grown = at[len(kept) - 1:]
    stretch = (end - grown[0]) / (grown[-1] - grown[0])
    return kept[:-1] + [grown[0] + stretch * (x - grown[0]) for x in grown]


def grid(width, height, cells):
    """Places across, from side to side, and shares of the height from the contact on."""
    cell = HALF_WIDTH / cells
    right = steps_to(width, cell, FINE * HALF_WIDTH)
    down = steps_to(height, cell, HALF_WIDTH)
    return [-x for x in reversed(right[1:])] + right, [y / height for y in down]


def cylinder(cells):
    across, up = grid(0.8 * RADIUS, RADIUS, cells)

    def place(x, share):
        low = RADIUS - math.sqrt(RADIUS**2 - x * x)
        return x, low + share * (RADIUS - low)

    return [[place(x, share) for x in across] for share in up]


def block(cells):
    across, down = grid(3 * RADIUS, 3 * RADIUS, cells)
    return [[(x, -3 * RADIUS * share) for x in across] for share in reversed(down)]


def mesh(rows, far_row):
    """MSH 2.2 of rows of nodes from the lowest to the highest; the sides along `far_row` are the surface "far"."""
    columns = len(rows[0])

    def node(i, j):
        return 1 + i + j * columns

    elements = [f"1 2 1 1 {node(i, far_row)} {node(i + 1, far_row)}" for i in range(columns - 1)]
    for j in range(len(rows) - 1):
        for i in range(columns - 1):
            a, b, c, d = node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)
            left = 2 * i < columns - 1
            for corners in ((a, b, c), (a, c, d)) if left else ((a, b, d), (b, c, d)):
                elements.append("2 2 2 2 " + " ".join(map(str, corners)))
    nodes = [f"{node(i, j)} {x!r} {y!r} 0" for j, row in enumerate(rows) for i, (x, y) in enumerate(row)]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "2", '1 1 "far"', '2 2 "body"',
             "$EndPhysicalNames", "$Nodes", str(len(nodes)), *nodes, "$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{number} {element}" for number, element in enumerate(elements, 1)]
    return "\n".join(lines + ["$EndElements"]) + "\n"


def chord(rows, x):
    """Height of the lower side of the cylinder as it is meshed."""
    low = rows[0]
    i = max(k for k in range(len(low) - 1) if low[k][0] <= x)
    (x0, y0), (x1, y1) = low[i], low[i + 1]
    return y0 + (y1 - y0) * (x - x0) / (x1 - x0)


def scene(rows_of_cylinder):
    """Monitors pair up: `b7` of the block and `c7` of the cylinder face each other. What `y` of the first is above that
    of the second is their overlap, and times the stiffness the pressure."""
    monitors = []
    for i in range(PROBES):
        x = FINE * HALF_WIDTH * i / PROBES
        for name, body, y in (("b", "block", 0.0), ("c", "cylinder", chord(rows_of_cylinder, x))):
            monitors.append({"name": f"{name}{i}", "body": body, "point": [x, y], "quantities": ["x", "y"]})
    return {
        "talus": 1, "title": "Hertz: a cylinder on a half-plane",
        "materials": {"rock": {"density": 2300, "model": "linear_elastic", "young_modulus": YOUNG,
                               "poisson_ratio": POISSON}},
        "cover": {"model": "mesh"},
        "contact": {"model": "frictionless"},
        "interfaces": [{"between": ["*", "*"], "normal_stiffness": STIFFNESS, "normal_damping": 0}],
        "bodies": [{"name": "block", "mesh": "block.msh", "material": "rock"},
                   {"name": "cylinder", "mesh": "cylinder.msh", "material": "rock", "fix": ["x", "rotation"]}],
        "prescribed": [{"body": "block", "surface": "far", "stiffness": 1e11, "displacement": [0, 0]}],
        "surface_loads": [{"body": "cylinder", "surface": "far", "traction": [0, -LOAD / (1.6 * RADIUS)]}],
        "settle": {"duration": 0.012, "damping": "adaptive"},
        "monitors": monitors,
        "time": {"end": 1e-8, "safety": 0.4},
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder")
    parser.add_argument("--cylinder", type=int, default=8, help="triangles per half width of the contact")
    parser.add_argument("--block", type=int, default=8, help="triangles per half width of the contact")
    arguments = parser.parse_args()
    if min(arguments.cylinder, arguments.block) < 2:
        parser.error("--cylinder and --block must be at least 2")
    arguments.out.mkdir(parents=True, exist_ok=True)
    upper, lower = cylinder(arguments.cylinder), block(arguments.block)
    (arguments.out / "cylinder.msh").write_text(mesh(upper, len(upper) - 1))
    (arguments.out / "block.msh").write_text(mesh(lower, 0))
    (arguments.out / "hertz.json").write_text(json.dumps(scene(upper), indent=1) + "\n")


if __name__ == "__main__":
    main()
