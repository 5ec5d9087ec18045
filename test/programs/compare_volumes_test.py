#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs CompareVolumes as a user does; the environment variable COMPARE_VOLUMES holds the path of the program."""

import json
import math
import os
import struct
import subprocess
import tempfile
import unittest

PROGRAM = os.environ.get("COMPARE_VOLUMES")
NAN = math.nan

# MetaImage's and NRRD's names for the types of the struct module.
META_TYPES = {"B": "UCHAR", "h": "SHORT", "H": "USHORT", "i": "INT", "q": "LONG_LONG", "f": "FLOAT", "d": "DOUBLE"}
NRRD_TYPES = {"B": "uint8", "h": "int16", "H": "uint16", "i": "int32", "q": "int64", "f": "float", "d": "double"}


def joined(numbers):
    return " ".join(str(number) for number in numbers)


def pack(pixel, values):
    return struct.pack(f"<{len(values)}{pixel}", *values)


def refuse_constant(name):
    raise ValueError(f"{name} is not JSON")


class CompareVolumes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write_bytes(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content)
        return self.path(name)

    def write_mha(self, name, size, pixel, values, spacing=None, origin=None, channels=1):
        """The first axis of size varies fastest in values."""
        header = (
            f"ObjectType = Image\nNDims = {len(size)}\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
            f"CompressedData = False\nOffset = {joined(origin or [0] * len(size))}\n"
            f"ElementSpacing = {joined(spacing or [1] * len(size))}\nDimSize = {joined(size)}\n"
            f"ElementNumberOfChannels = {channels}\nElementType = MET_{META_TYPES[pixel]}\nElementDataFile = LOCAL\n"
        )
        return self.write_bytes(name, header.encode() + pack(pixel, values))

    def write_nrrd(self, name, size, pixel, values):
        header = (
            f"NRRD0004\ntype: {NRRD_TYPES[pixel]}\ndimension: {len(size)}\nsizes: {joined(size)}\n"
            f"spacings: {joined([1] * len(size))}\nendian: little\nencoding: raw\n\n"
        )
        return self.write_bytes(name, header.encode() + pack(pixel, values))

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=60, check=False)

    def compare(self, *arguments):
        result = self.run_program(*arguments, "--json")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return json.loads(result.stdout, parse_constant=refuse_constant)

    def assert_fails(self, words, *arguments, code=1):
        """The exit code is 2 where the command line is wrong."""
        result = self.run_program(*arguments)
        self.assertEqual(result.returncode, code)
        self.assertEqual(result.stdout, "")
        self.assertRegex(result.stderr, r"\ACompareVolumes: [^\n]+\n\Z")
        self.assertIn(words, result.stderr)
        self.assertNotIn("0x", result.stderr)

    def assert_close(self, value, expected):
        self.assertTrue(math.isclose(value, expected, rel_tol=1e-14), f"{value} is not {expected}")


