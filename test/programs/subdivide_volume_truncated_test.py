#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""SubdivideVolume on inputs that end too early, from the start or while they are read: they are refused, or what was
read was all there. --places N PROGRAM tries so many places for each format; without arguments, a few with the program
that the environment variable SUBDIVIDE_VOLUME names."""

import os
import random
import shutil
import subprocess
import sys
import time
import unittest

import subdivide_volume_case
from subdivide_volume_case import ProgramTest, noise
from subdivide_volume_files import write_dicom_slice, write_meta

PLACES = 1
COUNTS = {"truncated": 0, "truncated where nothing is needed": 0, "shrunk, refused": 0, 
          "shrunk, read before": 0}

# What is cut, of the file that is given.
FORMATS = {"in.mha": "in.mha", "packed.mha": "packed.mha", "in.mhd": "in.raw", "packed.mhd": "packed.zraw",
           "in.nrrd": "in.nrrd", "packed.nrrd": "packed.nrrd", "apart.nhdr": "apart.raw", "more.nhdr": "more.raw.gz",
           "in.nii": "in.nii", "in.nii.gz": "in.nii.gz", "pair.hdr": "pair.img", "in.tif": "in.tif",
           "packed.tif": "packed.tif", "in.vtk": "in.vtk", "in.hdf5": "in.hdf5", "in.gipl": "in.gipl",
           "in.mrc": "in.mrc", "slices": "slices/slices_0003.tif", "dicom": "dicom/4.dcm"}
PACKED = ("packed.mha", "packed.mhd", "packed.nrrd", "more.nhdr", "packed.tif")
# Headers are texts or have more than one part; all of them are cut here, and what belongs to them is whole.
HEADERS = ("in.mhd", "apart.nhdr", "pair.hdr")


class Truncated(ProgramTest):
    def make_input(self, name, size=12):
        if name == "dicom":
            os.mkdir(self.path("dicom"))
            for number in range(6):
                write_dicom_slice(self.path(f"dicom/{number}.dcm"), "1.2.3.4", number, [size, size],
                                  noise(size * size, -1000, 1000, number), [1, 1, 2])
            return
        write_meta(self.path("plain.mha"), [size] * 3, "h", noise(size ** 3))
        if name == "in.mha":
            os.rename(self.path("plain.mha"), self.path(name))
            return
        more = ["--compress"] if name in PACKED else []
        target = "slices/" if name == "slices" else name
        result = self.run_program(self.path("plain.mha"), self.path(target), "--axes", "x", "--quiet", *more)
        self.assertEqual(result.returncode, 0, result.stderr)

    def assert_refused(self, name, good):
        """Unless what is missing is needed for nothing, such as the name of the program that wrote the file."""
        with open(self.path("old.mha"), "wb") as file:
            file.write(b"precious")
        result = self.run_program(self.path(name), self.path("old.mha"), "--quiet")
        COUNTS["truncated"] += 1
        if result.returncode == 0:
            COUNTS["truncated where nothing is needed"] += 1
            with open(self.path("old.mha"), "rb") as file:
                self.assertTrue(file.read() == good)
            return
        self.assert_fails(result, 1)
        with open(self.path("old.mha"), "rb") as file:
            self.assertEqual(file.read(), b"precious")

    def get_places(self, size):
        """The empty file, the first byte, places all over it, and all but the last byte."""
        source = random.Random(size)
        inner = [round((size - 2) * (i + source.random()) / PLACES) + 1 for i in range(PLACES)]
        return sorted({0, 1, size // 2, size - 1, *inner}) if PLACES > 1 else [1, size // 2, size - 1]

    def test_at_all_places(self):
        for name, cut in [*FORMATS.items(), *[(header, header) for header in HEADERS]]:
            self.setUp()
            self.make_input(name)
            path = self.path(cut)
            with open(path, "rb") as file:
                content = file.read()
            # A text may lack the end of its last line.
            size = len(content.rstrip()) if name == cut and name in HEADERS else len(content)
            self.assertEqual(self.run_program(self.path(name), self.path("whole.mha"), "--quiet").returncode, 0)
            with open(self.path("whole.mha"), "rb") as file:
                good = file.read()
            for place in self.get_places(size):
                with open(path, "wb") as file:
                    file.write(content[:place])
                with self.subTest(file=cut, bytes=place, of=size):
                    self.assert_refused(name, good)

    def test_while_they_are_read(self):
        source = random.Random(1)
        for name, cut in FORMATS.items():
            if name in ("dicom", "in.vtk", "in.gipl"):
                continue
            self.setUp()
            self.make_input(name, 48)
            command = [subdivide_volume_case.PROGRAM, self.path(name), self.path("out.mha"), "--quiet", "--streams",
                       "24", "--threads", "1"]
            path = self.path(cut)
            shutil.copy(path, self.path("whole"))
            start = time.monotonic()
            subprocess.run(command, check=True)
            duration = time.monotonic() - start
            with open(self.path("out.mha"), "rb") as file:
                good = file.read()
            for _ in range(max(1, PLACES // 4)):
                shutil.copy(self.path("whole"), path)
                if os.path.exists(self.path("out.mha")):
                    os.remove(self.path("out.mha"))
                process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
                time.sleep(source.uniform(0, 0.8 * duration))
                os.truncate(path, source.randrange(os.path.getsize(path)))
                text = process.communicate(timeout=120)[1]
                with self.subTest(file=cut):
                    if process.returncode == 0:
                        COUNTS["shrunk, read before"] += 1
                        with open(self.path("out.mha"), "rb") as file:
                            self.assertTrue(file.read() == good)
                    else:
                        COUNTS["shrunk, refused"] += 1
                        self.assertEqual((process.returncode, len(text.splitlines())), (1, 1), text)
                        self.assertFalse([entry for entry in os.listdir(self.folder) if entry.startswith((".", "out"))])


if __name__ == "__main__":
    if len(sys.argv) > 3 and sys.argv[1] == "--places":
        PLACES = int(sys.argv[2])
        subdivide_volume_case.PROGRAM = os.path.abspath(sys.argv[3])
        passed = unittest.main(argv=sys.argv[:1], exit=False).result.wasSuccessful()
        print("; ".join(f"{count} {what}" for what, count in COUNTS.items()))
        sys.exit(not passed)
    elif not subdivide_volume_case.PROGRAM:
        raise SystemExit("SUBDIVIDE_VOLUME is not set")
    unittest.main()
