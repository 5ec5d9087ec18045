#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""SubdivideVolume --levels; the environment variable SUBDIVIDE_VOLUME holds the path of the program."""

import filecmp
import os
import random
import re
import subprocess
import sys
import unittest

from subdivide_volume_case import PROGRAM, ProgramTest, noise, skip_under_sanitizers
from subdivide_volume_files import OPTION_TYPES, meta_header, write_meta, write_nifti

SCHEMES = ("nonoscillatory", "linear", "bounded", "bspline", "restored")


class Levels(ProgramTest):
    def chain(self, name, levels, real, output_type, *arguments):
        """One run after the other, with real values in the files between."""
        for level in range(1, levels):
            self.subdivide(name, f"level{level}.mha", *arguments, "--output-type", real)
            name = f"level{level}.mha"
        return self.meta(name, "last.mha", *arguments, "--output-type", output_type)

    def test_levels_are_a_chain_of_runs_that_rounds_once(self):
        size = [6, 5, 4]
        for pixel, real in (("h", "float"), ("B", "float"), ("i", "double"), ("f", "float"), ("d", "double")):
            write_meta(self.path("in.mha"), size, pixel, noise(120, 0, 256))
            for scheme in SCHEMES:
                for levels in (2, 3):
                    options = ["--scheme", scheme, "--boundary", "mirror" if scheme == "linear" else "nearest"]
                    expected = self.chain("in.mha", levels, real, OPTION_TYPES[pixel], *options)
                    out = self.meta("in.mha", "out.mha", "--levels", levels, *options)
                    self.assertEqual(out.size, [n << levels for n in size])
                    self.assertEqual(out.data, expected.data, (pixel, scheme, levels))

    def test_a_wider_output_type_has_doubles_between(self):
        write_meta(self.path("in.mha"), [6, 5, 4], "h", noise(120))
        expected = self.chain("in.mha", 2, "double", "double")
        self.assertEqual(self.meta("in.mha", "out.mha", "--levels", 2, "--output-type", "double").data, expected.data)

    def test_pieces_threads_and_memory_give_the_same_bytes(self):
        write_meta(self.path("in.mha"), [7, 6, 9], "H", noise(378))
        for scheme in SCHEMES:
            for levels in (2, 3):
                options = ["--scheme", scheme, "--levels", levels]
                whole = self.meta("in.mha", "whole.mha", *options, "--streams", 1, "--threads", 1).data
                for more in (["--streams", 2], ["--streams", 7], ["--streams", 100], ["--threads", 5],
                             ["--memory", "0.2G"]):
                    self.assertEqual(self.meta("in.mha", "out.mha", *options, *more).data, whole, (options, more))

    def test_boundaries_axes_and_other_dimensions_in_pieces(self):
        write_meta(self.path("in.mha"), [7, 6, 5], "h", noise(210))
        write_meta(self.path("plane.mha"), [9, 8], "f", noise(72))
        write_meta(self.path("series.mha"), [5, 4, 3, 2], "h", noise(120))
        write_meta(self.path("colours.mha"), [5, 4, 3], "B", noise(180, 0, 256), channels=3)
        for name, pixel, options in (("in.mha", "h", ["--boundary", "periodic"]), ("in.mha", "h", ["--boundary", "5"]),
                                     ("in.mha", "h", ["--axes", "xy"]), ("in.mha", "h", ["--axes", "z"]),
                                     ("plane.mha", "f", []), ("series.mha", "h", ["--axes", "xzt"]),
                                     ("colours.mha", "B", [])):
            expected = self.chain(name, 2, "float", OPTION_TYPES[pixel], *options).data
            for more in ([], ["--streams", 3], ["--streams", 1000]):
                self.assertEqual(self.meta(name, "out.mha", "--levels", 2, *options, *more).data, expected,
                                 (name, options, more))

    def test_the_first_index_lies_where_the_formula_says(self):
        """Index m of level L lies at m / 2^L - (2^L - 1) / 2^(L + 1) of the input's voxels."""
        spacing = [1, 2, 4]
        write_meta(self.path("in.mha"), [6, 5, 4], "h", noise(120), spacing=spacing)
        for levels in (1, 2, 3):
            for axes in ("xyz", "xz"):
                out = self.meta("in.mha", "out.mha", "--levels", levels, "--axes", axes)
                parts = [2 ** levels if axis in axes else 1 for axis in "xyz"]
                self.assertEqual(out.numbers("ElementSpacing"), [s / n for s, n in zip(spacing, parts)])
                self.assertEqual(out.numbers("Offset"), [-s * (n - 1) / (2 * n) for s, n in zip(spacing, parts)])

    def test_a_ramp_has_the_values_of_the_places_of_its_voxels(self):
        """Away from the border, schemes that keep linear functions show where each index lies."""
        write_meta(self.path("in.mha"), [40, 2], "d", [float(v) for v in range(40)] * 2)
        for scheme in SCHEMES:
            for levels in (1, 2, 3):
                out = self.meta("in.mha", "out.mha", "--levels", levels, "--axes", "x", "--scheme", scheme)
                parts = 2 ** levels
                for m in range(15 * parts, 25 * parts):
                    self.assertAlmostEqual(out.values[m], m / parts - (parts - 1) / (2 * parts), delta=1e-12)

    def test_a_memory_budget_is_kept(self):
        skip_under_sanitizers(self)
        side, budget = 110, 150 * 10 ** 6
        with open(self.path("in.mha"), "wb") as file:
            file.write(meta_header([side] * 3, "H") + random.Random(1).randbytes(2 * side ** 3))
        code = ("import resource, subprocess, sys; code = subprocess.run(sys.argv[1:]).returncode; "
                "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss); sys.exit(code)")
        peaks = []
        for name, arguments in (("whole.mha", ["--streams", 1]), ("pieces.mha", ["--memory", "150M"])):
            command = [PROGRAM, self.path("in.mha"), self.path(name), "--levels", 2, "--threads", 2, "--quiet", *arguments]
            measured = subprocess.run([sys.executable, "-c", code, *map(str, command)], capture_output=True, text=True,
                                      check=True)
            peaks.append(1024 * int(measured.stdout))
        self.assertGreater(peaks[0], budget, "the image is too small for this test")
        self.assertLess(peaks[1], budget)
        self.assertTrue(filecmp.cmp(self.path("whole.mha"), self.path("pieces.mha"), shallow=False))

    def test_nifti_is_not_held_in_memory(self):
        """It takes as little as a MetaImage of the same voxels."""
        with open(PROGRAM, "rb") as file:
            if re.search(b"__(asan|tsan)_init", file.read()):
                self.skipTest("sanitizers take memory of their own")
        size = [200, 200, 400]
        voxels = random.Random(1).randbytes(2 * 200 * 200 * 400)
        with open(self.path("in.mha"), "wb") as file:
            file.write(meta_header(size, "h") + voxels)
        write_nifti(self.path("in.nii"), size, [])
        with open(self.path("in.nii"), "ab") as file:
            file.write(voxels)
        with open(self.path("in.nii"), "rb") as file, open(self.path("pair.hdr"), "wb") as header:
            header.write(file.read(344) + b"ni1\0")
        os.symlink(self.path("in.nii"), self.path("pair.img"))
        code = ("import resource, subprocess, sys; code = subprocess.run(sys.argv[1:]).returncode; "
                "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss); sys.exit(code)")
        peaks = {}
        for name in ("in.mha", "in.nii", "pair.hdr"):
            command = [PROGRAM, self.path(name), self.path(name + ".mha"), "--axes", "z", "--threads", "2", "--memory",
                       "120M", "--quiet"]
            measured = subprocess.run([sys.executable, "-c", code, *command], capture_output=True, text=True, check=True)
            peaks[name] = 1024 * int(measured.stdout)
            self.assertTrue(filecmp.cmp(self.path("in.mha.mha"), self.path(name + ".mha"), shallow=False), name)
        for name, peak in peaks.items():
            self.assertLess(peak, peaks["in.mha"] + len(voxels) // 4, name)

    def test_other_numbers_are_refused(self):
        write_meta(self.path("in.mha"), [6, 5], "h", noise(30))
        for levels in ("0", "4", "-1", "1.5", "two"):
            self.assert_fails(self.run_program(self.path("in.mha"), self.path("out.mha"), "--levels", levels), 2,
                              "--levels")
        self.assertEqual(os.listdir(self.folder), ["in.mha"])


if __name__ == "__main__":
    if not PROGRAM:
        raise SystemExit("SUBDIVIDE_VOLUME is not set")
    unittest.main()
