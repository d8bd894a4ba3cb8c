#!/usr/bin/env python3
"""Writes a wall of bricks in running bond on a fixed base, as a scene, to the standard output.

  brick_wall.py --courses 20 --bricks 20 > ../brick_wall.json       411 bodies, the scene shipped
  brick_wall.py --courses 10 --bricks 10 > wall_106.json            106 bodies
  brick_wall.py --courses 30 --bricks 30 > wall_916.json            916 bodies

Every other course starts and ends with half a brick.
"""

import argparse
import sys

WIDTH, HEIGHT = 1.0, 0.5  # m, of a brick
OVERHANG, BASE_HEIGHT = 2.0, 1.0  # m, of the base beyond each end of the wall
DENSITY, YOUNG, POISSON, STIFFNESS, GRAVITY = 2300, 1e10, 0.25, 1e10, 10
RESTRAINED = (1 - POISSON) / (1 + POISSON) / (1 - 2 * POISSON)  # confined modulus over E
FREE = 1 / (1 - POISSON**2)  # modulus over E in plane strain, free to widen
DAMPING = 50  # 1/s


def plain(value):
    return f"{value:g}".replace("e+", "e")


def rectangle(left, bottom, right, top):
    return f"[[{left:g}, {bottom:g}], [{right:g}, {bottom:g}], [{right:g}, {top:g}], [{left:g}, {top:g}]]"


def course_edges(course, bricks):
    """The joints of a course, from left to right."""
    if course % 2 == 0:
        return [i * WIDTH for i in range(bricks + 1)]
    return [0.0] + [(i + 0.5) * WIDTH for i in range(bricks)] + [bricks * WIDTH]


def settlement(courses):
    """What the top course's centre loses: in the joints, and in the bricks for both bounds of their modulus.

    Brick k from the top is pressed by k - 1/2 courses on average, the first one over half its height only.
    """
    weight = DENSITY * GRAVITY * HEIGHT  # Pa per course
    joints = weight * courses * (courses + 1) / 2 / STIFFNESS
    bricks = weight * HEIGHT * (courses**2 / 2 - 0.25) / YOUNG
    return joints, bricks / RESTRAINED, bricks / FREE


def wall(courses, bricks):
    bodies = [("base", rectangle(-OVERHANG, -BASE_HEIGHT, bricks * WIDTH + OVERHANG, 0), ', "fixed": true')]
    for course in range(courses):
        edges = course_edges(course, bricks)
        for i in range(len(edges) - 1):
            outline = rectangle(edges[i], course * HEIGHT, edges[i + 1], (course + 1) * HEIGHT)
            bodies.append((f"c{course + 1}b{i + 1}", outline, ""))
    return bodies


def scene(courses, bricks):
    bodies = wall(courses, bricks)
    lines = [
        f'    {{"name": "{name}", "polygon": {outline}, "material": "brick"{rest}}}' for name, outline, rest in bodies
    ]
    edges = course_edges(courses - 1, bricks)
    middle = min(range(len(edges) - 1), key=lambda i: abs(edges[i] + edges[i + 1] - bricks * WIDTH)) + 1
    joints, least, most = settlement(courses)
    top = f"c{courses}b"
    body_lines = ",\n".join(lines)
    return f"""// A wall in running bond: {courses} courses of {bricks} bricks of {WIDTH:g} x {HEIGHT:g} m, {len(bodies)} bodies with the fixed base.
// Made by: generate/brick_wall.py --courses {courses} --bricks {bricks}
//
// Shows: many blocks at rest on each other under friction, the usual load of a benchmark. The bricks touch at
// the start and carry nothing yet, so the wall drops into its joints and rings. What stills it is a global damping
// of {DAMPING} 1/s: dashpots in the joints would hardly reach the slow up and down motion of the whole wall (with 0.3 of
// critical alone a chain of 20 bricks still moves by some 5 mm/s after 1 s), but lag by half a step and so make the
// stable step shorter. Nothing here bounces freely, so `safety` is 0.4.
// Right answer: the wall stands. The middle of the top course (`block`) sinks by
//   bed joints  rho g h / alpha * n (n + 1) / 2       = {joints:.4g} m (joint k from the top carries k courses)
//   bricks      rho g h^2 / M * (n^2 / 2 - 1 / 4)     = {least:.4g} to {most:.4g} m
// with n = {courses} courses, h = {HEIGHT:g} m, alpha = {plain(STIFFNESS)} Pa/m and M between the confined modulus {RESTRAINED:g} E
// (neighbours keep a brick from widening) and E / (1 - nu^2) = {FREE:.4g} E (free to widen): {joints + least:.3g} to {joints + most:.3g} m
// in all. Nothing slides, the left and the right end (`left`, `right`) move as mirror images.
//
//   talus run scenes/brick_wall.json --out wall
//   talus compare scenes/brick_wall.json --vary /contact/model=overlap_area,vertex_edge --out wall_laws
{{
  "talus": 1,
  "title": "Brick wall, {courses} x {bricks}",
  "gravity": [0, -{GRAVITY}],
  "materials": {{
    "brick": {{"density": {DENSITY}, "model": "linear_elastic", "young_modulus": {plain(YOUNG)}, "poisson_ratio": {POISSON}}}
  }},
  "cover": {{"model": "block"}},
  "contact": {{"model": "overlap_area"}},
  "interfaces": [
    // friction angle 30 deg: mu = tan 30
    {{"between": ["brick", "brick"], "normal_stiffness": {plain(STIFFNESS)}, "tangential_stiffness": {plain(STIFFNESS)},
     "friction_angle": 30, "normal_damping": 0, "tangential_damping": 0}}
  ],
  "bodies": [
{body_lines}
  ],
  "damping": {DAMPING},
  "monitors": [
    {{"name": "block", "body": "{top}{middle}"}},
    {{"name": "left", "body": "{top}1"}},
    {{"name": "right", "body": "{top}{len(edges) - 1}"}}
  ],
  "time": {{"end": 1, "dt": "auto", "safety": 0.4}},
  "output": {{"history": 0.01, "frames": 0.05}}
}}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--courses", type=int, default=20)
    parser.add_argument("--bricks", type=int, default=20, help="whole bricks in the first course")
    arguments = parser.parse_args()
    if arguments.courses < 1 or arguments.bricks < 1:
        parser.error("--courses and --bricks must be at least 1")
    sys.stdout.write(scene(arguments.courses, arguments.bricks))


if __name__ == "__main__":
    main()
