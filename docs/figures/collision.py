#!/usr/bin/env python3
"""Draws collision.svg: momentum of two equal blocks around their impact.

    build/release/bin/talus run scenes/collision.json --set /time/end=1.05 --set /output/history=1e-4 --out out/impact
    python3 docs/figures/collision.py out/impact/history.csv

Needs Python 3 alone. The second argument is the file to write; default: collision.svg beside this script.
"""
import csv
import pathlib
import sys

from drawing import BLUE, FAINT, GREEN, INK, SOFT, VERMILION, Axes, Drawing

HERE = pathlib.Path(__file__).resolve().parent
MASS = 2800.0  # kg per metre of thickness
LASTS = 8.5754e-3  # s, elastic bars


def read(path):
    with open(path, newline="") as file:
        rows = csv.reader(file)
        names = [name.rsplit(" [", 1)[0] for name in next(rows)]
        return dict(zip(names, zip(*[[float(value) for value in row] for row in rows])))


def sketch(d, x, y, scale, gap, names):
    """The two blocks, `gap` metres apart."""
    for left, color, fill, name in ((0, BLUE, "#d6e8f4", "A"), (1 + gap, VERMILION, "#fbe3d3", "B")):
        d.rectangle(x + left * scale, y - scale, scale, scale, fill, color, 1.6)
        d.text(x + (left + 0.5) * scale, y - 0.5 * scale + 5, name, 14, INK, "middle", 600)
    d.line(x - 14, y, x + (2 + gap) * scale + 14, y, FAINT)
    d.text(x + (1 + gap / 2) * scale, y + 19, names, 12, SOFT, "middle")


def draw(run, target):
    d = Drawing(760, 470, "Momentum of two blocks before, during and after their impact")
    d.text(28, 38, "Two equal blocks collide: momentum passes from A to B, none is lost", 17, INK, "start", 700)
    sketch(d, 100, 120, 44, 0.5, "before: 0.5 m/s against a block at rest")
    sketch(d, 500, 120, 44, 0.04, "after 1 s: in contact for 8.5 ms")
    axes = Axes(d, (72, 190, 640, 200), (0.995, 1.015), (0, 1700))
    axes.drawing.rectangle(axes.x(1), axes.top, axes.x(1 + LASTS) - axes.x(1), axes.height, "#f6f7f9")
    axes.frame([0.995, 1.0, 1.005, 1.01, 1.015], [0, 350, 700, 1050, 1400], "time, s",
               "momentum in x, N s per metre of thickness", "{:.3f}", "{:g}")
    a, b = ([MASS * v for v in run[f"{name}.vx"]] for name in "AB")
    axes.curve(run["t"], [p + q for p, q in zip(a, b)], GREEN, 7, opacity=0.35)
    axes.curve(run["t"], a, BLUE, 2.6)
    axes.curve(run["t"], b, VERMILION, 2.6)
    worst = max(abs(p + q - MASS * 0.5) for p, q in zip(a, b)) / (MASS * 0.5)
    d.text(axes.x(1.0043), axes.y(1400) - 10, f"both together: 1400 N s/m, but for {worst:.0e} of it", 13, GREEN, "middle", 600)
    d.text(axes.x(0.9975), axes.y(1400) + 18, "A", 14, BLUE, "middle", 600)
    d.text(axes.x(0.9975), axes.y(0) - 8, "B", 14, VERMILION, "middle", 600)
    d.text(axes.x(1.012), axes.y(1400) + 18, f"B: {run['B.vx'][-1]:.4f} m/s", 13, VERMILION, "middle", 600)
    d.text(axes.x(1.012), axes.y(0) - 8, f"A: {run['A.vx'][-1]:.4f} m/s", 13, BLUE, "middle", 600)
    d.text(axes.x(1.0 + LASTS / 2), axes.y(0) - 8, "in contact", 12, SOFT, "middle")
    d.text(28, 452, "Without friction and gravity; step 1e-4 s. A keeps 0.0001 m/s: 0.05 % of the energy stays as vibration.",
           12, SOFT)
    d.write(target)


def main():
    if not 2 <= len(sys.argv) <= 3:
        sys.exit(__doc__)
    draw(read(sys.argv[1]), pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else HERE / "collision.svg")


if __name__ == "__main__":
    main()
