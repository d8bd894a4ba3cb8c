#!/usr/bin/env python3
"""Draws incline.svg: two contact laws on the incline with two friction angles, with their analytic curves.

    build/release/bin/talus compare scenes/incline.json --vary /contact/model=overlap_area,vertex_edge --out out/incline
    python3 docs/figures/incline.py out/incline/compare.csv

Needs Python 3 alone. The second argument is the file to write; default: incline.svg beside this script.
"""
import bisect
import csv
import math
import pathlib
import sys

from drawing import BLUE, FAINT, INK, SOFT, VERMILION, Axes, Drawing

HERE = pathlib.Path(__file__).resolve().parent
REFERENCE = HERE.parents[1] / "scenes" / "reference"
LAWS = (("overlap_area", BLUE), ("vertex_edge", VERMILION))
COS, SIN = math.cos(math.radians(30)), math.sin(math.radians(30))
HEEL, LENGTH, BLOCK_HEIGHT = -9.243867, 2.0, 1.0  # m along the slope from B; m
MOMENT = 2.95  # s
PLOT_TOP, PLOT_HEIGHT = 474, 290


def read(path):
    with open(path, newline="") as file:
        rows = csv.reader(file)
        names = [name.rsplit(" [", 1)[0] for name in next(rows)]
        return dict(zip(names, zip(*[[float(value) for value in row] for row in rows])))


def at(series, column, time):
    """Linear between rows."""
    times = series["t"]
    right = min(max(bisect.bisect_left(times, time), 1), len(times) - 1)
    share = (time - times[right - 1]) / (times[right] - times[right - 1])
    return series[column][right - 1] + share * (series[column][right] - series[column][right - 1])


def sketch(d, run, left, top, scale):
    """The incline to scale: B is the origin of the scene."""
    def page(s, h=0.0):
        return left + (s * COS + h * SIN + 10.9) * scale, top + (6.9 + s * SIN - h * COS) * scale

    a, b, c = page(-12), page(0), page(12)
    base = max(a[1], c[1]) + 16
    d.path([a, b, c, (c[0], base), (a[0], base)], "none", 0, fill="#f1f3f5", closed=True)
    d.line(*a, *b, INK, 3.2)
    d.line(*b, *c, INK, 3.2)
    d.line(*a, *b, "#cbd2d9", 1.6)
    for s, words in ((-5.4, "AB:  φ = 20°"), (6.9, "BC:  φ = 38.3°")):
        x, y = page(s, -0.95)
        d.text(x, y, words, 12.5, SOFT, "middle", turn=30)
    # the slope
    x, y = page(12)
    d.line(x, y, x - 70, y, FAINT, 1, "3 3")
    d.path([(x - 52 * math.cos(k / 10 * math.radians(30)), y - 52 * math.sin(k / 10 * math.radians(30)))
            for k in range(11)], FAINT, 1)
    d.text(x - 60, y - 7, "30°", 12, SOFT, "end")

    places = (("t = 0", 0.0), (f"t = {MOMENT} s", MOMENT), ("at rest", run["t"][-1]))
    for words, time in places:
        law = "overlap_area/block."
        moved = at(run, law + "ux", time) * COS - at(run, law + "uy", time) * SIN
        corners = [page(HEEL + moved + s, h) for s, h in ((0, 0), (LENGTH, 0), (LENGTH, 1), (0, 1))]
        d.path(corners, BLUE, 1.6, fill="#d6e8f4", closed=True)
        x, y = page(HEEL + moved + LENGTH / 2, BLOCK_HEIGHT + 0.55)
        d.text(x + 6, y, words, 13, INK, "start", 600)
    for name, s in (("A", -12), ("B", 0), ("C", 12)):
        x, y = page(s)
        d.dot(x, y, 4, INK)
        px, py = page(s, -0.95)
        d.text(px - (6 if name == "C" else 0), py + 5, name, 14, INK, "middle", 600)
    bar_x, bar_y = a[0], base - 8
    d.line(bar_x, bar_y, bar_x + 4 * scale, bar_y, SOFT, 1.2)
    for x in (bar_x, bar_x + 4 * scale):
        d.line(x, bar_y - 4, x, bar_y + 4, SOFT, 1.2)
    d.text(bar_x + 2 * scale, bar_y - 7, "4 m", 12, SOFT, "middle")


