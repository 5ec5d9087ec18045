#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The experiments in their small setting: their orders, their building blocks and the metrics.

SUBDIVIDE_VOLUME and COMPARE_VOLUMES name the programs (see experiments/common.py for where else they are looked for).
"""
import csv
import gzip
import math
import pathlib
import sys
import tempfile
import unittest

import numpy as np
import pywt

EXPERIMENTS = pathlib.Path(__file__).resolve().parents[2] / "experiments"
sys.path.insert(0, str(EXPERIMENTS))

import common  # noqa: E402
import compression  # noqa: E402
import label_maps  # noqa: E402
import phantom  # noqa: E402
import run  # noqa: E402
import subsampling  # noqa: E402
import volumes  # noqa: E402
from report import Finding, Picture, Result, Table, Text  # noqa: E402

# Output * 1024 of the one-axis step 0,0,0,0,0,1,1,1,1,1 with the nearest voxel continued.
STEP_LINEAR = [0, 0, 0, 0, 0, 10, 14, -64, -112, 212, 812, 1136, 1088, 1010, 1014, 1024, 1024, 1024, 1024, 1024]
STEP_NONOSCILLATORY = [0, 0, 0, 0, 0, 1, 11, 56, 176, 386, 638, 848, 968, 1013, 1023, 1024, 1024, 1024, 1024, 1024]


class FolderTest(unittest.TestCase):
    """Tests with a folder of their own."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)


class Volumes(FolderTest):
    def test_meta_image_round_trip_keeps_voxels_type_and_spacing(self):
        for kind in ("u1", "i2", "u2", "i4", "f4", "f8"):
            data = np.arange(2 * 3 * 4, dtype=kind).reshape(2, 3, 4)
            volumes.write_volume(self.folder / "a.mha", data, (0.5, 0.25, 0.1))
            read = volumes.read_volume(self.folder / "a.mha")
            np.testing.assert_array_equal(read.data, data)
            self.assertEqual(read.data.dtype, data.dtype)
            self.assertEqual(read.spacing, (0.5, 0.25, 0.1))

    def test_nrrd_with_gzip_and_space_directions(self):
        data = np.arange(24, dtype="<i2").reshape(2, 3, 4)
        header = (
            "NRRD0004\n# a comment\ntype: short\ndimension: 3\nsizes: 4 3 2\nendian: little\nencoding: gzip\n"
            "space directions: (0.3,0.4,0) (0,2,0) (0,0,3)\n\n"
        )
        (self.folder / "a.nrrd").write_bytes(header.encode() + gzip.compress(data.tobytes()))
        read = volumes.read_volume(self.folder / "a.nrrd")
        np.testing.assert_array_equal(read.data, data)
        self.assertEqual(read.spacing, (3.0, 2.0, 0.5))

    def test_detached_nrrd_in_the_other_byte_order(self):
        data = np.arange(24, dtype=">f4").reshape(2, 3, 4)
        (self.folder / "a.raw").write_bytes(data.tobytes())
        header = "NRRD0004\ntype: float\ndimension: 3\nsizes: 4 3 2\nspacings: 1 2 3\nendian: big\nencoding: raw\n"
        (self.folder / "a.nhdr").write_text(header + "data file: a.raw\n")
        read = volumes.read_volume(self.folder / "a.nhdr")
        np.testing.assert_array_equal(read.data, data)
        self.assertEqual(read.spacing, (3.0, 2.0, 1.0))

    def test_a_truncated_missing_or_foreign_file_is_one_clear_line(self):
        volumes.write_volume(self.folder / "a.mha", np.zeros((4, 4, 4)))
        whole = (self.folder / "a.mha").read_bytes()
        (self.folder / "cut.mha").write_bytes(whole[:-100])
        (self.folder / "a.txt").write_text("no volume")
        (self.folder / "empty.nrrd").write_text("")
        reasons = {"cut.mha": "truncated", "a.txt": "file type", "b.mha": "No such", "empty.nrrd": "not an NRRD"}
        for name, reason in reasons.items():
            with self.assertRaisesRegex(volumes.VolumeError, f"^.*{name}: .*{reason}.*$"):
                volumes.read_volume(self.folder / name)

    def test_central_region_is_even_and_central(self):
        data = np.arange(7 * 9 * 4).reshape(7, 9, 4)
        region = volumes.central_region(volumes.Volume("a", data, (1, 1, 1)), 5)
        np.testing.assert_array_equal(region.data, data[1:5, 2:6, :])


