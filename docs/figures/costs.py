#!/usr/bin/env python3
"""Counts the instructions of a step with each feature off and on, and writes the tables of docs/costs.md.

    python3 docs/figures/costs.py [--talus build/release/bin/talus] [case ...]

Needs Python 3 and valgrind; takes some ten minutes. A count is the difference of two runs of which one takes more
steps, over their number: what comes before the first step and after the last one drops out. Memory is the largest resident set of
a larger scene, outside of valgrind. Without names of cases the tables of the page are written anew.
"""
import argparse
import copy
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from tables import ROOT, put_table

PAGE = ROOT / "docs/costs.md"
DT = 2e-5  # s
BEFORE = 100  # steps of the shorter run
ROCK = {"density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0.25}
INTERFACE = {"between": ["*", "*"], "normal_stiffness": 1e10, "tangential_stiffness": 1e10, "friction_angle": 30,
             "normal_damping": 0.3, "tangential_damping": 0.3}


def box(name, left, bottom, width, height, **more):
    right, top = left + width, bottom + height
    return {"name": name, "material": "rock", "polygon": [[left, bottom], [right, bottom], [right, top], [left, top]], **more}


def scene(bodies, **more):
    return {"talus": 1, "gravity": [0, -10], "materials": {"rock": ROCK}, "cover": {"model": "block"},
            "contact": {"model": "overlap_area"}, "interfaces": [INTERFACE], "bodies": bodies, **more}


def wall(columns=5, rows=6, **more):
    """Bricks in running bond on a fixed floor, at rest: so all contacts are there whatever is varied."""
    domain = [[0, 0], [columns, 0], [columns, rows / 2], [0, rows / 2]]
    return scene([box("floor", -1, -1, columns + 2, 1, fixed=True)],
                 settle={"duration": 1000 * DT, "damping": 2000},
                 blocks=[{"name": "wall", "domain": domain, "material": "rock", "bricks": {"width": 1, "height": 0.5}}], **more)


def lattice(**more):
    """A body of some 1000 elements that stands on a floor."""
    return scene([box("floor", -1, -1, 6, 1, fixed=True),
                  box("body", 0, 0, 4, 4, cover={"model": "hexagonal", "size": 0.2}, **more)])


def changed(base, **changes):
    """A copy with members replaced; a name with dots leads down."""
    result = copy.deepcopy(base)
    for name, value in changes.items():
        at = result
        *way, last = name.split("__")
        for part in way:
            at = at[int(part)] if part.isdigit() else at.setdefault(part, {})
        at[int(last) if last.isdigit() else last] = value
    return result


def worded(difference, share, noise, unit):
    """"none" for a difference that cannot be told from none."""
    return "none" if abs(difference) < noise else f"{share:,.1f} per {unit}" if abs(share) < 10 else f"{share:,.0f} per {unit}"


class Counter:
    def __init__(self, talus, folder):
        self.talus, self.folder = talus, folder

    def words(self, given, steps, words):
        end = steps * DT
        shutil.rmtree(self.folder / "out", ignore_errors=True)  # to clear it would count
        made = copy.deepcopy(given)
        made["time"] = {"end": end, "dt": DT}
        made.setdefault("output", {}).setdefault("history", end)
        path = self.folder / "scene.json"
        path.write_text(json.dumps(made))
        return [self.talus, "run", str(path), "--quiet", "--no-report", "--overwrite", "--simd", "avx2",
                "--out", str(self.folder / "out"), *words]

    def instructions(self, given, steps, words):
        profile = self.folder / "callgrind.out"
        done = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={profile}",
                               *self.words(given, steps, words)], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(done.stderr)
        return int(re.search(r"Collected : (\d+)", done.stderr).group(1))

    def per_step(self, given, words=()):
        # What is written at the end, and how often the state is remembered, differs by some 100,000 instructions.
        more = 1000 if "blocks" in given else 500 if "cover" in given["bodies"][-1] else 10000
        few, many = (self.instructions(given, BEFORE + steps, words) for steps in (0, more))
        return (many - few) / more

    def memory(self, given):
        """Largest resident set, bytes: the least of three runs."""
        least = float("inf")
        for _ in range(3):
            child = os.posix_spawn(self.talus, self.words(given, 10, ()), os.environ)
            _, status, usage = os.wait4(child, 0)
            if status != 0:
                sys.exit("a run failed")
            least = min(least, 1024 * usage.ru_maxrss)
        return least


