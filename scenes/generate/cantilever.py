#!/usr/bin/env python3
"""Writes the cantilever of Timoshenko and Goodier, as a scene, to the standard output.

  cantilever.py > ../cantilever.json

Its size is that of the lattice alone: --set /cover/size=0.0625.
"""

LENGTH, HEIGHT, LOAD = 10.0, 1.0, 1000.0  # m, m, N/m
YOUNG, POISSON = 1e10, 0.25
STIFFNESS = 1e11  # Pa/m, of the support
POINTS = 40

E, NU = YOUNG / (1 - POISSON**2), POISSON / (1 - POISSON)  # of plane strain
INERTIA = HEIGHT**3 / 12
# A parabola drawn by straight pieces falls short of its area by this factor.
WHOLE = 1 / (1 - 1 / POINTS**2)


def displacement(x, y):
    factor = LOAD / (6 * E * INERTIA)
    square = y * y - HEIGHT**2 / 4
    return (-factor * y * ((6 * LENGTH - 3 * x) * x + (2 + NU) * square),
            factor * (3 * NU * y * y * (LENGTH - x) + (4 + 5 * NU) * HEIGHT**2 * x / 4 + (3 * LENGTH - x) * x * x))


def shear(y):
    return LOAD / (2 * INERTIA) * (HEIGHT**2 / 4 - y * y)


def at_wall(y):
    """What a support has to aim at, so that it gives way to the exact displacement under the exact traction."""
    (ux, uy), bending = displacement(0, y), LOAD * LENGTH * y / INERTIA
    return ux + bending / STIFFNESS, uy - WHOLE * shear(y) / STIFFNESS


def table(values):
    return "[" + ", ".join(f"[{y:g}, {value:.9g}]" for y, value in values) + "]"


def scene():
    ys = [HEIGHT * (i / POINTS - 0.5) for i in range(POINTS + 1)]
    wall_x, wall_y = (table([(y, at_wall(y)[axis]) for y in ys]) for axis in range(2))
    tip = table([(y, WHOLE * shear(y)) for y in ys])
    deflection = displacement(LENGTH, 0)[1]
    return f"""// A cantilever of {LENGTH:g} x {HEIGHT:g} m under a shear load of {LOAD:g} N/m at its end, at rest (Timoshenko & Goodier).
// Made by: generate/cantilever.py
//
// Shows: bending on a lattice that does not fit the body, and how the error falls with the size of the lattice.
// Right answer: in plane strain the middle of the end (`tip`) stands {deflection:.6g} m higher, less what triangles of
// constant strain are too stiff by: of second order in /cover/size. The displacement counts from t = 0, so read
// the height, `tip.y`. Neither end is clamped, which would be a singular problem: the load is spread by the
// parabola of the theory, and the support aims at u + t / stiffness with the displacement u and the traction t of the
// theory at the wall, so that the exact solution is one of the scene whatever the stiffness.
//
//   talus run scenes/cantilever.json --out cantilever
//   talus run scenes/cantilever.json --set /cover/size=0.0625 --out cantilever_fine
{{
  "talus": 1,
  "title": "Cantilever of Timoshenko and Goodier",
  "materials": {{
    "rock": {{"density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": {POISSON}}}
  }},
  "cover": {{"model": "hexagonal", "size": 0.125, "offset_x": 0.031, "offset_y": 0.017, "angle": 11}},
  "bodies": [
    {{"name": "beam", "material": "rock", "polygon": [[0, -0.5], [10, -0.5], [10, 0.5], [0, 0.5]],
     "surfaces": {{"wall": [3], "end": [1]}}}}
  ],
  "prescribed": [
    {{"body": "beam", "surface": "wall", "stiffness": 1e11, "displacement": [
      {{"y": {wall_x}}},
      {{"y": {wall_y}}}
    ]}}
  ],
  "surface_loads": [
    {{"body": "beam", "surface": "end", "traction": [0, {{"y": {tip}}}]}}
  ],
  "settle": {{"duration": 0.8, "damping": "adaptive"}},
  "monitors": [
    {{"name": "tip", "body": "beam", "point": [10, 0], "quantities": ["x", "y"]}},
    {{"name": "middle", "body": "beam", "point": [5, 0], "quantities": ["x", "y"]}}
  ],
  "time": {{"end": 1e-4, "safety": 0.8}}
}}
"""


if __name__ == "__main__":
    print(scene(), end="")