def plots(d, run, references):
    whole = Axes(d, (62, PLOT_TOP, 320, PLOT_HEIGHT), (0, 7), (0, 6))
    zoom = Axes(d, (468, PLOT_TOP, 484, PLOT_HEIGHT), (2.7, 3.3), (4.6, 5.4))
    # The part that the second plot enlarges.
    d.path([(whole.x(3.3), whole.y(5.4)), (zoom.left, zoom.top), (zoom.left, zoom.top + zoom.height),
            (whole.x(3.3), whole.y(4.6))], "none", 0, fill="#faf6ec", closed=True)
    d.rectangle(zoom.left, zoom.top, zoom.width, zoom.height, "#fdfbf5")
    d.rectangle(whole.x(2.7), whole.y(5.4), whole.x(3.3) - whole.x(2.7), whole.y(4.6) - whole.y(5.4), "#faf6ec",
                "#d9cba3")
    whole_motion(d, whole, run, references)
    across_b(d, zoom, run, references)


def whole_motion(d, axes, run, references):
    axes.frame(range(0, 8), range(0, 7), "time, s", "speed of the block, m/s")
    for law, color in LAWS:
        axes.curve(run["t"], run[f"{law}/block.speed"], color, 2.2)
    for law, _ in LAWS:
        axes.curve(references[law]["t"], references[law]["block.speed"], INK, 1.0, "2 4")
    for x, where, acceleration, anchor in ((0.95, "on AB", "1.848 m/s²", "start"), (5.0, "on BC", "−1.839 m/s²", "end")):
        d.text(axes.x(x), axes.y(0.95), where, 12.5, SOFT, anchor, halo=True)
        d.text(axes.x(x), axes.y(0.95) + 16, acceleration, 12.5, SOFT, anchor, halo=True)
    d.text(axes.x(6.45), axes.y(0) - 8, "at rest", 12.5, SOFT, "middle", halo=True)


def across_b(d, axes, run, references):
    axes.frame([2.7, 2.8, 2.9, 3.0, 3.1, 3.2, 3.3], [4.6, 4.8, 5.0, 5.2, 5.4], "time, s",
               "speed while the block crosses B, m/s", "{:.1f}", "{:.1f}")
    bottom = axes.top + axes.height
    high, low = (at(run, f"{law}/block.speed", MOMENT) for law, _ in LAWS)
    for time, top, words in ((2.8, 5.174191, "toe at B"), (MOMENT, low, f"{MOMENT} s"), (3.1873, 4.93, "heel at B")):
        d.line(axes.x(time), bottom, axes.x(time), axes.y(top), FAINT, 1, "2 3")
        d.text(axes.x(time) - 6, axes.y(4.64), words, 12, SOFT, "end", halo=True)
    for law, color in LAWS:
        axes.curve(run["t"], run[f"{law}/block.speed"], color, 3.2)
    for law, _ in LAWS:
        axes.curve(references[law]["t"], references[law]["block.speed"], INK, 1.2, "3 5")
    x = axes.x(MOMENT)
    d.arrow(x, axes.y(low) - 5, x, axes.y(high) + 5, INK, 1.3, both=True)
    d.dot(x, axes.y(high), 3.8, BLUE)
    d.dot(x, axes.y(low), 3.8, VERMILION)
    d.text(x + 8, axes.y(5.133), f"{high - low:.3f} m/s", 13, INK, "start", 700)
    d.text(axes.x(2.99), axes.y(5.315), f"overlap_area  {high:.4f} m/s", 13, BLUE, "start", 600)
    d.text(axes.x(2.815), axes.y(4.945), f"vertex_edge  {low:.4f} m/s", 13, VERMILION, "start", 600, halo=True)


def draw(run, references, target):
    d = Drawing(980, PLOT_TOP + PLOT_HEIGHT + 88, "A block slides over the change of friction at B: speed by two contact laws and by analysis")
    d.text(28, 38, "A block slides from low onto high friction: how it brakes depends on the contact law", 18, INK,
           "start", 700)
    d.text(28, 61, "Weight carried by the whole base (overlap_area) or by its two corners (vertex_edge). "
           "Same scene, same settled start, same time step.", 13, SOFT)
    sketch(d, run, 200, 82, 25.0)
    plots(d, run, references)
    y = PLOT_TOP + PLOT_HEIGHT + 68
    d.line(28, y - 4, 52, y - 4, BLUE, 3.2)
    d.line(56, y - 4, 80, y - 4, VERMILION, 3.2)
    d.text(88, y, "talus", 12.5, INK)
    d.path([(136, y - 4), (172, y - 4)], INK, 1.2, "3 5")
    d.text(180, y, "analysis of a rigid block: linear base pressure by balance of moments; a force at each corner",
           12.5, INK)
    d.write(target)


def main():
    if not 2 <= len(sys.argv) <= 3:
        sys.exit(__doc__)
    target = pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else HERE / "incline.svg"
    draw(read(sys.argv[1]), {law: read(REFERENCE / f"incline_{law}.csv") for law, _ in LAWS}, target)


if __name__ == "__main__":
    main()
