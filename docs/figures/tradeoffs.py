#!/usr/bin/env python3
"""Makes all studies of docs/tradeoffs.md with the program and writes its tables and pictures anew.

    python3 docs/figures/tradeoffs.py [--talus build/release/bin/talus] [--out out/tradeoffs] [section ...]

Needs Python 3 alone; takes some five minutes, less where --out holds the runs of an earlier call. The pictures of
docs/figures/tradeoffs are the study.svg that the program wrote.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import time

from tables import ROOT, put, put_table

PAGE, PICTURES = ROOT / "docs/tradeoffs.md", ROOT / "docs/figures/tradeoffs"
REFERENCE = "scenes/reference/incline_overlap_area.csv"
QUIET = ["--set", "/output/frames=null"]
ONCE = ["--threads", "1"]


def from_scenes(path):
    return os.path.relpath(ROOT / path, ROOT / "scenes")


def last_row(folder):
    with open(folder / "history.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return {name.split(" [")[0]: float(value) for name, value in zip(rows[0], rows[-1])}


def record(folder):
    return json.loads((folder / "run.json").read_text(encoding="utf-8"))


def percent(value):
    return "–" if value is None else f"{100 * value:.2g} %"


def significant(value, digits=3):
    return f"{value:.{digits}g}"


class Studies:
    def __init__(self, talus, out):
        self.talus, self.out = talus, out

    def study(self, name, words, repeat=5):
        """Makes a study and puts its command and picture on the page; its runs, and the folder."""
        words = [*words, *ONCE] + (["--repeat", str(repeat)] if repeat > 1 else [])
        shown = " ".join(f"'{w}'" if any(c in w for c in '{}[]"* ') else w for w in words)
        shown = shown.replace(from_scenes(self.out), "../out/tradeoffs")  # as with the --out that is shown
        folder = self.out / name
        done = subprocess.run([self.talus, "study", *words, "--quiet", "--out", str(folder)], cwd=ROOT, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"talus study {shown}\n{done.stderr}")
        print(done.stdout, flush=True)
        study = json.loads((folder / "study.json").read_text(encoding="utf-8"))
        PICTURES.mkdir(exist_ok=True)
        shutil.copy(folder / "study.svg", PICTURES / f"{name}.svg")
        put(PAGE, f"{name} command", f"```\n$ talus study {shown} --out out/tradeoffs/{name}\n```\n\n"
                                     f"![Error against cost](figures/tradeoffs/{name}.svg)\n")
        return study, folder

    def table(self, name, study, folder, more=()):
        """A row per run; `more` are heads and functions of a run's folder."""
        heads = [f"`{pointer}`" for pointer in study["varied"]]
        heads += ["error", "CPU [s]", "Δt [s]", "residual", "overlap [m]", *(head for head, _ in more)]
        rows = []
        for run in study["runs"]:
            values = [f"`{value}`" for value in run["values"]]
            if run["end"] != "finished":
                rows.append([*values, run["end"] + ": " + run["trouble"].split(";")[0].split(" at t =")[0]] + [""] * (4 + len(more)))
                continue
            error = "reference" if study["reference"] == run["folder"] else percent(run["error [-]"])
            figures = [error, significant(run["cpu [s]"]), significant(run["dt [s]"]), percent(run["residual [-]"]),
                       significant(run["penetration [m]"])]
            rows.append(values + figures + [of(folder / run["folder"]) for _, of in more])
        put_table(PAGE, name, heads, rows)


