#!/usr/bin/env python3
"""Writes a pile of blocks in running bond on a fixed floor, as a scene, to the standard output.

  pile.py --blocks 5000 > pile_5000.json                                25 courses, each one block shorter
  pile.py --blocks 500000 --shape rectangle --cover rigid > pile.json   250 courses of rigid bricks
  pile.py --blocks 50000 --listing shuffled > pile_shuffled.json        blocks listed in no order

Each course is half a block in from the one below, up to some blocks more that make up the number. All courses
start with a slow fall that grows with their height, so that all of them touch after a few steps.
"""

import argparse
import math
import sys

from sliding import DAMPING, DENSITY, GRAVITY, POISSON, STIFFNESS, YOUNG, Uniform, plain

LENGTH, HEIGHT = 1.0, 0.6  # m, of a block
JITTER = 0.12  # share of the length by which the ends of a joint lean, to both sides
FLOOR_HEIGHT, OVERHANG = 2.0, 10.0  # m, of the floor, and how far it reaches beyond the pile
FRICTION = 30  # deg
CLOSING = 0.002  # m/s at which courses approach


def course_lengths(blocks):
    """Blocks in each course, from the floor up; the longest has about eight times as many as there are courses."""
    courses = max(1, round(math.sqrt(blocks / 8)))
    least = (blocks + courses * (courses - 1) // 2) // courses
    rest = blocks - courses * least + courses * (courses - 1) // 2
    return [least - k + (1 if k < rest else 0) for k in range(courses)]


def bodies(blocks, shape, seed):
    """All bodies, the fixed floor first: name, outline [m], velocity upwards [m/s] or None where fixed."""
    uniform = Uniform(seed)
    lengths = course_lengths(blocks)
    left, right = -OVERHANG, lengths[0] * LENGTH + OVERHANG
    yield "floor", [(left, -FLOOR_HEIGHT), (right, -FLOOR_HEIGHT), (right, 0.0), (left, 0.0)], None
    lean = JITTER if shape == "jittered" else 0
    for k, length in enumerate(lengths):
        bottom, top = round(k * HEIGHT, 6), round((k + 1) * HEIGHT, 6)

        def joint(i):
            """Its lower and its upper end, in steps of a micrometre: the text stays short."""
            return [round(LENGTH * (k / 2 + i + lean * uniform()), 6) for _ in range(2)]

        low, high = joint(0)
        for i in range(1, length + 1):
            next_low, next_high = joint(i)
            outline = [(low, bottom), (next_low, bottom), (next_high, top), (high, top)]
            yield f"c{k + 1}b{i}", outline, -CLOSING * (k + 1)
            low, high = next_low, next_high


def body_line(name, outline, velocity):
    points = ", ".join(f"[{x!r}, {y!r}]" for x, y in outline)
    rest = ', "fixed": true' if velocity is None else f', "velocity": [0, {velocity:g}]'
    return f'    {{"name": "{name}", "polygon": [{points}], "material": "rock"{rest}}}'


def listed(all_bodies, listing, seed):
    """Fisher and Yates' shuffle, where asked for."""
    if listing == "shuffled":
        uniform = Uniform(seed)
        for i in range(len(all_bodies) - 1, 0, -1):
            j = min(i, int((uniform() + 1) / 2 * (i + 1)))
            all_bodies[i], all_bodies[j] = all_bodies[j], all_bodies[i]
    return all_bodies


def scene(blocks, shape, cover, listing, seed):
    body_lines = ",\n".join(body_line(*body) for body in listed(list(bodies(blocks, shape, seed)), listing, seed))
    return f"""// A pile of {blocks} blocks in {len(course_lengths(blocks))} courses on a fixed floor.
// Made by: generate/pile.py --blocks {blocks} --shape {shape} --cover {cover} --listing {listing} --seed {seed}
//
// Shows: what many blocks cost to read, to set up and to step; a scene for measuring, without a closed-form answer.
{{
  "talus": 1,
  "title": "Pile of {blocks} blocks",
  "gravity": [0, -{GRAVITY}],
  "materials": {{
    "rock": {{"density": {DENSITY}, "model": "linear_elastic", "young_modulus": {plain(YOUNG)}, "poisson_ratio": {POISSON}}}
  }},
  "cover": {{"model": "{cover}"}},
  "contact": {{"model": "overlap_area"}},
  "interfaces": [
    {{"between": ["rock", "rock"], "normal_stiffness": {plain(STIFFNESS)}, "tangential_stiffness": {plain(STIFFNESS)},
     "friction_angle": {FRICTION}, "normal_damping": {DAMPING}, "tangential_damping": {DAMPING}}}
  ],
  "bodies": [
{body_lines}
  ],
  "monitors": [
    {{"name": "top", "body": "c{len(course_lengths(blocks))}b1"}}
  ],
  "time": {{"end": 0.1, "dt": "auto"}},
  "output": {{"history": 0.01}}
}}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blocks", type=int, default=5000)
    parser.add_argument("--shape", choices=("jittered", "rectangle"), default="jittered")
    parser.add_argument("--cover", choices=("block", "rigid"), default="block", help="deformable or rigid blocks")
    parser.add_argument("--listing", choices=("built", "shuffled"), default="built", help="course by course, or in no order")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    if arguments.blocks < 1:
        parser.error("--blocks must be at least 1")
    sys.stdout.write(scene(arguments.blocks, arguments.shape, arguments.cover, arguments.listing, arguments.seed))


if __name__ == "__main__":
    main()
