#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""SubdivideVolume --labels; the environment variable SUBDIVIDE_VOLUME holds the path of the program."""

import math
import os
import random
import struct
import unittest

from subdivide_volume_case import PROGRAM, ProgramTest
from subdivide_volume_files import Meta, read_nrrd, write_meta, write_nifti, write_nrrd

SEGMENTS = ["Segment0_ID:=a", "Segment0_Name:=liver", "Segment0_LabelValue:=3", "Segment0_Layer:=0",
            "Segment0_Extent:=0 5 0 4 0 3", "Segment1_ID:=b", "Segment1_LabelValue:=7",
            "Segment1_Extent:=1 5 0 4 0 2", "Segmentation_ReferenceImageExtentOffset:=2 2 2"]


def blobs(size, labels, seed=1):
    """Each voxel has the label of the nearest of a few points."""
    source = random.Random(seed)
    points = [([source.uniform(0, n) for n in size], labels[i % len(labels)]) for i in range(4 * len(labels))]
    values = []
    for number in range(math.prod(size)):
        place = []
        for n in size:
            place.append(number % n)
            number //= n
        values.append(min(points, key=lambda point: math.dist(point[0], place))[1])
    return values


class Labels(ProgramTest):
    SIZE = [11, 9, 8]

    def setUp(self):
        super().setUp()
        self.values = blobs(self.SIZE, [0, 3, 7])
        write_meta(self.path("in.mha"), self.SIZE, "h", self.values)

    def elect(self, values, size, scheme, *arguments):
        """The winner of each child, where the votes are the labels' indicators, subdivided as real values."""
        labels = sorted(set(values))
        votes = []
        for label in labels:
            write_meta(self.path("indicator.mha"), size, "d", [float(value == label) for value in values])
            votes.append(self.meta("indicator.mha", "vote.mha", "--scheme", *scheme, *arguments).values)
        winners = []
        doubled = [2 * n for n in size]
        for number, voted in enumerate(zip(*votes)):
            parent, stride, rest = 0, 1, number
            for n, m in zip(size, doubled):
                parent += rest % m // 2 * stride
                stride *= n
                rest //= m
            most = max(voted)
            tied = [label for label, vote in zip(labels, voted) if vote == most]
            winners.append(values[parent] if values[parent] in tied else tied[0])
        return winners

    def test_the_largest_vote_wins(self):
        for boundary in ("nearest", "periodic"):
            for scheme in (["restored", "--tension", 0], ["bspline"], ["linear"]):
                expected = self.elect(self.values, self.SIZE, scheme, "--boundary", boundary)
                out = self.meta("in.mha", "out.mha", "--labels", "--scheme", *scheme, "--boundary", boundary)
                self.assertEqual(list(out.values), expected, (scheme, boundary))

    def test_the_default_is_the_restored_scheme_without_a_tension(self):
        default = self.meta("in.mha", "out.mha", "--labels").data
        for options in (["--scheme", "default"], ["--scheme", "restored"], ["--tension", 0],
                        ["--scheme", "restored", "--tension", 0]):
            self.assertEqual(self.meta("in.mha", "out.mha", "--labels", *options).data, default)
        values = random.Random(1).choices([0, 3, 7], k=math.prod(self.SIZE))
        write_meta(self.path("noise.mha"), self.SIZE, "h", values)
        self.assertFalse(self.meta("noise.mha", "out.mha", "--labels").data ==
                         self.meta("noise.mha", "out.mha", "--labels", "--tension", 2).data)

    def test_every_format_keeps_the_set_of_labels(self):
        self.assertEqual(set(self.meta("in.mha", "out.mha", "--labels").values), {0, 3, 7})
        expected = Meta(self.path("out.mha")).data
        write_nifti(self.path("in.nii"), self.SIZE, self.values)
        with open(self.path("in.nii"), "r+b") as file:
            file.seek(68)
            file.write(struct.pack("<h", 1002))
        self.subdivide("in.nii", "out.nii", "--labels")
        with open(self.path("out.nii"), "rb") as file:
            self.assertEqual(file.read()[-len(expected):], expected)
        write_nrrd(self.path("in.seg.nrrd"), self.SIZE, "B", self.values, more=SEGMENTS)
        self.subdivide("in.seg.nrrd", "out.seg.nrrd", "--labels")
        self.assertEqual(list(read_nrrd(self.path("out.seg.nrrd"))[1]), list(Meta(self.path("out.mha")).values))

    def test_a_segmentation_keeps_its_names_but_no_extent_of_the_old_grid(self):
        write_nrrd(self.path("in.seg.nrrd"), self.SIZE, "B", self.values, more=SEGMENTS)
        for options in ([], ["--keep-metadata"]):
            self.subdivide("in.seg.nrrd", "out.seg.nrrd", "--labels", *options)
            header = read_nrrd(self.path("out.seg.nrrd"))[0]
            for line in ("Segment0_Name:=liver", "Segment0_LabelValue:=3", "Segment0_Layer:=0", "Segment1_ID:=b"):
                self.assertIn(line, header)
            self.assertFalse([line for line in header if "Extent" in line])

    def test_pieces_threads_and_memory_give_the_same_bytes(self):
        for levels in (1, 2):
            labels = ["--labels", "--levels", levels]
            whole = self.meta("in.mha", "whole.mha", *labels, "--threads", 1, "--streams", 1).data
            for options in (["--streams", 2], ["--streams", 7], ["--streams", 1000], ["--threads", 5],
                            ["--memory", "0.2G"]):
                out = self.meta("in.mha", "out.mha", *labels, *options)
                self.assertEqual(out.data, whole, (levels, options))

    def test_each_level_is_a_run_of_its_own(self):
        for scheme in ("restored", "bspline", "linear"):
            options = ["--labels", "--scheme", scheme, "--boundary", "mirror"]
            self.subdivide("in.mha", "once.mha", *options)
            self.subdivide("once.mha", "twice.mha", *options)
            thrice = self.meta("twice.mha", "thrice.mha", *options).data
            self.assertEqual(self.meta("in.mha", "out.mha", *options, "--levels", 3).data, thrice)

    def test_types_hold_the_labels_or_the_run_fails(self):
        for pixel, low, high in (("b", -128, 127), ("Q", 0, 2 ** 64 - 1), ("q", -2 ** 63, 2 ** 63 - 1)):
            values = [low if value == 3 else high if value == 7 else value for value in self.values]
            write_meta(self.path("extreme.mha"), self.SIZE, pixel, values)
            self.assertEqual(set(self.meta("extreme.mha", "out.mha", "--labels").values), {0, low, high})
        small = self.meta("in.mha", "out.mha", "--labels", "--output-type", "uint8")
        self.assertEqual((small.pixel, set(small.values)), ("B", {0, 3, 7}))
        os.remove(self.path("out.mha"))
        write_meta(self.path("large.mha"), self.SIZE, "h", [300 if value == 7 else value for value in self.values])
        self.assert_fails(self.run_program(self.path("large.mha"), self.path("out.mha"), "--labels", "--output-type",
                                           "uint8", "--quiet"), 1, "label 300", "uint8")

    def test_what_labels_cannot_be_is_refused(self):
        files = [self.path("in.mha"), self.path("out.mha"), "--labels"]
        for scheme in ("nonoscillatory", "bounded"):
            self.assert_fails(self.run_program(*files, "--scheme", scheme), 2, "--labels", scheme, "restored")
        for output_type in ("float", "double"):
            self.assert_fails(self.run_program(*files, "--output-type", output_type), 1, "--labels", output_type)
        self.assert_fails(self.run_program(*files, "--boundary", "1.5"), 1, "1.5")
        write_meta(self.path("real.mha"), [4, 3], "f", [0] * 12)
        self.assert_fails(self.run_program(self.path("real.mha"), self.path("out.mha"), "--labels"), 1, "--labels",
                          "float")
        write_meta(self.path("pairs.mha"), [4, 3], "B", [0] * 24, channels=2)
        self.assert_fails(self.run_program(self.path("pairs.mha"), self.path("out.mha"), "--labels"), 1, "--labels",
                          "2 components")

    def test_a_constant_beyond_the_image_is_a_label_of_its_own(self):
        out = self.meta("in.mha", "out.mha", "--labels", "--boundary", "9")
        self.assertLessEqual({0, 3, 7}, set(out.values))
        self.assertLessEqual(set(out.values), {0, 3, 7, 9})


if __name__ == "__main__":
    if not PROGRAM:
        raise SystemExit("SUBDIVIDE_VOLUME is not set")
    unittest.main()
