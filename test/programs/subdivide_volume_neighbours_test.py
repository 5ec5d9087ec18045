# SPDX-License-Identifier: Apache-2.0
"""SubdivideVolume on files whose neighbours image libraries take for them, and on those that lack a part of theirs."""

import os
import tempfile
import unittest

from subdivide_volume_case import ProgramTest, noise
from subdivide_volume_files import Meta, write_meta, write_nifti

SIZE = [7, 6, 5]
COUNT = 7 * 6 * 5


class Neighbours(ProgramTest):
    def voxels(self, name):
        self.subdivide(name, "read.mha", "--scheme", "linear")
        return Meta(self.path("read.mha")).values

    def test_a_compressed_nifti_beside_a_plain_one(self):
        links = {name for name in os.listdir(tempfile.gettempdir()) if name.startswith(".links-")}
        write_meta(self.path("truth.mha"), SIZE, "h", noise(COUNT, seed=2))
        truth = self.voxels("truth.mha")
        for endings in ((".nii", ".nii.gz"), (".NII", ".NII.GZ")):
            write_nifti(self.path("scan" + endings[0]), SIZE, noise(COUNT, seed=3))
            self.subdivide("truth.mha", "scan" + endings[1], "--axes", "x")
            self.subdivide("truth.mha", "apart.mha", "--axes", "x")
            with self.subTest(endings=endings):
                self.assertEqual(self.voxels("scan" + endings[1]), self.voxels("apart.mha"))
                self.assertNotEqual(self.voxels("scan" + endings[0]), truth)
        after = {name for name in os.listdir(tempfile.gettempdir()) if name.startswith(".links-")}
        self.assertFalse(after - links)

    def test_pairs_in_capitals_or_compressed_are_read_back(self):
        write_meta(self.path("truth.mha"), SIZE, "h", noise(COUNT, seed=2))
        self.subdivide("truth.mha", "once.mha", "--axes", "x")
        truth = self.voxels("once.mha")
        for ending in (".HDR", ".IMG", ".IMG.GZ", ".hdr", ".img.gz"):
            for file in os.listdir(self.folder):
                if file.startswith("pair"):
                    os.remove(self.path(file))
            self.subdivide("truth.mha", "pair" + ending, "--axes", "x")
            with self.subTest(ending=ending):
                self.assertEqual(self.voxels("pair" + ending), truth)

    def test_pairs_that_lack_a_part(self):
        write_meta(self.path("truth.mha"), SIZE, "h", noise(COUNT, seed=2))
        self.subdivide("truth.mha", "plain.img")
        self.subdivide("truth.mha", "gzip.img.gz")
        for file in ("plain.img", "gzip.img.gz"):
            with open(self.path(file), "rb") as source:
                whole = source.read()
            for part in (len(whole) // 2, len(whole) - 1, 0):
                with open(self.path(file), "wb") as cut:
                    cut.write(whole[:part])
                with self.subTest(file=file, part=part):
                    self.assert_fails(self.run_program(self.path(file), self.path("out.mha")), 1, file)
        write_nifti(self.path("plain.nii"), SIZE, noise(COUNT))
        os.remove(self.path("plain.hdr"))
        self.assert_fails(self.run_program(self.path("plain.img"), self.path("out.mha")), 1, "plain.hdr")

    def test_a_file_in_the_way_of_a_pair(self):
        write_meta(self.path("truth.mha"), SIZE, "h", noise(COUNT))
        for output, other in (("pair.img", "pair.hdr"), ("PAIR.IMG", "PAIR.HDR")):
            with open(self.path(other), "w", encoding="ascii") as file:
                file.write("another's")
            self.assert_fails(self.run_program(self.path("truth.mha"), self.path(output)), 1, other)
            with open(self.path(other), encoding="ascii") as file:
                self.assertEqual(file.read(), "another's")
            self.assertFalse(os.path.exists(self.path(output)))

    def test_a_pair_of_another_program(self):
        write_meta(self.path("truth.mha"), SIZE, "h", noise(COUNT))
        for gz in ("", ".gz"):
            names = ["pair.hdr" + gz, "pair.img" + gz]
            for output in names:
                if output == "pair.hdr.gz":
                    continue  # no ending of an output
                for name in names:
                    with open(self.path(name), "w", encoding="ascii") as file:
                        file.write("ENVI\nsamples = 7\n" + name)
                with self.subTest(output=output):
                    result = self.run_program(self.path("truth.mha"), self.path(output))
                    self.assert_fails(result, 1, *names, "NIfTI")
                    for name in names:
                        with open(self.path(name), encoding="ascii") as file:
                            self.assertEqual(file.read(), "ENVI\nsamples = 7\n" + name)
            for name in names:
                os.remove(self.path(name))
            self.subdivide("truth.mha", names[1])  # and NIfTI's own pair gives way to the next one
            self.subdivide("truth.mha", "once.mha", "--axes", "x")
            self.subdivide("truth.mha", names[1], "--axes", "x")
            self.assertEqual(self.voxels(names[1]), self.voxels("once.mha"))
            for name in names:
                os.remove(self.path(name))

    def test_endings_of_nifti_in_both_cases(self):
        write_meta(self.path("truth.mha"), SIZE, "h", noise(COUNT))
        self.assert_fails(self.run_program(self.path("truth.mha"), self.path("out.Nii.Gz")), 1, "capitals")
        write_nifti(self.path("in.Nii"), SIZE, noise(COUNT))
        self.assert_fails(self.run_program(self.path("in.Nii"), self.path("out.mha")), 1, "capitals")

    def test_endings_in_capitals_and_both_cases_are_read_back(self):
        write_meta(self.path("truth.mha"), SIZE, "h", noise(COUNT, seed=3))
        self.subdivide("truth.mha", "once.mha", "--axes", "x")
        truth = self.voxels("once.mha")
        for name in ("a.GIPL.GZ", "a.Gipl.Gz", "a.gipl.GZ", "a.GIPL", "a.MHA", "a.Mhd", "a.NRRD", "b.Nhdr", "a.NII.GZ",
                     "a.VTK", "a.Hdf5", "a.TIF", "a.Tiff", "a.MRC"):
            self.subdivide("truth.mha", name, "--axes", "x")
            with self.subTest(name=name):
                self.assertEqual(self.voxels(name), truth)

    def test_voxels_as_text(self):
        values = noise(COUNT, seed=4)
        text = " ".join(map(str, values))
        headers = {"text.mha": "ObjectType = Image\nNDims = 3\nBinaryData = False\nDimSize = 7 6 5\n"
                               "ElementType = MET_SHORT\nElementDataFile = LOCAL\n",
                   "text.vtk": "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET STRUCTURED_POINTS\n"
                               "DIMENSIONS 7 6 5\nSPACING 1 1 1\nORIGIN 0 0 0\nPOINT_DATA 210\n"
                               "SCALARS voxels short 1\nLOOKUP_TABLE default\n"}
        write_meta(self.path("truth.mha"), SIZE, "h", values)
        truth = self.voxels("truth.mha")
        for name, header in headers.items():
            with open(self.path(name), "w", encoding="ascii") as file:
                file.write(header + text + "\n")
            with self.subTest(name=name):
                self.assertEqual(self.voxels(name), truth)
                for cut in (text[: len(text) // 2], text.rsplit(" ", 1)[0], ""):
                    with open(self.path(name), "w", encoding="ascii") as file:
                        file.write(header + cut + "\n")
                    self.assert_fails(self.run_program(self.path(name), self.path("out.mha")), 1, name, "truncated")

    def test_a_name_that_no_file_can_have(self):
        write_meta(self.path("truth.mha"), SIZE, "h", noise(COUNT))
        for ending in (".mha", ".nii", ".nii.gz", ".img", ".vtk", ".tif", ".mrc"):
            name = "n" * (256 - len(ending)) + ending
            result = self.run_program(self.path("truth.mha"), self.path(name), "--quiet")
            with self.subTest(ending=ending):
                self.assert_fails(result, 1, f"{name}: File name too long")

    def test_raw_voxels_without_their_layout(self):
        with open(self.path("voxels.raw"), "wb") as file:
            file.write(bytes(210))
        self.assert_fails(self.run_program(self.path("voxels.raw"), self.path("out.mha")), 1, "voxels.raw", "--raw")


if __name__ == "__main__":
    unittest.main()
