#!/usr/bin/env python3
"""Measures everything that docs/benchmarks.md shows and writes its tables anew, between their markers.

  measure.py                                all but the large cases
  measure.py --large                        those too: half an hour more
  measure.py --only peers,machine           some of it; the other figures stay
  measure.py --column "Zen 5"               a column of that name instead of one called "here"

The figures are kept in docs/benchmarks.json, a column for each machine.
"""

import argparse
import contextlib
import datetime
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

from quickest import on_quickest_processor

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PAGE, STORE = ROOT / "docs/benchmarks.md", ROOT / "docs/benchmarks.json"
SECTIONS = ("machine", "steps", "memory", "continuum", "threads", "interface", "setup", "programs", "peers")

STEPS = "^(brick_wall/411/overlap_area|sliding|pile|many_elements).*threads:[{}]"
LARGE_STEPS = "^large/(sliding|pile).*threads:[{}]"
MEMORY = """sliding/504/block/priority sliding/5000/block/priority pile/5000/block/symmetric
            large/sliding/50000/block/priority large/sliding/50000/block/symmetric large/sliding/50000/rigid/priority
            large/pile/50000/block/symmetric large/pile/50000/rigid/symmetric
            large/pile_shuffled/50000/block/symmetric large/pile/500000/block/symmetric""".split()


def google_benchmark(binary, pattern, repetitions):
    """{name: {counter: median}} of the cases that fit the pattern."""
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        command = [binary, f"--benchmark_filter={pattern}", f"--benchmark_repetitions={repetitions}"]
        command += [f"--benchmark_out={out.name}", "--benchmark_out_format=json"]
        command += ["--benchmark_enable_random_interleaving=true"] if repetitions > 1 else []
        subprocess.run(command, check=True)
        runs = json.load(open(out.name))["benchmarks"]
    found = {}
    for run in runs:
        if run["run_type"] != "iteration" or run.get("error_occurred"):
            continue
        name = re.sub(r"/(iterations:\d+|real_time|manual_time|repeats:\d+)", "", run["name"]).removeprefix("large/")
        for key, value in run.items():
            if isinstance(value, (int, float)):
                found.setdefault(name, {}).setdefault(key, []).append(value)
    return {name: {key: statistics.median(values) for key, values in case.items()} for name, case in found.items()}


def on_quickest(binaries):
    def trial():
        found = google_benchmark(binaries / "talus_benchmarks", "^sliding/504/block/priority/threads:1", 3)
        return min(case["ns_per_block_step"] for case in found.values())

    return on_quickest_processor(trial)


def google_benchmark_by_threads(binaries, pattern, arguments, repetitions):
    """One thread on the quickest processor, several wherever the system puts them."""
    found = {}
    for threads in sorted(arguments.threads):
        place = on_quickest(binaries) if threads == "1" else contextlib.nullcontext()
        with place:
            found |= google_benchmark(binaries / "talus_benchmarks", pattern.format(threads), repetitions)
    return found


def first_match(pattern, text, default="unknown"):
    found = re.search(pattern, text, re.MULTILINE)
    return found.group(1).strip() if found else default


def measure_machine(binaries, _):
    processor = pathlib.Path("/proc/cpuinfo").read_text()
    caches = subprocess.run(["lscpu", "--caches=NAME,ONE-SIZE"], text=True, capture_output=True).stdout.split("\n")[1:]
    own = json.loads(subprocess.run([binaries / "talus_machine"], check=True, text=True, capture_output=True).stdout)
    return {
        "processor": first_match(r"^model name\s*: (.*)$", processor),
        "family, model, stepping": ", ".join(
            first_match(rf"^{key}\s*: (.*)$", processor) for key in ("cpu family", "model", "stepping")
        ),
        "clock as reported": first_match(r"^cpu MHz\s*: (.*)$", processor) + " MHz",
        "cores": os.cpu_count(),
        "caches of a core": ", ".join(" ".join(line.split()) for line in caches if line) or "unknown",
        "compiler": own["compiler"],
        "peak, one thread: scalar": f"{own['scalar_gflops']:.3g} GFLOP/s",
        "peak, one thread: AVX2": f"{own['avx2_gflops']:.3g} GFLOP/s",
        "peak, one thread: AVX-512": f"{own['avx512_gflops']:.3g} GFLOP/s",
        "memory, one thread": f"{own['triad_gb_per_s']:.3g} GB/s",
        f"memory, {own['threads']} threads": f"{own['triad_all_gb_per_s']:.3g} GB/s",
    }


def measure_steps(binaries, arguments):
    found = google_benchmark_by_threads(binaries, STEPS, arguments, arguments.repetitions)
    if arguments.large:
        found |= google_benchmark_by_threads(binaries, LARGE_STEPS, arguments, 1)
    return found


def measure_memory(binaries, arguments):
    """Each case in a process of its own: what others left free would be counted as room already there."""
    found = {}
    for case in MEMORY:
        if arguments.large or "/500000/" not in case:
            found |= google_benchmark(binaries / "talus_benchmarks", f"^{case}/threads:1", 1)
    return found