def bounce(studies):
    """The share of the contact's critical step against what a bounce gains or loses, worst of the phases in a bin."""
    mass, stiffness = 2800, 2e8  # kg/m, Pa/m: squares of 1 m that meet on a side
    critical = 2 * math.sqrt(mass / (2 * stiffness))
    study, folder = studies.study("bounce", [
        "scenes/collision.json", "--metric", "B.speed", "--vary", "/time/dt=1e-5:3e-3", "--sample", "60",
        "--reference", "scenes/reference/collision_rigid.csv", "--set", "/cover/model=rigid", "--set", "/output/history=0.5",
        "--set", "/limits/energy_residual=1", *QUIET], repeat=3)
    runs = []
    for run in study["runs"]:
        if run["end"] == "finished":
            row, whole = last_row(folder / run["folder"]), record(folder / run["folder"])
            runs.append((whole["dt [s]"] / critical, abs((row["B.vx"] - row["A.vx"]) / 0.5 - 1),
                         run["error [-]"], run["residual [-]"], whole["steps"]))
    rows, edges = [], [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.6]
    for low, high in zip(edges, edges[1:]):
        inside = [run for run in runs if low <= run[0] < high]
        if inside:
            worst = [max(run[i] for run in inside) for i in (1, 2, 3)]
            rows.append([f"{low:g} to {high:g}", len(inside), *map(percent, worst), f"{min(r[4] for r in inside):,}"])
    beyond = [run for run in study["runs"] if run["end"] != "finished"]
    if beyond:
        rows.append(["above 1", len(beyond), "stopped", "", "", ""])
    put_table(PAGE, "bounce", ["Δt over the critical", "runs", "restitution off by", "velocity off by (RMS)", "residual", "steps"], rows)


def stiffness(studies):
    study, folder = studies.study("stiffness", [
        "scenes/column.json", "--metric", "block.uy", "--vary", "/interfaces/0/normal_stiffness=1e8,1e9,1e10,1e11,1e12",
        "--set", '/damping="adaptive"', "--set", "/time/end=2"], repeat=3)
    studies.table("stiffness", study, folder, [("the top sinks by [m]", lambda run: significant(-last_row(run)["block.uy"], 4))])


def laws(studies):
    study, folder = studies.study("laws", [
        "scenes/collision.json", "--metric", "B.speed", "--vary",
        "/contact/model=frictionless,overlap_area,vertex_edge,feng_volume,potential_symmetric", "--vary",
        "/time/dt=4e-4,2e-4,1e-4,5e-5,2.5e-5", "--reference", "scenes/reference/collision_rigid.csv", "--set", "/cover/model=rigid",
        "--set", "/output/history=0.5", "--set", "/limits/energy_residual=1", *QUIET])
    studies.table("laws", study, folder)
    study, folder = studies.study("laws_friction", [
        "scenes/incline.json", "--vary", "/contact/model=overlap_area,cohesive_overlap,vertex_edge", "--vary", "/time/dt=1.2e-4,6e-5,3e-5",
        "--reference", REFERENCE, *QUIET])
    studies.table("laws_friction", study, folder, [("v(end) [m/s]", lambda run: significant(last_row(run)["block.speed"], 2))])


def covers(studies):
    mesh = studies.out / "block.msh"
    made = subprocess.run([sys.executable, "scenes/generate/mesh.py", "--size", "2", "1", "--divisions", "4", "2", "--corner",
                           "-8.005423651204648", "4.6219335", "--angle", "-30"], cwd=ROOT, capture_output=True, text=True, check=True)
    (ROOT / mesh).write_text(made.stdout, encoding="utf-8")
    body = json.dumps({"name": "block", "material": "rock", "mesh": from_scenes(mesh)})
    covers = [{"model": "rigid"}, {"model": "block"}, {"model": "mesh"}] + [{"model": "hexagonal", "size": s} for s in (0.4, 0.25)]
    study, folder = studies.study("covers", [
        "scenes/incline.json", "--vary", "/cover=" + ",".join(json.dumps(c, separators=(",", ":")) for c in covers),
        "--reference", REFERENCE, "--set", f"/bodies/1={body}", "--set", "/materials/rock/damping_time=1e-5", "--set", "/time/end=3", *QUIET], repeat=3)
    studies.table("covers", study, folder, [("elements", lambda run: record(run)["elements"])])


def bending(studies):
    study, folder = studies.study("bending", [
        "scenes/cantilever.json", "--metric", "tip.y", "--vary", "/cover/size=0.25,0.176777,0.125,0.0883883"], repeat=1)
    off = lambda run: percent(abs(last_row(run)["tip.y"] / 3.7766e-4 - 1))
    studies.table("bending", study, folder, [("off the theory by", off), ("elements", lambda run: record(run)["elements"])])


def slivers(studies):
    study, folder = studies.study("slivers", [
        "scenes/cantilever.json", "--metric", "tip.y", "--vary", "/cover/slivers=merge,mass_scale,keep"], repeat=1)
    off = lambda run: percent(abs(last_row(run)["tip.y"] / 3.7766e-4 - 1))
    studies.table("slivers", study, folder, [("off the theory by", off), ("steps to settle", lambda run: f"{record(run)['settle_steps']:,}")])


