#!/usr/bin/env python3
"""Analytic motion of the rigid block of `incline.json` (section 4.2 of the paper).

A block of length L and height H slides down a ramp of 30 degrees. Along AB the friction angle is 20 degrees,
past B it is 38.3 degrees. The acceleration down the slope is g (sin(theta) - mu_eff cos(theta)); while the
block spans B, mu_eff depends on how the weight is spread over its base, and so on the contact law:

  overlap_area  linear pressure by moment balance; what a law with distributed pressure must give
  vertex_edge   one force at each end of the base; what a vertex-edge law must give
  uniform       uniform pressure, which ignores the moment of friction about the centre
  paper         triangular pressure, Eq. 49 (with the factor g that is missing in print)

  incline.py                  write incline_overlap_area.csv and incline_vertex_edge.csv beside this file
  incline.py --model paper    write the curve of one model to the standard output
  incline.py --check          compare all models with the figures in KNOWN; exit code 1 on a miss
"""

import argparse
import math
import pathlib
import sys

GRAVITY = 10.0  # m/s2
SLOPE = math.radians(30)
MU_AB = math.tan(math.radians(20))
MU_BC = math.tan(math.radians(38.3))
MU_STEP = MU_BC - MU_AB
LENGTH = 2.0  # m, along the slope
HEIGHT = 1.0  # m
RATIO = HEIGHT / LENGTH
TOE_BEFORE_B = 7.243867  # m, so that the toe reaches B at 2.8 s
END, OUTPUT_STEP = 10.0, 0.01  # s
STEP = 1e-4  # s, Runge-Kutta step while the block spans B


# Effective friction coefficient; `share` is the part of the base still on AB, from 1 to 0.


def uniform(share):
    return MU_BC - MU_STEP * share


def paper(share):
    return MU_BC - MU_STEP * share**2


def vertex_edge(share):
    """Corner forces N/2 (1 -+ mu_eff H/L): the heel on AB, the toe on BC."""
    if share >= 1:
        return MU_AB
    if share <= 0:
        return MU_BC
    return 0.5 * (MU_AB + MU_BC) / (1 - 0.5 * MU_STEP * RATIO)


def overlap_area(share):
    """Pressure N/L (1 + 3 mu_eff (H/L) z), z from -1 at the heel to 1 at the toe, as long as the heel presses."""
    mu = (MU_BC - MU_STEP * share) / (1 - 3 * RATIO * MU_STEP * share * (1 - share))
    return mu if mu <= 1 / (3 * RATIO) else heel_lifted(share)


def heel_lifted(share):
    """Triangular pressure on a part 3 (1/2 - mu_eff H/(2 L)) of the base next to the toe.

    On AB stands the rear (share - 1 + part) of it, with the square of its share of the load. The defect below
    grows with mu, so bisection is safe.
    """

    def defect(mu):
        part = 1.5 * (1 - mu * RATIO)
        on_ab = max(0.0, share - 1 + part) / part
        return mu - MU_BC + MU_STEP * on_ab**2

    low, high = MU_AB, MU_BC
    while True:
        middle = 0.5 * (low + high)
        if middle in (low, high):
            return middle
        if defect(middle) < 0:
            low = middle
        else:
            high = middle


MODELS = {"overlap_area": overlap_area, "vertex_edge": vertex_edge, "uniform": uniform, "paper": paper}


def acceleration(mu):
    return GRAVITY * (math.sin(SLOPE) - mu * math.cos(SLOPE))


