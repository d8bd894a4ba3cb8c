#!/usr/bin/env python3
"""Runs scenes/vaiont.json and prints what the landslide did; draws vaiont.svg (section and speeds).

    python3 docs/figures/vaiont.py build/release/bin/talus --out out/vaiont --threads 2
    python3 docs/figures/vaiont.py --out out/vaiont           # from a run that is there already
    python3 docs/figures/vaiont.py TALUS --out out/short --set /time/end=5

Needs Python 3 alone. --picture FILE says where the picture goes; default: vaiont.svg beside this script.

Times are those of frames, every 0.1 s. The mean velocity weighs each block by its area. The mass hits the far bank in
the middle of the time in which its mean velocity is within 2 % of the peak, and is at rest when it stays below 1 % of
that to the end; so does the mean speed, of single blocks too, below 0.1 m/s.
"""
import argparse
import csv
import json
import math
import pathlib
import re
import subprocess
import sys

import frames
from drawing import BLUE, FAINT, GOLD, GREEN, GRID, INK, SOFT, VERMILION, Axes, Drawing

HERE = pathlib.Path(__file__).resolve().parent
SCENE = HERE.parent.parent / "scenes" / "vaiont.json"
EVERY = 0.1  # s, between frames
REST = 0.1  # m/s, mean speed
FOOT, LEVEL = 1234.0, 0.0  # m, foot of the far bank and floor of the gorge
GROUND = ((-63.037, 587.909), (352, 445), (685, 230), (920, 230), (1214, 0))  # before the slide
BOX, SCALE = (-150, 1600, -40, 640), 0.44  # m shown; pixels per metre
SHADES = ("#eef3f8", "#cfe1ee", "#a6cbe3", "#f5dcae", "#eeaf5c", "#dc7429", "#a63c06")
FASTEST = 28.0  # m/s, end of the scale of colours
MONITORS = (("back", BLUE), ("middle", GOLD), ("front", GREEN))


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("talus", nargs="?", help="the program; without it a run in --out is taken")
    parser.add_argument("--out", default="out/vaiont", type=pathlib.Path)
    parser.add_argument("--threads", default="1")
    parser.add_argument("--set", action="append", default=[], metavar="/POINTER=VALUE")
    parser.add_argument("--picture", default=HERE / "vaiont.svg", type=pathlib.Path)
    return parser.parse_args()


def run(given):
    words = [given.talus, "run", str(SCENE), "--out", str(given.out), "--overwrite", "--threads", given.threads]
    for change in [f"/output/frames={EVERY}", f"/output/history={EVERY / 2}"] + given.set:
        words += ["--set", change]
    code = subprocess.run(words, check=False).returncode
    if code != 0:
        sys.exit(f"talus ended with {code}")


def frame_list(folder):
    """(time, frame, contacts) of each frame, as paths."""
    index = (folder / "frames.pvd").read_text(encoding="ascii")
    entries = re.findall(r'timestep="([^"]+)" part="(\d)" file="([^"]+)"', index)
    bodies = [(float(time), folder / name) for time, part, name in entries if part == "0"]
    contacts = [folder / name for _, part, name in entries if part == "1"]
    return [(time, body, contact) for (time, body), contact in zip(bodies, contacts)]


class Section:
    """The blocks at one time: corners and velocities of each, those of the slide alone."""

    def __init__(self, path, slide):
        arrays = frames.read(path)
        self.blocks, self.bed, self.speeds = [], [], []
        for cell, body, speed in zip(frames.cells(arrays), arrays["body"], arrays["speed"]):
            corners = [arrays["Points"][i][:2] for i in cell]
            if body in slide:
                self.blocks.append((corners, [arrays["velocity"][i][:2] for i in cell]))
                self.speeds.append(speed)
            else:
                self.bed.append(corners)

    def mean(self):
        """Mean of velocity (x, y) and of speed, and the area. Velocity is affine on a block: corners of triangles
        give that of their centroids without error."""
        area = vx = vy = speed = 0.0
        for corners, velocities in self.blocks:
            own = x = y = 0.0
            for i in range(1, len(corners) - 1):
                (x0, y0), (x1, y1), (x2, y2) = corners[0], corners[i], corners[i + 1]
                part = ((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)) / 2
                own += part
                x += part * (velocities[0][0] + velocities[i][0] + velocities[i + 1][0]) / 3
                y += part * (velocities[0][1] + velocities[i][1] + velocities[i + 1][1]) / 3
            area, vx, vy, speed = area + own, vx + x, vy + y, speed + math.hypot(x, y)
        return vx / area, vy / area, speed / area, area


