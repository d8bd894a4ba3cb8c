#!/usr/bin/env python3
"""Measures with the program every figure of docs/verification.md that comes out of runs.

    python3 docs/figures/measure.py [--talus build/release/bin/talus] [case ...]

Needs Python 3 alone. Prints a line per figure: what, measured, wanted. Ends with 1 if one is out of its bounds.
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ROOT / "scenes"
COS, SIN = math.cos(math.radians(30)), math.sin(math.radians(30))
TOE_AT_START = -7.243867  # m along the slope from B
BRAKING = 1.839457  # m/s2, on BC

missed = []


def report(what, measured, wanted, held=None):
    mark = "" if held is None else ("  ok" if held else "  MISSED")
    if held is False:
        missed.append(what)
    print(f"  {what:<58} {measured:<22} {wanted}{mark}", flush=True)


class Program:
    def __init__(self, path, folder):
        self.path, self.folder, self.count = path, folder, 0

    def run(self, scene, *overrides, options=()):
        """Runs a scene; its history as {column: values} and its run.json."""
        self.count += 1
        out = self.folder / f"run{self.count}"
        words = [self.path, "run", str(scene), "--quiet", "--out", str(out), *options]
        for override in overrides:
            words += ["--set", override]
        done = subprocess.run(words, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(words)}\nended with {done.returncode}: {done.stderr}")
        return read_history(out / "history.csv"), json.loads((out / "run.json").read_text())


def read_history(path):
    with open(path, newline="") as file:
        rows = csv.reader(file)
        names = [name.split(" [")[0] for name in next(rows)]
        columns = list(zip(*[[float(value) for value in row] for row in rows]))
    return dict(zip(names, columns))


def at(history, column, time):
    index = min(range(len(history["t"])), key=lambda i: abs(history["t"][i] - time))
    return history[column][index]


def moved(history, begin, end):
    """Largest distance of the block between two times from where it is at the first of them."""
    inside = [i for i, t in enumerate(history["t"]) if begin - 1e-9 <= t <= end + 1e-9]
    x, y = history["block.ux"], history["block.uy"]
    return max(math.hypot(x[i] - x[inside[0]], y[i] - y[inside[0]]) for i in inside)


def within(value, reference, share):
    return abs(value - reference) <= share * abs(reference)


def incline(program):
    speeds = {}
    for law, v295, stop in (("overlap_area", 5.278582, 5.869491), ("vertex_edge", 5.085557, 5.881320)):
        history, _ = program.run(SCENES / "incline.json", f"/contact/model={law}", "/output/history=0.001")
        speed, time = history["block.speed"], history["t"]
        speeds[law] = at(history, "block.speed", 2.95)
        report(f"{law}: v(2.95 s) [m/s]", f"{speeds[law]:.6f}", f"{v295} +- 0.2 %", within(speeds[law], v295, 2e-3))
        peak = max(range(len(speed)), key=speed.__getitem__)
        wanted_peak = 5.285220 if law == "overlap_area" else 5.174191
        report(f"{law}: peak [m/s] at [s]", f"{speed[peak]:.6f} at {time[peak]:.3f}", f"{wanted_peak} +- 0.2 %",
               within(speed[peak], wanted_peak, 2e-3))
        last = max(i for i, v in enumerate(speed) if v > 0.01)
        stopped = time[last] + speed[last] / BRAKING
        report(f"{law}: stop [s]", f"{stopped:.5f}", f"{stop} +- 0.3 %", within(stopped, stop, 3e-3))
        toe = TOE_AT_START + at(history, "block.ux", 5.9) * COS - at(history, "block.uy", 5.9) * SIN
        if law == "overlap_area":
            report(f"{law}: toe past B [m]", f"{toe:.5f}", "8.623 +- 0.3 %", within(toe, 8.623, 3e-3))
        drift = moved(history, 5.9, 10)
        report(f"{law}: drift 5.9 to 10 s [m]", f"{drift:.2e}", "< 1e-6", drift < 1e-6)
    part = speeds["overlap_area"] - speeds["vertex_edge"]
    report("the laws part at 2.95 s by [m/s]", f"{part:.6f}", "0.193 +- 0.01", abs(part - 0.193) <= 0.01)


def creep_of_paper_rule(program):
    common = ("/contact/overlap_area/friction_rule=paper", "/cover/model=rigid", '/bodies/1/fix=["rotation"]')
    for dt in ("1e-5", "2e-5", "1e-4"):
        history, _ = program.run(SCENES / "incline.json", *common, f"/time/dt={dt}")
        speed = moved(history, 6, 10) / 4
        report(f"paper rule, dt {dt} s: creep [m/s]", f"{speed:.3e}", "1.363e-3 +- 10 %", within(speed, 1.363e-3, 0.1))


def stick(program):
    for law in ("overlap_area", "vertex_edge"):
        history, _ = program.run(SCENES / "stick_31deg.json", f"/contact/model={law}")
        motion = max(history["block.displacement"])
        report(f"{law}: motion in 3 s [m]", f"{motion:.2e}", "< 1e-6", motion < 1e-6)
        history, _ = program.run(SCENES / "stick_31deg.json", f"/contact/model={law}", "/settle/duration=1e-6",
                                 "/interfaces/0/normal_damping=0", "/interfaces/0/tangential_damping=0")
        report(f"{law}: undamped, unsettled, motion in 3 s [m]", f"{history['block.displacement'][-1]:.4f}", "creeps")
        creep = (history["block.displacement"][-1] - at(history, "block.displacement", 2)) / (3 - 2)
        report(f"{law}: undamped, unsettled, mean speed 2 to 3 s [m/s]", f"{creep:.4f}", "creeps")


def incline_paper(program):
    for law in ("overlap_area", "vertex_edge"):
        history, _ = program.run(SCENES / "incline_paper.json", f"/contact/model={law}")
        near = [v for t, v in zip(history["t"], history["block.speed"]) if 2.9 <= t <= 3.0]
        report(f"{law}: v(2.95 s) [m/s]", f"{at(history, 'block.speed', 2.95):.4f}", "no tolerance")
        report(f"{law}: v, 2.9 to 3.0 s, least and most [m/s]", f"{min(near):.3f} to {max(near):.3f}", "no tolerance")
        report(f"{law}: mean speed 6 to 7 s [m/s]", f"{moved(history, 6, 7):.4f}", "creeps")


def collision(program):
    faces = ('/monitors=[{"name": "A", "body": "A"}, {"name": "B", "body": "B"},'
             ' {"name": "front", "body": "A", "point": [1, 0.5]}, {"name": "back", "body": "B", "point": [1.5, 0.5]}]')
    history, record = program.run(SCENES / "collision.json")
    v_b = history["B.vx"][-1]
    after = [v for t, v in zip(history["t"], history["B.vx"]) if t > 1.1]
    report("v_B at the end [m/s]", f"{v_b:.6f}", "0.4990 to 0.5000", 0.4990 <= v_b <= 0.5)
    report("v_B after the impact, mean [m/s]", f"{sum(after) / len(after):.6f}", "0.49986")
    error = max(abs(a + b - 0.5) for a, b in zip(history["A.vx"], history["B.vx"])) / 0.5
    report("x-momentum, largest error over m v0", f"{error:.1e}", "1e-12", error < 1e-12)
    depth = record["largest_penetration [m]"]
    report("largest overlap [m]", f"{depth:.4e}", "1.27e-3 to 1.33e-3", 1.27e-3 <= depth <= 1.33e-3)
    dt = 1e-5
    history, _ = program.run(SCENES / "collision.json", f"/time/dt={dt}", f"/output/history={dt}", "/time/end=1.2",
                             "/output/frames=0.4", faces)
    touching = [t for t, a, b in zip(history["t"], history["front.ux"], history["back.ux"]) if 0.5 + b - a < 0]
    end = touching[0]
    for t in touching:
        end = t if t - end < 3 * dt else end
    lasts = end - touching[0]
    report("contact lasts [s]", f"{lasts:.4e}", "8.2e-3 to 8.7e-3", 8.2e-3 <= lasts <= 8.7e-3)
    largest = [largest_residual(program, dt) for dt in (1e-4, 5e-5, 2.5e-5)]
    report("largest energy residual, worst phase, dt 1e-4 s", f"{largest[0]:.2e}", "< 3e-4", largest[0] < 3e-4)
    orders = [math.log2(a / b) for a, b in zip(largest, largest[1:])]
    report("order of the residual, dt 1e-4, 5e-5, 2.5e-5 s", ", ".join(f"{o:.2f}" for o in orders), "2",
           all(1.8 < o < 2.2 for o in orders))
    history, _ = program.run(SCENES / "collision_unequal.json")
    for body, wanted in (("A", 0.25), ("B", 0.75)):
        last = [v for t, v in zip(history["t"], history[f"{body}.vx"]) if t > 1.1]
        mean = sum(last) / len(last)
        report(f"unequal masses: v_{body} after the impact, mean [m/s]", f"{mean:.5f}", f"{wanted}, less vibration",
               within(mean, wanted, 5e-3))


def largest_residual(program, dt, phases=8):
    """When the blocks touch between two steps decides on the residual of a run, so take the worst of some."""
    worst = 0
    for phase in range(phases):
        x = phase / phases * 0.5 * dt  # B this much farther away
        polygon = f"/bodies/1/polygon=[[{1.5 + x!r}, 0], [{2.5 + x!r}, 0], [{2.5 + x!r}, 1], [{1.5 + x!r}, 1]]"
        _, record = program.run(SCENES / "collision.json", f"/time/dt={dt}", "/time/end=1.1", "/output/frames=1", polygon)
        worst = max(worst, record["largest_residual_share"])
    return worst


def bounce_scene(chamfer):
    """A block falls on another; `chamfer` is None for flat on flat, else the width of the edge at the corner, m."""
    if chamfer is None:
        lower, upper = [[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1.001], [1, 1.001], [1, 2.001], [0, 2.001]]
    else:
        d = math.sqrt(0.5)
        tip = [[0, 0]] if chamfer == 0 else [[chamfer / 2, -chamfer / 2], [-chamfer / 2, -chamfer / 2]]
        lower = tip + [[-d, -d], [0, -2 * d], [d, -d]]
        c, s = math.cos(math.radians(10)), math.sin(math.radians(10))
        height = 0.001 - (0 if chamfer == 0 else chamfer / 2) + 0.8 * s
        upper = [[x * c - y * s, x * s + y * c + height - 0.2 * s] for x, y in ((-.4, 0), (.6, 0), (.6, 1), (-.4, 1))]
        touch = max(y + s / c * (0 - x) for x, y in tip) if chamfer else 0.0
        bottom = upper[0][1] + s / c * (0 - upper[0][0])
        upper = [[x, y - bottom + touch + 0.001] for x, y in upper]
    rock = {"density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0.25}
    return {"talus": 1, "materials": {"rock": rock}, "contact": {"model": "frictionless"},
            "interfaces": [{"between": ["rock", "rock"], "normal_stiffness": 1e10, "normal_damping": 0}],
            "bodies": [{"name": "lower", "polygon": lower, "material": "rock"},
                       {"name": "upper", "polygon": upper, "material": "rock", "velocity": [0, -2]}],
            "monitors": [{"name": "upper", "body": "upper"}], "time": {"end": 0.03}, "output": {"history": 0.03}}


def bounces(program):
    """Energy before against energy after. A corner's force grows with the square of the overlap, so the step in
    which it touches matters little; flat on flat starts with a kink, whose phase within a step costs up to a quarter
    of (omega dt)^2 of the energy of approach, here half of the whole; omega^2 = alpha L over the reduced mass."""
    for what, chamfer in (("flat", None), ("corner", 0), ("chamfer of 10 mm", 0.01), ("chamfer of 2 mm", 0.002)):
        scene = program.folder / f"bounce_{what.replace(' ', '_')}.json"
        scene.write_text(json.dumps(bounce_scene(chamfer)))
        _, record = program.run(scene)
        critical = record["critical_dt [s]"]
        for share in (0.02, 0.002):
            dt = share * critical
            _, record = program.run(scene, f"/time/dt={dt!r}")
            ledger = record["ledger"]
            error = abs(ledger["residual [J/m]"]) / ledger["throughput [J/m]"]
            kink = 1e10 / 1150 * dt * dt / 8
            bound = kink if chamfer is None else 1e-8
            bounced = ledger["contact [J/m]"] == 0 and record["largest_penetration [m]"] > 0
            report(f"{what}: energy, dt {share} of critical {critical:.3g} s", f"{error:.1e}", f"< {bound:.1e}",
                   bounced and (error < bound or share == 0.02))


def rest(program):
    history, _ = program.run(SCENES / "column.json")
    sunk = -history["block.uy"][-1]
    report("column: the top sinks by [m]", f"{sunk:.4e}", "2.338e-4", within(sunk, 2.338e-4, 1e-3))
    report("column: speed at the end [m/s]", f"{history['block.speed'][-1]:.1e}", "0")
    history, _ = program.run(SCENES / "brick_wall.json", options=("--threads", "2"))
    sunk = -history["block.uy"][-1]
    report("brick_wall: the top sinks by [m]", f"{sunk:.4e}", "3.37e-4 to 3.49e-4", 3.37e-4 <= sunk <= 3.49e-4)
    report("brick_wall: speed at the end [m/s]", f"{history['block.speed'][-1]:.1e}", "at rest before 1 s")
    uneven = abs(history["left.ux"][-1] + history["right.ux"][-1])
    report("brick_wall: left and right, ux differ by [m]", f"{uneven:.1e}", "mirror images")


def same_bits(program):
    short = "/time/end=0.05"
    hashes = [program.run(SCENES / "brick_wall.json", short, options=options)[1]["state_hash"]
              for options in (("--threads", "1"), ("--threads", "2"), ("--no-skin",))]
    report("brick_wall: threads 1 and 2", "same" if hashes[0] == hashes[1] else "differ", "same state_hash",
           hashes[0] == hashes[1])
    report("brick_wall: skin and no skin", "same" if hashes[0] == hashes[2] else "differ", "same state_hash",
           hashes[0] == hashes[2])
    near, near_record = program.run(SCENES / "incline.json")
    far, far_record = program.run(SCENES / "incline.json", "/origin=[5e5, 5e6]")
    apart = max(abs(a - b) for name in near for a, b in zip(near[name], far[name]))
    report("incline at (5e5, 5e6) m: trajectory", f"{apart:.1e}", "1e-12", apart <= 1e-12)
    report("incline at (5e5, 5e6) m: state",
           "same" if near_record["state_hash"] == far_record["state_hash"] else "differ", "same state_hash")


def generated(program, name, *arguments):
    """What a generator writes to the standard output, as a file of that name."""
    script = SCENES / "generate" / arguments[0]
    done = subprocess.run([sys.executable, str(script), *arguments[1:]], capture_output=True, text=True, check=True)
    path = program.folder / name
    path.write_text(done.stdout)
    return path


def orders(errors, ratio=2.0):
    return [math.log(a / b) / math.log(ratio) for a, b in zip(errors, errors[1:])]


def meshed(program, source, name, body, surfaces, size, columns, rows, corner):
    """A copy of a scene, a dictionary, with its only body as a mesh whose sides have the names `surfaces`."""
    mesh = generated(program, f"{name}.msh", "mesh.py", "--size", *map(str, size), "--divisions", str(columns),
                     str(rows), "--corner", *map(str, corner))
    text = mesh.read_text()
    for old, new in surfaces.items():
        text = text.replace(f'"{old}"', f'"{new}"')
    mesh.write_text(text)
    scene = dict(source, cover={"model": "mesh"}, bodies=[{"name": body, "mesh": str(mesh), "material": "rock"}])
    path = program.folder / f"{name}.json"
    path.write_text(json.dumps(scene))
    return path


def scene_text(path):
    return json.loads("\n".join(line.split(" //")[0] for line in path.read_text().split("\n")
                                if not line.lstrip().startswith("//")))


def cantilever(program):
    exact = 3.7766e-4
    errors = []
    for size in (0.25, 0.176777, 0.125, 0.0883883):
        history, _ = program.run(SCENES / "cantilever.json", f"/cover/size={size}")
        errors.append(abs(history["tip.y"][-1] - exact) / exact)
        report(f"hexagonal, H/{1 / size:.3g}: deflection [m]", f"{history['tip.y'][-1]:.5e}", f"{exact}, error {errors[-1]:.2%}")
    over_two = [math.log2(errors[i] / errors[i + 2]) for i in range(2)]
    report("hexagonal: order of the error", ", ".join(f"{o:.2f}" for o in over_two), ">= 1.9",
           all(o >= 1.9 for o in over_two))
    errors = []
    for rows in (4, 8, 16):
        scene = meshed(program, scene_text(SCENES / "cantilever.json"), f"beam{rows}", "beam",
                       {"left": "wall", "right": "end"}, (10, 1), 10 * rows, rows, (0, -0.5))
        history, _ = program.run(scene)
        errors.append(abs(history["tip.y"][-1] - exact) / exact)
        report(f"mesh, H/{rows}: deflection [m]", f"{history['tip.y'][-1]:.5e}", f"{exact}, error {errors[-1]:.2%}")
    first, last = orders(errors)
    report("mesh: order of the error", f"{first:.2f}, {last:.2f}", "the last >= 1.9", last >= 1.9)


def bar_scene(size):
    """Let go at the first time of the history in the shape of the first longitudinal mode."""
    wave = [[x, math.sin(math.pi * x / 10)] for x in (-5 + 0.1 * i for i in range(101))]
    points = [-5 + 10 * (i + 0.5) / 40 for i in range(40)]
    return {"talus": 1,
            "materials": {"rock": {"density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0}},
            "cover": {"model": "hexagonal", "size": size, "offset_x": 0.123, "offset_y": 0.057, "angle": 17},
            "bodies": [{"name": "bar", "material": "rock", "polygon": [[-5, -0.25], [5, -0.25], [5, 0.25], [-5, 0.25]],
                        "surfaces": {"top": [2], "bottom": [0]}}],
            "surface_loads": [{"body": "bar", "surface": surface, "traction": [{"scale": 1e5, "x": wave}, 0]}
                              for surface in ("top", "bottom")],
            "settle": {"duration": 0.05, "damping": "adaptive"},
            "stages": [{"name": "free", "from": 2e-4, "set": {"/surface_loads": []}}],
            "monitors": [{"name": f"m{i}", "body": "bar", "point": [x, 0], "quantities": ["x"]}
                         for i, x in enumerate(points)],
            "time": {"end": 0.1002, "safety": 0.2}, "output": {"history": 2e-4}}


def frequency(program, scene):
    """From the zeros of the share of the first mode in the motion."""
    history, _ = program.run(scene)
    points = [-5 + 10 * (i + 0.5) / 40 for i in range(40)]
    share = [sum(math.sin(math.pi * x / 10) * (history[f"m{i}.x"][k] - x) for i, x in enumerate(points))
             for k in range(len(history["t"]))]
    time = history["t"]
    zeros = [time[k - 1] + (time[k] - time[k - 1]) * share[k - 1] / (share[k - 1] - share[k])
             for k in range(1, len(time)) if share[k - 1] * share[k] < 0]
    return (len(zeros) - 1) / 2 / (zeros[-1] - zeros[0])


def bar(program):
    exact = math.sqrt(1e10 / 2300) / 20
    for cover in ("hexagonal", "mesh"):
        errors = []
        for size in (0.5, 0.25, 0.125):
            scene = program.folder / f"bar{size}.json"
            scene.write_text(json.dumps(bar_scene(size)))
            if cover == "mesh":
                scene = meshed(program, bar_scene(size), f"bar_mesh{size}", "bar", {}, (10, 0.5), round(10 / size),
                               round(0.5 / size), (-5, -0.25))
            found = frequency(program, scene)
            errors.append(abs(found - exact) / exact)
            report(f"{cover}, {size} m: frequency [Hz]", f"{found:.4f}", f"{exact:.3f}, error {errors[-1]:.1e}")
        mean = math.log(errors[0] / errors[-1]) / math.log(4)
        report(f"{cover}: order, over both halvings", f"{mean:.2f}", ">= 1.9", mean >= 1.9)


def contact_patch(program):
    for what, cover in (("hexagonal on hexagonal", None), ("block on hexagonal", '{"model": "block"}')):
        history, _ = program.run(SCENES / "contact_patch.json", *([f"/bodies/1/cover={cover}"] if cover else []))
        error = max(abs(history[f"{at}.stress_{c}"][-1] - due) / 1000
                    for at in ("below", "above", "middle") for c, due in (("xx", 0), ("yy", -1000), ("xy", 0)))
        report(f"{what}: stress off the even pressure, share", f"{error:.1e}", "1e-6", error <= 1e-6)


def hertz(program):
    """Half width from where the two boundaries part, peak from p^2 against x^2 in the inner 0.6 of it."""
    for cylinder, block in ((6, 6), (6, 10), (10, 6), (10, 10)):
        folder = program.folder / f"hertz{cylinder}_{block}"
        subprocess.run([sys.executable, str(SCENES / "generate/hertz.py"), "--out", str(folder), "--cylinder",
                        str(cylinder), "--block", str(block)], check=True)
        history, _ = program.run(folder / "hertz.json")
        x, p = [], []
        while f"b{len(x)}.y" in history:
            b, c = (f"{name}{len(x)}" for name in "bc")
            x.append((history[f"{b}.x"][-1] + history[f"{c}.x"][-1]) / 2)
            p.append(1e13 * (history[f"{b}.y"][-1] - history[f"{c}.y"][-1]))
        out = next(i for i, value in enumerate(p) if value <= 0)
        width = x[out - 1] + (x[out] - x[out - 1]) * p[out - 1] / (p[out - 1] - p[out])
        inner = [(u * u, v * v) for u, v in zip(x, p) if u < 0.6 * width]
        mean = [sum(column) / len(inner) for column in zip(*inner)]
        slope = sum((u - mean[0]) * (v - mean[1]) for u, v in inner) / sum((u - mean[0]) ** 2 for u, _ in inner)
        peak = math.sqrt(mean[1] - slope * mean[0])
        what = f"a/{cylinder} on a/{block}"
        report(f"{what}: half width [m]", f"{width:.6f}", "0.015451 +- 3 %", within(width, 0.015451, 0.03))
        report(f"{what}: peak pressure [MPa]", f"{peak / 1e6:.3f}", "41.203 +- 3 %", within(peak, 41.2026e6, 0.03))


CASES = {"incline": incline, "creep": creep_of_paper_rule, "stick": stick, "incline_paper": incline_paper,
         "collision": collision, "bounces": bounces, "rest": rest, "same_bits": same_bits,
         "cantilever": cantilever, "bar": bar, "contact_patch": contact_patch, "hertz": hertz}


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("--talus", default=str(ROOT / "build/release/bin/talus"), help="the program")
    options.add_argument("cases", nargs="*", metavar="case", help=f"which of {', '.join(CASES)}; default: all")
    chosen = options.parse_args()
    unknown = [case for case in chosen.cases if case not in CASES]
    if unknown:
        options.error(f"unknown case {unknown[0]!r}; there are {', '.join(CASES)}")
    with tempfile.TemporaryDirectory() as folder:
        program = Program(chosen.talus, pathlib.Path(folder))
        for case in chosen.cases or CASES:
            print(case)
            CASES[case](program)
    if missed:
        sys.exit(f"{len(missed)} out of bounds: {'; '.join(missed)}")


if __name__ == "__main__":
    main()
