#!/usr/bin/env python3
"""Runs scenes/vaiont.json with several time steps, prints how they part and what they cost; draws vaiont_steps.svg.

    python3 docs/figures/vaiont_steps.py build/release/bin/talus --out out/vaiont_steps    # an hour of one core
    python3 docs/figures/vaiont_steps.py --out out/vaiont_steps                            # from runs that are there
    python3 docs/figures/vaiont_steps.py                                                   # from vaiont_steps.json

Needs Python 3 alone. What the runs gave is kept in vaiont_steps.json beside this script; the picture lies there, too.

All start from one settled geometry: that of a run made first, which alone keeps the friction it settled with and is left
out. The mean velocity is that of the whole mass, in frames every 0.1 s.
"""
import argparse
import itertools
import json
import math
import pathlib
import subprocess
import sys

from drawing import BLUE, FAINT, GOLD, GREEN, INK, SOFT, VERMILION, Axes, Drawing
from vaiont import FOOT, LEVEL, REST, SCENE, Section, frame_list

HERE = pathlib.Path(__file__).resolve().parent
STORE, PICTURE = HERE / "vaiont_steps.json", HERE / "vaiont_steps.svg"
EVERY = 0.1  # s, between frames
PAPER, AUTO, END = "1e-5", "auto", 35  # s
SETTLES = "3.5e-4"  # s, the run made first
PERTURBED = ("3.7314e-4", "3.7038e-4", "3.6901e-4")  # a step less or more per frame
OTHERS = ("5e-5", "1e-4", "3e-4", "4e-4", "5e-4", "6e-4", "8e-4")
FIRST_BLOCK = 9.9  # s, the first block is on the far bank (docs/vaiont.md)
UNTIL = (FIRST_BLOCK, 12.0, 13.0, 14.5)  # s, stretches over which runs are compared


def run(talus, out):
    words = [talus, "compare", str(SCENE), "--vary", "/time/dt=" + ",".join((SETTLES, AUTO, PAPER) + PERTURBED + OTHERS)]
    words += ["--threads", "1", "--out", str(out), "--overwrite"]
    for change in (f"/output/frames={EVERY}", f"/output/history={EVERY}", f"/time/end={END}"):
        words += ["--set", change]
    # 4: a step was too large, which is told by the run's own record.
    if subprocess.run(words, check=False).returncode not in (0, 4):
        sys.exit("talus compare failed")


def centroid(blocks):
    """Of all blocks together."""
    area = x = y = 0.0
    for corners, _ in blocks:
        for i in range(1, len(corners) - 1):
            (x0, y0), (x1, y1), (x2, y2) = corners[0], corners[i], corners[i + 1]
            part = ((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)) / 2
            area, x, y = area + part, x + part * (x0 + x1 + x2) / 3, y + part * (y0 + y1 + y2) / 3
    return x / area, y / area


def collect(folder):
    """What is kept of a run."""
    record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    if record["end"] != "finished":
        return {"end": record["trouble"]}
    names = [b["name"] for b in json.loads((folder / "resolved.json").read_text(encoding="utf-8"))["bodies"]]
    slide = {i for i, name in enumerate(names) if name.startswith("slide_")}
    velocity, speeds = [], []
    for time, body, _ in frame_list(folder):
        section = Section(body, slide)
        vx, vy, speed, _ = section.mean()
        velocity.append([round(vx, 3), round(vy, 3)])
        speeds.append(speed)
        if time == 0:
            start = centroid(section.blocks)
    end = centroid(section.blocks)
    moving = [i for i, speed in enumerate(speeds) if speed >= REST]
    corners = [corner for block, _ in section.blocks for corner in block]
    return {
        "t": record["t [s]"], "dt": record["dt [s]"], "critical_dt": record["critical_dt [s]"],
        "steps": record["steps"], "cpu": round(record["cost"]["stepping"]["cpu [s]"], 2),
        "residual": record["largest_residual_share"], "velocity": velocity,
        "rest": moving[-1] * EVERY if moving[-1] < len(speeds) - 1 else None,
        "moved": round(math.dist(start, end), 2), "front": round(max(x for x, _ in corners), 1),
        "run_up": round(max((y - LEVEL for x, y in corners if x >= FOOT), default=0), 1),
    }


def speeds(run):
    return [math.hypot(*v) for v in run["velocity"]]


def peak(run):
    """Largest mean velocity, m/s, and its frame."""
    values = speeds(run)
    return max(values), values.index(max(values))


def apart(run, other, until):
    """Largest difference of the mean velocities, as vectors, up to a time, m/s."""
    frames = round(until / EVERY) + 1
    return max(math.dist(a, b) for a, b in zip(run["velocity"][:frames], other["velocity"][:frames]))


def cells_of(name, each, paper):
    value, frame = peak(each)
    cells = [name, f"{each['dt'] / each['critical_dt']:.2f}", f"{each['steps']:,}", f"{each['cpu']:.0f}"]
    if each is paper:
        cells += ["–"] * len(UNTIL)
    else:
        cells += [f"{100 * apart(each, paper, t) / peak(paper)[0]:.2f}" for t in UNTIL]
    cells += [f"{value:.2f}", f"{frame * EVERY:.1f}", f"{each['rest']:.1f}" if each["rest"] else "–"]
    return cells + [f"{each['moved']:.1f}", f"{each['run_up']:.0f}", f"{100 * each['residual']:.2g}"]


