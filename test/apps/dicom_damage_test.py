# SPDX-License-Identifier: Apache-2.0
"""Damaged DICOM files, on which the library may abort; WATCHED_PROGRAM holds the path of a program that reads one."""

import os
import random
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "programs"))
from subdivide_volume_files import write_dicom_slice  # noqa: E402

PROGRAM = os.environ.get("WATCHED_PROGRAM")


class Damage(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        for number in range(3):
            write_dicom_slice(self.path(number), "1.2.3.4", number, [8, 6], list(range(48)), [1, 1, 1])
        with open(self.path(1), "rb") as file:
            self.content = file.read()

    def path(self, number):
        return os.path.join(self.folder, f"slice{number}.dcm")

    def read(self, content):
        """Reads the series after the second slice was replaced."""
        with open(self.path(1), "wb") as file:
            file.write(content)
        return subprocess.run([PROGRAM, "dicom", self.folder], capture_output=True, text=True, check=False, timeout=100)

    def test_a_whole_series_is_read(self):
        result = self.read(self.content)
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_a_truncated_file_is_named_wherever_it_ends(self):
        for size in [*range(0, len(self.content), 7), len(self.content) - 1]:
            result = self.read(self.content[:size])
            with self.subTest(size=size):
                self.assertEqual((result.returncode, result.stdout), (1, ""))
                self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
                self.assertIn("slice1.dcm", result.stderr)
                self.assertNotRegex(result.stderr, r"gdcm|[ch]xx|Assertion")

    def test_a_file_of_its_first_letters_alone_is_damaged(self):
        self.assertIn("the DICOM file is damaged", self.read(self.content[:132]).stderr)

    def test_damaged_bytes_end_in_one_line_or_not_at_all(self):
        source = random.Random(3)
        for _ in range(60):
            content = bytearray(self.content)
            for _ in range(4):
                content[source.randrange(132, 470)] = source.randrange(256)
            result = self.read(bytes(content))
            self.assertIn(result.returncode, (0, 1), result.stderr)
            self.assertEqual(result.stderr.count("\n"), result.returncode, result.stderr)


if __name__ == "__main__":
    unittest.main()
