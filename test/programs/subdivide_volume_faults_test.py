#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""SubdivideVolume where the system fails it: disks, limits, folders and streams. The old output is intact or the new
one complete, nothing else was touched, and the exit code is 0 only where the output is complete.

    python3 test/programs/subdivide_volume_faults_test.py --steps 20 PROGRAM

tries so many sizes and limits for each kind of output and prints how many; without arguments, a few with the program
that the environment variable SUBDIVIDE_VOLUME names."""

import argparse
import os
import random
import resource
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest

from subdivide_volume_case import skip_under_sanitizers
from subdivide_volume_faults import KINDS, Scene

STEPS = int(os.environ.get("FAULT_STEPS", "2"))
RUNS = []


def spread(low, high):
    """Numbers from low to high, evenly on a scale of ratios."""
    return sorted({round(low * (high / low) ** (i / max(STEPS - 1, 1))) for i in range(STEPS)})


class Faults(unittest.TestCase):
    def setUp(self):
        self.program = os.environ["SUBDIVIDE_VOLUME"]
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    @staticmethod
    def get_kinds(first):
        """In a short test, a sixth of them for each fault."""
        return list(KINDS) if STEPS >= 5 else list(KINDS)[first::6]

    def make_scene(self, kind, **arguments):
        folder = os.path.join(self.folder, kind)
        os.makedirs(folder, exist_ok=True)
        return Scene(self.program, folder, kind, **arguments)

    def hit(self, scene, what, *more, prepare=True, **keywords):
        """One run under a fault, and the one after it."""
        if prepare:
            scene.prepare()
        result = subprocess.run(scene.get_command(*more), capture_output=True, text=True, check=False, timeout=120,
                                **keywords)
        if "error while loading shared libraries" in result.stderr:
            return result  # it did not even start
        RUNS.append((self.id().split(".")[-1], result.returncode))
        self.assertIn(result.returncode, (0, 1, 2), (scene.kind, what, result.stderr))
        self.assertEqual(scene.find_fault(result.returncode), "", (scene.kind, what, result.stderr))
        return result

    def assert_told(self, result, what):
        """A failure is told in one line, and so is that something was not kept."""
        self.assertEqual(result.returncode, 1, what)
        lines = [line for line in result.stderr.splitlines() if ": warning: " not in line]
        self.assertEqual(len(lines), 1, (what, result.stderr))
        self.assertTrue(lines[0].startswith("SubdivideVolume: "), (what, lines))

    def test_the_disk_is_full(self):
        disk = os.path.join(self.folder, "disk")
        os.mkdir(disk)
        for kind in self.get_kinds(0):
            scene = self.make_scene(kind)
            needed = sum(os.path.getsize(os.path.join(root, name)) for root, _, names in os.walk(scene.saved)
                         for name in names)
            scene.folder = disk
            for size in spread(needed + 100000, 2 * needed + 200000):
                mount = ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", disk]
                if os.geteuid() != 0 or subprocess.run(mount, capture_output=True, check=False).returncode != 0:
                    self.skipTest("only root may mount a small disk")
                try:
                    if not self.fits(scene):
                        continue
                    result = self.hit(scene, size, prepare=False)
                    if result.returncode != 0:
                        self.assert_told(result, (kind, size))
                finally:
                    subprocess.run(["umount", disk], check=True)

    @staticmethod
    def fits(scene):
        """Whether the disk has room for what is there before the run."""
        try:
            scene.prepare()
        except (AssertionError, OSError, shutil.Error):
            return False
        return True

    def test_a_file_may_not_grow(self):
        for kind in self.get_kinds(1):
            scene = self.make_scene(kind)
            for size in spread(500, 260000):
                result = self.hit(scene, size, preexec_fn=self.limit(resource.RLIMIT_FSIZE, size))
                if result.returncode != 0:
                    self.assertLessEqual(len([line for line in result.stderr.splitlines() if "warning" not in line]), 1)

    @staticmethod
    def limit(what, value):
        return lambda: resource.setrlimit(what, (value, value))

    def test_memory_is_short(self):
        skip_under_sanitizers(self)
        for kind in self.get_kinds(2):
            scene = self.make_scene(kind)
            for size in spread(150 << 20, 600 << 20):
                result = self.hit(scene, size, preexec_fn=self.limit(resource.RLIMIT_AS, size))
                if result.returncode != 0 and "shared libraries" not in result.stderr:
                    self.assertIn("memory", result.stderr, (kind, size))
            result = self.hit(scene, "--memory", "--memory", "1K")
            self.assert_told(result, kind)
            self.assertIn("--memory", result.stderr)

    def test_files_cannot_be_opened(self):
        skip_under_sanitizers(self, "sanitizers open pipes of their own")
        for kind in self.get_kinds(3):
            scene = self.make_scene(kind)
            for number in (7, 12) if STEPS < 5 else range(3, 3 + STEPS):
                self.hit(scene, number, preexec_fn=self.limit(resource.RLIMIT_NOFILE, number))

    def test_streams_are_closed(self):
        """The first files that are opened then have the numbers of the streams, and must not get what is printed."""
        for kind in self.get_kinds(4):
            scene = self.make_scene(kind)
            for closed in ((0, 1, 2), (1,), (2,), (1, 2))[:max(1, STEPS)]:
                scene.options = [option for option in scene.options if option != "--quiet"]
                command = " ".join(f"{number}>&-" if number else "<&-" for number in closed)
                scene.prepare()
                result = subprocess.run(["sh", "-c", f'exec "$@" {command}', "sh", *scene.get_command()], check=False,
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=120)
                RUNS.append(("streams", result.returncode))
                self.assertEqual((result.returncode, scene.find_fault(0)), (0, ""), (kind, closed))

    def test_the_folder_vanishes(self):
        """It is renamed or removed, and perhaps another one stands there, in the middle of the run."""
        source = random.Random(1)
        for kind in self.get_kinds(5):
            scene = self.make_scene(kind, size=40)
            moved = scene.folder + "-moved"
            for way in ("rename", "replace", "remove") * max(1, STEPS // 3):
                scene.prepare()
                process = subprocess.Popen(scene.get_command(), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                time.sleep(source.uniform(0, 0.1))
                if way == "remove":
                    shutil.rmtree(scene.folder, ignore_errors=True)
                else:
                    os.rename(scene.folder, moved)
                if way == "replace":
                    os.mkdir(scene.folder)
                    with open(os.path.join(scene.folder, "precious"), "wb"):
                        pass
                code = process.wait(timeout=120)
                RUNS.append(("vanishes", code))
                self.assertIn(code, (0, 1), (kind, way))
                if way != "remove":
                    target, scene.folder = scene.folder, moved
                    # What a run keeps beside its output moves with the folder, out of its reach.
                    fault = scene.find_fault(1, was_killed=True)
                    scene.folder = target
                    if way == "replace" and fault == "":
                        self.assertLessEqual({"precious"}, set(os.listdir(target)))
                    self.assertEqual(fault, "", (kind, way))
                shutil.rmtree(moved, ignore_errors=True)
                shutil.rmtree(scene.folder, ignore_errors=True)

    def test_a_folder_that_must_not_be_written(self):
        """Nor must the files in it."""
        if os.geteuid() == 0 and not self.may_become_nobody():
            self.skipTest("root may write everywhere, and cannot become another user here")
        as_user = {"user": 65534} if os.geteuid() == 0 else {}
        os.chmod(self.folder, 0o755)
        for kind in self.get_kinds(0):
            scene = self.make_scene(kind)
            scene.prepare()
            for root, folders, names in os.walk(scene.folder):
                for name in names:
                    os.chmod(os.path.join(root, name), 0o444)
            os.chmod(scene.folder, 0o555)
            result = self.hit(scene, "locked", prepare=False, **as_user)
            os.chmod(scene.folder, 0o755)
            self.assert_told(result, kind)
            self.assertIn("ermission", result.stderr, kind)

    @unittest.skipUnless(shutil.which("strace"), "for want of strace")
    def test_a_file_written_in_place_that_does_not_reach_the_disk(self):
        """It is not the old output any more, and must not be taken for the new one."""
        if os.geteuid() == 0 and not self.may_become_nobody():
            self.skipTest("root may write everywhere, and cannot become another user here")
        as_user = {"user": 65534} if os.geteuid() == 0 else {}
        os.chmod(self.folder, 0o755)
        scene = self.make_scene("mha")
        for number, code in (1, 1), (2, 1), (3, 0):  # the temporary file, what it is copied over, none
            scene.prepare()
            os.chmod(scene.output, 0o666)
            os.chmod(scene.folder, 0o555)
            file = os.stat(scene.output).st_ino
            command = ["strace", "-f", "-qq", "-o", "/dev/null", "-e", "trace=fsync", "-e",
                       f"inject=fsync:error=EIO:when={number}", *scene.get_command()]
            result = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120, **as_user)
            os.chmod(scene.folder, 0o755)
            self.assertEqual(result.returncode, code, (number, result.stderr))
            self.assertEqual(os.stat(scene.output).st_ino, file, number)
            self.assertEqual("Input/output error" in result.stderr, code == 1, (number, result.stderr))
            self.assertEqual(scene.get_state(), scene.old if number == 1 else scene.new, number)

    @staticmethod
    def may_become_nobody():
        return subprocess.run([os.environ["SUBDIVIDE_VOLUME"], "--version"], user=65534, capture_output=True,
                              check=False).returncode == 0

    def test_another_file_system(self):
        if os.stat("/dev/shm").st_dev == os.stat(self.folder).st_dev:
            self.skipTest("there is one file system only")
        with tempfile.TemporaryDirectory(dir="/dev/shm") as other:
            for kind in self.get_kinds(1):
                scene = self.make_scene(kind, target=os.path.join(other, "target"))
                self.assertEqual(self.hit(scene, "other disk").returncode, 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("program")
    arguments, rest = parser.parse_known_args()
    os.environ["SUBDIVIDE_VOLUME"] = os.path.abspath(arguments.program)
    globals()["STEPS"] = arguments.steps
    failed = not unittest.main(argv=[sys.argv[0], *rest], exit=False).result.wasSuccessful()
    codes = [code for _, code in RUNS]
    complete = codes.count(0)
    print(f"{len(codes)} runs under faults: {complete} complete, {len(codes) - complete} failed and said so")
    sys.exit(failed)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        main()
    elif not os.environ.get("SUBDIVIDE_VOLUME"):
        raise SystemExit("SUBDIVIDE_VOLUME is not set")
    unittest.main()
