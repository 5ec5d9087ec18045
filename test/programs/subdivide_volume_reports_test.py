#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What SubdivideVolume says of a run; the environment variable SUBDIVIDE_VOLUME holds the path of the program."""

import json
import math
import os
import re
import struct
import subprocess
import unittest

from subdivide_volume_case import PROGRAM, ProgramTest, noise
from subdivide_volume_files import OPTION_TYPES, Meta, write_meta, write_nifti, write_nrrd

LIMITS = {"B": (0, 255), "b": (-128, 127), "H": (0, 65535), "h": (-32768, 32767), "I": (0, 2 ** 32 - 1),
          "i": (-2 ** 31, 2 ** 31 - 1)}


def refuse_constant(name):
    raise ValueError(f"{name} is not JSON")


class Reports(ProgramTest):
    def report(self, *arguments):
        """What --json prints: an object and nothing else."""
        result = self.run_program(*arguments, "--json", "--quiet")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return json.loads(result.stdout, parse_constant=refuse_constant)

    def run_and_report(self, input_name, *arguments):
        return self.report(self.path(input_name), self.path("out.mha"), *arguments)


class Counts(Reports):
    """NaN, infinite and clamped voxels are counted, each once, in any pieces."""

    def test_integers_that_double_does_not_hold(self):
        for pixel, value, warns in (("q", 2**53 + 1, True), ("q", -2**62, True), ("Q", 2**64 - 1, True),
                                    ("q", 2**53 - 1, False), ("Q", 2**53 - 1, False), ("d", 2.0**60, False)):
            write_meta(self.path("in.mha"), [4, 3, 2], pixel, [0] * 23 + [value])
            for options in ([], ["--streams", "3"], ["--labels"] if pixel != "d" else []):
                result = self.run_program("--json", *options, self.path("in.mha"), self.path("out.mha"))
                count = 1 if warns and "--labels" not in options else 0
                with self.subTest(value=value, options=options):
                    self.assertEqual((result.returncode, result.stderr.count("2^53")), (0, count), result.stderr)
                    self.assertEqual(len(json.loads(result.stdout)["warnings"]), count)

    def test_an_ordinary_run(self):
        values = noise(120, -500, 500)
        write_meta(self.path("in.mha"), [6, 5, 4], "h", values, spacing=[1, 2, 4])
        report = self.run_and_report("in.mha", "--streams", 3)
        out = Meta(self.path("out.mha"))
        self.assertEqual(report["input"]["size"], [6, 5, 4])
        self.assertEqual(report["input"]["spacing"], [1, 2, 4])
        self.assertEqual((report["input"]["minimum"], report["input"]["maximum"]), (min(values), max(values)))
        self.assertEqual((report["input"]["nan"], report["input"]["infinite"]), (0, 0))
        self.assertEqual(report["output"]["size"], [12, 10, 8])
        self.assertEqual(report["output"]["spacing"], [0.5, 1, 2])
        self.assertEqual(report["output"]["origin"], [-0.25, -0.5, -1])
        self.assertEqual(report["output"]["type"], "int16")
        self.assertEqual((report["output"]["minimum"], report["output"]["maximum"]), (min(out.values), max(out.values)))
        self.assertEqual((report["output"]["clamped"], report["output"]["nan_became_0"]), (0, 0))
        self.assertEqual((report["input"]["path"], report["output"]["path"]),
                         (self.path("in.mha"), self.path("out.mha")))
        self.assertEqual(report["warnings"], [])
        self.assertGreaterEqual(report["pieces"], 3)
        self.assertGreater(report["seconds"], 0)
        self.assertEqual("SubdivideVolume " + report["version"], self.run_program("--version").stdout.strip())

    def test_clamped_voxels_of_every_type(self):
        """The oracle: the same run in double, rounded and compared with the limits here."""
        for pixel, (low, high) in LIMITS.items():
            values = [low if i % 3 == 0 else high if i % 3 == 1 else (low + high) // 2 for i in noise(1000)]
            write_meta(self.path("in.mha"), [10, 10, 10], pixel, values)
            for scheme in ("linear", "nonoscillatory", "restored", "bounded", "bspline"):
                self.run_and_report("in.mha", "--scheme", scheme, "--output-type", "double")
                reals = Meta(self.path("out.mha")).values
                expected = sum(not low <= round(value) <= high for value in reals)
                self.assertEqual(expected == 0, scheme in ("bounded", "bspline"), scheme)
                for options in ([], ["--streams", "7"], ["--threads", "1"]):
                    report = self.run_and_report("in.mha", "--scheme", scheme, *options)
                    self.assertEqual(report["output"]["clamped"], expected, (pixel, scheme, options))

    def test_clamped_by_a_smaller_type(self):
        write_meta(self.path("in.mha"), [8, 8, 8], "d", [float(v) for v in noise(512, -300, 600)])
        self.run_and_report("in.mha")
        expected = sum(not 0 <= round(value) <= 255 for value in Meta(self.path("out.mha")).values)
        self.assertGreater(expected, 100)
        for options in ([], ["--streams", "5"]):
            report = self.run_and_report("in.mha", "--output-type", "uint8", *options)
            self.assertEqual(report["output"]["clamped"], expected)
        text = self.subdivide("in.mha", "out.mha", "--output-type", "uint8").stdout
        self.assertRegex(text, rf"(?m)^output .*range 0 to 255, {expected} clamped$")

    def test_nan_and_infinite_voxels(self):
        for pixel in "fd":
            values = [float(value) for value in noise(720, 10, 200)]
            values[100], values[300], values[301] = math.nan, math.inf, -math.inf
            write_meta(self.path("in.mha"), [9, 8, 10], pixel, values)
            for options in ([], ["--streams", "20"], ["--axes", "xy", "--streams", "3"]):
                report = self.run_and_report("in.mha", *options)
                out = Meta(self.path("out.mha")).values
                self.assertEqual((report["input"]["nan"], report["input"]["infinite"]), (1, 2))
                self.assertEqual(report["input"]["maximum"], max(v for v in values if math.isfinite(v)))
                self.assertEqual(report["output"]["nan"], sum(math.isnan(v) for v in out))
                self.assertEqual(report["output"]["infinite"], sum(math.isinf(v) for v in out))
                finite = [v for v in out if math.isfinite(v)]
                self.assertEqual((report["output"]["minimum"], report["output"]["maximum"]), (min(finite), max(finite)))
                rounded = self.run_and_report("in.mha", "--output-type", "int16", *options)["output"]
                self.assertEqual(rounded["nan_became_0"], sum(math.isnan(v) for v in out))
                self.assertGreater(rounded["nan_became_0"], 0)
                self.assertEqual(rounded["clamped"], sum(math.isinf(v) or not -32768 <= round(v) <= 32767
                                                         for v in out if not math.isnan(v)))
        self.assertRegex(self.subdivide("in.mha", "out.mha").stdout, r"(?m)^input .*, 1 NaN, 2 infinite$")

    def test_an_image_without_a_finite_voxel(self):
        write_meta(self.path("in.mha"), [3, 2], "f", [math.nan] * 6)
        report = self.run_and_report("in.mha")
        self.assertEqual((report["input"]["minimum"], report["input"]["maximum"]), (None, None))
        self.assertEqual((report["input"]["nan"], report["output"]["nan"]), (6, 24))
        self.assertIn("no finite value", self.subdivide("in.mha", "out.mha").stdout)


class Forecasts(Reports):
    """--info reads the header, writes nothing, and foresees what a run does."""

    def test_what_is_foreseen_comes_true(self):
        write_nrrd(self.path("in.nrrd"), [20, 18, 16], "h", noise(5760), more=["spacings: 1 2 4"])
        for options in ([], ["--streams", "5"], ["--axes", "xz"], ["--output-type", "float"]):
            forecast = self.report("--info", self.path("in.nrrd"), self.path("out.mha"), *options)
            self.assertFalse(os.path.exists(self.path("out.mha")))
            self.assertEqual(sorted(os.listdir(self.folder)), ["in.nrrd"])
            report = self.report(self.path("in.nrrd"), self.path("out.mha"), *options)
            for key in ("size", "spacing", "origin", "directions", "type", "components"):
                self.assertEqual(forecast["input"][key], report["input"][key])
                self.assertEqual(forecast["output"][key], report["output"][key])
            self.assertEqual(forecast["input"]["format"], report["input"]["format"])
            self.assertEqual(forecast["output"]["bytes"], len(Meta(self.path("out.mha")).data))
            self.assertEqual(forecast["pieces"], report["pieces"])
            self.assertGreater(forecast["memory_bytes"], forecast["output"]["bytes"])
            self.assertGreater(forecast["disk_free_bytes"], 0)
            os.remove(self.path("out.mha"))

    def test_without_an_output(self):
        write_meta(self.path("in.mha"), [6, 5, 4], "h", noise(120), spacing=[1, 2, 4])
        result = self.run_program("--info", self.path("in.mha"))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertRegex(result.stdout, r"(?m)^input .*6 x 5 x 4 int16, spacing 1 x 2 x 4")
        self.assertRegex(result.stdout, r"(?m)^output .*12 x 10 x 8 int16, spacing 0.5 x 1 x 2")
        self.assertRegex(result.stdout, r"(?m)^memory .*1 piece$")

    def test_a_budget_is_foreseen(self):
        write_meta(self.path("in.mha"), [100, 100, 100], "B", bytes(10 ** 6))
        self.assert_fails(self.run_program("--info", self.path("in.mha"), "--memory", "20M"), 1, "--memory")

    def test_a_file_that_cannot_be_read(self):
        self.assert_fails(self.run_program("--info", self.path("none.mha")), 1, "none.mha", "No such file")

    def test_an_output_that_cannot_be_written(self):
        write_meta(self.path("in.mha"), [6, 5, 4], "h", noise(120))
        self.assert_fails(self.run_program("--info", self.path("in.mha"), self.path("out.xyz")), 1, ".xyz")


class Words(Reports):
    """Choices without regard to case, sizes with decimals, unknown arguments in their order."""

    def setUp(self):
        super().setUp()
        write_meta(self.path("in.mha"), [6, 5, 4], "h", noise(120))
        self.files = [self.path("in.mha"), self.path("out.mha")]

    def test_case_does_not_matter(self):
        expected = self.meta("in.mha", "out.mha", "--scheme", "linear", "--axes", "xy", "--boundary", "mirror",
                             "--output-type", "float").data
        out = self.meta("in.mha", "out.mha", "--scheme", "LINEAR", "--axes", "XY", "--boundary", "Mirror",
                        "--output-type", "Float")
        self.assertEqual(out.data, expected)
        self.subdivide("in.mha", "out.mha", "--scheme", "NonOscillatory", "--target", "Portable")
        message = self.run_program(*self.files, "--target", "none").stderr
        for target in re.search(r"one of (.*), not none", message)[1].split(", "):
            for name in (target, target.lower(), target.upper()):
                self.subdivide("in.mha", "out.mha", "--target", name)

    def test_sizes(self):
        for size in ("0.5G", "500M", "500MB", "500000k", "1.5GiB", "1gb", "1.5 GiB", "2e9", "1T", "524288KiB"):
            self.subdivide("in.mha", "out.mha", "--memory", size)
        for size in ("", "G", "0", "-1G", "0.5X", "1GG", "inf", "nan", "1Gi5", "9e99T"):
            result = self.run_program(*self.files, "--memory", size)
            self.assertEqual(result.returncode, 2, size)
            self.assertIn("--memory", result.stderr)
            self.assertNotIn("UINT", result.stderr)

    def test_a_size_is_what_it_says(self):
        """What does not fit just below a size fits just above it, in either unit."""
        needed = self.report("--info", self.path("in.mha"))["memory_bytes"]
        for unit, factor in (("k", 1000), ("KiB", 1024), ("M", 1000 ** 2), ("MiB", 1024 ** 2), ("G", 1000 ** 3)):
            small, large = needed / factor * 0.5, needed / factor * 1.5
            self.assertEqual(self.run_program("--info", self.path("in.mha"), "--memory", f"{small:.6f}{unit}").returncode, 1)
            self.assertEqual(self.run_program("--info", self.path("in.mha"), "--memory", f"{large:.6f}{unit}").returncode, 0)

    def test_unknown_arguments_in_their_order(self):
        for arguments, words in ((["--foo", "--bar"], "--foo --bar"), (["one", "two", "three"], "one two three")):
            self.assert_fails(self.run_program(*self.files, *arguments), 2, words)

    def test_options_are_named_with_the_reason(self):
        for option, value, words in (("--scheme", "cubic", "restored"), ("--tension", "1", "greater than 1"),
                                     ("--output-type", "int", "uint16"), ("--spacing", "0", "greater than 0"),
                                     ("--spacing", "1,x", "1,x"), ("--origin", "inf", "inf"), ("--raw", "8x8", "--raw"),
                                     ("--compression-level", "10", "10"), ("--target", "none", "portable"),
                                     ("--axes", "xw", "xw"), ("--channel", "-1", "-1")):
            self.assert_fails(self.run_program(*self.files, option, value), 2, option, words)

    def test_an_origin_is_a_number_for_each_axis_as_its_help_says(self):
        text = " ".join(self.run_program("--help").stdout.split())
        self.assertRegex(text, r"--origin NUMBERS The place of the first voxel[^-]*: one number for each axis")
        self.assert_fails(self.run_program(*self.files, "--origin", "5"), 1, "--origin 5", "3 numbers are needed")
        self.subdivide("in.mha", "out.mha", "--origin", "5,6,7")

    def test_the_tension_of_the_restored_scheme(self):
        for tension in ("0", "0.5", "1", "7"):
            self.subdivide("in.mha", "out.mha", "--scheme", "restored", "--tension", tension)
        os.remove(self.path("out.mha"))
        for tension in ("-0.1", "inf"):
            self.assert_fails(self.run_program(*self.files, "--scheme", "restored", "--tension", tension), 2,
                              "restored", tension)

    def test_help_has_examples_and_codes(self):
        text = self.run_program("--help").stdout
        for words in ("Examples:", "SubdivideVolume scan.mha", "Exit status:", "--info", "--json", "--formats", "restored"):
            self.assertIn(words, text)

    def test_json_and_tags_for_slicer_do_not_mix(self):
        self.assert_fails(self.run_program(*self.files, "--json", "--progress-xml"), 2, "--json", "--progress-xml")

    def test_a_report_that_cannot_be_written(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("there is no /dev/full")
        for arguments in (["--json", *self.files], ["--info", self.files[0]], ["--formats"]):
            with open("/dev/full", "w", encoding="ascii") as full:
                result = subprocess.run([PROGRAM, *arguments], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
            self.assertEqual(result.returncode, 1, arguments)
            self.assertIn("No space left", result.stderr)


class Formats(Reports):
    def test_the_table(self):
        result = self.run_program("--formats")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        lines = result.stdout.splitlines()
        self.assertRegex(lines[0], r"read +write +stream +compress")
        for ending in (".mha", ".mhd", ".nrrd", ".nhdr", ".nii", ".tif"):
            self.assertTrue(any(ending in line for line in lines[1:]), ending)

    def test_the_table_is_true(self):
        """What the table says of writing, streaming and compressing is what the program does."""
        write_meta(self.path("in.mha"), [8, 6, 4], "B", noise(192, 0, 256))
        rows = self.report("--formats")
        self.assertGreater(len(rows), 8)
        for row in rows:
            for ending in row["endings"]:
                if not ending.startswith("."):
                    continue
                name = self.path("out" + ending)
                result = self.run_program("--info", self.path("in.mha"), name, "--streams", "2")
                self.assertEqual(result.returncode == 0, row["writes"], (ending, result.stderr))
                if row["writes"]:
                    self.assertEqual(json.loads(self.run_program(
                        "--info", self.path("in.mha"), name, "--streams", "2", "--json").stdout)["pieces"] > 1,
                                     row["writes_parts"], ending)


class Labels(Reports):
    """A file that says that it is a label map is not doubled without a word."""

    def test_nifti(self):
        write_nifti(self.path("in.nii"), [6, 5, 4], [v % 3 for v in range(120)])
        self.assertEqual(self.run_and_report("in.nii")["warnings"], [])
        with open(self.path("in.nii"), "r+b") as file:
            file.seek(68)
            file.write(struct.pack("<h", 1002))
        self.check_warning("in.nii")

    def test_seg_nrrd(self):
        for name, labels in (("in.nrrd", False), ("in.seg.nrrd", True)):
            write_nrrd(self.path(name), [6, 5, 4], "B", [v % 3 for v in range(120)],
                       more=["Segment0_ID:=a", "Segment0_LabelValue:=1"] if labels else [])
        self.assertEqual(self.run_and_report("in.nrrd")["warnings"], [])
        self.check_warning("in.seg.nrrd")

    def test_the_name_of_a_segmentation_is_enough_and_so_is_any_segment(self):
        values = [v % 3 for v in range(120)]
        for name in ("in.seg.nrrd", "In.Seg.NRRD"):
            write_nrrd(self.path(name), [6, 5, 4], "B", values)
            self.check_warning(name)
        write_nrrd(self.path("other.nrrd"), [6, 5, 4], "B", values, more=["Segment3_ID:=b", "Segment3_Name:=lung"])
        self.check_warning("other.nrrd")
        write_meta(self.path("in.mha"), [6, 5, 4], "B", values, more=["Segment0_LabelValue = 1"])
        self.check_warning("in.mha")

    def check_warning(self, name):
        result = self.run_program(self.path(name), self.path("out.mha"))
        self.assertEqual(result.returncode, 0)
        self.assertEqual(len(re.findall("(?m)^SubdivideVolume: warning: .*--labels", result.stderr)), 1, result.stderr)
        self.assertRegex(result.stdout, "(?m)^warning .*label")
        self.assertEqual(len(self.run_and_report(name)["warnings"]), 1)
        report = self.run_and_report(name, "--labels")
        self.assertEqual((report["warnings"], report["labels"], report["scheme"], report["tension"]),
                         ([], True, "restored", 0))


if __name__ == "__main__":
    if not PROGRAM:
        raise SystemExit("SUBDIVIDE_VOLUME is not set")
    unittest.main()
