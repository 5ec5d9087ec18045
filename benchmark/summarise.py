#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints what CompareUpsampling measured (its --benchmark_out file) as Markdown tables. It judges nothing."""

import argparse
import json
import math
import statistics
import sys
from collections import defaultdict

REFERENCE = "ExpandLinear"
SUBJECT = "NonOscillatory"
PEAK = "MultiplyAddPeak@"
# The rows of the README's table.
README_ROWS = {
    "NonOscillatory": "non-oscillatory",
    "Restored": "restored",
    "Linear": "linear",
    "BoundedLinear": "bounded linear",
    "BSpline": "B-spline scheme",
    "LabelMap": "label map of 20 organs (`LabelSubdivisionImageFilter`)",
    "ExpandNearest": "`ExpandImageFilter`, nearest",
    "ExpandLinear": "`ExpandImageFilter`, linear",
    "ResampleBSpline3": "`ResampleImageFilter`, B-spline of order 3",
    "ResampleBSpline5": "`ResampleImageFilter`, B-spline of order 5",
}


class Row:
    """The repetitions of one row; times in seconds for one update."""

    def __init__(self):
        self.times = []
        self.faults = []
        self.lane_operations = None

    def add(self, run, use_processor_time):
        if use_processor_time:
            self.times.append(run["user_seconds"] + run["system_seconds"])
        else:
            self.times.append(run["real_time"] * {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}[run["time_unit"]])
        self.faults.append(run["minor_faults"])
        self.lane_operations = run.get("lane_operations")

    @property
    def time(self):
        return statistics.median(self.times)


def read_rows(runs, use_processor_time):
    """Sorts runs into {workload: {memory: {filter: Row}}} and the peaks {threads: {target: Row}}."""
    workloads = defaultdict(lambda: defaultdict(lambda: defaultdict(Row)))
    peaks = defaultdict(lambda: defaultdict(Row))
    # Shuffled repetitions come in any order; families are numbered as the rows were registered.
    for run in sorted(runs, key=lambda run: run["family_index"]):
        if run["run_type"] != "iteration" or run.get("error_occurred") or run.get("skipped"):
            continue
        parts = run["name"].split("/")
        if parts[0].startswith(PEAK):
            peaks[parts[1]][parts[0][len(PEAK) :]].add(run, use_processor_time)
        else:
            name, pixel, size, threads, memory = parts[:5]
            workloads[pixel, int(size), threads][memory][name].add(run, use_processor_time)
    return workloads, peaks


def milliseconds(row):
    return f"{1e3 * row.time:.2f}" if row else ""


def ratio(slower, faster):
    return f"{slower.time / faster.time:.2f}" if slower and faster else ""


def fresh_memory_share(fresh, reused):
    """The part of a fresh update that goes away when the output memory is reused."""
    return f"{100 * (1 - reused.time / fresh.time):.0f} %" if fresh and reused else ""


def used_target(name, context):
    return name.partition("@")[2] or context["kernel_target"]


def floor_and_share(name, row, peaks, context):
    """The time that the row's lane operations take at the peak of the row's instruction set, and its share of the
    measured time."""
    peak = peaks.get(used_target(name, context))
    if not (row and row.lane_operations and peak):
        return "", ""
    floor = row.lane_operations * peak.time / peak.lane_operations
    return f"{1e3 * floor:.2f}", f"{100 * floor / row.time:.0f} %"


def print_table(header, rows):
    print("| " + " | ".join(header) + " |")
    print("|" + "---|" + "---:|" * (len(header) - 1))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def format_threads(threads):
    count = threads.partition(":")[2]
    return f"{count} thread" + ("" if count == "1" else "s")


