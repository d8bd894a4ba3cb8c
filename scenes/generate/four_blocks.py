#!/usr/bin/env python3
"""Writes the four blocks with vertex on vertex of section 4.4, as a scene, to the standard output.

  four_blocks.py > ../four_blocks.json          the scene shipped
  four_blocks.py --direction 50                 load of the same size, 50 degrees below the horizontal
  four_blocks.py --mirror                       right and left exchanged, for comparing with the first

The load points to the left and down. Up to 45 degrees block A moves to the left, beyond it moves down.
"""

import argparse
import math
import sys

SIDE, LENGTH = 2.0, 3.0  # m, of block C; of the two long sides of block A
HALF_ANGLE = 10.0  # deg, of block A at its vertex
LOAD, SHIPPED = 5e7, (-4e7, -3e7)  # N/m
DAMPING, STEP, STEPS = 2e4, 1e-5, 600000  # 1/s, s


def bodies():
    """All share the origin. Swapping x and y maps A, C and the base to themselves and B to D."""
    angle = math.radians(45 + HALF_ANGLE)
    x, y = round(LENGTH * math.cos(angle), 6), round(LENGTH * math.sin(angle), 6)
    low, far = -SIDE, 8.0
    return {
        "base": [(low, low), (far, low), (far, low - 1), (low - 1, low - 1), (low - 1, far), (low, far)],
        "A": [(0, 0), (y, x), (x, y)],
        "B": [(0, 0), (0, low), (y, low), (y, x)],
        "C": [(0, 0), (low, 0), (low, low), (0, low)],
        "D": [(0, 0), (x, y), (low, y), (low, 0)],
    }


def scene(direction, mirror):
    sign = -1 if mirror else 1
    force = SHIPPED
    if direction is not None:
        # Swapping the components of a load at 45 - d gives that at 45 + d to the last bit.
        turned = abs(direction - 45)
        less, more = (LOAD * math.sin(math.radians(45 + s * turned)) for s in (-1, 1))
        force = (-less, -more) if direction > 45 else (-more, -less)
    more = {"base": ',\n     "surfaces": {"smooth": [0, 1, 2, 3, 4, 5]}, "fixed": true', "A": ', "fix": ["rotation"]'}
    words = []
    for name, points in bodies().items():
        polygon = ", ".join(f"[{sign * x + 0:.10g}, {y:.10g}]" for x, y in points)
        words.append(f'    {{"name": "{name}", "polygon": [{polygon}], "material": "rock"' +
                     more.get(name, "") + "}")
    body_lines = ",\n".join(words)
    given = ("" if direction is None else f" --direction {direction:g}") + (" --mirror" if mirror else "")
    end = STEP * STEPS
    monitors = ",\n".join(f'    {{"name": "{n}", "body": "{n}", "quantities": ["ux", "uy", "speed", "rotation"]}}'
                          for n in "ABCD")
    middle = sum(bodies()["A"][k][0] for k in range(3)) / 3
    return f"""// Four blocks whose vertices meet in one point, section 4.4 of the paper (after Bao and Zhao 2010).
// Made by: generate/four_blocks.py{given}
//
// Shows: contact of vertex with vertex, where a law that asks for the one edge to push against must guess. The load
// pushes block A to the left and down, more to the left: A must slide along the top edge of C, not down C's side.
// Coordinates are not published; these are our own. C is a square, A a wedge of {2 * HALF_ANGLE:g} degrees along the diagonal;
// D lies on C to the left of A, B stands beside C below A. The fixed table is carried on up the left side, so
// that x and y may be swapped: then B and D change places, and nothing else. The table is smooth.
// Taken from the paper: material, friction of 15 degrees, size of the load, step and number of steps, no gravity. The
// load reads kN there, but must be N. Undamped, it would carry the blocks kilometres away within 6 s: the global
// damping of {DAMPING:g} 1/s lets them creep. (With 2/dt it would be the static analysis of DDA, all velocities set to
// zero at each step, {2 / STEP / DAMPING:g} times as slow.) Other than in the paper the stiffness is ten times larger, and A
// must not turn: with 1e10 Pa/m the tip of A sinks 0.18 m into the corner of C before it finds a side.
// Right answer: A goes to the left and D rises, held by the wall; B moves to the right far less. With the load turned
// beyond 45 degrees, B and D change roles, exactly there. The mirror image (--mirror) must move alike.
//
//   talus run scenes/four_blocks.json --out four_blocks
//   talus compare scenes/four_blocks.json --vary /contact/model=overlap_area,vertex_edge --out four_blocks_laws
{{
  "talus": 1,
  "title": "Four blocks, vertex on vertex",
  "materials": {{
    "rock": {{"density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0.3}}
  }},
  "cover": {{"model": "block"}},
  "contact": {{"model": "overlap_area"}},
  "interfaces": [
    {{"between": ["rock", "rock"], "normal_stiffness": 1e11, "tangential_stiffness": 1e11, "friction_angle": 15,
     "normal_damping": 0, "tangential_damping": 0}},
    {{"between": ["smooth", "rock"], "normal_stiffness": 1e11, "tangential_stiffness": 1e11, "friction_angle": 0,
     "normal_damping": 0, "tangential_damping": 0}}
  ],
  "bodies": [
{body_lines}
  ],
  "loads": [
    {{"body": "A", "point": [{sign * middle:.10g}, {middle:.10g}], "force": [{sign * force[0]!r}, {force[1]!r}]}}
  ],
  "damping": {DAMPING:g},
  "monitors": [
{monitors}
  ],
  "time": {{"end": {end:g}, "dt": {STEP:g}}},
  "output": {{"history": 0.01, "frames": 0.1}}
}}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--direction", type=float, help="angle of the load below the horizontal, deg")
    parser.add_argument("--mirror", action="store_true", help="exchange right and left")
    arguments = parser.parse_args()
    if arguments.direction is not None and not 0 <= arguments.direction <= 90:
        parser.error("--direction must be 0 to 90")
    sys.stdout.write(scene(arguments.direction, arguments.mirror))


if __name__ == "__main__":
    main()
