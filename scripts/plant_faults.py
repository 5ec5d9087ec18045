#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plants small faults in the sources, one at a time, and shows that each makes a test fail.

The sources are copied into a temporary folder; the project itself is not touched. Each fault of test/faults/faults.py
replaces one text that stands in one file exactly once. What is built and run is test/faults/CMakeLists.txt: the tests
that need no ITK and, for faults in the filter, a few of the filter's. Prints a table of the faults and of the first test
that caught each. Ends with 1 if a fault survives, or if a text is no longer there.

    scripts/plant_faults.py                 all faults
    scripts/plant_faults.py mask limit      those whose names contain one of the words
    scripts/plant_faults.py --check         only whether every text stands in its file exactly once
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "test" / "faults"))
sys.dont_write_bytecode = True

from faults import FAULTS, Fault  # noqa: E402  (the path is set above)

COPIED = ("cmake", "include", "src", "test")
LONGEST_TEST = 1200  # seconds; a fault may make a loop endless
CASES = "60"  # of each generated test, unless the environment says otherwise: fewer than its own number, for speed
FAILED_TEST = re.compile(r"^\[  FAILED  \] ([\w/.]+)", re.MULTILINE)


class Outcome(NamedTuple):
    """What became of a fault."""

    fault: Fault
    caught_by: str
    seconds: float


def misplaced(root: Path) -> list[str]:
    """The faults whose text does not stand in its file exactly once, one line for each."""
    found = []
    for fault in FAULTS:
        path = root / fault.file
        count = path.read_text(encoding="utf-8").count(fault.text) if path.is_file() else 0
        if count != 1 or fault.text == fault.replacement:
            found.append(f"{fault.name}: its text stands {count} times in {fault.file}, but must once: {fault.text!r}")
    return found


def build(folder: Path, target: str, jobs: int) -> subprocess.CompletedProcess[str]:
    """Builds a target of the copy."""
    command = ["cmake", "--build", str(folder / "build"), "--parallel", str(jobs), "--target", target]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def run_tests(folder: Path, target: str) -> str:
    """The first test that fails, or nothing."""
    command = [str(folder / "build" / target), "--gtest_fail_fast", "--gtest_brief=1"]
    environment = {"SUBDIVISION_CASES": CASES, **os.environ}
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=LONGEST_TEST,
                              env=environment)
    except subprocess.TimeoutExpired:
        return f"no end within {LONGEST_TEST} s"
    if done.returncode == 0:
        return ""
    failed = FAILED_TEST.search(done.stdout)
    return failed.group(1) if failed else f"the tests end with {done.returncode}"


def plant(folder: Path, fault: Fault, jobs: int) -> Outcome:
    """Plants a fault in the copy, builds and tests it, and takes the fault out again."""
    begin = time.monotonic()
    path = folder / fault.file
    right = path.read_text(encoding="utf-8")
    path.write_text(right.replace(fault.text, fault.replacement), encoding="utf-8")
    try:
        built = build(folder, fault.target, jobs)
        if built.returncode != 0:
            sys.exit(f"plant_faults.py: the fault {fault.name!r} does not compile:\n{built.stdout[-3000:]}")
        caught_by = run_tests(folder, fault.target)
    finally:
        path.write_text(right, encoding="utf-8")
    return Outcome(fault, caught_by, time.monotonic() - begin)


def prepare(folder: Path, targets: set[str], jobs: int) -> None:
    """Copies the sources, builds them as they are, and has all tests pass."""
    for name in COPIED:
        shutil.copytree(ROOT / name, folder / name)
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    has_filter = f"-DFaults_HAVE_FILTER={'ON' if 'FilterTests' in targets else 'OFF'}"
    source = str(folder / "test" / "faults")
    subprocess.run(["cmake", "-S", source, "-B", str(folder / "build"), *generator, *launcher, has_filter],
                   check=True, stdout=subprocess.DEVNULL)
    for target in sorted(targets):
        built = build(folder, target, jobs)
        if built.returncode != 0:
            sys.exit(f"plant_faults.py: {target} does not compile without a fault:\n{built.stdout[-3000:]}")
        failed = run_tests(folder, target)
        if failed:
            sys.exit(f"plant_faults.py: without any fault, {target} fails already: {failed}")


def main() -> int:
    """The program."""
    parser = argparse.ArgumentParser(description="Plants small faults, one at a time; each must make a test fail.")
    parser.add_argument("words", nargs="*", help="only the faults whose names contain one of these words")
    parser.add_argument("--check", action="store_true", help="only check that each fault's text stands in its file once")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="compilers at once")
    arguments = parser.parse_args()

    lines = misplaced(ROOT)
    for line in lines:
        print(f"plant_faults.py: {line}", file=sys.stderr)
    if lines or arguments.check:
        return 1 if lines else 0
    words = arguments.words or [""]
    chosen = [fault for fault in FAULTS if any(word in fault.name for word in words)]
    outcomes = []
    with tempfile.TemporaryDirectory(prefix="plant_faults-") as temporary:
        folder = Path(temporary)
        prepare(folder, {fault.target for fault in chosen}, arguments.jobs)
        print("| fault | caught by |\n|---|---|", flush=True)
        for fault in chosen:
            outcome = plant(folder, fault, arguments.jobs)
            outcomes.append(outcome)
            print(f"| {fault.name} | {outcome.caught_by or '**survives**'} |", flush=True)
    survivors = [outcome.fault.name for outcome in outcomes if not outcome.caught_by]
    print(f"\n{len(outcomes) - len(survivors)} of {len(outcomes)} faults caught")
    return 1 if survivors or not outcomes else 0


if __name__ == "__main__":
    sys.exit(main())
