#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Says where NonOscillatorySubdivisionImageFilter spends its time, or its instructions, stage by stage, as Markdown.

Needs a CompareUpsampling with the module linked in statically, debug information and fixed addresses (see README.md),
and the programs perf or valgrind, objdump and addr2line."""

import argparse
import json
import re
import subprocess
import sys
import tempfile
from collections import Counter, defaultdict
from pathlib import Path

# An instruction belongs to the stage of the innermost function, inlined or not, that is named here.
STAGES = {
    "read rows": r"RowReader|::Widen|::ScaleRow",
    "write rows": r"RowWriter|InterleaveChildren|NonTemporalWriter|::CopyLines",
    "local range": r"LocalRange|::Bound\b",
    "restoration": r"Restoration|Sharpening|Restore\b",
    "pass along x": r"::FilterAlongX",
    "pass along y": r"::FilterAlongY",
    "limited differences": r"InPlaneDifferences|SweepDifferences",
    "pass along z": r"::FilterAlongZ",
    "sweep": r"\w+Sweep<",
    "tiles": r"Subdivider|SubdivisionProgress",
}
ELSEWHERE = "elsewhere"
LANES = {"zmm": 16, "ymm": 8, "xmm": 4}
# Packed arithmetic of AVX and SSE; loads, stores, moves and shuffles are none.
ARITHMETIC = re.compile(
    r"v?(add|sub|mul|fn?m(add|sub)\d+|min|max|andn?|x?or|sqrt|cmp\w*|cvt\w+|rndscale|round|blendv?)p[sd]$"
    r"|vp?(add|sub|mul\w*|min|max|and|andn|or|xor|ternlog|sll|srl|sra|cmp\w+|blendv|pack)\w*$"
)
MOVES = re.compile(r"v?(mov|p?broadcast|p?unpck|punpck|shuf|perm|pack|pmov|insert|extract|align|p?blend)")


def run(command, **options):
    try:
        return subprocess.run(command, check=True, text=True, capture_output=True, **options).stdout
    except FileNotFoundError:
        sys.exit(f"{command[0]}: not found")
    except subprocess.CalledProcessError as error:
        last_line = (error.stderr.strip().splitlines() or ["no message"])[-1]
        sys.exit(f"{command[0]} ended with {error.returncode}: {last_line}")


def benchmark_command(arguments, repetitions):
    row = rf"^{arguments.scheme}/{arguments.pixel}/.*/reused"
    return [
        arguments.program,
        f"--size={arguments.size}",
        f"--pixel={arguments.pixel}",
        "--threads=1",
        f"--repetitions={repetitions}",
        f"--benchmark_filter={row}",
    ]


def sample_addresses(arguments):
    """Samples of the processor clock by address; those in shared libraries and in the system under None."""
    with tempfile.TemporaryDirectory() as folder:
        data = str(Path(folder, "perf.data"))
        run(["perf", "record", "-q", "-e", "cpu-clock", "-F", "2000", "-o", data]
            + benchmark_command(arguments, arguments.repetitions))
        lines = run(["perf", "script", "-i", data, "-F", "ip,dso"]).splitlines()
    weights = Counter()
    program = Path(arguments.program).resolve()
    for line in lines:
        address, _, owner = line.strip().partition(" ")
        in_program = owner.strip(" ()") == str(program)
        weights[int(address, 16) if in_program else None] += 1
    return weights


def count_addresses(arguments):
    """Executed instructions of the timed updates by address, those in shared libraries under None; and how many updates
    these were."""
    with tempfile.TemporaryDirectory() as folder:
        data = Path(folder, "callgrind.out")
        results = Path(folder, "results.json")
        run(["valgrind", "--tool=callgrind", "--dump-instr=yes", "--compress-strings=no", "--compress-pos=no",
             "--collect-atstart=no", "--toggle-collect=subdivision_benchmark::UpdateTimer::Time*",
             f"--callgrind-out-file={data}"] + benchmark_command(arguments, 1) + [f"--benchmark_out={results}"])
        lines = data.read_text(encoding="utf-8").splitlines()
        updates = sum(row["iterations"] for row in json.loads(results.read_text(encoding="utf-8"))["benchmarks"])
    weights = Counter()
    owner = ""
    program = Path(arguments.program).resolve()
    is_call = False
    for line in lines:
        if line.startswith("ob="):
            owner = line[3:]
        elif line.startswith("calls="):
            is_call = True
        elif line.startswith("0x"):
            # The line after calls= holds the cost of the call, which is counted where it arises.
            if not is_call:
                address, _, cost = line.split()
                weights[int(address, 16) if owner == str(program) else None] += int(cost)
            is_call = False
    return weights, updates


def find_stages(program, addresses):
    """The stage of every address."""
    addresses = sorted(addresses)
    text = "\n".join(hex(address) for address in addresses)
    lines = run(["addr2line", "-a", "-f", "-i", "-C", "-e", program], input=text).splitlines()
    stages = {}
    address = None
    for line in lines:
        if re.fullmatch(r"0x[0-9a-f]+", line):
            address = int(line, 16)
            stages[address] = ELSEWHERE
        elif stages[address] == ELSEWHERE:
            for stage, pattern in STAGES.items():
                if re.search(pattern, line):
                    stages[address] = stage
                    break
    return stages


def classify_instruction(text):
    """("arithmetic", lanes), ("moves", lanes) or ("scalar", 1) of one disassembled instruction."""
    mnemonic = text.split()[0]
    lanes = max((LANES[register] for register in LANES if f"%{register}" in text), default=0)
    if lanes and ARITHMETIC.match(mnemonic):
        return "arithmetic", lanes
    if lanes and MOVES.match(mnemonic):
        return "moves", lanes
    return "scalar", 1


def disassemble(program):
    instructions = {}
    for line in run(["objdump", "-d", "--no-show-raw-insn", program]).splitlines():
        address, colon, text = line.partition(":\t")
        if colon and text:
            instructions[int(address, 16)] = classify_instruction(text)
    return instructions


def print_table(header, rows):
    print("| " + " | ".join(header) + " |")
    print("|---|" + "---:|" * (len(header) - 1))
    for row in rows:
        print("| " + " | ".join(row) + " |")


def print_times(arguments):
    weights = sample_addresses(arguments)
    stages = find_stages(arguments.program, [address for address in weights if address is not None])
    samples = Counter()
    for address, weight in weights.items():
        samples[stages.get(address, ELSEWHERE)] += weight
    elsewhere = samples.pop(ELSEWHERE, 0)
    total = sum(samples.values())
    if total == 0:
        sys.exit(f"{arguments.program}: no sample in the filter")
    rows = [[stage, f"{100 * samples[stage] / total:.1f} %"] for stage in STAGES if samples[stage]]
    print_table(["stage", "time"], rows)
    print(f"\n{total} samples in the filter, {elsewhere} elsewhere (setting up, the system)")


def print_instructions(arguments):
    weights, updates = count_addresses(arguments)
    addresses = [address for address in weights if address is not None]
    stages = find_stages(arguments.program, addresses)
    instructions = disassemble(arguments.program)
    voxels = updates * arguments.size**3
    counts = defaultdict(Counter)
    for address, weight in weights.items():
        stage = stages.get(address, ELSEWHERE)
        kind, lanes = instructions.get(address, ("scalar", 1))
        counts[stage][kind] += weight
        if kind == "arithmetic":
            counts[stage]["lane operations"] += lanes * weight
    kinds = ["lane operations", "arithmetic", "moves", "scalar"]
    counts["all"] = sum(counts.values(), Counter())
    rows = [
        [stage] + [f"{counts[stage][kind] / voxels:.1f}" for kind in kinds]
        for stage in [*STAGES, ELSEWHERE, "all"]
        if counts[stage]
    ]
    print_table(["stage", "lane operations a voxel", "vector arithmetic", "vector moves", "other"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["time", "instructions"])
    parser.add_argument("program", help="CompareUpsampling")
    parser.add_argument("--scheme", default="NonOscillatory", help="the row to profile (default: %(default)s)")
    parser.add_argument("--pixel", default="ushort", help="default: %(default)s")
    parser.add_argument("--size", type=int, default=128, help="edge of the volume in voxels (default: %(default)s)")
    parser.add_argument("--repetitions", type=int, default=20, help="of the timed update (default: %(default)s)")
    arguments = parser.parse_args()
    print_times(arguments) if arguments.what == "time" else print_instructions(arguments)


if __name__ == "__main__":
    main()
