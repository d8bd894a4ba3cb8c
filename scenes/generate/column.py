#!/usr/bin/env python3
"""Writes a column of square blocks on a fixed base, as a scene, to the standard output.

  column.py --blocks 10 > ../column.json       11 bodies, the scene shipped
  column.py --blocks 100 > column_100.json     101 bodies, for benchmarks

From 66 blocks on the column is too slender to stand for ever: with joints of this stiffness and blocks that do
not bend it buckles at a height of (7.84 alpha w^2 h / (12 rho g))^(1/3) = 65.7 m.
"""

import argparse
import math
import sys

SIDE = 1.0  # m
BASE_WIDTH = 3.0  # m
DENSITY, YOUNG, POISSON, STIFFNESS, GRAVITY = 2300, 1e10, 0.25, 1e10, 10


def plain(value):
    return f"{value:g}".replace("e+", "e")


def rectangle(left, bottom, right, top):
    return f"[[{left:g}, {bottom:g}], [{right:g}, {bottom:g}], [{right:g}, {top:g}], [{left:g}, {top:g}]]"


def settlement(blocks):
    """Height lost by the centre of the top block: joints, then blocks that are free to widen."""
    weight = DENSITY * GRAVITY * SIDE  # Pa per block
    joints = weight * blocks * (blocks + 1) / 2 / STIFFNESS
    # Block k from the top is pressed by k - 1/2 blocks on average, the first one over half its height only.
    return joints, weight * SIDE * (blocks**2 / 2 - 0.25) * (1 - POISSON**2) / YOUNG


def scene(blocks):
    margin = (BASE_WIDTH - SIDE) / 2
    base = rectangle(-margin, -SIDE, SIDE + margin, 0)
    lines = [f'    {{"name": "base", "polygon": {base}, "material": "rock", "fixed": true}}']
    for i in range(blocks):
        outline = rectangle(0, i * SIDE, SIDE, (i + 1) * SIDE)
        lines.append(f'    {{"name": "b{i + 1}", "polygon": {outline}, "material": "rock"}}')
    joints, elastic = settlement(blocks)
    # The slowest mode of the chain: one cell is a joint and a block, their compliances added.
    compliance = 1 / STIFFNESS + SIDE * (1 - POISSON**2) / YOUNG
    slowest = math.pi / (2 * blocks + 1) / (DENSITY * SIDE * compliance) ** 0.5
    damping = float(f"{1.3 * slowest:.2g}")
    end = float(f"{max(0.5, 60 / damping):.2g}")
    body_lines = ",\n".join(lines)
    return f"""// A column of {blocks} blocks of {SIDE:g} x {SIDE:g} m on a fixed base.
// Made by: generate/column.py --blocks {blocks}
//
// Shows: blocks that touch at the start come to rest under their own weight. The slowest up and down motion of
// the column has about {slowest:.3g} rad/s; the global damping of {damping:g} 1/s takes it to rest within a few swings.
// Right answer: the centre of the top block (`block`) sinks by
//   joints  rho g h / alpha * n (n + 1) / 2               = {joints:.5g} m (joint k from the top carries k blocks)
//   blocks  rho g h^2 (1 - nu^2) / E * (n^2 / 2 - 1 / 4)  = {elastic:.5g} m (plane strain, free to widen)
// with n = {blocks}, h = {SIDE:g} m and alpha = {plain(STIFFNESS)} Pa/m: {joints + elastic:.4g} m in all. Springs at corners (`vertex_edge`)
// hinder the widening a little and give somewhat less. Nothing moves sideways or turns.
//
//   talus run scenes/column.json --out column
//   talus compare scenes/column.json --vary /contact/model=overlap_area,vertex_edge,frictionless --out column_laws
{{
  "talus": 1,
  "title": "Column of {blocks} blocks",
  "gravity": [0, -{GRAVITY}],
  "materials": {{
    "rock": {{"density": {DENSITY}, "model": "linear_elastic", "young_modulus": {plain(YOUNG)}, "poisson_ratio": {POISSON}}}
  }},
  "cover": {{"model": "block"}},
  "contact": {{"model": "overlap_area"}},
  "interfaces": [
    {{"between": ["rock", "rock"], "normal_stiffness": {plain(STIFFNESS)}, "tangential_stiffness": {plain(STIFFNESS)},
     "friction_angle": 30, "normal_damping": 0.3, "tangential_damping": 0.3}}
  ],
  "bodies": [
{body_lines}
  ],
  "damping": {damping:g},
  "monitors": [
    {{"name": "block", "body": "b{blocks}"}}
  ],
  "time": {{"end": {end:g}, "dt": "auto"}},
  "output": {{"history": {end / 100:g}}}
}}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blocks", type=int, default=10)
    arguments = parser.parse_args()
    if arguments.blocks < 1:
        parser.error("--blocks must be at least 1")
    sys.stdout.write(scene(arguments.blocks))


if __name__ == "__main__":
    main()