def cases():
    """Name, what is off, what is on, per how many of what: (word, scene, words of the command)."""
    block, bricks = scene([box("block", 0, 0, 1, 1)]), wall()
    per_brick = (33, "brick")
    resting = scene([box("floor", -1, -1, 3, 1, fixed=True), box("block", 0, 0, 1, 1)], settle={"duration": 1000 * DT, "damping": 2000})
    free = changed(block)
    del free["contact"], free["interfaces"]
    fixed = [box(f"fixed{i}", 20 + 2 * i, 0, 1, 1, fixed=True) for i in range(1000)]
    cut = [{"points": [[1, 2.03], [3, 2.03]]}]
    monitors = [{"name": f"m{i}", "body": "block"} for i in range(10)]
    rows = changed(block, output={"history": 10 * DT})
    calm = {"speed": 1e-300, "after": 1}
    at_once = {"speed": 1e3, "acceleration": 1e6, "after": 2 * DT}
    load = [{"body": "block", "point": [0.5, 0.5], "force": [0, 0]}]
    shaking = [{"scale": 1, "time": [[0, 0], [1, 1]]}, 0]
    stage = [{"name": "second", "from": DT, "set": {"/gravity": [0, -10]}}]
    return [
        ("deformation", ("`rigid`", changed(block, cover={"model": "rigid"})), ("`block`", block), (1, "block")),
        ("friction", ("0, `overlap_area`", changed(resting, interfaces__0__friction_angle=0)), ("30°", resting), (1, "contact")),
        ("friction, another law", ("`frictionless`", changed(resting, contact={"model": "frictionless"})), ("`overlap_area`, 30°", resting),
         (1, "contact")),
        ("contact damping", ("0", changed(resting, interfaces__0__normal_damping=0, interfaces__0__tangential_damping=0)),
         ("0.3 of critical", resting), (1, "contact")),
        ("global damping", ("none", block), ("50 /s", changed(block, damping=50)), (1, "block")),
        ("adaptive damping", ("none", block), ("`adaptive`", changed(block, damping="adaptive")), (1, "block")),
        ("contact section, one free block", ("none", free), ("`overlap_area`", block), (1, "step")),
        ("fixed bodies", ("none", block), ("1000 far away", changed(block, bodies=block["bodies"] + fixed)), (1000, "fixed body")),
        ("monitors, between output times", ("none", block), ("10", changed(block, monitors=monitors)), (1, "step")),
        ("monitors, every 10 steps", ("none", rows), ("10", changed(rows, monitors=monitors)), (0.1, "row")),
        ("history and ledger, every 10 steps", ("one row", block), ("a row", rows), (0.1, "row")),
        ("frames, every 10 steps", ("none", rows), ("a frame", changed(rows, output__frames=10 * DT)), (0.1, "frame")),
        ("checkpoints", ("none", block), ("`--checkpoint-every 1e6`", block, ("--checkpoint-every", "1e6")), (1, "step")),
        ("profile", ("none", block), ("`--profile`", block, ("--profile",)), (1, "step")),
        ("stages", ("none", block), ("one, after a step", changed(block, stages=stage)), (1, "step")),
        ("motion of the ground", ("none", block), ("a function", changed(block, base_acceleration=shaking)), (1, "step")),
        ("loads", ("none", block), ("one point load", changed(block, loads=load)), (1, "step")),
        ("sleep, nothing sleeps", ("none", bricks), ("`sleep`", changed(bricks, sleep=calm)), per_brick),
        ("sleep, all sleep", ("none", bricks), ("`sleep`", changed(bricks, sleep=at_once)), per_brick),
        ("discontinuities", ("none", lattice()), ("one, 2 m", lattice(discontinuities=cut)), (1, "step")),
        ("self-contact", ("none", lattice()), ("`self_contact`", lattice(self_contact=True)), (1, "step")),
    ]


def memory_cases():
    big, count = changed(wall(50, 40), settle={"duration": 10 * DT, "damping": 2000}), 2020
    monitors = [{"name": f"m{i}", "body": f"wall_{i}"} for i in range(1, 101)]
    yield "deformation", changed(big, cover={"model": "rigid"}), big, count, "brick"
    yield "friction", changed(big, contact={"model": "frictionless"}), big, count, "brick"
    yield "global damping", big, changed(big, damping=50), count, "brick"
    yield "adaptive damping", big, changed(big, damping="adaptive"), count, "brick"
    yield "monitors", big, changed(big, monitors=monitors), 100, "monitor"
    yield "frames", big, changed(big, output={"frames": 10 * DT, "history": 10 * DT}), count, "brick"
    yield "sleep", big, changed(big, sleep={"speed": 1e-300, "after": 1}), count, "brick"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--talus", default=str(ROOT / "build/release/bin/talus"))
    parser.add_argument("cases", nargs="*")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        counter = Counter(given.talus, pathlib.Path(folder))
        known, table = {}, []
        for name, off, on, (share, unit) in cases():
            if given.cases and name not in given.cases:
                continue
            counts = []
            for _, made, *words in (off, on):
                key = json.dumps([made, words])
                if key not in known:
                    known[key] = counter.per_step(made, *words)
                counts.append(known[key])
            more = (counts[1] - counts[0]) / share
            table.append([name, off[0], on[0], f"{counts[0]:,.0f}", f"{counts[1]:,.0f}", worded(counts[1] - counts[0], more, 2, unit)])
            print(" | ".join(table[-1]), flush=True)
        if given.cases:
            return
        put_table(PAGE, "instructions", ["feature", "off", "on", "instructions per step, off", "on", "difference"], table)
        table = []
        for name, off, on, count, unit in memory_cases():
            sizes = [counter.memory(each) for each in (off, on)]
            table.append([name, f"{sizes[0] / 1e6:.1f}", f"{sizes[1] / 1e6:.1f}", worded(sizes[1] - sizes[0], (sizes[1] - sizes[0]) / count, 4e5, unit)])
            print(" | ".join(table[-1]), flush=True)
        put_table(PAGE, "memory", ["feature", "off [MB]", "on [MB]", "bytes"], table)


if __name__ == "__main__":
    main()
