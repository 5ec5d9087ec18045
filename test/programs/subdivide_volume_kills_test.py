#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""SubdivideVolume killed: the old output is intact or the new one complete, and nothing else was touched.

    python3 test/programs/subdivide_volume_kills_test.py --kills 200 PROGRAM

kills so many runs at random moments and prints what became of them. With --calls, runs are also killed, by strace, at
each of the system calls with which they touch the folder of the output, and each of these calls fails in turn for want
of room. Without arguments, a short test of both with the program that the environment variable SUBDIVIDE_VOLUME
names."""

import argparse
import collections
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from subdivide_volume_faults import KINDS, Scene

SIGNALS = (signal.SIGTERM, signal.SIGINT, signal.SIGHUP)
WHO = ("both", "child", "watcher", *SIGNALS)

# The calls with which a run makes, changes and names files.
CALLS = ("openat", "mkdir", "write", "pwrite64", "ftruncate", "fallocate", "fsync", "chmod", "fchmod", "fchmodat",
         "link", "linkat", "rename", "renameat", "renameat2", "unlink", "unlinkat", "rmdir", "flock")


def find_children(process):
    try:
        with open(f"/proc/{process}/task/{process}/children", encoding="ascii") as file:
            return [int(word) for word in file.read().split()]
    except FileNotFoundError:
        return []


def kill(process, who):
    if who in SIGNALS:
        process.send_signal(who)
        return
    children = find_children(process.pid)
    for number in children if who == "child" else [process.pid] if who == "watcher" else [*children, process.pid]:
        try:
            os.kill(number, signal.SIGKILL)
        except ProcessLookupError:
            pass


def wait_for_end(numbers):
    """The child of a watcher that was killed dies a moment later."""
    for number in numbers:
        while True:
            try:
                with open(f"/proc/{number}/stat", encoding="ascii") as file:
                    if file.read().rsplit(")", 1)[1].split()[0] in "ZX":
                        break
            except (FileNotFoundError, ProcessLookupError):
                break
            time.sleep(0.001)


class RandomKills:
    """Kills at random moments of a run's time."""

    def __init__(self, program, folder, kinds, seed, size):
        self.random = random.Random(seed)
        self.scenes = {}
        for kind in kinds:
            os.mkdir(os.path.join(folder, kind))
            self.scenes[kind] = Scene(program, os.path.join(folder, kind), kind, size)
        self.times = {kind: self.measure(scene) for kind, scene in self.scenes.items()}
        self.counts = collections.Counter()

    @staticmethod
    def measure(scene):
        scene.prepare()
        start = time.monotonic()
        scene.run(*scene.get_command())
        return time.monotonic() - start

    def try_once(self, kind, who):
        """\\return what went wrong"""
        scene = self.scenes[kind]
        scene.prepare()
        process = subprocess.Popen(scene.get_command(), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(self.random.uniform(0, 1.1 * self.times[kind]))
        children = find_children(process.pid)
        kill(process, who)
        code = process.wait(timeout=60)
        wait_for_end(children)
        fault = scene.find_fault(code, who not in SIGNALS)
        state = "new" if scene.get_state() == scene.new else "old"
        left = "with files left" if scene.get_strays() else "with nothing left"
        self.counts["was over" if code == 0 else f"{state} output, {left}"] += 1
        return fault or scene.find_fault_of_next_run()


def find_calls(scene, calls):
    """The system calls that concern the folder of the output, each with its number among those of its thread."""
    trace = scene.saved + ".trace"
    scene.prepare()
    subprocess.run(["strace", "-f", "-y", "-s", "4096", "-e", f"trace={','.join(calls)}", "-o", trace,
                    *scene.get_command()], capture_output=True, check=True)
    counts, found = collections.Counter(), set()
    with open(trace, encoding="utf-8", errors="replace") as file:
        for line in file:
            match = re.match(r"(\d+) +(\w+)\(", line)
            if match:
                counts[match.groups()] += 1
                if scene.folder in line:
                    found.add((match.group(2), counts[match.groups()]))
    return sorted(found)


class FaultsAtCalls:
    """Faults at each of the calls of a run."""

    FAULTS = ("killed", "error=ENOSPC")

    def __init__(self, scene):
        self.scene = scene

    def try_once(self, call, number, fault):
        self.scene.prepare()
        what = "signal=SIGKILL" if fault == "killed" else fault
        command = ["strace", "-f", "-qq", "-o", "/dev/null", "-e", f"trace={call},wait4", "-e",
                   f"inject={call}:{what}:when={number}"]
        if fault == "killed":  # the watcher asks once before it waits
            command += ["-e", "inject=wait4:signal=SIGKILL:when=2+"]
        result = self.scene.run(*command, *self.scene.get_command())
        started = "error while loading shared libraries" not in result.stderr
        if started and result.returncode not in (0, 1, 2, -signal.SIGKILL, 128 + signal.SIGKILL):
            return f"exit code {result.returncode}: {result.stderr}"
        if result.returncode in (1, 2) and call != "write" and len(result.stderr.splitlines()) != 1:
            return f"not one line: {result.stderr}"
        # Where a call fails that renames or removes, something may be left as it is where the run is killed.
        was_killed = fault == "killed" or call in ("openat", "rename", "unlink", "unlinkat", "rmdir")
        return self.scene.find_fault(result.returncode, was_killed) or self.scene.find_fault_of_next_run()


class Kills(unittest.TestCase):
    def setUp(self):
        self.program = os.environ.get("SUBDIVIDE_VOLUME")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def test_at_random_moments(self):
        kinds = list(KINDS)[1::2]
        kills = RandomKills(self.program, self.folder, kinds, 1, 24)
        for number, kind in enumerate(kinds):
            who = WHO[number % len(WHO)]
            self.assertEqual(kills.try_once(kind, who), "", (kind, who))

    @unittest.skipUnless(shutil.which("strace"), "for want of strace")
    def test_where_the_output_gets_its_name(self):
        for kind in ("mhd", "hdr", "slices", "piece mhd"):
            folder = os.path.join(self.folder, kind)
            os.mkdir(folder)
            faults = FaultsAtCalls(Scene(self.program, folder, kind, 6))
            for call, number in find_calls(faults.scene, ("link", "rename", "renameat2")):
                for fault in FaultsAtCalls.FAULTS:
                    self.assertEqual(faults.try_once(call, number, fault), "", (kind, call, number, fault))


def kill_many(arguments, folder):
    kills = RandomKills(arguments.program, folder, arguments.kinds, arguments.seed, arguments.size)
    faults = 0
    for number in range(arguments.kills):
        kind, who = arguments.kinds[number % len(arguments.kinds)], kills.random.choice(WHO)
        fault = kills.try_once(kind, who)
        if fault:
            faults += 1
            print(f"{kind}, {getattr(who, 'name', who)} killed: {fault}")
    print(f"{arguments.kills} kills, {faults} faults: " +
          "; ".join(f"{count} {what}" for what, count in sorted(kills.counts.items())))
    return faults


def fail_at_calls(arguments, folder):
    runs = faults = 0
    for kind in arguments.kinds:
        own = os.path.join(folder, "calls " + kind)
        os.mkdir(own)
        at_calls = FaultsAtCalls(Scene(arguments.program, own, kind, 6))
        for call, number in find_calls(at_calls.scene, CALLS):
            for fault in FaultsAtCalls.FAULTS:
                runs += 1
                found = at_calls.try_once(call, number, fault)
                if found:
                    faults += 1
                    print(f"{kind}, {call} {number}, {fault}: {found}", flush=True)
    print(f"{runs} faults at system calls, {faults} with a wrong end")
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kills", type=int, default=0)
    parser.add_argument("--calls", action="store_true")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--size", type=int, default=64, help="of the input, along each axis")
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=list(KINDS))
    parser.add_argument("program")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        faults = kill_many(arguments, folder) if arguments.kills else 0
        faults += fail_at_calls(arguments, folder) if arguments.calls else 0
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        main()
    elif not os.environ.get("SUBDIVIDE_VOLUME"):
        raise SystemExit("SUBDIVIDE_VOLUME is not set")
    unittest.main()