def measure_continuum(binaries, arguments):
    return google_benchmark_by_threads(binaries, "^(lattice|mesh)/1e6/threads:[{}]", arguments, arguments.repetitions)


def measure_interface(binaries, arguments):
    with on_quickest(binaries):
        return google_benchmark(binaries / "talus_benchmarks", "^interface/", arguments.repetitions)


THREADS = {"talus": "talus_benchmarks", "OpenMP": "talus_benchmarks_openmp", "oneTBB": "talus_benchmarks_onetbb"}
SHARED = "^sliding/504/block/priority/threads:2|^large/sliding/50000/block/priority/threads:2"


def measure_threads(binaries, arguments):
    """The same steps with loops divided by three libraries, one after the other, round after round."""
    present = {name: binaries / file for name, file in THREADS.items() if (binaries / file).exists()}
    rounds = [
        {name: google_benchmark(binary, SHARED, 1) for name, binary in present.items()} for _ in range(arguments.rounds)
    ]
    cases = {}
    for case in rounds[0]["talus"]:
        for name in present:
            times = [each[name][case]["ns_per_block_step"] for each in rounds]
            ratios = [each[name][case]["ns_per_block_step"] / each["talus"][case]["ns_per_block_step"] for each in rounds]
            cases[f"{case} {name}"] = {
                "ns_per_block_step": statistics.median(times),
                "ratio": statistics.median(ratios),
            }
    return cases


def measure_setup(binaries, arguments):
    pattern = "setup/" if arguments.large else "^(large/)?setup/pile/(5000|50000)/"
    return google_benchmark(binaries / "talus_benchmarks", pattern, 1)


def measure_programs(binaries, arguments):
    return google_benchmark_by_threads(binaries, "whole_program/.*threads:[{}]", arguments, 1)


def measure_peers(binaries, arguments):
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        command = [sys.executable, HERE / "peers/compare.py", "--rounds", str(arguments.rounds), "--json", out.name]
        command += ["--talus", binaries / "talus", "--box2d", binaries / "peer_box2d"]
        subprocess.run(command, check=True)
        return json.load(open(out.name))


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def number(value, digits=3):
    """Figures of a measurement; a dash where a column lacks the case."""
    if value is None:
        return "–"
    if value >= 10 ** (digits - 1):
        value = round(value, digits - 1 - len(str(int(value))) + 1)
        return f"{value:,.0f}"
    return f"{value:.{digits}g}"


def percent(value):
    return "–" if value is None else f"{100 * value:.1f} %"


def counted(value):
    return "–" if value is None else f"{value:,.0f}"


def columns_of(store, section):
    """Columns that hold the section, and the cases of any of them."""
    columns = [column for column in store if section in store[column]]
    cases = {}
    for column in columns:
        cases |= dict.fromkeys(store[column][section])
    return columns, list(cases)


def get(store, column, section, case, key):
    return store.get(column, {}).get(section, {}).get(case, {}).get(key)


def show_machine(store):
    columns, keys = columns_of(store, "machine")
    rows = [[key] + [store[column]["machine"].get(key, "–") for column in columns] for key in keys]
    rows.append(["when, load"] + [store[column]["when"] for column in columns])
    return table([""] + columns, rows)


def natural(name):
    """Sorts numbers within names by their size."""
    return [part.zfill(9) if part.isdigit() else part for part in re.split(r"(\d+)", name)]


def show_steps(store):
    columns, cases = columns_of(store, "steps")
    cases.sort(key=natural)
    keys = ["blocks", "overlapping_pairs", "candidate_pairs"]
    heads = ["case", "blocks", "pairs that overlap", "candidates"]
    for what in ("ns per block and step", "ns per overlapping pair and step"):
        heads += [f"{what}, {column}" for column in columns]
    rows = []
    for case in cases:
        latest = next(column for column in reversed(columns) if case in store[column]["steps"])
        row = [f"`{case}`"] + [counted(get(store, latest, "steps", case, key)) for key in keys]
        for key in ("ns_per_block_step", "ns_per_contact_step"):
            for column in columns:
                value = get(store, column, "steps", case, key)
                row.append(number(value))
        rows.append(row)
    return table(heads, rows)


def show_one_figure(store, section, key, what):
    columns, cases = columns_of(store, section)
    cases.sort(key=natural)
    rows = [[f"`{case}`"] + [number(get(store, c, section, case, key)) for c in columns] for case in cases]
    return table(["case"] + [f"{what}, {column}" for column in columns], rows)


def show_memory(store):
    return show_one_figure(store, "memory", "bytes_per_block", "bytes per block")


def show_continuum(store):
    return show_one_figure(store, "continuum", "ns_per_element_step", "ns per element and step")