STEPPED = ([f"mesh of 0.2 m, ν = {nu}" for nu in (0, 0.25, 0.45)] + [f"whole lattice of 0.25 m, ν = {nu}" for nu in (0, 0.25, 0.45)]
           + [f"lattice of 0.25 m cut 1/{share} of a row above vertices, ν = 0.25" for share in ("100", "10,000")])


def lumped(studies):
    """Row sums against the consistent mass, from the reference cases."""
    file = ROOT / studies.out / "mass.json"
    done = subprocess.run([studies.talus, "verify", "mass", "--json", str(file)], cwd=ROOT, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stdout + done.stderr)
    cases = {case["name"]: [row["value"] for row in case["rows"]] for case in json.loads(file.read_text(encoding="utf-8"))["cases"]}
    shown = lambda value: f"{value:+.2g} %"
    rows = []
    for i, size in enumerate((0.5, 0.25, 0.125)):
        modes = [cases["frequencies"][9 * i + 3 * mode:9 * i + 3 * mode + 2] for mode in range(3)]
        rows.append([size, *(shown(value) for mode in modes for value in mode)])
    heads = [f"mode {mode}: {mass}" for mode in (1, 2, 3) for mass in ("row sums", "consistent")]
    put_table(PAGE, "lumped frequencies", ["size [m]", *heads], rows)
    found = iter(cases["step"] + cases["cut"][2:])
    rows = [[what, *(significant(next(found)) for _ in range(3))] for what in STEPPED]
    put_table(PAGE, "lumped step", ["body", "row sums [s]", "consistent [s]", "quotient"], rows)


def strain_mass(studies):
    covers = [{"model": "block"}] + [{"model": "block", "strain_mass_scale": s} for s in (4, 16, 64, 256)] + [{"model": "rigid"}]
    vary = ["--vary", "/cover=" + ",".join(json.dumps(c, separators=(",", ":")) for c in covers), *QUIET]
    sunk = lambda run: significant(-last_row(run)["block.uy"], 4)
    soft = [w for key in ("normal", "tangential") for w in ("--set", f"/interfaces/0/{key}_stiffness=5e8")]
    for name, joints in (("strain_mass_stiff", []), ("strain_mass_soft", soft)):
        study, folder = studies.study(name, [
            "scenes/brick_wall.json", "--metric", "block.uy", *vary, "--set", "/time/end=0.2", *joints], repeat=3)
        studies.table(name, study, folder, [("the top sinks by [m]", sunk)])
    study, folder = studies.study("strain_mass_impact", [
        "scenes/collision.json", "--metric", "B.speed", *vary, "--set", "/time/dt=1e-5", "--set", "/output/history=0.5"], repeat=3)
    bounce_off = lambda run: percent(1 - (last_row(run)["B.vx"] - last_row(run)["A.vx"]) / 0.5)
    critical = lambda run: significant(record(run)["critical_dt [s]"])
    studies.table("strain_mass_impact", study, folder, [("critical Δt [s]", critical), ("restitution short by", bounce_off)])


def vote(studies):
    study, folder = studies.study("vote", [
        "scenes/incline.json", "--vary", '/time/dt="auto",3e-5,6e-5,9e-5,1.2e-4,1.5e-4,1.8e-4', "--reference", REFERENCE, *QUIET])
    studies.table("vote", study, folder, [("of critical", lambda run: significant(record(run)["dt [s]"] / record(run)["critical_dt [s]"], 2))])


def in_turn(studies, rounds, choices):
    """Runs of the program in turn; for each choice the records of its rounds, and the bytes of its folder."""
    found = {name: ([], 0) for name, _ in choices}
    for number in range(rounds):
        for name, words in choices:
            folder = studies.out / "turns" / f"{name}_{number}".replace(" ", "_")
            done = subprocess.run([studies.talus, "run", *words, "--quiet", "--no-report", "--overwrite", "--out", str(folder)],
                                  cwd=ROOT, capture_output=True, text=True)
            if done.returncode != 0:
                sys.exit(done.stderr)
            records, _ = found[name]
            records.append(record(ROOT / folder))
            size = sum(f.stat().st_size for f in (ROOT / folder).rglob("*") if f.is_file())
            found[name] = (records, size)
            shutil.rmtree(ROOT / folder)
    return found