class Programs(unittest.TestCase):
    def test_children_of_a_step_along_every_axis(self):
        step = np.repeat([0.0, 1.0], 5)
        for scheme, expected in (("linear", STEP_LINEAR), ("nonoscillatory", STEP_NONOSCILLATORY)):
            for axis in range(3):
                shape = [1, 1, 1]
                shape[axis] = 10
                data = np.broadcast_to(step.reshape(shape), [10 if w == axis else 3 for w in range(3)])
                result = common.subdivide(data, scheme=scheme, output_type="double")
                line = np.moveaxis(result, axis, 0)[:, 3, 3]
                np.testing.assert_array_equal(line * 1024, expected)

    def test_what_the_program_refuses_is_one_line(self):
        with self.assertRaisesRegex(common.ProgramError, "tension") as caught:
            common.subdivide(np.zeros((4, 4, 4)), tension=1.0)
        self.assertNotIn("\n", str(caught.exception))

    def test_peers_lie_at_the_same_places(self):
        ramp = np.broadcast_to(np.arange(40.0), (4, 4, 40))
        places = np.arange(80) / 2 - 0.25
        inner = slice(30, 50)
        np.testing.assert_array_equal(common.interpolate(ramp, 0)[3, 3], np.repeat(np.arange(40.0), 2))
        for order in (1, 3, 5):
            np.testing.assert_allclose(common.interpolate(ramp, order)[3, 3, inner], places[inner], atol=1e-4)
        for scheme in common.SCHEMES:
            result = common.subdivide(ramp, scheme=scheme)
            np.testing.assert_allclose(result[3, 3, inner], places[inner], atol=1e-4)

    def test_average_down(self):
        data = np.zeros((2, 2, 4))
        data[0, 1, 1], data[1, 0, 3] = 8.0, 4.0
        np.testing.assert_array_equal(common.average_down(data), [[[1.0, 0.5]]])


class Metrics(unittest.TestCase):
    def test_one_voxel_off_by_one(self):
        """Two by two by two voxels 0, 10 along x; the first one becomes 1. By hand, peak 10: the mean square error
        is 1/8, the squares of the reference sum to 400, the total variation is 40 before and 30 + sqrt(83) after."""
        reference = np.tile([0.0, 10.0], (2, 2, 1))
        test = reference.copy()
        test[0, 0, 0] = 1.0
        measured = common.compare(reference, test)
        self.assertAlmostEqual(measured["psnr_db"], 10 * math.log10(100 * 8), places=9)
        self.assertAlmostEqual(measured["relative_l2_error"], 1 / 20, places=12)
        self.assertEqual(measured["median_relative_error"], 0.0)
        self.assertAlmostEqual(measured["relative_total_variation"], (30 + math.sqrt(83)) / 40, places=12)
        self.assertEqual((measured["test_minimum"], measured["test_maximum"]), (0.0, 10.0))

    def test_quantiles(self):
        """101 errors 0, 1, ... 100 in disorder, peak 1000: the median is 50, the 99 % quantile 99."""
        reference = np.zeros((1, 1, 101))
        reference[0, 0, -1] = 1000.0
        errors = (np.arange(101) * 37) % 101
        measured = common.compare(reference, reference - errors)
        self.assertAlmostEqual(measured["median_relative_error"], 0.050, places=12)
        self.assertAlmostEqual(measured["q99_relative_error"], 0.099, places=12)


class Report(FolderTest):
    def test_a_section_in_markdown_and_csv(self):
        table = Table("numbers", "Some.", [("what", ""), ("value", ".1f")], [["one", 1.25], ["none", None]])
        result = Result("Title")
        result.add(Text("Words."), table, Picture("a.png", "A picture."))
        result.add(Finding("it is so.", True), Finding("it is not so.", False, "Because."))
        text = result.markdown("results")
        for line in ("## Title", "| one | 1.2 |", "| none |  |", "![A picture.](results/a.png)"):
            self.assertIn(line + "\n", text)
        self.assertIn("**Agrees:** it is so.", text)
        self.assertIn("**Does not agree:** it is not so. Because.", text)
        result.write_tables(self.folder)
        with open(self.folder / "numbers.csv", newline="") as stream:
            self.assertEqual(list(csv.reader(stream)), [["what", "value"], ["one", "1.25"], ["none", ""]])


