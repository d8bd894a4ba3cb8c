#!/usr/bin/env python3
"""Runs talus and its peers on the same sliding bodies, one after the other and round after round.

  compare.py                                  504 and 5000 blocks, three rounds, what is installed of the peers
  compare.py --sizes 504 --rounds 5 --json peers.json

Per program: ns of processor time per moving body and step on one thread, the median over the rounds; its ratio to
talus with deformable blocks, one of each two master; its step; and what became of the bodies: their root mean
square speed at the end, and how many pairs of them touch. A program that is not installed is left out.
"""

import argparse
import json
import math
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[i]) for i in (0, 1)]

import bodies as words  # noqa: E402
import sliding  # noqa: E402
from quickest import on_quickest_processor  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[3]
SPAN = {504: 0.2, 5000: 0.04}  # s that are simulated: so long that the first steps, of cold caches, do not count
BOX2D_STEP, LAMMPS_STEP, LAMMPS_WARM_UP = 1e-4, 5e-5, 10  # s, s, steps
ONE_THREAD = dict(os.environ, OMP_NUM_THREADS="1")


def span(blocks):
    return SPAN.get(blocks, 0.2 if blocks < 2000 else 0.04)


def output_of(command, folder):
    done = subprocess.run(command, cwd=folder, env=ONE_THREAD, text=True, capture_output=True)
    if done.returncode != 0:
        sys.exit(f"failed: {' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


class Talus:
    def __init__(self, program, folder, blocks, cover, roles, mass):
        self.name = f"talus, {'deformable' if cover == 'block' else 'rigid'}"
        if roles == "symmetric":
            self.name += ", both roles"
        out = folder / f"{cover}_{roles}_{blocks}"
        self.scene = out.with_suffix(".json")
        self.scene.write_text(sliding.scene(blocks, cover, roles, 1))
        self.command = [program, "run", self.scene, "--threads", "1", "--overwrite", "--out", out]
        self.command += ["--set", f"/time/end={span(blocks)}", "--set", f"/output/history={span(blocks)}"]
        self.folder, self.blocks, self.mass, self.record = folder, blocks, mass, out / "run.json"

    def run(self):
        output_of(self.command, self.folder)
        record = json.loads(self.record.read_text())
        seconds = record["cost"]["stepping"]["cpu [s]"]
        return {
            "ns": seconds * 1e9 / record["steps"] / self.blocks,
            "step": record["dt [s]"],
            "steps": record["steps"],
            "speed": math.sqrt(2 * record["ledger"]["kinetic [J/m]"] / self.mass),
            "note": f"largest overlap {record['largest_penetration [m]']:.2g} m",
        }


class Box2d:
    name = "Box2D"

    def __init__(self, program, folder, blocks, bodies):
        path = folder / f"box2d_{blocks}.txt"
        words.write_box2d(path, bodies)
        self.steps, self.folder = round(span(blocks) / BOX2D_STEP), folder
        friction = math.tan(math.radians(sliding.FRICTION))
        self.command = [program, path, str(self.steps), str(BOX2D_STEP), f"{friction:.9g}"]

    def run(self):
        found = json.loads(output_of(self.command, self.folder))
        return {
            "ns": found["ns"],
            "step": BOX2D_STEP,
            "steps": self.steps,
            "speed": found["speed"],
            "note": f"{found['touching']} of {found['pairs']} pairs touch, {found['awake']} bodies awake, "
            f"none faster than {found['largest_speed']:.3g} m/s",
        }


class Lammps:
    name = "LAMMPS"

    def __init__(self, program, folder, blocks, bodies, mass):
        self.steps, self.folder, self.blocks, self.mass = round(span(blocks) / LAMMPS_STEP), folder, blocks, mass
        data, script = folder / f"lammps_{blocks}.data", folder / f"lammps_{blocks}.in"
        words.write_lammps(data, script, blocks, bodies, self.steps - LAMMPS_WARM_UP, LAMMPS_WARM_UP, LAMMPS_STEP)
        self.command = [program, "-in", script, "-log", "none"]

    def run(self):
        text = output_of(self.command, self.folder)
        loops = re.findall(r"Loop time of (\S+) on 1 procs for (\d+) steps", text)
        busy = re.findall(r"([\d.]+)% CPU use", text)  # of the loop: others may have had the processor meanwhile
        last = re.findall(r"^ +(\d+) +\d+ +(\S+) +(\S+) *$", text, re.MULTILINE)[-1]
        pairs = re.findall(r"Total # of neighbors = (\d+)", text)
        builds = re.findall(r"Neighbor list builds = (\d+)", text)
        seconds, steps = float(loops[-1][0]) * float(busy[-1]) / 100, int(loops[-1][1])
        return {
            "ns": seconds * 1e9 / steps / self.blocks,
            "step": LAMMPS_STEP,
            "steps": self.steps,
            "speed": math.sqrt(2 * float(last[1]) / self.mass),
            "note": f"{pairs[-1]} pairs in the list, built {builds[-1]} times, {float(last[2]):.3g} J/m in contacts",
        }


def programs(arguments, folder, blocks):
    bodies = sliding.bodies(blocks)
    moving = [outline for _, outline, velocity, _ in bodies if velocity is not None]
    mass = sliding.DENSITY * sum(words.area_and_centre(outline)[0] for outline in moving)
    ways = [("block", "priority"), ("block", "symmetric"), ("rigid", "priority")]
    found = [Talus(arguments.talus, folder, blocks, cover, roles, mass) for cover, roles in ways]
    if pathlib.Path(arguments.box2d).exists():
        found.append(Box2d(arguments.box2d, folder, blocks, bodies))
    if shutil.which(arguments.lammps):
        found.append(Lammps(arguments.lammps, folder, blocks, bodies, mass))
    return found


def one_round(rivals):
    with on_quickest_processor(lambda: rivals[0].run()["ns"]):
        return [rival.run() for rival in rivals]


def compare(arguments, blocks):
    """{name: what was found}; "ns" is the median over the rounds, "all" has them all."""
    with tempfile.TemporaryDirectory() as folder:
        rivals = programs(arguments, pathlib.Path(folder), blocks)
        rounds = [one_round(rivals) for _ in range(arguments.rounds)]
    result = {}
    for rival, runs in zip(rivals, zip(*rounds)):
        times = [run["ns"] for run in runs]
        # Each round by itself: what slows the machine for a while slows all programs of a round.
        ratios = [run["ns"] / own[0]["ns"] for run, own in zip(runs, rounds)]
        medians = {"ns": statistics.median(times), "ratio": statistics.median(ratios), "all": times}
        result[rival.name] = {**runs[-1], **medians}
    return result


def program_at(path):
    return pathlib.Path(path).resolve()  # programs run in folders of their own


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", default="504,5000", help="numbers of blocks")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--talus", default=ROOT / "build/release/bin/talus", type=program_at)
    parser.add_argument("--box2d", default=ROOT / "build/release/bin/peer_box2d", type=pathlib.Path)
    parser.add_argument("--lammps", default="lmp")
    parser.add_argument("--json", type=pathlib.Path, help="write what was found here, too")
    arguments = parser.parse_args()
    found = {}
    for blocks in map(int, arguments.sizes.split(",")):
        found[blocks] = compare(arguments, blocks)
        print(f"{blocks} sliding blocks, {span(blocks)} s, {arguments.rounds} rounds")
        for name, run in found[blocks].items():
            print(
                f"  {name:30} {run['ns']:9.0f} ns  {run['ratio']:6.2f}  step {run['step']:.3g} s"
                f"  speed {run['speed']:.4f} m/s  {run['note']}",
                flush=True,
            )
    if arguments.json:
        arguments.json.write_text(json.dumps(found, indent=1) + "\n")


if __name__ == "__main__":
    main()
