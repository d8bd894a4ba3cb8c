#!/usr/bin/env python3
"""Writes a mesh of triangles over a rectangle, in Gmsh's format MSH 2.2, to the standard output.

  mesh.py --size 10 1 --divisions 40 4 > beam.msh
  mesh.py --size 1 1 --divisions 8 8 --corner -0.5 2 > block.msh
  mesh.py --size 2 1 --divisions 8 4 --corner -8.005423651204648 4.6219335 --angle -30 > sloping.msh

Sides are the physical groups "left", "right", "top" and "bottom", the triangles the group "body". Diagonals
alternate, so that the mesh has no direction of its own.
"""

import argparse
import math
import sys

SIDES = ("left", "right", "top", "bottom")
BODY = len(SIDES) + 1


def nodes_of(corner, size, divisions, angle):
    """Row by row from the lower left; upright, the last ones are exactly on the far sides."""
    (left, bottom), (width, height), (columns, rows) = corner, size, divisions
    cos, sin = (math.cos(math.radians(angle)), math.sin(math.radians(angle))) if angle else (1.0, 0.0)
    for j in range(rows + 1):
        for i in range(columns + 1):
            along, up = width * (i / columns), height * (j / rows)
            yield left + along * cos - up * sin, bottom + along * sin + up * cos


def elements_of(columns, rows):
    """Type, physical group, entity and nodes of each element."""

    def node(i, j):
        return 1 + i + j * (columns + 1)

    for j in range(rows):
        yield 1, 1, (node(0, j + 1), node(0, j))
        yield 1, 2, (node(columns, j), node(columns, j + 1))
    for i in range(columns):
        yield 1, 3, (node(i + 1, rows), node(i, rows))
        yield 1, 4, (node(i, 0), node(i + 1, 0))
    for j in range(rows):
        for i in range(columns):
            a, b, c, d = node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)
            if (i + j) % 2 == 0:
                yield 2, BODY, (a, b, c)
                yield 2, BODY, (a, c, d)
            else:
                yield 2, BODY, (a, b, d)
                yield 2, BODY, (b, c, d)


def mesh(corner, size, divisions, angle=0.0):
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(BODY)]
    lines += [f'1 {number} "{name}"' for number, name in enumerate(SIDES, 1)]
    lines += [f'2 {BODY} "body"', "$EndPhysicalNames"]
    nodes = list(nodes_of(corner, size, divisions, angle))
    lines += ["$Nodes", str(len(nodes))]
    lines += [f"{number} {x!r} {y!r} 0" for number, (x, y) in enumerate(nodes, 1)]
    elements = list(elements_of(*divisions))
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    for number, (kind, group, corners) in enumerate(elements, 1):
        lines.append(f"{number} {kind} 2 {group} {group} {' '.join(map(str, corners))}")
    lines.append("$EndElements")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=float, nargs=2, required=True, metavar=("WIDTH", "HEIGHT"), help="m")
    parser.add_argument("--divisions", type=int, nargs=2, required=True, metavar=("COLUMNS", "ROWS"))
    parser.add_argument("--corner", type=float, nargs=2, default=(0.0, 0.0), metavar=("X", "Y"), help="lower left, m")
    parser.add_argument("--angle", type=float, default=0.0, help="turned about that corner, degrees counter-clockwise")
    arguments = parser.parse_args()
    if min(arguments.size) <= 0:
        parser.error("--size must be above 0")
    if min(arguments.divisions) < 1:
        parser.error("--divisions must be at least 1")
    sys.stdout.write(mesh(arguments.corner, arguments.size, arguments.divisions, arguments.angle))


if __name__ == "__main__":
    main()
