#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs SubdivideVolume as a user does; the environment variable SUBDIVIDE_VOLUME holds the path of the program."""

import array
import filecmp
import math
import os
import pty
import random
import re
import subprocess
import sys
import unittest
import xml.etree.ElementTree

from subdivide_volume_case import PROGRAM, ProgramTest, noise, skip_under_sanitizers
from subdivide_volume_errors import Errors  # noqa: F401: its tests run from here
from subdivide_volume_files import (META_TYPES, OPTION_TYPES, Meta, meta_header, read_nrrd, write_compressed_meta,
                                    write_dicom_slice, write_meta, write_nifti, write_nrrd)

SCHEMES = ("nonoscillatory", "linear", "bounded", "bspline")


class Results(ProgramTest):
    """What is computed."""

    STEP = {"linear": [0] * 5 + [10, 14, -64, -112, 212, 812, 1136, 1088, 1010, 1014] + [1024] * 5,
            "nonoscillatory": [0] * 5 + [1, 11, 56, 176, 386, 638, 848, 968, 1013, 1023] + [1024] * 5}

    def test_a_step_gives_the_numbers_of_the_schemes(self):
        rows = 3
        write_meta(self.path("in.mha"), [10, rows], "d", ([0.0] * 5 + [1.0] * 5) * rows)
        for scheme, expected in self.STEP.items():
            out = self.meta("in.mha", "out.mha", "--axes", "x", "--scheme", scheme)
            self.assertEqual(out.size, [20, rows])
            self.assertEqual([1024 * value for value in out.values], expected * rows)

    def test_bounded_and_bspline_stay_within_the_range_and_differ(self):
        write_meta(self.path("in.mha"), [12, 11, 10], "f", noise(1320))
        outs = {scheme: self.meta("in.mha", "out.mha", "--scheme", scheme) for scheme in SCHEMES}
        self.assertEqual(len({out.data for out in outs.values()}), len(SCHEMES))
        for scheme in ("bounded", "bspline"):
            self.assertGreaterEqual(min(outs[scheme].values), 0)
            self.assertLess(max(outs[scheme].values), 1000)

    def test_a_large_tension_is_the_linear_scheme_almost(self):
        write_meta(self.path("in.mha"), [12, 11, 10], "d", noise(1320))
        linear = self.meta("in.mha", "out.mha", "--scheme", "linear", "--boundary", "periodic").values
        distances = []
        for tension in ("1.01", "2", "1e6"):
            out = self.meta("in.mha", "out.mha", "--tension", tension, "--boundary", "periodic").values
            distances.append(sum(abs(a - b) for a, b in zip(out, linear)))
        self.assertGreater(distances[0], distances[1])
        self.assertLess(distances[2], 1e-6)

    def test_the_boundary_is_what_padding_the_image_by_hand_gives(self):
        size, width = 7, 8
        row = noise(size)
        beyond = {"nearest": lambda i: row[min(max(i, 0), size - 1)],
                  "periodic": lambda i: row[i % size],
                  "mirror": lambda i: row[i % (2 * size) if i % (2 * size) < size else 2 * size - 1 - i % (2 * size)],
                  "-3.5": lambda i: row[i] if 0 <= i < size else -3.5}
        write_meta(self.path("in.mha"), [size, 2], "f", row * 2)
        for boundary, value in beyond.items():
            out = self.meta("in.mha", "out.mha", "--axes", "x", "--boundary", boundary)
            padded = [value(i) for i in range(-width, size + width)]
            write_meta(self.path("padded.mha"), [len(padded), 2], "f", padded * 2)
            reference = self.meta("padded.mha", "outpadded.mha", "--axes", "x")
            expected = list(reference.values[2 * width:2 * (width + size)])
            self.assertEqual(list(out.values[:2 * size]), expected, boundary)

    def test_axes_keep_their_grid_unless_they_are_subdivided(self):
        write_meta(self.path("in.mha"), [6, 5, 4], "h", noise(120), spacing=[1, 2, 4])
        for axes in ("x", "y", "z", "xy", "zx", "xyz"):
            out = self.meta("in.mha", "out.mha", "--axes", axes)
            factors = [2 if axis in axes else 1 for axis in "xyz"]
            self.assertEqual(out.size, [n * f for n, f in zip([6, 5, 4], factors)])
            self.assertEqual(out.numbers("ElementSpacing"), [s / f for s, f in zip([1, 2, 4], factors)])
            self.assertEqual(out.numbers("Offset"), [-s / 4 if f == 2 else 0 for s, f in zip([1, 2, 4], factors)])

    def test_a_time_series_is_subdivided_frame_by_frame(self):
        frames = [noise(60, seed=frame) for frame in range(3)]
        write_meta(self.path("in.mha"), [5, 4, 3, 3], "h", sum(frames, []))
        out = self.meta("in.mha", "out.mha")
        self.assertEqual(out.size, [10, 8, 6, 3])
        alone = b""
        for frame in frames:
            write_meta(self.path("frame.mha"), [5, 4, 3], "h", frame)
            alone += self.meta("frame.mha", "outframe.mha").data
        self.assertEqual(out.data, alone)
        self.assertEqual(self.meta("in.mha", "out.mha", "--axes", "t").size, [5, 4, 3, 6])

    def test_components_are_subdivided_one_by_one(self):
        channels = [noise(60, 0, 256, seed=channel) for channel in range(3)]
        write_meta(self.path("in.mha"), [5, 4, 3], "B", [v for voxel in zip(*channels) for v in voxel], channels=3)
        out = self.meta("in.mha", "out.mha", "--boundary", "7")
        for channel, values in enumerate(channels):
            write_meta(self.path("one.mha"), [5, 4, 3], "B", values)
            self.assertEqual(out.data[channel::3], self.meta("one.mha", "outone.mha", "--boundary", "7").data)

    def test_every_pixel_type_can_be_read_and_written(self):
        values = [[0, 10, 20, 250, 255, 120][(x + y) % 6] // 2 for y in range(6) for x in range(8)]
        write_meta(self.path("double.mha"), [8, 6], "d", values)
        reals = self.meta("double.mha", "out.mha", "--scheme", "linear").values
        for pixel in META_TYPES:
            write_meta(self.path("in.mha"), [8, 6], pixel, values)
            self.assertEqual(self.meta("in.mha", "out.mha").pixel, pixel)
            for to in META_TYPES:
                out = self.meta("in.mha", "out.mha", "--scheme", "linear", "--output-type", OPTION_TYPES[to])
                self.assertEqual(out.pixel, to)
                bits = 8 * out.values.itemsize
                low, high = (-2 ** (bits - 1), 2 ** (bits - 1) - 1) if to.islower() else (0, 2 ** bits - 1)
                expected = reals if to in "fd" else [min(max(round(v), low), high) for v in reals]
                for a, b in zip(out.values, expected):
                    self.assertAlmostEqual(a, b, delta=1e-4 if to in "fd" else 0, msg=f"{pixel} to {to}")

    def test_the_phantom_has_the_ranges_of_the_schemes(self):
        write_meta(self.path("in.mha"), [96, 96, 96], "d", phantom())
        linear = self.meta("in.mha", "out.mha", "--scheme", "linear").values
        self.assertAlmostEqual(min(linear), -0.3127940520644188, delta=1e-12)
        self.assertAlmostEqual(max(linear), 1.5234947204589844, delta=1e-12)
        result = self.subdivide("in.mha", "out.mha")
        values = Meta(self.path("out.mha")).values
        self.assertEqual((min(values), max(values)), (0.0, 1.0))
        self.assertRegex(result.stdout, r"(?m)^input .*range 0 to 1$")
        self.assertRegex(result.stdout, r"(?m)^output .*192 x 192 x 192 double, spacing 0.5 x 0.5 x 0.5, range 0 to 1$")


def phantom():
    """Cube, stick, planes and two balls in 96 voxels along each axis, x fastest."""
    boxes = [((8, 28), (8, 28), (8, 28)), ((40, 42), (8, 10), (6, 46)), ((8, 40), (50, 52), (50, 86)),
             ((8, 10), (50, 80), (50, 86))]
    values = [0.0] * 96 ** 3
    for z in range(96):
        for y in range(96):
            row = 96 * (y + 96 * z)
            for (z0, z1), (y0, y1), (x0, x1) in boxes:
                if z0 <= z < z1 and y0 <= y < y1:
                    values[row + x0:row + x1] = [1.0] * (x1 - x0)
            for x in range(96):
                if (z - 66) ** 2 + (y - 26) ** 2 + (x - 26) ** 2 <= 256:
                    values[row + x] = 1.0
                distance = (z - 66) ** 2 + (y - 66) ** 2 + (x - 66) ** 2
                if distance < 400:
                    values[row + x] = 1 - math.sqrt(distance) / 20
    return values


class Streaming(ProgramTest):
    """Pieces, threads and memory change nothing but the memory."""

    def test_pieces_and_threads_give_the_same_bytes(self):
        write_meta(self.path("in.mha"), [13, 11, 9], "H", noise(1287))
        for boundary in ("nearest", "mirror", "periodic", "5"):
            whole = self.meta("in.mha", "out.mha", "--boundary", boundary, "--threads", 1).data
            for streams in (2, 3, 7, 18, 1000):
                result = self.subdivide("in.mha", "out.mha", "--boundary", boundary, "--streams", streams)
                self.assertEqual(Meta(self.path("out.mha")).data, whole)
                self.assertGreaterEqual(int(re.search(r"(\d+) piece", result.stdout)[1]), min(streams, 18))
            self.assertEqual(self.meta("in.mha", "out.mha", "--boundary", boundary, "--threads", 5).data, whole)

    def test_other_dimensions_components_and_files_stream(self):
        images = {"flat.mha": ([40, 30], "f", 1), "series.mha": ([6, 5, 4, 5], "h", 1),
                  "vectors.mha": ([6, 5, 7], "B", 4), "real.mha": ([9, 8, 7], "d", 1)}
        for name, (size, pixel, channels) in images.items():
            write_meta(self.path(name), size, pixel, noise(math.prod(size) * channels, 0, 256), channels=channels)
            whole = self.meta(name, "out.mha", "--output-type", "int16").data
            self.assertEqual(self.meta(name, "out.mha", "--output-type", "int16", "--streams", 9).data, whole)
            self.assertEqual(self.meta(name, "out.mhd", "--output-type", "int16", "--streams", 9).data, whole)
            self.assertEqual(Meta(self.path("out.mhd")).fields["ElementDataFile"], "out.raw")
            again = self.meta("out.mha", "again.mha").data
            self.assertEqual(self.meta("out.mhd", "again.mhd", "--streams", 5).data, again)

    def test_files_of_the_same_names_in_the_current_folder_are_left_alone(self):
        write_meta(self.path("whole.mha"), [7, 11, 13], "h", noise(1001))
        whole = self.meta("whole.mha", "expected.mha").data
        header = meta_header([7, 11, 13], "h", data_file="scan.raw")
        voxels = array.array("h", noise(1001)).tobytes()
        decoys = {"scan.mhd": header, "scan.raw": voxels, "scan.zraw": b"decoy", "other.raw": b"decoy", "probe": b"decoy"}
        for name, content in decoys.items():
            with open(self.path(name), "wb") as file:
                file.write(content)
        os.mkdir(self.path("doubled"))
        for output in ("doubled/scan.mhd", "doubled/scan.mhd", "doubled/other.mhd"):
            for options in (["--streams", 20], ["--streams", 1], ["--compress"]):
                result = self.run_program("scan.mhd", output, *options, cwd=self.folder)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(Meta(self.path(output)).data, whole)
                for name, content in decoys.items():
                    with open(self.path(name), "rb") as file:
                        self.assertEqual(file.read(), content, name)
        self.assertEqual(self.run_program("scan.mhd", "scan.mhd", "--streams", 20, cwd=self.folder).returncode, 0)
        self.assertEqual(Meta(self.path("scan.mhd")).data, whole)

    def test_an_output_in_place_of_its_input(self):
        for ending in ("mha", "mhd"):
            write_meta(self.path("in.mha"), [20, 18, 16], "H", noise(5760))
            self.subdivide("in.mha", f"start.{ending}", "--axes", "x")
            expected = self.meta(f"start.{ending}", "out.mha").data
            self.assertEqual(self.meta(f"start.{ending}", f"start.{ending}", "--streams", 6).data, expected)

    def test_a_link_stays_a_link(self):
        write_meta(self.path("in.mha"), [4, 4], "H", noise(16))
        write_meta(self.path("target.mha"), [1, 1], "H", [0])
        os.symlink("target.mha", self.path("link.mha"))
        self.subdivide("in.mha", "link.mha")
        self.assertTrue(os.path.islink(self.path("link.mha")))
        self.assertEqual(Meta(self.path("target.mha")).size, [8, 8])

    def test_an_image_of_two_files_is_written_where_a_link_leads_to(self):
        write_meta(self.path("in.mha"), [4, 4, 4], "H", noise(64))
        os.mkdir(self.path("other"))
        for name, target, data in (("a.mhd", "real.mhd", "real.raw"), ("b.nhdr", "real.nhdr", "real.raw"),
                                   ("c.hdr", "pair.hdr", "pair.img"), ("d.img", "twin.img", "twin.hdr")):
            for options in ([], ["--piece", "1/1"]) if name[0] in "ab" else ([],):
                os.symlink(f"other/{target}", self.path(name))
                result = self.run_program(self.path("in.mha"), self.path(name), *options)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn(f"{name} is a link", result.stderr)
                self.assertIn(os.path.realpath(self.path(f"other/{target}")), result.stderr)
                self.assertTrue(os.path.islink(self.path(name)))
                self.assertEqual(sorted(os.listdir(self.path("other"))), sorted([target, data]))
                os.remove(self.path(name))
                for file in (target, data):
                    os.remove(self.path(f"other/{file}"))

    def test_a_memory_budget_is_kept(self):
        skip_under_sanitizers(self)
        side, budget = 240, 150 * 10 ** 6
        with open(self.path("in.mha"), "wb") as file:
            file.write(meta_header([side] * 3, "H"))
            for plane in range(side):
                file.write(random.Random(plane).randbytes(2 * side * side))
        code = ("import resource, subprocess, sys; code = subprocess.run(sys.argv[1:]).returncode; "
                "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss); sys.exit(code)")
        peaks = []
        for name, arguments in (("whole.mha", ["--streams", 1]), ("pieces.mha", ["--memory", "150M"])):
            command = [PROGRAM, self.path("in.mha"), self.path(name), "--quiet", "--threads", 2, *arguments]
            measured = subprocess.run([sys.executable, "-c", code, *map(str, command)], capture_output=True, text=True,
                                      check=True)
            peaks.append(1024 * int(measured.stdout))
        self.assertGreater(peaks[0], budget, "the image is too small for this test")
        self.assertLess(peaks[1], budget)
        self.assertTrue(filecmp.cmp(self.path("whole.mha"), self.path("pieces.mha"), shallow=False))

    def test_a_budget_that_cannot_be_kept_is_an_error(self):
        write_meta(self.path("in.mha"), [100, 100, 100], "B", bytes(10 ** 6))
        for name in ("out.mha", "out.nii"):
            self.assert_fails(self.run_program(self.path("in.mha"), self.path(name), "--memory", "20M"), 1, "--memory")
        self.assert_fails(self.run_program(self.path("in.mha"), self.path("out.nii"), "--memory", "70M"), 1, "pieces")

    def test_streams_that_do_nothing_are_warned_of(self):
        write_meta(self.path("in.mha"), [6, 5, 4], "h", noise(120))
        write_nifti(self.path("in.nii.gz"), [6, 5, 4], noise(120))
        whole = self.meta("in.mha", "whole.mha").data
        for names, words in ((("in.mha", "out.nii"), "cannot be written"),
                             (("in.nii.gz", "out.mha"), "cannot be read")):
            result = self.run_program(*map(self.path, names), "--streams", 3)
            self.assertEqual(result.returncode, 0)
            self.assertIn("SubdivideVolume: warning: ", result.stderr)
            self.assertIn(words, result.stderr)
        self.assertEqual(Meta(self.path("out.mha")).data, whole)


class Files(ProgramTest):
    """Formats and what they carry besides voxels."""

    def test_formats_that_are_read_alike_give_the_same_voxels(self):
        size, values = [9, 8, 7], noise(504, -1000, 1000)
        write_meta(self.path("in.mha"), size, "h", values)
        expected = self.meta("in.mha", "out.mha").data
        write_compressed_meta(self.path("compressed.mha"), size, "h", values)
        write_nrrd(self.path("raw.nrrd"), size, "h", values)
        write_nrrd(self.path("gzip.nrrd"), size, "h", values, encoding="gzip")
        write_nifti(self.path("in.nii"), size, values)
        write_nifti(self.path("in.nii.gz"), size, values)
        for name in ("compressed.mha", "raw.nrrd", "gzip.nrrd", "in.nii", "in.nii.gz"):
            self.assertEqual(self.meta(name, "out.mha").data, expected, name)

    def test_formats_that_are_written_alike_are_read_back(self):
        write_meta(self.path("in.mha"), [9, 8, 7], "h", noise(504, -1000, 1000))
        expected = self.meta("in.mha", "once.mha", "--axes", "x").data
        twice = self.meta("once.mha", "twice.mha", "--axes", "y").data
        for ending in ("mhd", "nrrd", "nhdr", "nii", "nii.gz", "img", "vtk", "gipl", "tif", "hdf5", "mrc"):
            for options in ([], ["--compress"]):
                folder = f"{ending}{len(options)}"
                os.mkdir(self.path(folder))
                self.subdivide("in.mha", f"{folder}/out.{ending}", "--axes", "x", *options)
                self.assertEqual(self.meta(f"{folder}/out.{ending}", "back.mha", "--axes", "y").data, twice, folder)
        self.assertEqual(read_nrrd(self.path("nrrd0/out.nrrd"))[1], expected)
        self.assertEqual(read_nrrd(self.path("nrrd1/out.nrrd"))[1], expected)

    def test_compression_makes_the_file_smaller(self):
        write_meta(self.path("in.mha"), [32, 32, 32], "h", [v // 2000 for v in range(32 ** 3)])
        plain = self.meta("in.mha", "plain.mha")
        for ending in ("mha", "mhd"):
            packed = self.meta("in.mha", f"packed.{ending}", "--compress")
            self.assertEqual((packed.fields["CompressedData"], packed.data), ("True", plain.data))
        self.assertLess(os.path.getsize(self.path("packed.mha")), os.path.getsize(self.path("plain.mha")) // 4)

    def test_direction_origin_and_metadata_survive(self):
        more = ["TransformMatrix = 0 1 0 -1 0 0 0 0 1", "Offset = 10 20 30", "Patient = a phantom"]
        write_meta(self.path("in.mha"), [6, 5, 4], "h", noise(120), spacing=[1, 2, 4], more=more)
        out = self.meta("in.mha", "out.mha")
        self.assertEqual(out.numbers("TransformMatrix"), [0, 1, 0, -1, 0, 0, 0, 0, 1])
        # The first index lies a quarter of a voxel before the old one along each axis of the image.
        self.assertEqual(out.numbers("Offset"), [10 + 2 / 4, 20 - 1 / 4, 30 - 4 / 4])
        self.assertNotIn("ITK_original_spacing", out.fields)
        write_nrrd(self.path("in.nrrd"), [6, 5, 4], "h", noise(120), more=["Patient:=a phantom"])
        self.subdivide("in.nrrd", "out.nrrd", "--keep-metadata")
        self.assertIn("Patient:=a phantom", read_nrrd(self.path("out.nrrd"))[0])
        self.assertEqual(self.meta("in.nrrd", "out.mha", "--keep-metadata").fields["Patient"], "a phantom")

    def test_a_dicom_series(self):
        size, spacing = [8, 6, 5], [0.5, 0.75, 2]
        slices = [noise(48, -1000, 1000, seed=z) for z in range(size[2])]
        os.mkdir(self.path("dicom"))
        for z, values in enumerate(slices):
            write_dicom_slice(self.path(f"dicom/{9 - z}.dcm"), "1.2.3.4", z, size, values, spacing)
        out = self.meta("dicom", "out.mha")
        self.assertEqual(out.size, [16, 12, 10])
        self.assertEqual(out.numbers("ElementSpacing"), [0.25, 0.375, 1])
        write_meta(self.path("in.mha"), size, "h", sum(slices, []))
        self.assertEqual(out.data, self.meta("in.mha", "whole.mha").data)
        self.assertEqual(out.data, self.meta("dicom", "out.mha", "--streams", 4).data)

        write_dicom_slice(self.path("dicom/other.dcm"), "1.2.3.9", 0, size, slices[0], spacing)
        os.remove(self.path("out.mha"))
        command = [self.path("dicom"), self.path("out.mha")]
        self.assert_fails(self.run_program(*command), 1, "--series", "1.2.3.4", "1.2.3.9")
        self.assert_fails(self.run_program(*command, "--series", "1.2.3"), 1, "no DICOM series 1.2.3 ")
        self.assertEqual(self.meta("dicom", "out.mha", "--series", "1.2.3.4").data, out.data)


class Messages(ProgramTest):
    """What the program prints."""

    def setUp(self):
        super().setUp()
        write_meta(self.path("in.mha"), [6, 5, 4], "h", noise(120))

    def test_quiet_prints_nothing(self):
        result = self.subdivide("in.mha", "out.mha", "--quiet")
        self.assertEqual((result.stdout, result.stderr), ("", ""))

    def test_lines_where_there_is_no_terminal(self):
        result = self.subdivide("in.mha", "out.mha", "--streams", 4)
        self.assertRegex(result.stderr, r"\A(\d+0? %\n)+\Z")
        self.assertEqual(result.stderr.splitlines()[-1], "100 %")
        self.assertRegex(result.stdout,
                         r"\Ainput .*6 x 5 x 4 int16.*\noutput .*12 x 10 x 8 int16.*\ntime .*4 pieces\n\Z")

    def test_a_bar_on_a_terminal(self):
        try:
            controller, terminal = pty.openpty()
        except OSError as error:
            self.skipTest(f"no terminal to be had: {error}")
        subprocess.run([PROGRAM, self.path("in.mha"), self.path("out.mha")], stdout=subprocess.DEVNULL, stderr=terminal,
                       check=True)
        os.close(terminal)
        text = os.read(controller, 65536).decode()
        os.close(controller)
        self.assertTrue(text.endswith("\r[" + "#" * 40 + "] 100 %\r\n"), text)

    def test_progress_as_slicer_reads_it(self):
        result = self.subdivide("in.mha", "out.mha", "--progress-xml", "--streams", 4)
        self.assertEqual(result.stderr, "")
        steps = [float(text) for text in re.findall(r"<filter-progress>(.*)</filter-progress>", result.stdout)]
        self.assertEqual((steps, steps[-1]), (sorted(steps), 1.0))
        tags = re.sub(r"(?s)(input|output|time) .*", "", result.stdout)
        root = xml.etree.ElementTree.fromstring(f"<all>{tags}</all>")
        self.assertEqual([root[0].tag, root[-1].tag], ["filter-start", "filter-end"])
        self.assertEqual(root.find("filter-start/filter-name").text, "SubdivideVolume")

    def test_the_description_for_slicer_matches_the_options(self):
        result = self.run_program("--xml")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertTrue(result.stdout.startswith("<?xml"))
        root = xml.etree.ElementTree.fromstring(result.stdout.encode())
        self.assertEqual(root.tag, "executable")
        arguments = []
        for parameter in root.findall("parameters/*[longflag]"):
            flag, default = parameter.find("longflag").text, parameter.find("default").text
            # An empty string and what is false are left out.
            if parameter.tag == "boolean":
                arguments += [flag] if default == "true" else []
                self.assertEqual(self.subdivide("in.mha", "out.mha", flag).returncode, 0)
            elif default is not None:
                arguments += [flag, default]
            else:
                self.assertEqual(parameter.tag, "string")
                self.assertIn(flag, self.run_program("--help").stdout)
            for element in parameter.findall("element"):
                self.assertEqual(self.subdivide("in.mha", "out.mha", arguments[-2], element.text).returncode, 0)
        indices = [image.find("channel").text for image in root.findall("parameters/image")]
        self.assertEqual(indices, ["input", "output"])
        # Slicer's own command line: all flags first, then the volumes.
        result = self.run_program(*arguments, self.path("in.mha"), self.path("out.nrrd"))
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_help_and_version(self):
        self.assertIn("--scheme", self.run_program("--help").stdout)
        self.assertRegex(self.run_program("--version").stdout, r"^SubdivideVolume \d+\.\d+")


if __name__ == "__main__":
    if not PROGRAM:
        raise SystemExit("SUBDIVIDE_VOLUME is not set")
    unittest.main()