class Figures(CompareVolumes):
    def test_names_behind_two_dashes_are_no_options(self):
        self.write_mha("-a.mha", [2, 2], "h", [1, 2, 3, 4])
        for arguments in (["--json", "--quantile", "0.9", "--", "-a.mha", "-a.mha"], ["--json", "--", "-a.mha", "-a.mha"]):
            result = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False, cwd=self.folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(json.loads(result.stdout)["relative_l2_error"], 0)

    def test_2d_hand_computed(self):
        reference = self.write_mha("r.mha", [2, 2], "f", [0, 3, 4, 0])
        test = self.write_mha("t.mha", [2, 2], "f", [1, 3, 2, -0.5])
        figures = self.compare(reference, test)
        # Errors 1, 0, 2, 0.5.
        self.assert_close(figures["psnr_db"], 10 * math.log10(16 / (5.25 / 4)))
        self.assert_close(figures["relative_l2_error"], math.sqrt(5.25) / 5)
        self.assert_close(figures["median_relative_error"], 0.75 / 4)
        self.assert_close(figures["q99_relative_error"], (1 + 0.97) / 4)
        self.assert_close(figures["reference_total_variation"], 12)
        self.assert_close(figures["test_total_variation"], math.sqrt(4 + 1) + 3.5 + 2.5)
        self.assert_close(figures["relative_total_variation"], (math.sqrt(5) + 6) / 12)
        self.assertEqual((figures["test_minimum"], figures["test_maximum"]), (-0.5, 3))
        self.assertEqual((figures["reference_minimum"], figures["reference_maximum"]), (0, 4))
        self.assertEqual(figures["peak"], 4)
        self.assertEqual((figures["compared_voxels"], figures["excluded_voxels"]), (4, 0))

    def test_3d_of_two_types_and_formats(self):
        reference = self.write_nrrd("r.nrrd", [2, 1, 2], "h", [-100, 0, 300, 0])
        test = self.write_mha("t.mha", [2, 1, 2], "B", [0, 0, 200, 40])
        figures = self.compare(reference, test)
        self.assert_close(figures["psnr_db"], 10 * math.log10(400**2 / ((100**2 + 100**2 + 40**2) / 4)))
        self.assert_close(figures["relative_l2_error"], math.sqrt(21600 / 100000))
        self.assert_close(figures["median_relative_error"], 70 / 400)
        self.assert_close(figures["reference_total_variation"], math.hypot(100, 400) + 300)
        self.assert_close(figures["test_total_variation"], 200 + 40 + 160)

    def test_4d(self):
        reference = self.write_nrrd("r.nrrd", [1, 1, 1, 3], "d", [0, 1, 4])
        test = self.write_nrrd("t.nrrd", [1, 1, 1, 3], "d", [0, 2, 3])
        figures = self.compare(reference, test)
        self.assert_close(figures["relative_total_variation"], 3 / 4)
        self.assert_close(figures["median_relative_error"], 1 / 4)

    def test_integers_that_float_does_not_hold(self):
        large = 2**24
        for pixel in "iq":
            reference = self.write_mha("r.mha", [2, 1], pixel, [0, large])
            test = self.write_mha("t.mha", [2, 1], pixel, [0, large + 1])
            figures = self.compare(reference, test)
            self.assertEqual(figures["test_maximum"], large + 1)
            self.assert_close(figures["relative_l2_error"], 1 / large)

    def test_integers_that_double_does_not_hold(self):
        reference = self.write_mha("r.mha", [2, 1], "q", [0, 2**53 + 1])
        test = self.write_mha("t.mha", [2, 1], "q", [0, 2**53 - 1])
        result = self.run_program(reference, test, "--json")
        self.assertEqual((result.returncode, result.stderr.count("\n"), result.stderr.count("2^53")), (0, 1, 1))
        warnings = json.loads(result.stdout)["warnings"]
        self.assertEqual(len(warnings), 1)
        self.assertIn("r.mha", warnings[0])
        self.assertEqual(self.compare(test, test)["warnings"], [])

    def test_equal_images_have_no_finite_psnr(self):
        image = self.write_mha("r.mha", [3, 1], "H", [1, 60000, 2])
        figures = self.compare(image, image)
        self.assertIsNone(figures["psnr_db"])
        self.assertEqual(figures["relative_l2_error"], 0)
        self.assertEqual(figures["q99_relative_error"], 0)
        self.assertEqual(figures["relative_total_variation"], 1)

    def test_undefined_ratios_are_null(self):
        reference = self.write_mha("r.mha", [2, 1], "f", [0, 0])
        test = self.write_mha("t.mha", [2, 1], "f", [0, 1])
        figures = self.compare(reference, test, "--peak", "1")
        self.assertIsNone(figures["relative_l2_error"])
        self.assertIsNone(figures["relative_total_variation"])
        self.assert_close(figures["psnr_db"], 10 * math.log10(2))

    def test_non_finite_voxels_are_excluded_and_counted(self):
        reference = self.write_mha("r.mha", [5, 1], "f", [0, 1, NAN, 3, 5])
        test = self.write_mha("t.mha", [5, 1], "f", [0, 2, 2, math.inf, 6])
        figures = self.compare(reference, test)
        self.assertEqual((figures["compared_voxels"], figures["excluded_voxels"]), (3, 2))
        self.assert_close(figures["relative_l2_error"], math.sqrt(2 / 26))
        self.assert_close(figures["relative_total_variation"], 2)


