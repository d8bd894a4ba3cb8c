#!/usr/bin/env python3
"""Draws beams.svg: two elastic beams at four stages, and how fast the crest of the lower one moves.

    build/release/bin/talus run scenes/beams.json --out out/beams
    build/release/bin/talus run scenes/beams.json --set /interfaces/0/friction_angle=0 --out out/beams0
    python3 docs/figures/beams.py out/beams out/beams0

Needs Python 3 alone. The third argument is the file to write; default: beams.svg beside this script.
"""
import csv
import math
import pathlib
import sys

import frames
from drawing import BLUE, FAINT, INK, SOFT, VERMILION, Axes, Drawing

HERE = pathlib.Path(__file__).resolve().parent
STAGES = (8, 12, 16, 20)  # m of the upper beam
SCALE, LEFT, TOP = 17.0, 28, 98  # pixels per metre; upper left corner of the first picture
BOX = (-12.6, 13.4, -0.6, 11.6)  # m, what a picture shows
LARGEST = 420.0  # Pa, end of the scale of colours
SHADES = ("#eef3f8", "#cfe1ee", "#a6cbe3", "#f5dcae", "#eeaf5c", "#dc7429", "#a63c06")


def shade(value):
    return SHADES[min(int(value / LARGEST * len(SHADES)), len(SHADES) - 1)]


def shear(frame):
    """Largest shear stress of each element, Pa."""
    return [math.hypot((x - y) / 2, s) for x, y, s in zip(frame["stress_xx"], frame["stress_yy"], frame["stress_xy"])]


def stage(d, folder, moved, column, row):
    # Frames are written every 0.2 s and the upper beam moves at 1 m/s.
    frame = frames.read(folder / "frames" / f"frame_{round(moved / 0.2):06d}.vtu")
    width, height = (BOX[1] - BOX[0]) * SCALE, (BOX[3] - BOX[2]) * SCALE
    left, top = LEFT + column * (width + 36), TOP + row * (height + 34)

    def page(point):
        return left + (point[0] - BOX[0]) * SCALE, top + (BOX[3] - point[1]) * SCALE

    # One path for each shade keeps the file small.
    outlines = {color: "" for color in SHADES}
    for stress, corners in zip(shear(frame), frames.cells(frame)):
        places = [page(frame["Points"][k]) for k in corners]
        outlines[shade(stress)] += "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in places) + "Z"
    for color, outline in outlines.items():
        d.parts.append(f'<path d="{outline}" fill="{color}" stroke="#8795a1" stroke-width="0.35"/>')
    d.line(*page((BOX[0], 0)), *page((BOX[1], 0)), FAINT, 1)
    for x in (-6, 6):
        d.line(*page((x - 0.9, 0)), *page((x + 0.9, 0)), INK, 3)
    y = page((0, 11))[1]
    for x in (moved - 13.7 - 6, moved - 13.7 + 6):
        d.line(*page((x - 0.6, 11)), *page((x + 0.6, 11)), INK, 3)
        d.arrow(page((x, 0))[0] - 12, y - 10, page((x, 0))[0] + 12, y - 10, INK, 1.4)
    d.text(page((BOX[0], 0))[0], page((0, 0.5))[1], f"u = {moved} m", 15, INK, "start", 700, halo=True)


def colours(d, x, y):
    for k, color in enumerate(SHADES):
        d.rectangle(x + 34 * k, y, 34, 11, color, "#8795a1", 0.5)
    for value in (0, LARGEST):
        d.text(x + 34 * len(SHADES) * value / LARGEST, y + 26, f"{value:g}" + (" +" if value else ""), 12, SOFT, "middle")
    d.text(x + 17 * len(SHADES), y + 26, "largest shear stress, Pa", 12, SOFT, "middle")


def history(path):
    with open(path / "history.csv", newline="", encoding="utf-8") as file:
        rows = csv.reader(file)
        names = [name.split(" [")[0] for name in next(rows)]
        return dict(zip(names, zip(*[[float(value) for value in row] for row in rows])))


def snap(series):
    """Largest speed of the crest until half a second after it comes back over its first place."""
    times, across = series["t"], series["lower.ux"]
    gives_way = max(range(len(times)), key=lambda i: across[i])
    back = next(i for i in range(gives_way, len(times)) if across[i] < 0)
    end = next(i for i in range(back, len(times)) if times[i] >= times[back] + 0.6)
    return max(range(gives_way, end), key=lambda i: series["lower.speed"][i])


def curves(d, runs, top):
    axes = Axes(d, (70, top, 850, 190), (6, 20), (0, 2.5))
    axes.frame(range(6, 21, 2), (0, 0.5, 1, 1.5, 2, 2.5), "way u of the upper beam, m",
               "speed of the lower beam's crest, m/s")
    for (words, color, anchor), series in runs:
        axes.curve(series["t"], series["lower.speed"], color, 1.5)
        i = snap(series)
        x, y = axes.x(series["t"][i]), axes.y(series["lower.speed"][i])
        d.dot(x, y, 3.8, color)
        words += f": {series['t'][i]:.2f} m"
        d.text(x + (-10 if anchor == "end" else 6), axes.y(2.22), words, 13, color, anchor, 600, halo=True)


def draw(folder, frictionless, target):
    d = Drawing(966, 812, "Two curved elastic beams at four stages, and the speed of the crest of the lower one")
    d.text(28, 38, "Two elastic beams slide over each other and snap through", 18, INK, "start", 700)
    d.text(28, 61, "340 patches, 506 elements, friction 10°, no damping. The upper one is driven at its two tops, 1 m/s.",
           13, SOFT)
    for number, moved in enumerate(STAGES):
        stage(d, folder, moved, number % 2, number // 2)
    colours(d, 694, 24)
    curves(d, ((("without friction", VERMILION, "end"), history(frictionless)),
               (("10°", BLUE, "start"), history(folder))), 574)
    d.write(target)


def main():
    if not 3 <= len(sys.argv) <= 4:
        sys.exit(__doc__)
    target = pathlib.Path(sys.argv[3]) if len(sys.argv) == 4 else HERE / "beams.svg"
    draw(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), target)


if __name__ == "__main__":
    main()