def show_threads(store):
    columns, cases = columns_of(store, "threads")
    heads = ["case and who divides the loops"] + [f"ns per block and step, {column}" for column in columns]
    heads += [f"ratio to talus, {column}" for column in columns]
    return table(
        heads,
        [
            [f"`{case.split()[0]}` {case.split()[1]}"]
            + [number(get(store, column, "threads", case, "ns_per_block_step")) for column in columns]
            + [number(get(store, column, "threads", case, "ratio")) for column in columns]
            for case in cases
        ],
    )


def show_interface(store):
    columns, cases = columns_of(store, "interface")
    parts = {
        "step_us": "step [µs]",
        "interface_us_per_step": "its contacts through the interface [µs]",
        "fused_us_per_step": "compiled as one [µs]",
        "interface_over_fused": "ratio",
        "share_of_step": "the interface, of the step",
    }
    heads = ["case"] + [f"{what}, {column}" for what in parts.values() for column in columns]
    rows = []
    for case in cases:
        row = [f"`{case}`"]
        for key in parts:
            values = [get(store, column, "interface", case, key) for column in columns]
            shown = percent if key == "share_of_step" else number
            row += [shown(value) for value in values]
        rows.append(row)
    return table(heads, rows)


def show_setup(store):
    columns, cases = columns_of(store, "setup")
    parts = {
        "reading_s": "read the text",
        "overlap_check_s": "of that, overlaps",
        "construction_s": "make the simulation",
        "model_s": "of that, the model",
    }
    heads = ["case"] + [f"{what} [s], {column}" for what in parts.values() for column in columns]
    rows = [
        [f"`{case}`"] + [number(get(store, column, "setup", case, key)) for key in parts for column in columns]
        for case in cases
    ]
    return table(heads, rows)


def show_programs(store):
    return show_one_figure(store, "programs", "cpu_s_per_simulated_s", "CPU s per simulated s")


def show_peers(store):
    columns, sizes = columns_of(store, "peers")
    heads = ["blocks", "program", "step [s]", "speed at the end [m/s]"]
    heads += [f"ns per body and step, {column}" for column in columns]
    heads += [f"ratio to talus, {column}" for column in columns] + ["seen in the last run"]
    rows = []
    for size in sizes:
        latest = next(column for column in reversed(columns) if size in store[column]["peers"])
        for name, run in store[latest]["peers"][size].items():
            runs = [store[column]["peers"].get(size, {}).get(name, {}) for column in columns]
            row = [size, name, f"{run['step']:.3g}", f"{run['speed']:.4f}"]
            row += [number(each.get("ns")) for each in runs]
            row += [number(each.get("ratio")) for each in runs] + [run["note"]]
            rows.append(row)
    return table(heads, rows)


def stored():
    return json.loads(STORE.read_text()) if STORE.exists() else {}


def rewrite(store):
    text = PAGE.read_text()
    show = {
        "machine": show_machine,
        "steps": show_steps,
        "memory": show_memory,
        "continuum": show_continuum,
        "threads": show_threads,
        "interface": show_interface,
        "setup": show_setup,
        "programs": show_programs,
        "peers": show_peers,
    }
    for section in SECTIONS:
        if not columns_of(store, section)[0]:
            continue
        begin, end = f"<!-- {section}: begin -->", f"<!-- {section}: end -->"
        start, stop = text.index(begin) + len(begin), text.index(end)
        text = text[:start] + "\n" + show[section](store) + "\n" + text[stop:]
    PAGE.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--column", default="here", help="what the machine is called")
    parser.add_argument("--only", default=",".join(SECTIONS), help="some of " + ", ".join(SECTIONS))
    parser.add_argument("--large", action="store_true", help="also cases that run for minutes")
    parser.add_argument("--repetitions", type=int, default=3, help="of the cases of Google Benchmark")
    parser.add_argument("--rounds", type=int, default=3, help="of the comparisons with peers and of threads")
    parser.add_argument("--threads", default="12", help="1 on a busy machine, where two threads tell nothing")
    parser.add_argument("--binaries", type=lambda path: pathlib.Path(path).resolve(), default=ROOT / "build/release/bin")
    parser.add_argument("--tables", action="store_true", help="measure nothing, write the tables")
    arguments = parser.parse_args()
    wanted = [] if arguments.tables else arguments.only.split(",")
    if not set(wanted) <= set(SECTIONS):
        parser.error("--only takes some of " + ", ".join(SECTIONS))
    if arguments.tables:
        rewrite(stored())
    for section in wanted:
        figures = globals()[f"measure_{section}"](arguments.binaries, arguments)
        store = stored()
        column = store.setdefault(arguments.column, {})
        column[section] = figures if section == "machine" else column.get(section, {}) | figures
        load = os.getloadavg()[1]
        column["when"] = f"{datetime.date.today()}, load average {load:.1f} on {os.cpu_count()} cores"
        STORE.write_text(json.dumps(store, indent=1) + "\n")
        rewrite(store)


if __name__ == "__main__":
    main()
