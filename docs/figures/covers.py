#!/usr/bin/env python3
"""Sets the covers side by side on the incline: speed at 2.95 s and what it costs, under two contact laws.

    python3 docs/figures/covers.py [--talus build/release/bin/talus]

Needs Python 3 alone. Ends with 1 if the speeds under the overlap law part by more than 0.3 %.
"""
import argparse
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

from tables import ROOT

SCENES = ROOT / "scenes"

OUTLINE = [[-8.005423651204648, 4.6219335], [-6.27337284363577, 3.6219335],
           [-5.77337284363577, 4.487958903784438], [-7.505423651204648, 5.487958903784438]]
RIGHT = {"overlap_area": 5.278582, "vertex_edge": 5.085557}  # m/s, a base pressure that is linear; two feet


def run(talus, folder, *overrides):
    """Rows of history.csv by the names of its columns, and run.json."""
    changes = [word for override in overrides for word in ("--set", override)]
    subprocess.run([talus, "run", str(SCENES / "incline.json"), "--quiet", "--overwrite", "--out", str(folder / "run"),
                    *changes], check=True)
    with open(folder / "run/history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return rows, json.loads((folder / "run/run.json").read_text())


def sloping_mesh(folder, columns, rows):
    """The block of the incline as triangles."""
    corner = [repr(x) for x in OUTLINE[0]]
    made = subprocess.run([sys.executable, str(SCENES / "generate/mesh.py"), "--size", "2", "1", "--corner", *corner,
                           "--divisions", str(columns), str(rows), "--angle", "-30"],
                          capture_output=True, text=True, check=True)
    path = folder / f"block_{columns}x{rows}.msh"
    path.write_text(made.stdout)
    return path


def variants(folder):
    """What, cover, and shape of the block."""
    polygon = {"polygon": OUTLINE}
    yield "rigid", {"model": "rigid"}, polygon
    yield "block", {"model": "block"}, polygon
    for size in (0.4, 0.25):
        yield f"hexagonal, size {size:g} m", {"model": "hexagonal", "size": size}, polygon
    for columns, rows in ((4, 2), (8, 4)):
        mesh = sloping_mesh(folder, columns, rows)
        yield f"mesh, {2 * columns * rows} triangles", {"model": "mesh"}, {"mesh": str(mesh)}


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("--talus", default=str(ROOT / "build/release/bin/talus"), help="the program")
    chosen = options.parse_args()
    apart = {}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for law, right in RIGHT.items():
            print(f"{law}: one element or none has {right} m/s")
            print(f"  {'cover':<24}{'v(2.95 s) [m/s]':>16}{'steps':>9}{'CPU [s]':>9}")
            speeds = []
            for what, cover, shape in variants(folder):
                block = json.dumps({"name": "block", "material": "rock", **shape})
                history, record = run(chosen.talus, folder, "/time/end=3", "/output/frames=3", f"/contact/model={law}", "/materials/rock/damping_time=1e-5",
                                      f"/cover={json.dumps(cover)}", f"/bodies/1={block}")
                row = min(history, key=lambda row: abs(float(row["t [s]"]) - 2.95))
                speeds.append(float(row["block.speed [m/s]"]))
                steps = record["steps"] + record["settle_steps"]
                print(f"  {what:<24}{speeds[-1]:>16.6f}{steps:>9}{record['cost']['cpu [s]']:>9.2f}", flush=True)
            apart[law] = (max(speeds) - min(speeds)) / max(speeds)
            print(f"  the covers part by {100 * apart[law]:.2f} %")
    if apart["overlap_area"] > 0.003:
        sys.exit("out of bounds: the covers part by more than 0.3 % under overlap_area")


if __name__ == "__main__":
    main()
