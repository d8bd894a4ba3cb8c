#!/usr/bin/env python3
"""Writes rows of quadrilateral blocks that slide on each other down an inclined base, to the standard output.

  sliding.py --blocks 504 > sliding_504.json                      8 rows of 63 blocks
  sliding.py --blocks 5000 --cover rigid > sliding_5000.json      25 rows of 200 rigid blocks
  sliding.py --blocks 504 --roles priority > one_sided.json       the lower of two blocks is master, of a row the one behind

Joints between the blocks of a row lean at random and are open by a tenth of a millimetre; rows differ in height, and
one block in eight is a millimetre lower than its row. Each row starts a little faster than the one below, so all
of them slip, and falls towards it, so all of them touch. Per block 1.5 to 1.9 pairs overlap, about two fifths of
those whose boxes meet.
"""

import argparse
import math
import sys

LENGTH, HEIGHT = 1.0, 0.7  # m, of a block on average
JITTER = 0.12  # share of either by which it varies, to both sides
JOINT = 1e-4  # m, gap between blocks of a row
LOWER, LOW_SHARE = 1e-3, 0.125  # m by which a block is lower than its row, and the share of those that are
BASE_HEIGHT, OVERHANG = 2.0, 20.0  # m, of the base, and how far it reaches beyond the rows
SLOPE, FRICTION = 20.0, 8.5  # deg
FIRST_SPEED, SPEED_STEP = 1.0, 0.1  # m/s down the slope: of the first row, and from row to row
CLOSING = 0.002  # m/s at which rows approach
DENSITY, YOUNG, POISSON, STIFFNESS, DAMPING, GRAVITY = 2300, 1e10, 0.25, 1e10, 0.3, 9.81


class Uniform:
    """The linear congruential generator of Numerical Recipes, mapped to [-1, 1): the same numbers everywhere."""

    def __init__(self, seed):
        self.state = seed % 2**32

    def __call__(self):
        self.state = (1664525 * self.state + 1013904223) % 2**32
        return self.state / 2**31 - 1


def row_count(blocks):
    """Rows that grow with the square root, as a heap does, and divide the blocks evenly."""
    most = max(1, round(math.sqrt(blocks / 8)))
    return next(rows for rows in range(most, 0, -1) if blocks % rows == 0)


def rows_of_blocks(blocks, seed=1):
    """Outlines row by row, counter-clockwise, in the frame of the slope: x down the slope, y off the base."""
    uniform = Uniform(seed)
    rows = row_count(blocks)
    columns = blocks // rows
    bottom, outlines = 0.0, []
    for _ in range(rows):
        top = bottom + HEIGHT * (1 + JITTER * uniform())
        shift = LENGTH * uniform() / 2
        low, high = [], []
        for i in range(columns + 1):
            low.append(shift + LENGTH * (i + JITTER * uniform()))
            high.append(shift + LENGTH * (i + JITTER * uniform()))
        row = []
        for i in range(columns):
            own_top = top - (LOWER if uniform() < 2 * LOW_SHARE - 1 else 0)
            share = (own_top - bottom) / (top - bottom)
            ends = [low[k] + share * (high[k] - low[k]) for k in (i, i + 1)]
            row.append([(low[i], bottom), (low[i + 1] - JOINT, bottom), (ends[1] - JOINT, own_top), (ends[0], own_top)])
        outlines.append(row)
        bottom = top
    return outlines


def down_the_slope(point):
    """Turns the frame of the slope into that of the world, x right and y up."""
    c, s = math.cos(math.radians(SLOPE)), math.sin(math.radians(SLOPE))
    return (c * point[0] + s * point[1], c * point[1] - s * point[0])


def bodies(blocks, seed=1):
    """All bodies, the fixed base first: name, outline [m], velocity [m/s] or None where fixed, row from 1 on."""
    rows = rows_of_blocks(blocks, seed)
    left, right = -OVERHANG, len(rows[0]) * LENGTH + OVERHANG
    base = [(left, -BASE_HEIGHT), (right, -BASE_HEIGHT), (right, 0.0), (left, 0.0)]
    result = [("base", [down_the_slope(p) for p in base], None, 0)]
    for number, row in enumerate(rows, 1):
        velocity = down_the_slope((FIRST_SPEED + SPEED_STEP * (number - 1), -CLOSING * number))
        for i, outline in enumerate(row, 1):
            result.append((f"r{number}b{i}", [down_the_slope(p) for p in outline], velocity, number))
    return result


def plain(value):
    return f"{value:g}".replace("e+", "e")


def body_line(number, name, outline, velocity, roles):
    points = ", ".join(f"[{x!r}, {y!r}]" for x, y in outline)
    rest = ', "fixed": true' if velocity is None else f', "velocity": [{velocity[0]!r}, {velocity[1]!r}]'
    if roles == "priority":
        rest += f', "priority": {-number}'
    return f'    {{"name": "{name}", "polygon": [{points}], "material": "rock"{rest}}}'


def scene(blocks, cover, roles, seed):
    all_bodies = enumerate(bodies(blocks, seed))  # row by row
    body_lines = ",\n".join(body_line(number, *body[:3], roles) for number, body in all_bodies)
    rows = row_count(blocks)
    return f"""// {blocks} blocks in {rows} rows slide on each other down a base inclined by {SLOPE:g} deg.
// Made by: generate/sliding.py --blocks {blocks} --cover {cover} --roles {roles} --seed {seed}
//
// Shows: what a step costs where many blocks touch and slip; a scene for measuring, without a closed-form answer.
{{
  "talus": 1,
  "title": "{blocks} sliding blocks",
  "gravity": [0, -{GRAVITY}],
  "materials": {{
    "rock": {{"density": {DENSITY}, "model": "linear_elastic", "young_modulus": {plain(YOUNG)}, "poisson_ratio": {POISSON}}}
  }},
  "cover": {{"model": "{cover}"}},
  "contact": {{"model": "overlap_area", "roles": "{roles}"}},
  "interfaces": [
    {{"between": ["rock", "rock"], "normal_stiffness": {plain(STIFFNESS)}, "tangential_stiffness": {plain(STIFFNESS)},
     "friction_angle": {FRICTION}, "normal_damping": {DAMPING}, "tangential_damping": {DAMPING}}}
  ],
  "bodies": [
{body_lines}
  ],
  "monitors": [
    {{"name": "first", "body": "r1b1"}},
    {{"name": "last", "body": "r{rows}b1"}}
  ],
  "time": {{"end": 0.1, "dt": "auto"}},
  "output": {{"history": 0.01}}
}}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blocks", type=int, default=504)
    parser.add_argument("--cover", choices=("block", "rigid"), default="block", help="deformable or rigid blocks")
    parser.add_argument("--roles", choices=("symmetric", "priority"), default="symmetric")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    if arguments.blocks < 1:
        parser.error("--blocks must be at least 1")
    sys.stdout.write(scene(arguments.blocks, arguments.cover, arguments.roles, arguments.seed))


if __name__ == "__main__":
    main()
