#!/usr/bin/env python3
"""Writes the two curved elastic beams of section 4.3, as a scene, to the standard output.

  beams.py > ../beams.json                      the scene shipped: 340 patches, 506 elements
  beams.py --size 0.27 > beams_fine.json        elements half as large

Beams are half rings. The lower one stands on its two ends, the upper one hangs from its two tops.
"""

import argparse
import math
import sys

RADIUS, THICKNESS = 6.0, 1.2  # m, of the middle line
HEIGHT, START = 11.0, 13.7  # m, centre of the upper half ring above and left of that of the lower one
SEGMENTS = 48  # of an arc, even: a vertex at mid-span
PER_LINE = 5


def half_ring(centre, sign):
    """Outer arc from right to left, inner arc back: edge SEGMENTS and the last edge are the ends."""

    def point(radius, k):
        # Computed for one quarter and mirrored, so that both halves have the same bits.
        m = min(k, SEGMENTS - k)
        x = radius * math.cos(math.pi * m / SEGMENTS) if 2 * m < SEGMENTS else 0.0
        y = radius * math.sin(math.pi * m / SEGMENTS)
        return round(centre[0] + (x if m == k else -x), 6), round(centre[1] + sign * y, 6)

    outer = [point(RADIUS + THICKNESS / 2, k) for k in range(SEGMENTS + 1)]
    inner = [point(RADIUS - THICKNESS / 2, k) for k in range(SEGMENTS, -1, -1)]
    return outer + inner


def polygon(points, indent):
    words = [f"[{x:.10g}, {y:.10g}]" for x, y in points]
    lines = [", ".join(words[i:i + PER_LINE]) for i in range(0, len(words), PER_LINE)]
    return "[" + (",\n" + " " * indent).join(lines) + "]"


def scene(size):
    lower = polygon(half_ring((0, 0), 1), 17)
    upper = polygon(half_ring((-START, HEIGHT), -1), 17)
    ends = f"[{SEGMENTS}, {2 * SEGMENTS + 1}]"
    return f"""// Two curved elastic beams, section 4.3 of the paper (after Popp et al. 2010): the upper one is driven over the
// lower one, bends it aside and lets it snap through. Made by: generate/beams.py --size {size:g}
//
// Shows: large sliding with friction between bodies of many elements, large rotation with small strain.
// Coordinates are not published; these are our own. Half rings of radius {RADIUS:g} m and thickness {THICKNESS:g} m; the lower one is
// held at its ends, the upper one hangs {HEIGHT:g} m above, starts {START:g} m to the left and is driven at its two tops. Undeformed
// they would cut {2 * (RADIUS + THICKNESS / 2) - HEIGHT:g} m into each other; they touch at u = {START - math.sqrt((2 * RADIUS + THICKNESS) ** 2 - HEIGHT**2):.2f} m. No gravity, no damping of any kind. The upper beam
// starts with the speed of its tops, so that the start makes no wave.
// Right answer: no closed form. The snap (largest speed of the lower crest after it gave way) comes at about 15 m
// without friction, at about 16 m with 10 degrees; then friction takes the energy of the motion bit by bit, while
// without it the beams go on swinging. u = 1 m/s t. The ledger must close; docs/beams_and_blocks.md has what was measured.
// The density of 2.3 that `talus validate` asks about is the paper's, which gives no unit.
//
//   talus run scenes/beams.json --out beams
//   talus compare scenes/beams.json --vary /interfaces/0/friction_angle=0,10 --out beams_friction
//   talus run scenes/beams.json --set /materials/beam/damping_time=5e-2 --out beams_damped      comes close to rest
{{
  "talus": 1,
  "title": "Two curved elastic beams",
  "materials": {{
    "beam": {{"density": 2.3, "model": "hypoelastic", "young_modulus": 1e4, "poisson_ratio": 0.32}}
  }},
  "cover": {{"model": "hexagonal", "size": {size:g}}},
  "contact": {{"model": "overlap_area"}},
  "interfaces": [
    {{"between": ["beam", "beam"], "normal_stiffness": 1e5, "tangential_stiffness": 1e5, "friction_angle": 10,
     "normal_damping": 0, "tangential_damping": 0}}
  ],
  "bodies": [
    {{"name": "lower", "material": "beam", "surfaces": {{"ends": {ends}}},
     "polygon": {lower}}},
    {{"name": "upper", "material": "beam", "surfaces": {{"tops": {ends}}}, "velocity": [1, 0],
     "polygon": {upper}}}
  ],
  "prescribed": [
    {{"body": "lower", "surface": "ends", "stiffness": 1e6, "velocity": [0, 0]}},
    {{"body": "upper", "surface": "tops", "stiffness": 1e6, "velocity": [1, 0]}}
  ],
  "monitors": [
    {{"name": "lower", "body": "lower", "point": [0, {RADIUS:g}]}},
    {{"name": "upper", "body": "upper", "point": [{-START:g}, {HEIGHT - RADIUS:g}]}}
  ],
  "time": {{"end": 20, "dt": "auto"}},
  "output": {{"history": 0.02, "frames": 0.2}}
}}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=float, default=0.542, help="side of the triangles of the lattice, m")
    arguments = parser.parse_args()
    if not arguments.size > 0:
        parser.error("--size must be positive")
    sys.stdout.write(scene(arguments.size))


if __name__ == "__main__":
    main()