class Motion:
    """Distance of the toe past B and speed, over time: closed form on AB and on BC, Runge-Kutta between."""

    def __init__(self, friction):
        self.friction = friction
        self.on_ab = acceleration(MU_AB)
        self.on_bc = acceleration(MU_BC)
        self.time_at_b = math.sqrt(2 * TOE_BEFORE_B / self.on_ab)
        self.nodes = [(0.0, self.on_ab * self.time_at_b)]  # (distance, speed) every STEP from time_at_b on
        while self.nodes[-1][0] < LENGTH:
            self.nodes.append(self.step(self.nodes[-1], STEP))
        before = self.nodes[-2]
        part = bisect(lambda dt: self.step(before, dt)[0] - LENGTH, 0.0, STEP)
        self.time_past_b = self.time_at_b + (len(self.nodes) - 2) * STEP + part
        self.speed_past_b = self.step(before, part)[1]
        self.stop_time = self.time_past_b - self.speed_past_b / self.on_bc
        self.stop_distance = LENGTH - 0.5 * self.speed_past_b**2 / self.on_bc

    def rate(self, distance, speed):
        # Strictly between 0 and 1 while spanning B: the corner forces jump at both ends.
        share = min(max(1 - distance / LENGTH, 1e-15), 1 - 1e-15)
        return speed, acceleration(self.friction(share))

    def step(self, state, dt):
        s, v = state
        s1, v1 = self.rate(s, v)
        s2, v2 = self.rate(s + 0.5 * dt * s1, v + 0.5 * dt * v1)
        s3, v3 = self.rate(s + 0.5 * dt * s2, v + 0.5 * dt * v2)
        s4, v4 = self.rate(s + dt * s3, v + dt * v3)
        return s + dt / 6 * (s1 + 2 * s2 + 2 * s3 + s4), v + dt / 6 * (v1 + 2 * v2 + 2 * v3 + v4)

    def at(self, t):
        """Distance of the toe past B (m) and speed (m/s)."""
        if t <= self.time_at_b:
            return 0.5 * self.on_ab * t**2 - TOE_BEFORE_B, self.on_ab * t
        if t < self.time_past_b:
            index = min(int((t - self.time_at_b) / STEP), len(self.nodes) - 2)
            return self.step(self.nodes[index], t - self.time_at_b - index * STEP)
        rest = min(t, self.stop_time) - self.time_past_b
        speed = 0.0 if t >= self.stop_time else self.speed_past_b + self.on_bc * rest
        return LENGTH + self.speed_past_b * rest + 0.5 * self.on_bc * rest**2, speed

    def peak(self):
        """Largest speed and its time: where the acceleration changes sign, if not at B itself."""

        def braking(t):
            return -self.rate(*self.at(t))[1]

        first = self.time_at_b + 1e-9
        t = self.time_at_b if braking(first) > 0 else bisect(braking, first, self.time_past_b)
        return self.at(t)[1], t

    def rows(self):
        for i in range(round(END / OUTPUT_STEP) + 1):
            t = round(i * OUTPUT_STEP, 10)
            distance, speed = self.at(t)
            slid = distance + TOE_BEFORE_B
            yield t, speed, slid * math.cos(SLOPE), -slid * math.sin(SLOPE)


def bisect(function, low, high):
    """Zero of a function that is negative at `low` and not at `high`, to the last bit or so."""
    for _ in range(100):
        middle = 0.5 * (low + high)
        if function(middle) < 0:
            low = middle
        else:
            high = middle
    return high


def csv(model):
    lines = ["t [s],block.speed [m/s],block.ux [m],block.uy [m]"]
    for row in Motion(MODELS[model]).rows():
        lines.append(f"{row[0]:.2f}," + ",".join(f"{value + 0.0:.12g}" for value in row[1:]))
    return "\n".join(lines) + "\n"


# Figures found independently of this script: v(2.95), peak, its time, time on BC at last, time of the stop.
KNOWN = {
    "uniform": (5.342517, 5.350179, 2.989, 3.177953, 5.991734),
    "paper": (5.262742, 5.272140, 2.912, 3.186687, 5.868261),
    "overlap_area": (5.278582, 5.285220, 2.920, 3.186002, 5.869491),
    "vertex_edge": (5.085557, 5.174191, 2.800, 3.195464, 5.881320),
}
KNOWN_STOP_DISTANCE = {"overlap_area": 8.623}  # m, toe past B
NAMES = ("v(2.95) [m/s]", "peak [m/s]", "at [s]", "on BC [s]", "stop [s]")
# Half a unit of the last digit; a whole one where the start, itself rounded to 1e-6 m, can decide it.
ALLOWED = (1e-6, 1e-6, 5e-4, 1e-6, 1e-6)


def check():
    misses = 0
    for model, known in KNOWN.items():
        motion = Motion(MODELS[model])
        peak, peak_time = motion.peak()
        found = [motion.at(2.95)[1], peak, peak_time, motion.time_past_b, motion.stop_time]
        rows = list(zip(NAMES, found, known, ALLOWED))
        if model in KNOWN_STOP_DISTANCE:
            rows.append(("past B [m]", motion.stop_distance, KNOWN_STOP_DISTANCE[model], 5e-4))
        for name, value, right, allowed in rows:
            missed = not abs(value - right) <= allowed
            misses += missed
            print(f"{model:13} {name:14} {value:.7f}  known {right:g}{'  MISSED' if missed else ''}")
    return misses


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--model", choices=MODELS, help="write this model's curve to the standard output")
    parser.add_argument("--check", action="store_true", help="compare with known figures")
    arguments = parser.parse_args()
    if arguments.check:
        return 1 if check() else 0
    if arguments.model:
        sys.stdout.write(csv(arguments.model))
        return 0
    for model in ("overlap_area", "vertex_edge"):
        (pathlib.Path(__file__).parent / f"incline_{model}.csv").write_text(csv(model), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
