# SPDX-License-Identifier: Apache-2.0
"""Runs SubdivideVolume; the environment variable SUBDIVIDE_VOLUME holds the path of the program."""

import os
import random
import re
import subprocess
import tempfile
import unittest

from subdivide_volume_files import Meta

PROGRAM = os.environ.get("SUBDIVIDE_VOLUME")


def skip_under_sanitizers(test, why="sanitizers take memory of their own"):
    with open(os.environ["SUBDIVIDE_VOLUME"], "rb") as file:
        if re.search(b"__(asan|tsan)_init", file.read()):
            test.skipTest(why)


def noise(count, low=0, high=1000, seed=1):
    source = random.Random(seed)
    return [source.randrange(low, high) for _ in range(count)]


class ProgramTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_program(self, *arguments, **keywords):
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False,
                              timeout=600, **keywords)

    def subdivide(self, input_name, output_name, *arguments):
        """Runs the program, which must succeed, leave nothing but its output behind, and say nothing but what a format
        cannot hold."""
        before = set(os.listdir(self.folder))
        result = self.run_program(self.path(input_name), self.path(output_name), *arguments)
        said = re.findall(r"SubdivideVolume: (?!warning: .*(holds no|cannot hold|changes the values of voxels))", result.stderr)
        self.assertEqual((result.returncode, len(said)), (0, 0), result.stderr)
        self.assertFalse([name for name in set(os.listdir(self.folder)) - before if "partial" in name])
        return result

    def meta(self, input_name, output_name, *arguments):
        self.subdivide(input_name, output_name, *arguments)
        return Meta(self.path(output_name))

    def assert_fails(self, result, code, *words):
        """One line on stderr that holds the words; nothing else, anywhere."""
        self.assertEqual(result.returncode, code, result.stderr)
        lines = [line for line in result.stderr.splitlines() if not re.fullmatch(r"\d+ %", line)]
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertTrue(lines[0].startswith("SubdivideVolume: "), lines[0])
        for word in words:
            self.assertIn(word, lines[0])
        left = [name for name in os.listdir(self.folder) if name.startswith((".", "out"))]
        for name in left:
            os.remove(self.path(name))
        self.assertEqual(left, [])