class Phantom(FolderTest):
    def test_objects(self):
        volume = phantom.phantom()
        self.assertEqual(volume[20, 20, 20], 1.0)  # cube
        self.assertEqual(volume[41, 9, 45], 1.0)  # stick
        self.assertEqual((volume[66, 26, 42], volume[66, 26, 43]), (1.0, 0.0))  # solid sphere
        self.assertEqual((volume[66, 66, 66], volume[66, 66, 71], volume[66, 66, 86]), (1.0, 0.75, 0.0))  # ramp
        plane = volume[8:40, 50:52, 50:86]
        self.assertTrue((plane == 1.0).all() and (volume[8:10, 50:80, 50:86] == 1.0).all())

    def test_ranges_and_page(self):
        (result,) = run.run_experiments(["phantom"], "small", self.folder)
        rows = result.table("phantom_ranges").rows
        linear = next(row for row in rows if row[1] == "linear subdivision")
        np.testing.assert_allclose(linear[3:5], (-0.3127940520644188, 1.5234947204589844), rtol=0, atol=1e-12)
        kept = [row for row in rows if row[1] == "non-oscillatory"]
        self.assertEqual([row[2] for row in kept], [1.01, 1.5, 2.0, 4.0, 8.0])
        for row in kept:
            self.assertEqual(row[3:6], [0.0, 1.0, 0.0])
        text = (self.folder / "RESULTS.md").read_text(encoding="utf-8")
        self.assertIn("(results/phantom_96.png)", text)
        self.assertTrue((self.folder / "results/phantom_96.png").read_bytes().startswith(b"\x89PNG"))
        self.assertTrue((self.folder / "results/phantom_ranges.csv").exists())


class ComputedTomography(FolderTest):
    """The orders of the paper's tables on the sample volumes."""

    def setUp(self):
        super().setUp()
        found, notes = volumes.sample_volumes()
        for note in notes:
            print(note, file=sys.stderr)
        if not found:
            self.skipTest("no sample volume on this machine")
        self.names = [volume.name for volume in found]

    def rows(self, table, *key):
        """The metrics of the row that begins with the key: PSNR, L2, median, 99 % quantile, total variation."""
        (row,) = [row for row in table.rows if tuple(row[: len(key)]) == key]
        return row[len(key) :][-7:-2]

    def test_subsampling_has_the_order_of_table_1(self):
        table = subsampling.run("small", self.folder).table("subsampling")
        for name in self.names:
            linear = self.rows(table, name, "linear subdivision")
            kept = self.rows(table, name, "non-oscillatory", 2.0)
            self.assertGreater(linear[0], kept[0], "PSNR")
            self.assertGreater(linear[4], kept[4], "total variation")
            smoothest = self.rows(table, name, "B-spline subdivision")
            self.assertGreater(kept[0], smoothest[0], "PSNR")
            self.assertTrue((self.folder / f"subsampling_difference_{name}.png").exists())
            self.assertTrue((self.folder / f"subsampling_tension_{name}.png").exists())

    def test_compression_has_the_order_of_table_2(self):
        table = compression.run("small", self.folder).table("compression")
        for name in self.names:
            for factor in (5, 12, 30):
                labels = ("compressed", "linear subdivision", "non-oscillatory")
                plain, linear, kept = (self.rows(table, f"{name}, centre", factor, label) for label in labels)
                self.assertLess(plain[0], linear[0], "PSNR")
                self.assertLess(linear[0], kept[0], "PSNR")
                for metric in (1, 2, 3):
                    self.assertGreater(plain[metric], linear[metric])
                    self.assertGreater(linear[metric], kept[metric])


class LabelMaps(unittest.TestCase):
    def test_every_peer_puts_the_children_of_a_slab_where_they_belong(self):
        """Voxels 8 ... 15 along z: a shift of the grid by a quarter of a voxel or more would show on one side."""
        slab = np.zeros((24, 16, 16), dtype=np.uint8)
        slab[8:16] = 1
        for name, double in label_maps.methods().items():
            with self.subTest(name):
                doubled = double(slab)
                self.assertEqual(doubled.dtype, np.uint8)
                self.assertEqual(np.flatnonzero(doubled[:, 8, 8]).tolist(), list(range(16, 32)))

    def test_measure_counts_wrong_children_by_the_true_boundary(self):
        true = np.zeros((8, 8, 8), dtype=np.uint8)
        true[2:6, 2:6, 2:6] = 1  # 64 voxels, 8 of them inside: 56 on the boundary
        doubled = true.copy()
        doubled[2, 2, 2:6] = 0
        doubled[0, 0, 0] = 1
        wrong, volume = label_maps.measure(doubled, true)
        self.assertAlmostEqual(wrong, 5 / 56)
        self.assertAlmostEqual(volume, -3 / 64)


class Compression(unittest.TestCase):
    def test_keeps_as_many_coefficients_as_the_factor_says(self):
        noise = np.random.default_rng(1).normal(100.0, 10.0, (32, 32, 32))
        result = compression.compress(noise, 8).astype(np.float64)
        layers = pywt.wavedecn(result - noise.mean(), "bior4.4", mode="periodization")
        coefficients, _ = pywt.coeffs_to_array(layers)
        self.assertEqual(np.count_nonzero(np.abs(coefficients) > 1e-3), 32**3 // 8)

    def test_factor_one_changes_nothing(self):
        noise = np.random.default_rng(2).normal(0.0, 10.0, (16, 24, 20))
        np.testing.assert_allclose(compression.compress(noise, 1), noise, atol=1e-4)


if __name__ == "__main__":
    unittest.main()