def print_tables(runs):
    paper, coarse = runs[PAPER], runs[AUTO]
    top = peak(paper)[0]
    print(f"{paper['steps']:,} and {coarse['steps']:,} steps, {paper['steps'] / coarse['steps']:.1f} times as many; "
          f"CPU {paper['cpu']:.0f} and {coarse['cpu']:.0f} s, {paper['cpu'] / coarse['cpu']:.1f} times")
    print(f"differences from {PAPER} s in % of its largest mean velocity, {top:.2f} m/s\n")
    heads = ["step [s]", "of the critical", "steps", "CPU [s]"] + [f"apart until {t:g} s" for t in UNTIL]
    heads += ["peak [m/s]", "at [s]", "rest from [s]", "moved [m]", "run-up [m]", "ledger [%]"]
    print("| " + " | ".join(heads) + " |\n|" + "---|" * len(heads))
    for name in (PAPER,) + OTHERS[:3] + (AUTO,) + PERTURBED + OTHERS[3:]:
        each = runs[name]
        print("| " + (f"{name} | {each['end']}" if "end" in each else " | ".join(cells_of(name, each, paper))) + " |")
    near = [runs[name] for name in (AUTO,) + PERTURBED]
    spread = [max(100 * apart(a, b, t) / top for a, b in itertools.combinations(near, 2)) for t in UNTIL]
    cells = [f"{value:.2f}" for value in spread]
    for key, digits in (("peak", 2), ("at", 1), ("rest", 1), ("moved", 1), ("run_up", 0)):
        values = [{"peak": peak(r)[0], "at": peak(r)[1] * EVERY}.get(key, r.get(key)) for r in near]
        cells.append(f"{max(values) - min(values):.{digits}f}" if all(values) else "–")
    print("| the four near auto, among each other | | | | " + " | ".join(cells) + " | |")


def draw(runs):
    d = Drawing(830, 640, "The Vaiont landslide with several time steps: mean velocity, and difference from the finest")
    paper = runs[PAPER]
    top = peak(paper)[0]
    colors = {"5e-5": GREEN, "1e-4": BLUE, AUTO: VERMILION, "4e-4": GOLD}
    mean_step = runs[AUTO]["t"] / runs[AUTO]["steps"]
    names = [name if name != AUTO else f"auto, {1e4 * mean_step:.2f}e-4" for name in colors]
    times = [EVERY * i for i in range(len(runs[AUTO]["velocity"]))]

    d.text(28, 34, "Mean velocity of the slide with several time steps", 16, INK, weight=700)
    plot = Axes(d, (64, 84, 736, 210), (0, 35), (0, 25))
    plot.frame(range(0, 36, 5), range(0, 26, 5), "time, s", "m/s")
    for name in PERTURBED:
        plot.curve(times, speeds(runs[name]), FAINT, 3.0, opacity=0.45)
    for name, color in colors.items():
        plot.curve(times, speeds(runs[name]), color, 1.5)
    plot.curve(times, speeds(paper), INK, 2.0, "6 4")
    entries = [(f"{PAPER} s, the paper's", INK, "6 4", 2)]
    entries += [(f"{name} s", color, None, 2) for name, color in zip(names, colors.values())]
    for i, (name, color, dash, width) in enumerate(entries + [("auto, changed by 0.4 to 0.7 %", FAINT, None, 4)]):
        d.line(590, 100 + 18 * i, 616, 100 + 18 * i, color, width, dash)
        d.text(624, 104 + 18 * i, name, 12, SOFT)

    d.text(28, 376, f"Difference from the run with {PAPER} s, in % of its largest mean velocity", 16, INK, weight=700)
    worst = max(100 * apart(runs[name], paper, UNTIL[-1]) / top for name in list(colors) + list(PERTURBED))
    limit = math.ceil(worst + 0.3)
    plot = Axes(d, (64, 424, 736, 160), (0, 15), (0, limit))
    plot.frame(range(0, 16, 5), range(limit + 1), "time, s", "%")
    last = round(UNTIL[-1] / EVERY) + 1
    for name, color in [(name, FAINT) for name in PERTURBED] + list(colors.items()):
        values = [100 * math.dist(a, b) / top for a, b in zip(runs[name]["velocity"][:last], paper["velocity"])]
        plot.curve(times[:last], values, color, 3.0 if color == FAINT else 1.5, opacity=0.45 if color == FAINT else 1)
    d.line(plot.x(FIRST_BLOCK), plot.top, plot.x(FIRST_BLOCK), plot.top + plot.height, FAINT, 1, "4 4")
    d.text(plot.x(FIRST_BLOCK) - 6, plot.top + 12, "first loose block on the far bank", 11, SOFT, "end")
    d.write(PICTURE)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("talus", nargs="?", help="the program; without it runs in --out are taken")
    parser.add_argument("--out", type=pathlib.Path, help="folder of the runs; without it those kept are taken")
    given = parser.parse_args()
    if given.talus:
        given.out = given.out or pathlib.Path("out/vaiont_steps")
        run(given.talus, given.out)
    if given.out:
        runs = {folder.name: collect(folder) for folder in sorted(given.out.iterdir())
                if folder.name != SETTLES and (folder / "run.json").exists()}
        STORE.write_text(json.dumps(runs, separators=(",", ":")).replace('},"', '},\n"') + "\n", encoding="utf-8")
    runs = json.loads(STORE.read_text(encoding="utf-8"))
    print_tables(runs)
    draw(runs)


if __name__ == "__main__":
    main()
