# SPDX-License-Identifier: Apache-2.0
"""What a call from Python costs beside the C++ filter.

    python benchmark/python_overhead.py build/ci/bin/CompareUpsampling

Both take turns, so that a drift of the machine's speed hits both alike; a ratio of 1 says that Python costs nothing. The
times are those of the whole call and of the whole update, for fresh memory and for memory that is used again.
"""

import argparse
import json
import os
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
from nonoscillatory_subdivision import subdivide
from summarise import SUBJECT, read_rows


def time_filter(program, size, threads, repetitions, use_processor_time):
    """Seconds of each update of the C++ filter: {memory: [...]}."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "results.json")
        command = [program, f"--size={size}", "--pixel=ushort", f"--threads={threads}", f"--repetitions={repetitions}"]
        command += [f"--benchmark_filter=^{SUBJECT}/", f"--benchmark_out={file}"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        workloads, _ = read_rows(json.loads(file.read_text())["benchmarks"], use_processor_time)
    (workload,) = workloads.values()
    return {memory: rows[SUBJECT].times for memory, rows in workload.items()}


def time_package(volume, threads, repetitions, clock):
    """The same for the package."""
    out = np.empty([2 * length for length in volume.shape], volume.dtype)
    subdivide(volume, out=out, threads=threads)
    times = {"fresh": [], "reused": []}
    for _ in range(repetitions):
        for memory, target in (("fresh", None), ("reused", out)):
            begin = clock()
            result = subdivide(volume, out=target, threads=threads)
            times[memory].append(clock() - begin)
            del result
    return times


def time_small_call(repetitions=5000):
    """The least and the median time of a call for 4³ voxels, in microseconds."""
    volume = np.zeros((4, 4, 4), np.uint16)
    times = []
    for _ in range(repetitions):
        begin = time.perf_counter()
        subdivide(volume)
        times.append(time.perf_counter() - begin)
    return 1e6 * min(times), 1e6 * statistics.median(times)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="CompareUpsampling")
    parser.add_argument("--size", type=int, default=250)
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--repetitions", type=int, default=5, help="in each round")
    parser.add_argument("--processor-time", action="store_true", help="of all threads: for a machine that is not idle")
    options = parser.parse_args()
    clock = time.process_time if options.processor_time else time.perf_counter

    print("4³ voxels, microseconds a call: least {:.0f}, median {:.0f}".format(*time_small_call()))
    volume = np.random.default_rng(0).integers(0, 2000, (options.size,) * 3, dtype=np.uint16)
    pairs = {"fresh": ([], []), "reused": ([], [])}
    for _ in range(options.rounds):
        ours = time_package(volume, options.threads, options.repetitions, clock)
        theirs = time_filter(
            options.program, options.size, options.threads, options.repetitions, options.processor_time
        )
        for memory, (package, cxx) in pairs.items():
            package += ours[memory]
            cxx += theirs[memory]
    print(f"{options.size}³ uint16, {options.threads} threads, seconds and Python's ratio to C++:")
    for memory, (package, cxx) in pairs.items():
        for name, function in (("least", min), ("median", statistics.median)):
            a, b = function(package), function(cxx)
            print(f"  {memory} memory, {name}: Python {a:.4f}, C++ {b:.4f}, ratio {a / b:.3f}")


if __name__ == "__main__":
    main()