class Options(CompareVolumes):
    def setUp(self):
        super().setUp()
        self.reference = self.write_mha("r.mha", [2, 2], "f", [0, 3, 4, 0], spacing=[0.5, 4])
        self.test = self.write_mha("t.mha", [2, 2], "f", [0, 4, 4, 2], spacing=[0.5, 4])

    def test_peak(self):
        figures = self.compare(self.reference, self.test, "--peak", "8")
        self.assert_close(figures["psnr_db"], 10 * math.log10(64 / (5 / 4)))
        self.assert_close(figures["median_relative_error"], 0.5 / 8)

    def test_numbers_that_are_none(self):
        for option in ("--peak", "--quantile", "--spacing", "--origin", "--channel", "--frame"):
            for value in ("nan", "-nan", "inf", "-inf", "", "1e400", "1,nan", "two") + (
                    () if option == "--origin" else ("-1",)):
                result = self.run_program(self.reference, self.test, f"{option}={value}")
                with self.subTest(option=option, value=value):
                    self.assertEqual((result.returncode, result.stdout, result.stderr.count("\n")), (2, "", 1))
                    self.assertIn(option, result.stderr)

    def test_quantiles(self):
        wanted = [(0.25, 0), (1, 0.5)]
        for arguments in (
            [self.reference, self.test, "--quantile", "0.25", "1"],
            ["--quantile", "0.25", "1", "--", self.reference, self.test],
            [self.reference, "--quantile", "0.25", "--quantile", "1", "--", self.test],
        ):
            result = self.run_program("--json", *arguments)
            quantiles = json.loads(result.stdout)["relative_error_quantiles"]
            self.assertEqual([(entry["level"], entry["value"]) for entry in quantiles], wanted)

    def test_spacing(self):
        figures = self.compare(self.reference, self.test, "--use-spacing")
        self.assert_close(figures["reference_total_variation"], 2 * (math.hypot(6, 1) + 0.75 + 8))
        self.assert_close(figures["test_total_variation"], 2 * (math.hypot(8, 1) + 0.5 + 4))

    def test_text(self):
        result = self.run_program(self.reference, self.test, "--quantile", "0.75")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for line in (
            "PSNR: 11.0721 dB (peak 4)",
            "relative L2 error: 44.7214 %",
            "relative error, quantile 0.5: 12.5 %",
            "relative error, quantile 0.99: 49.25 %",
            "relative error, quantile 0.75: 31.25 %",
            "test range: 0 to 4",
            "voxels: 4 compared, 0 excluded (not finite)",
        ):
            self.assertIn(line, result.stdout.splitlines())

    def test_geometry_to_a_thousandth_of_a_voxel(self):
        values = [0, 3, 4, 0]
        figures = self.compare(self.reference, self.reference)
        for spacing, origin, fits in (([0.5, 4], [0.0004, 0.003], True), ([0.5, 4], [0.0006, 0], False),
                                      ([0.5, 4], [0, 0.005], False), ([0.5004, 4], [0, 0], True),
                                      ([0.5, 4.005], [0, 0], False)):
            near = self.write_mha("n.mha", [2, 2], "f", values, spacing=spacing, origin=origin)
            if fits:
                self.assertEqual(self.compare(self.reference, near), figures)
            else:
                self.assert_fails("--ignore-geometry", self.reference, near)
            self.assertEqual(self.compare(self.reference, near, "--ignore-geometry"), figures)

    def test_raw_files(self):
        raw = self.write_bytes("t.raw", pack("f", [0, 4, 4, 2]))
        expected = self.compare(self.reference, self.test)
        self.assertEqual(self.compare(self.reference, raw, "--test-raw", "2x2:float", "--ignore-geometry"), expected)
        other = self.write_bytes("r.raw", pack("f", [0, 3, 4, 0]))
        self.assertEqual(self.compare(other, raw, "--raw", "2x2:float", "--test-raw", "2x2:float"), expected)

    def test_version(self):
        result = self.run_program("--version")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertRegex(result.stdout, r"^CompareVolumes \d+\.\d+")

    def test_a_result_that_cannot_be_written(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("there is no /dev/full")
        for options in ([], ["--json"]):
            with open("/dev/full", "w", encoding="ascii") as full:
                result = subprocess.run([PROGRAM, self.reference, self.test, *options], stdout=full,
                                        stderr=subprocess.PIPE, text=True, check=False)
            self.assertEqual(result.returncode, 1)
            self.assertRegex(result.stderr, r"\ACompareVolumes: [^\n]*No space left[^\n]*\n\Z")

    def test_help(self):
        result = self.run_program("--help")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for option in ("REFERENCE", "TEST", "--json", "--peak", "--quantile", "--use-spacing", "null"):
            self.assertIn(option, result.stdout)


class Errors(CompareVolumes):
    def setUp(self):
        super().setUp()
        self.reference = self.write_mha("r.mha", [2, 2], "f", [0, 3, 4, 0])

    def test_arguments(self):
        self.assert_fails("REFERENCE is required", code=2)
        self.assert_fails("TEST is required", self.reference, code=2)
        self.assert_fails("--wrong", self.reference, self.reference, "--wrong", code=2)
        for peak in ("0", "-1", "high", "inf", "nan"):
            self.assert_fails("--peak", self.reference, self.reference, "--peak", peak, code=2)
            self.assertLess(len(self.run_program(self.reference, self.reference, "--peak", peak).stderr), 120)
        for level in ("-0.1", "1.1", "half", "nan"):
            self.assert_fails("--quantile", self.reference, self.reference, "--quantile", level, code=2)

    def test_files(self):
        missing = self.path("missing.mha")
        self.assert_fails("missing.mha: No such file", self.reference, missing)
        self.assert_fails("missing.mha: No such file", missing, self.reference)
        self.assert_fails("notes.txt", self.reference, self.write_bytes("notes.txt", b"not an image\n"))
        colours = self.write_mha("rgb.mha", [2, 2], "B", [0] * 12, channels=3)
        self.assert_fails("rgb.mha: its voxels have 3 components", self.reference, colours)

    def test_truncated_files(self):
        self.write_nrrd("r.nrrd", [2, 2], "f", [0, 3, 4, 0])
        for extension in ("mha", "nrrd"):
            with open(self.path(f"r.{extension}"), "rb") as file:
                whole = file.read()
            cut = self.write_bytes(f"cut.{extension}", whole[:-5])
            self.assert_fails(f"cut.{extension}", self.reference, cut)

    def test_images_that_differ(self):
        values = [0, 3, 4, 0]
        self.assert_fails("region", self.reference, self.write_mha("t.mha", [4, 1], "f", values))
        self.assert_fails("dimension", self.reference, self.write_mha("t.mha", [2, 2, 1], "f", values))
        self.assert_fails("Spacing", self.reference, self.write_mha("t.mha", [2, 2], "f", values, spacing=[1, 1.5]))
        self.assert_fails("Origin", self.reference, self.write_mha("t.mha", [2, 2], "f", values, origin=[0, 0.5]))

    def test_too_many_dimensions(self):
        image = self.write_mha("r.mha", [1, 1, 1, 1, 2], "f", [0, 1])
        self.assert_fails("5 axes", image, image)

    def test_components_are_compared_one_by_one(self):
        """The figures are those of all numbers together; total variation is that of each component by itself."""
        first, second = [0, 30, 40, 0, 7, 9], [255, 3, 9, 1, 1, 2]
        other = [1, 30, 38, 0, 7, 9]
        interleaved = lambda a, b: [value for pair in zip(a, b) for value in pair]
        reference = self.write_mha("r.mha", [3, 2], "B", interleaved(first, second), channels=2)
        test = self.write_mha("t.mha", [3, 2], "B", interleaved(other, second), channels=2)
        figures = self.compare(reference, test)
        self.assertAlmostEqual(figures["psnr_db"], 10 * math.log10(255 ** 2 / (5 / 12)))
        self.assertAlmostEqual(figures["relative_l2_error"], math.sqrt(5 / sum(v * v for v in first + second)))
        self.assertEqual((figures["reference_minimum"], figures["reference_maximum"]), (0, 255))
        self.assertEqual((figures["compared_voxels"], figures["peak"]), (12, 255))
        turned = self.write_mha("turned.mha", [2, 3], "B", interleaved(other, second), channels=2)
        self.assert_fails("region", reference, turned)
        single = [self.compare(self.write_mha(f"r{i}.mha", [3, 2], "B", a), self.write_mha(f"t{i}.mha", [3, 2], "B", b))
                  for i, (a, b) in enumerate(((first, other), (second, second)))]
        for key in ("reference_total_variation", "test_total_variation"):
            self.assertAlmostEqual(figures[key], sum(each[key] for each in single))
        self.assertAlmostEqual(figures["relative_total_variation"],
                               figures["test_total_variation"] / figures["reference_total_variation"])

    def test_equal_constant_images_need_no_peak(self):
        for value in (0, 7):
            constant = self.write_mha("c.mha", [2, 2], "f", [value] * 3 + [NAN])
            figures = self.compare(constant, constant)
            self.assertEqual((figures["psnr_db"], figures["relative_l2_error"], figures["median_relative_error"]), (None, 0, 0))
            self.assertEqual((figures["peak"], figures["compared_voxels"], figures["excluded_voxels"]), (0, 3, 1))
            self.assertEqual(figures["relative_total_variation"], 1)
            printed = self.run_program(constant, constant).stdout
            self.assertIn("PSNR: inf dB", printed)
            self.assertIn("relative total variation: 100 % (0 of 0)", printed)
        self.assert_fails("constant", constant, self.write_mha("d.mha", [2, 2], "f", [8] * 4))

    def test_images_without_figures(self):
        constant = self.write_mha("c.mha", [2, 2], "f", [7] * 4)
        self.assert_fails("constant", constant, self.reference)
        nothing = self.write_mha("n.mha", [2, 2], "f", [NAN] * 4)
        self.assert_fails("no voxel", self.reference, nothing)


if __name__ == "__main__":
    if not PROGRAM:
        raise SystemExit("The environment variable COMPARE_VOLUMES must hold the path of the program.")
    unittest.main()