def median_ratio(records, base, of):
    return statistics.median(of(r) / of(b) for r, b in zip(records, base))


def threads(studies):
    rows, folder = [], ROOT / studies.out
    scene = studies.out / "pile.json"
    made = subprocess.run([sys.executable, "scenes/generate/pile.py", "--blocks", "5000"], cwd=ROOT, capture_output=True, text=True, check=True)
    (folder / "pile.json").write_text(made.stdout, encoding="utf-8")
    for what, words in (("`incline`, 1 block", ["scenes/incline.json", "--set", "/time/end=3", *QUIET]),
                        ("`brick_wall`, 410 blocks", ["scenes/brick_wall.json", "--set", "/time/end=0.1", *QUIET]),
                        ("`pile.py --blocks 5000`", [str(scene), "--set", "/time/end=0.01", "--set", "/output/history=0.01"])):
        found = in_turn(studies, 5, [("one", words), ("two", [*words, "--threads", "2"])])
        (one, _), (two, _) = found["one"], found["two"]
        same = all(a["state_hash"] == b["state_hash"] for a, b in zip(one, two))
        wall = median_ratio(two, one, lambda r: r["cost"]["stepping"]["wall [s]"])
        cpu = median_ratio(two, one, lambda r: r["cost"]["stepping"]["cpu [s]"])
        rows.append([what, f"{wall:.2f}", f"{cpu:.2f}", "same" if same else "differ"])
    put_table(PAGE, "threads", ["scene", "time on the clock, two threads over one", "processor time, two over one", "state"], rows)


def output(studies):
    base = ["scenes/brick_wall.json", "--set", "/time/end=0.1"]
    choices = [("a row per 0.1 s", '{"history": 0.1}'), ("a row per 1 ms", '{"history": 0.001}'),
               ("a row per 0.1 ms", '{"history": 0.0001}'), ("a row per 0.05 ms", '{"history": 0.00005}'),
               ("a frame per 10 ms", '{"history": 0.001, "frames": 0.01}'), ("a frame per 1 ms", '{"history": 0.001, "frames": 0.001}')]
    found = in_turn(studies, 3, [(name, [*base, "--set", f"/output={value}"]) for name, value in choices])
    first = found[choices[0][0]][0]
    rows = []
    for name, (records, size) in found.items():
        writing = statistics.median(r["cost"]["writing"]["cpu [s]"] / r["cost"]["stepping"]["cpu [s]"] for r in records)
        stepping = median_ratio(records, first, lambda r: r["cost"]["stepping"]["cpu [s]"])
        rows.append([name, f"{records[0]['dt [s]']:.3g}", f"{records[0]['steps']:,}", f"{stepping:.2f}", percent(writing), f"{size / 1e6:.2f}"])
    put_table(PAGE, "output", ["output", "Δt [s]", "steps", "time in the steps, over the first", "writing over stepping", "MB"], rows)


def mass(studies):
    for part in (lumped, strain_mass, slivers):
        part(studies)


SECTIONS = {s.__name__: s for s in (bounce, stiffness, laws, covers, bending, mass, vote, threads, output)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--talus", default=str(ROOT / "build/release/bin/talus"))
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/tradeoffs"), help="within the folder of the sources")
    parser.add_argument("sections", nargs="*", metavar="section", help=", ".join(SECTIONS))
    given = parser.parse_args()
    (ROOT / given.out).mkdir(parents=True, exist_ok=True)
    studies = Studies(given.talus, given.out)
    start, load = time.time(), os.getloadavg()[0]
    for name in given.sections or SECTIONS:
        print(f"-- {name}", flush=True)
        SECTIONS[name](studies)
    if not given.sections:
        whole = record(ROOT / given.out / "bounce" / "run_0001")
        put(PAGE, "machine", f"{whole['machine']['processor']}, {whole['machine']['cores']} cores; load average {load:.1f} at the start and "
                             f"{os.getloadavg()[0]:.1f} at the end.\n")
    print(f"{time.time() - start:.0f} s")


if __name__ == "__main__":
    main()
