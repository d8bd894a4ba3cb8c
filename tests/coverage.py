"""Holds what gcovr counted, file by file, against the floors of the folders.

    coverage.py SUMMARY.json FLOORS.txt [--raise] [--worst]
"""

import json
import sys
from pathlib import Path

KINDS = ("line", "branch")
PLURAL = {"line": "lines", "branch": "branches"}
# Code is added without a test for every line of it, and which threads wait is not the same in every run: so much may
# be missing, in points, or this many lines or branches where a folder has few.
MARGIN_POINTS = 0.2
MARGIN_COUNT = 2
HEADER = "# Share of the lines and branches that the quick tests run, %. tests/coverage.sh --raise writes this.\n"


def folder_of(path):
    """core by its folders, the others as a whole."""
    parts = Path(path).parts
    return "/".join(parts[:2]) if parts[0] == "core" else parts[0]


def add_up(files):
    """{folder: {kind: [covered, total]}}, sorted."""
    folders = {}
    for file in files:
        sums = folders.setdefault(folder_of(file["filename"]), {kind: [0, 0] for kind in KINDS})
        for kind in KINDS:
            sums[kind][0] += file[f"{kind}_covered"]
            sums[kind][1] += file[f"{kind}_total"]
    return dict(sorted(folders.items()))


def share(covered, total):
    """%, rounded down to tenths as the floors are written; 100 where there is nothing to cover."""
    return (1000 * covered // total) / 10 if total else 100.0


def read_floors(file):
    """{folder: {kind: %}}"""
    floors = {}
    for line in file.read_text().splitlines() if file.exists() else []:
        if line and not line.startswith("#"):
            folder, *values = line.split()
            floors[folder] = dict(zip(KINDS, map(float, values)))
    return floors


def falls(folders, floors):
    """In words, what is below its floor by more than the margin."""
    words = []
    for folder, sums in folders.items():
        for kind, (covered, total) in sums.items():
            if folder not in floors:
                continue
            floor = floors[folder][kind]
            due = floor / 100 * total - max(MARGIN_POINTS / 100 * total, MARGIN_COUNT)
            if covered < due:
                words.append(f"{folder}: {covered} of {total} {PLURAL[kind]} are run, {share(covered, total)} %, where "
                             f"the floor is {floor} %; test what is new, or say in the change why it cannot be tested "
                             "and lower the floor")
    words += [f"{folder}: has no floor; --raise gives it one" for folder in folders if folder not in floors]
    words += [f"{folder}: has a floor and is not there; --raise takes it away" for folder in floors
              if folder not in folders]
    return words


def raise_floors(folders, floors, file):
    """The higher one of what is and what was: floors are lowered by hand."""
    lines = [HEADER]
    for folder, sums in folders.items():
        values = [max(share(*sums[kind]), floors.get(folder, {}).get(kind, 0)) for kind in KINDS]
        lines.append(f"{folder:<18}{values[0]:6.1f}{values[1]:6.1f}\n")
    file.write_text("".join(lines))


def main(summary, floors_file, *words):
    files = json.loads(Path(summary).read_text())["files"]
    folders, floors_file = add_up(files), Path(floors_file)
    floors = read_floors(floors_file)
    for folder, sums in folders.items():
        print(f"{folder:<18}" + "".join(f"{share(*sums[kind]):7.1f} % of {sums[kind][1]:5d} {PLURAL[kind]}"
                                        for kind in KINDS))
    if "--worst" in words:
        print("\nMost lines and branches that are never run:")
        missing = {file["filename"]: sum(file[f"{kind}_total"] - file[f"{kind}_covered"] for kind in KINDS)
                   for file in files}
        for file in sorted(files, key=lambda file: -missing[file["filename"]])[:40]:
            print(f"{file['filename']:<50} {file['line_total'] - file['line_covered']:5d} lines, "
                  f"{file['branch_total'] - file['branch_covered']:5d} branches")
    if "--raise" in words:
        raise_floors(folders, floors, floors_file)
        return 0
    fallen = falls(folders, floors)
    for sentence in fallen:
        print(sentence, file=sys.stderr)
    return 1 if fallen else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