def print_workload(workload, memories, peaks, context):
    pixel, size, threads = workload
    print(f"## {size}³ {pixel}, {format_threads(threads)}\n")
    fresh, reused = memories["fresh"], memories["reused"]
    lines = []
    for name in dict.fromkeys([*fresh, *reused]):
        new, old = fresh.get(name), reused.get(name)
        lines.append(
            [
                name,
                milliseconds(new),
                milliseconds(old),
                ratio(fresh.get(REFERENCE), new),
                ratio(reused.get(REFERENCE), old),
                ratio(new, fresh.get(SUBJECT)),
                ratio(old, reused.get(SUBJECT)),
                f"{1e9 * old.time / size**3:.2f}" if old else "",
                f"{statistics.median(new.faults):.0f}" if new else "",
                fresh_memory_share(new, old),
                *floor_and_share(name, old, peaks, context),
            ]
        )
    header = [
        "row",
        "fresh, ms",
        "reused, ms",
        f"× {REFERENCE}, fresh",
        "reused",
        f"{SUBJECT} ×, fresh",
        "reused",
        "ns a voxel, reused",
        "page faults, fresh",
        "fresh memory's share",
        "floor, ms",
        "floor / reused",
    ]
    print_table(header, lines)


def two_digits(value):
    """The value to two significant digits, and never with an exponent."""
    decimals = max(0, 1 - math.floor(math.log10(value)))
    return f"{value:.{decimals}f}"


def print_readme_table(workload, memories):
    """How many times as fast as the reference the README's rows are; the reference's own time in seconds."""
    pixel, size, threads = workload
    print(f"{size}³ {pixel}, {format_threads(threads)}\n\n| filter | fresh memory | reused |\n|---|---:|---:|")
    for name, title in README_ROWS.items():
        cells = []
        for rows in (memories["fresh"], memories["reused"]):
            row, reference = rows.get(name), rows.get(REFERENCE)
            cell = two_digits(reference.time / row.time) if row and reference else ""
            cells.append(f"1 ({row.time:.2f} s)" if cell and name == REFERENCE else cell)
        if any(cells):
            print(f"| {title} | {cells[0]} | {cells[1]} |")
    print()


def print_spread(workload, memories):
    pixel, size, threads = workload
    lines = [
        [f"{name}, {memory}", str(len(row.times))]
        + [f"{1e3 * time:.2f}" for time in (min(row.times), row.time, max(row.times))]
        for memory, rows in memories.items()
        for name, row in rows.items()
    ]
    print(f"## Spread: {size}³ {pixel}, {format_threads(threads)}\n")
    print_table(["row", "repetitions", "least, ms", "median, ms", "most, ms"], lines)


def print_peaks(peaks, use_processor_time):
    print("## Multiply-add peak\n")
    lines = [
        [target, threads.partition(":")[2], f"{row.lane_operations / row.time / 1e9:.1f}"]
        for threads, targets in peaks.items()
        for target, row in targets.items()
    ]
    second = "processor second" if use_processor_time else "second"
    print_table(["instruction set", "threads", f"10⁹ lanes a {second}"], lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("json", help="the file that CompareUpsampling wrote with --benchmark_out")
    parser.add_argument("--readme", action="store_true", help="print the README's table alone")
    parser.add_argument("--spread", action="store_true", help="print the least and the most time of each row, too")
    parser.add_argument(
        "--processor-time",
        action="store_true",
        help="take the processor time of all threads for the time: less disturbed by other programs, blind to waiting",
    )
    arguments = parser.parse_args()
    try:
        with open(arguments.json, encoding="utf-8") as file:
            results = json.load(file)
    except (OSError, ValueError) as error:
        sys.exit(f"{arguments.json}: {error}")

    context = results["context"]
    for key in ("processor", "kernel_target", "itk", "compiler", "transparent_huge_pages"):
        print(f"- {key.replace('_', ' ')}: {context[key]}")
    print(f"- load average at the start: {context['load_avg'][0]:.1f}")
    print(f"- times: {'processor time of all threads' if arguments.processor_time else 'wall clock'}, medians\n")
    workloads, peaks = read_rows(results["benchmarks"], arguments.processor_time)
    if arguments.readme:
        for workload, memories in workloads.items():
            print_readme_table(workload, memories)
        return
    for workload, memories in workloads.items():
        print_workload(workload, memories, peaks.get(workload[2], {}), context)
    if arguments.spread:
        for workload, memories in workloads.items():
            print_spread(workload, memories)
    if peaks:
        print_peaks(peaks, arguments.processor_time)


if __name__ == "__main__":
    main()