def measure(folder):
    resolved = json.loads((folder / "resolved.json").read_text(encoding="utf-8"))
    names = [body["name"] for body in resolved["bodies"]]
    slide = {i for i, name in enumerate(names) if name.startswith("slide_")}
    bank = names.index("far_bank")
    result = {"blocks": len(slide), "times": [], "mean": [], "speed": [], "hit": None}
    sections = {}
    for time, body, contact in frame_list(folder):
        section = Section(body, slide)
        vx, vy, speed, area = section.mean()
        result["times"].append(time)
        result["mean"].append(math.hypot(vx, vy))
        result["speed"].append(speed)
        result.setdefault("area", area)
        if not sections:
            sections["start"] = (time, section)
        if result["hit"] is None:
            touching = frames.read(contact)
            if any(bank in pair for pair in zip(touching["body_a"], touching["body_b"])):
                result["hit"] = time
                sections["hit"] = (time, section)
        last = (time, section)
    sections["end"] = last
    peak = max(result["mean"])
    fast = [time for time, speed in zip(result["times"], result["mean"]) if speed > 0.98 * peak]
    result["fast"] = fast[0], fast[-1]
    result["rest"] = quiet_from(result["times"], result["mean"], 0.01 * peak)
    result["still"] = quiet_from(result["times"], result["speed"], REST)
    corners = [corner for block, _ in last[1].blocks for corner in block]
    result["front"] = max(x for x, _ in corners)
    result["run_up"] = max((y - LEVEL for x, y in corners if x >= FOOT), default=None)
    with open(folder / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    result["history"] = {key: [float(row[key]) for row in rows] for key in rows[0]}
    return result, sections


def quiet_from(times, values, limit):
    """The time from which the values stay below the limit; None if that of the last frame does not."""
    moving = [i for i, value in enumerate(values) if value >= limit]
    if not moving:
        return times[0]
    return times[moving[-1] + 1] if moving[-1] + 1 < len(times) else None


def text(value, unit, digits=1):
    return "not within the run" if value is None else f"{value:.{digits}f} {unit}"


def report(result):
    history = result["history"]
    peak = max(result["mean"])
    rows = [("blocks", str(result["blocks"])), ("area of the section", f"{result['area']:.0f} m2"),
            ("first block on the far bank", text(result["hit"], "s")),
            ("the mass hits the far bank", "{:.1f} s, the middle of {:.1f} to {:.1f} s".format(
                sum(result["fast"]) / 2, *result["fast"])),
            ("peak of the mean velocity",
             f"{peak:.1f} m/s at {result['times'][result['mean'].index(peak)]:.1f} s")]
    time = history["t [s]"]
    for name, _ in MONITORS:
        speeds = history[f"{name}.speed [m/s]"]
        rows.append((f"peak velocity, {name}", f"{max(speeds):.1f} m/s at {time[speeds.index(max(speeds))]:.1f} s"))
        ux, uy = history[f"{name}.ux [m]"][-1], history[f"{name}.uy [m]"][-1]
        rows.append((f"displacement, {name}", f"{math.hypot(ux, uy):.0f} m"))
    rows += [("run-up above the floor of the gorge", text(result["run_up"], "m", 0)),
             ("mean velocity below 1 % of its peak from", text(result["rest"], "s")),
             (f"mean speed below {REST:g} m/s from", text(result["still"], "s")),
             ("mean speed at the end", text(result["speed"][-1], "m/s", 3)), ("front at the end", f"x = {result['front']:.0f} m")]
    for label, value in rows:
        print(f"| {label} | {value} |")


def draw_section(d, time, section, title, top):
    left = 30

    def at(point):
        return left + (point[0] - BOX[0]) * SCALE, top + 24 + (BOX[3] - point[1]) * SCALE

    width, height = (BOX[1] - BOX[0]) * SCALE, (BOX[3] - BOX[2]) * SCALE
    clip = d.clip(left, top + 24, width, height)
    for corners in section.bed:
        d.path([at(corner) for corner in corners], GRID, 0.5, fill=GRID, closed=True, clip=clip)
    for (corners, _), speed in zip(section.blocks, section.speeds):
        shade = SHADES[min(int(speed / FASTEST * len(SHADES)), len(SHADES) - 1)]
        d.path([at(corner) for corner in corners], SOFT, 0.4, fill=shade, closed=True, clip=clip)
    d.path([at(point) for point in GROUND], VERMILION, 1.2, "5 4", clip=clip)
    d.text(left, top + 14, f"{title}, t = {time:.1f} s", 13, INK, weight=600)
    return top + 24 + height + 14


def draw(result, sections, path):
    d = Drawing(830, 1340, "The Vaiont landslide: section at the start, at the hit and at the end, and velocities")
    top = 18.0
    for key, title in (("start", "Start"), ("hit", "First contact with the far bank"), ("end", "End of the run")):
        if key in sections:
            top = draw_section(d, *sections[key], title, top)
    for i, shade in enumerate(SHADES):
        d.rectangle(30 + 34 * i, top, 34, 10, shade, FAINT, 0.5)
    d.text(30, top + 24, "0", 11, SOFT)
    d.text(30 + 34 * len(SHADES), top + 24, f"{FASTEST:g} m/s", 11, SOFT, "end")
    d.line(420, top + 5, 460, top + 5, VERMILION, 1.2, "5 4")
    d.text(468, top + 9, "ground before the slide", 11, SOFT)
    history = result["history"]
    time = history["t [s]"]
    highest = max([max(result["mean"])] + [max(history[f"{name}.speed [m/s]"]) for name, _ in MONITORS])
    limit = max(5 * math.ceil(highest * 1.05 / 5), 1)
    end = max(time)
    plot = Axes(d, (64, top + 66, 730, 1340 - top - 66 - 56), (0, end), (0, limit))
    step = 5 if end > 10 else max(end / 5, 1e-9)
    plot.frame([step * i for i in range(int(end / step) + 1)], range(0, limit + 1, 5), "time, s", "speed, m/s")
    plot.curve(result["times"], result["mean"], INK, 2.4)
    d.text(790, top + 62, "mean velocity (black)", 11, INK, "end")
    for i, (name, color) in enumerate(MONITORS):
        plot.curve(time, history[f"{name}.speed [m/s]"], color, 1.4)
        d.text(640 - 60 * i, top + 62, name, 11, color, "end")
    if result["hit"] is not None:
        d.line(plot.x(result["hit"]), plot.top, plot.x(result["hit"]), plot.top + plot.height, FAINT, 1, "4 4")
    d.write(path)


def main():
    given = arguments()
    if given.talus:
        run(given)
    result, sections = measure(given.out)
    report(result)
    draw(result, sections, given.picture)


if __name__ == "__main__":
    main()
