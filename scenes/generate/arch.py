#!/usr/bin/env python3
"""Writes a semicircular arch of voussoirs on fixed abutments, as a scene, to the standard output.

  arch.py --voussoirs 25 > ../arch.json               5 % thicker than the thinnest arch that stands
  arch.py --voussoirs 7 --factor 0.97 > arch_7.json   3 % thinner: it falls

The radius is that of the centre line, half of inner and outer radius together. Sides of voussoirs are straight.
"""

import argparse
import math
import sys

DENSITY, STIFFNESS, GRAVITY = 2300, 1e12, 9.81
FRICTION = 60  # degrees


def plain(value):
    return f"{value:g}".replace("e+", "e")


def at(radius, angle):
    """A point of the arch by its angle from the vertical, to the right."""
    return radius * math.sin(angle), radius * math.cos(angle)


def part(inner, outer, begin, end):
    """Area of a straight-sided piece between two angles, and its moment about the vertical through the crown."""
    ring = [at(outer, end), at(outer, begin), at(inner, begin), at(inner, end)]
    area = moment = 0.0
    for (x0, y0), (x1, y1) in zip(ring, ring[1:] + ring[:1]):
        cross = x0 * y1 - x1 * y0
        area += cross / 2
        moment += cross * (x0 + x1) / 6
    return area, moment


def room(voussoirs, thickness, thrust):
    """How far the horizontal thrust can move up and down, as a moment, until it leaves a joint (radius 1, unit
    weight per area). Below 0 there is no line of thrust within the arch."""
    inner, outer = 1 - thickness / 2, 1 + thickness / 2
    step = math.pi / voussoirs
    angle, area, moment = 0.0, 0.0, 0.0
    least, most = -math.inf, math.inf
    # The joints of one half from the crown down; an odd number has half a voussoir first.
    joint = 0.0 if voussoirs % 2 == 0 else step / 2
    while joint < math.pi / 2 + step / 2:
        if joint > angle:
            begin = -joint if angle == 0 and voussoirs % 2 else angle
            more, more_moment = part(inner, outer, begin, joint)
            if begin < 0:  # the right half of the voussoir at the crown
                more, more_moment = more / 2, half_key(inner, outer, joint)
            area, moment = area + more, moment + more_moment
        for radius, upper in ((outer, True), (inner, False)):
            x, y = at(radius, joint)
            bound = thrust * y + area * x - moment
            least, most = (least, min(most, bound)) if upper else (max(least, bound), most)
        angle, joint = joint, joint + step
    return most - least


def half_key(inner, outer, angle):
    """Moment of the right half of the voussoir at the crown: a trapezium with its upright side at x = 0."""
    (top, _), (bottom, _) = at(outer, angle), at(inner, angle)
    height = (outer - inner) * math.cos(angle)
    return height * (top * top + top * bottom + bottom * bottom) / 6


def stands(voussoirs, thickness):
    """Whether some thrust keeps the line of thrust in all joints; the room is a concave function of the thrust."""
    low, high = 0.0, 1.0
    for _ in range(100):
        left, right = low + (high - low) / 3, high - (high - low) / 3
        if room(voussoirs, thickness, left) < room(voussoirs, thickness, right):
            low = left
        else:
            high = right
    return room(voussoirs, thickness, low) > 0


def thinnest(voussoirs):
    """Least thickness over radius of an arch that stands, of rigid voussoirs that do not slide (Heyman)."""
    low, high = 0.01, 0.5
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (low, middle) if stands(voussoirs, middle) else (middle, high)
    return high


def points(pairs):
    return "[" + ", ".join(f"[{x!r}, {y!r}]" for x, y in pairs) + "]"


def scene(voussoirs, factor, radius):
    limit = thinnest(voussoirs)
    thickness = factor * limit * radius
    inner, outer = radius - thickness / 2, radius + thickness / 2
    step = math.pi / voussoirs
    lines = []
    for name, side in (("left", -1), ("right", 1)):
        inside, outside = side * (inner - thickness), side * (outer + thickness)
        low, high = min(inside, outside), max(inside, outside)
        base = points([(low, -thickness), (high, -thickness), (high, 0.0), (low, 0.0)])
        lines.append(f'    {{"name": "{name}", "polygon": {base}, "material": "rock", "fixed": true}}')
    angles = [(k - voussoirs / 2) * step for k in range(voussoirs + 1)]
    for number, (begin, end) in enumerate(zip(angles, angles[1:]), 1):
        corners = [at(inner, begin), at(inner, end), at(outer, end), at(outer, begin)]
        # The first and last joint lie on the abutments, to the last bit.
        corners = [(x, 0.0 if abs(y) < 1e-12 * radius else y) for x, y in corners]
        lines.append(f'    {{"name": "v{number}", "polygon": {points(corners)}, "material": "rock"}}')
    crown = (voussoirs + 1) // 2
    fate = "stands" if factor > 1 else "falls"
    body_lines = ",\n".join(lines)
    return f"""// A semicircular arch of {voussoirs} voussoirs on fixed abutments, {factor:g} times as thick as the thinnest that stands.
// Made by: generate/arch.py --voussoirs {voussoirs} --factor {factor:g} --radius {radius:g}
//
// Shows: stability of masonry. What decides is geometry alone: whether a line of thrust fits within the arch.
// Right answer: rigid voussoirs that do not slide stand from t/R = {limit:.5f} on ({voussoirs} voussoirs, R the radius of the
// centre line; 0.10748 for very many, after Milankovitch). This arch has {factor * limit:.5f}: it {fate}. Joints give a little: the
// penalty is {plain(STIFFNESS)} Pa/m, so that where the thrust comes close to an edge the overlap stays small against t.
// It settles with friction held stuck; from t = 0 there is no damping whatever, in the joints neither.
//
//   talus run scenes/arch.json --out arch
//   scenes/generate/arch.py --voussoirs {voussoirs} --factor 0.97 > thin.json && talus run thin.json --out thin
{{
  "talus": 1,
  "title": "Arch of {voussoirs} voussoirs",
  "gravity": [0, -{GRAVITY}],
  "materials": {{"rock": {{"density": {DENSITY}}}}},
  "cover": {{"model": "rigid"}},
  "contact": {{"model": "overlap_area"}},
  "interfaces": [
    {{"between": ["rock", "rock"], "normal_stiffness": {plain(STIFFNESS)}, "tangential_stiffness": {plain(STIFFNESS)},
     "friction_angle": {FRICTION}, "normal_damping": 0, "tangential_damping": 0}}
  ],
  "bodies": [
{body_lines}
  ],
  "settle": {{"duration": 1, "damping": "adaptive", "until": 1e-6}},
  "monitors": [
    {{"name": "crown", "body": "v{crown}"}}
  ],
  "time": {{"end": 10, "safety": 0.4}},
  "output": {{"history": 0.02}}
}}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--voussoirs", type=int, default=25)
    parser.add_argument("--factor", type=float, default=1.05, help="thickness over that of the thinnest arch")
    parser.add_argument("--radius", type=float, default=10.0, help="of the centre line, m")
    arguments = parser.parse_args()
    if arguments.voussoirs < 5:
        parser.error("--voussoirs must be at least 5")
    if arguments.factor <= 0:
        parser.error("--factor must be above 0")
    if arguments.radius <= 0:
        parser.error("--radius must be above 0")
    sys.stdout.write(scene(arguments.voussoirs, arguments.factor, arguments.radius))


if __name__ == "__main__":
    main()
