#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What pieces of an output cost: constants measured with SubdivideVolume on this machine, and what follows for volumes
of 2048 and 8192 voxels along each axis.

    python3 benchmark/piece_costs.py [--pieces 16] [--threads 8] [--bandwidth 2e9] PROGRAM

Processor time is measured, not time, so that a busy machine does not matter much. The bandwidth is that of the shared
file system, in bytes a second; it is the reader's to fill in."""

import argparse
import json
import os
import random
import resource
import subprocess
import tempfile

HALO = 5  # voxels that a piece reads beyond its own on either side
TYPE_BYTES = 2


def run_piece(program, folder, size):
    """Processor seconds of a run that makes all of an output as one piece."""
    source, target = os.path.join(folder, "in.raw"), os.path.join(folder, "out.mha")
    with open(source, "wb") as file:
        file.write(random.Random(1).randbytes(TYPE_BYTES * size ** 3))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([program, "--piece", "1/1", "--raw", f"{size}x{size}x{size}:uint16", "--threads", "1", "--quiet",
                    source, target], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    os.remove(target)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measure(program, folder):
    """Processor seconds to start and end, and for each voxel of the output."""
    small, large = 8, 160
    start = min(run_piece(program, folder, small) for _ in range(5))
    whole = min(run_piece(program, folder, large) for _ in range(3))
    return start, (whole - start) / (2 * large) ** 3


def find_memory(program, folder, size, threads, budget):
    """Bytes that a process takes within a budget, as the program plans it; the file has a size, and no bytes."""
    source = os.path.join(folder, "empty.raw")
    with open(source, "wb") as file:
        file.truncate(TYPE_BYTES * size ** 3)
    result = subprocess.run([program, "--info", "--json", "--raw", f"{size}x{size}x{size}:uint16", "--threads",
                             str(threads), "--memory", budget, source, os.path.join(folder, "out.mha")],
                            capture_output=True, text=True, check=False)
    os.remove(source)
    return json.loads(result.stdout)["memory_bytes"] if result.returncode == 0 else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pieces", type=int, nargs="+", default=[1, 16, 64, 256])
    parser.add_argument("--threads", type=int, default=8)
    parser.add_argument("--bandwidth", type=float, default=2e9)
    parser.add_argument("program")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        start, voxel = measure(arguments.program, folder)
        print(f"start and end of a process: {start:.3f} s of a core; each voxel of the output: {voxel * 1e9:.2f} ns "
              "of a core\n")
        print("| input | pieces | each reads | each writes | memory with --memory 4G | computing | the files | a run |")
        print("|---|---|---|---|---|---|---|---|")
        for size in (2048, 8192):
            memory = find_memory(arguments.program, folder, size, arguments.threads, "4G")
            for pieces in arguments.pieces:
                planes = min(size, size / pieces + (2 * HALO if pieces > 1 else 0))
                reads = TYPE_BYTES * size ** 2 * planes
                writes = TYPE_BYTES * (2 * size) ** 3 / pieces
                computing = start + voxel * (2 * size) ** 3 / pieces / arguments.threads
                # What was written is read again, for the checksum.
                files = pieces * (reads + 2 * writes) / arguments.bandwidth
                print(f"| {size}³ | {pieces} | {reads / 1e9:.1f} GB | {writes / 1e9:.1f} GB | "
                      f"{'does not fit' if memory is None else f'{memory / 1e9:.1f} GB'} | {computing:.0f} s | "
                      f"{files:.0f} s | {max(computing, files):.0f} s |")


if __name__ == "__main__":
    main()
