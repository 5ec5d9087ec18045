# SPDX-License-Identifier: Apache-2.0
"""SubdivideVolume on files whose headers can be misunderstood: read as they are meant, or refused."""

import gzip
import os
import struct
import unittest

from subdivide_volume_case import ProgramTest, noise
from subdivide_volume_files import (Meta, read_nrrd, write_dicom_slice, write_meta, write_nifti, write_nrrd,
                                    write_tiff)

SIZE = [7, 6, 5]
VALUES = noise(7 * 6 * 5)


class Headers(ProgramTest):
    def setUp(self):
        super().setUp()
        write_meta(self.path("truth.mha"), SIZE, "h", VALUES)
        self.truth = self.meta("truth.mha", "read.mha").values

    def patch_nifti(self, *numbers, name="in.nii"):
        """A NIfTI file with numbers put into its header: a format of struct, a place and a value."""
        write_nifti(self.path(name), SIZE, VALUES, numbers)

    def read(self, name, *words):
        """Reads a file, with a warning that has the words, if there are any."""
        result = self.run_program(self.path(name), self.path("read.mha"), "--quiet" if not words else "--streams=1")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr.count("warning"), 1 if words else 0, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        return Meta(self.path("read.mha"))

    def refuse(self, name, *words):
        self.assert_fails(self.run_program(self.path(name), self.path("out.mha")), 1, name, *words)

    def test_nifti_voxels_start_behind_the_header(self):
        for offset in (0, 4, 348):
            self.patch_nifti(("<f", 108, offset))
            self.refuse("in.nii", "vox_offset")
        self.patch_nifti(("<f", 108, 400))
        self.refuse("in.nii", "truncated")
        with open(self.path("in.nii"), "r+b") as file:
            content = file.read()
            file.seek(0)
            file.write(content[:352] + b"x" * 48 + content[352:])
        self.assertEqual(self.read("in.nii").values, self.truth)

    def test_nifti_bits_are_those_of_the_type(self):
        self.patch_nifti(("<h", 72, 32))
        with open(self.path("in.nii"), "r+b") as file:
            content = file.read()
            file.write(content[352:])  # as many bytes as these bits ask for
            content += content[352:]
        self.refuse("in.nii", "bitpix", "datatype")
        os.remove(self.path("in.nii"))
        with gzip.open(self.path("in.nii.gz"), "wb") as file:
            file.write(content)
        self.refuse("in.nii.gz", "bitpix", "datatype")

    def test_nifti_magic_is_that_of_the_files(self):
        for magic in (b"ni1\0", b"n+2\0", bytes(4)):
            for offset in (0, 352):  # at 0, the header would be read as voxels
                self.patch_nifti(("4s", 344, magic), ("<f", 108, offset))
                self.refuse("in.nii", "magic")
        self.patch_nifti()
        with open(self.path("in.nii"), "rb") as file:
            content = file.read()
        for header, voxels in (("pair.hdr", "pair.img"), ("half.hdr", "half.img.gz")):
            for magic, start, word in ((b"n+1\0", 352, "magic"), (b"ni2\0", 0, "magic"), (b"ni1\0", 0, None)):
                with open(self.path(header), "wb") as file:
                    file.write(content[:108] + struct.pack("<f", start) + content[112:344] + magic)
                with (gzip.open if voxels.endswith(".gz") else open)(self.path(voxels), "wb") as file:
                    file.write(content[352 - start:])
                for name in (header, voxels):
                    with self.subTest(name=name, magic=magic):
                        if word:
                            self.refuse(name, word)
                        else:
                            self.assertEqual(self.read(name).values, self.truth)

    def test_a_nifti_slope_of_none(self):
        for name in ("in.nii", "in.nii.gz"):
            self.patch_nifti(("<2f", 112, 0, 7), name="in.nii")
            if name.endswith(".gz"):
                with open(self.path("in.nii"), "rb") as plain, gzip.open(self.path(name), "wb") as file:
                    file.write(plain.read())
                os.remove(self.path("in.nii"))
            self.refuse(name, "scl_slope")
        self.patch_nifti(("<2f", 112, 0, 0))
        self.assertEqual(self.read("in.nii").values, self.truth)

    def test_two_placements_of_a_nifti(self):
        quaternion = [("<h", 252, 1), ("<3f", 268, 10, 20, 30)]
        matrix = lambda x: [("<h", 254, 1), ("<12f", 280, 1, 0, 0, x, 0, 1, 0, 20, 0, 0, 1, 30)]
        self.patch_nifti(*quaternion, *matrix(10))
        self.read("in.nii")
        self.assertEqual(self.run_program(self.path("in.nii"), self.path("read.mha")).stderr.count("warning"), 0)
        self.patch_nifti(*quaternion, *matrix(11))
        meta = self.read("in.nii", "sform is taken")
        # NIfTI's x and y point the other way; the first child lies a quarter of a voxel before its parent.
        self.assertEqual(meta.numbers("Offset"), [-10.75, -19.75, 29.75])
        self.patch_nifti(*quaternion, ("<h", 254, 1), ("<12f", 280, 2, 0, 0, 10, 0, 2, 0, 20, 0, 0, 2, 30))
        meta = self.read("in.nii", "qform is taken")
        self.assertEqual(meta.numbers("Offset"), [-9.75, -19.75, 29.75])

    def test_nifti_2_is_told(self):
        self.patch_nifti(("<i", 0, 540), ("4s", 4, b"n+2\0"), ("4s", 344, bytes(4)))
        self.refuse("in.nii", "NIfTI-2")

    def test_nrrd_axes_given_by_their_ends(self):
        for centers, spacing, first in (("cell", [2, 3, 4], [1, 1.5, 2]), ("node", [14 / 6, 18 / 5, 5], [0, 0, 0])):
            write_nrrd(self.path("in.nrrd"), SIZE, "h", VALUES,
                       more=["axis mins: 0 0 0", "axis maxs: 14 18 20", f"centers: {centers} {centers} {centers}"])
            meta = self.read("in.nrrd")
            self.assertEqual(meta.values, self.truth)
            for found, wanted, start, origin in zip(meta.numbers("ElementSpacing"), spacing, first,
                                                    meta.numbers("Offset")):
                self.assertAlmostEqual(found, wanted / 2)
                self.assertAlmostEqual(origin, start - wanted / 4)

    def test_gradients_of_nrrd_keep_the_frame_that_they_refer_to(self):
        write_nrrd(self.path("in.nrrd"), [*SIZE, 2], "h", VALUES + VALUES, more=[
            "space: right-anterior-superior", "space directions: (1,0,0) (0,1,0) (0,0,1) none",
            "kinds: space space space list", "measurement frame: (0,1,0) (1,0,0) (0,0,1)",
            "DWMRI_gradient_0000:=1 0 0", "DWMRI_gradient_0001:=0 1 0"])
        for name, *options in (["out.nrrd"], ["out.nhdr", "--compress"]):
            result = self.run_program(self.path("in.nrrd"), self.path(name), "--keep-metadata", *options)
            self.assertEqual((result.returncode, result.stderr.count("warning")), (0, 0), result.stderr)
            with open(self.path(name), "rb") as file:
                header = file.read().split(b"\n\n")[0].decode()
            self.assertIn("\nmeasurement frame: (0,-1,0) (-1,0,0) (0,0,1)\n", header)
            self.assertIn("\nDWMRI_gradient_0001:=0 1 0", header)
        for name, *options in (["out.mha"], ["out.nii"], ["slices/"], ["pieces.mhd", "--piece", "1/2"]):
            result = self.run_program(self.path("in.nrrd"), self.path(name), "--keep-metadata", *options)
            self.assertIn("cannot hold the measurement frame", result.stderr)

    def test_symmetric_tensors_of_nrrd_stay_such(self):
        values = noise(6 * len(VALUES))
        write_nrrd(self.path("in.nrrd"), [6, *SIZE], "h", values, more=["kinds: 3D-symmetric-matrix domain domain domain"])
        write_meta(self.path("vectors.mha"), SIZE, "h", values, channels=6)
        truth = self.meta("vectors.mha", "out.mha").data

        def check(name):
            header, data = read_nrrd(self.path(name))
            if name.endswith(".nhdr"):
                with open(self.path("out.raw"), "rb") as file:
                    data = file.read()
            self.assertIn("kinds: 3D-symmetric-matrix domain domain domain", header)
            self.assertEqual(data, truth)

        for name, *options in (["out.nrrd"], ["out.nhdr"], ["out.nrrd", "--streams", 3], ["out.nrrd", "--compress"]):
            self.subdivide("in.nrrd", name, *options)
            check(name)
        for name in ("pieces.nrrd", "out.nhdr"):
            for piece in ("2/2", "1/2"):
                result = self.run_program("--piece", piece, self.path("in.nrrd"), self.path(name))
                self.assertEqual(result.returncode, 0, result.stderr)
            check(name)
        self.subdivide("pieces.nrrd", "again.nrrd")

    def test_an_nrrd_encoding_that_is_not_read(self):
        write_nrrd(self.path("in.nrrd"), SIZE, "h", VALUES, encoding="bzip2")
        self.refuse("in.nrrd", "bzip2", "gzip")

    def test_the_order_of_axes_of_an_mrc_file(self):
        self.subdivide("truth.mha", "in.mrc")
        self.read("in.mrc")
        with open(self.path("in.mrc"), "r+b") as file:
            file.seek(64)
            file.write(struct.pack("<3i", 3, 2, 1))
        self.refuse("in.mrc", "3 2 1")

    def test_a_file_that_is_not_what_its_ending_says(self):
        for ending, name in (("nii", "NIfTI"), ("png", "PNG"), ("h5", "HDF5"), ("vtk", "VTK"), ("bmp", "BMP")):
            for content in (b"", b"hello, I am a text"):
                with open(self.path(f"in.{ending}"), "wb") as file:
                    file.write(content)
                self.refuse(f"in.{ending}", f"no {name} file")
        with open(self.path("in.xyz"), "wb") as file:
            file.write(bytes(100))
        self.refuse("in.xyz", "none of the known", "--raw")

    def write_bmp(self, name, colours):
        """A picture of 8 x 6 pixels with a table of colours."""
        pixels = bytes(noise(48, 0, 256))
        table = b"".join(bytes([*colours(i), 0]) for i in range(256))
        header = struct.pack("<2sIHHI", b"BM", 54 + 1024 + 48, 0, 0, 54 + 1024)
        header += struct.pack("<IiiHHIIiiII", 40, 8, 6, 1, 8, 0, 48, 2835, 2835, 256, 0)
        with open(self.path(name), "wb") as file:
            file.write(header + table + pixels)
        return pixels

    def test_tables_of_grey_values_are_no_colours(self):
        pixels = self.write_bmp("in.bmp", lambda i: (i, i, i))
        rows = [value for row in range(5, -1, -1) for value in pixels[8 * row:8 * row + 8]]
        write_meta(self.path("flat.mha"), [8, 6], "B", rows)
        self.assertEqual(self.read("in.bmp").values, self.meta("flat.mha", "out.mha").values)
        self.write_bmp("in.bmp", lambda i: (i, 0, 255 - i))
        self.assertEqual(self.read("in.bmp").fields["ElementNumberOfChannels"], "3")

    def test_bitmaps_of_32_bits_are_refused(self):
        os.mkdir(self.path("slices"))
        header = struct.pack("<2sIHHI", b"BM", 54 + 4 * 48, 0, 0, 54)
        header += struct.pack("<IiiHHIIiiII", 40, 8, 6, 1, 32, 0, 4 * 48, 2835, 2835, 0, 0)
        for name in ("in.bmp", "slices/a1.bmp", "slices/a2.bmp"):
            with open(self.path(name), "wb") as file:
                file.write(header + bytes(range(192)))
        self.refuse("in.bmp", "32 bits")
        self.refuse("slices", "a1.bmp", "32 bits")

    def test_damaged_pictures_are_told(self):
        write_meta(self.path("flat.mha"), [200, 150], "B", noise(30000, 0, 256))
        for ending in ("png", "jpg"):
            self.subdivide("flat.mha", f"in.{ending}")
            with open(self.path(f"in.{ending}"), "rb") as file:
                whole = file.read()
            for part in (16, len(whole) // 2, len(whole) - 40):
                with open(self.path(f"in.{ending}"), "wb") as file:
                    file.write(whole[:part])
                with self.subTest(ending=ending, part=part):
                    result = self.run_program("--quiet", self.path(f"in.{ending}"), self.path("out.mha"))
                    self.assert_fails(result, 1, f"in.{ending}")
                    self.assertRegex(result.stderr, "damaged|truncated")
        middle = len(whole) // 2
        with open(self.path("in.jpg"), "wb") as file:
            file.write(whole[:middle] + b"\xff\xd9" + bytes(len(whole) - middle - 4) + b"\xff\xd9")
        self.assert_fails(self.run_program("--quiet", self.path("in.jpg"), self.path("out.mha")), 1, "in.jpg", "damaged")

    def test_a_folder_of_dicom_with_a_picture(self):
        os.mkdir(self.path("both"))
        for number in range(3):
            write_dicom_slice(self.path(f"both/{number}.dcm"), "1.2.3.4", number, [7, 6], noise(42), [1, 1, 1])
        self.read("both")
        write_tiff(self.path("both/preview.tif"), 7, 6, noise(42))
        self.refuse("both", "DICOM", "0.dcm")

    def test_dicom_without_its_first_bytes(self):
        write_dicom_slice(self.path("in.dcm"), "1.2.3.4", 0, [7, 6], noise(42), [1, 1, 1])
        expected = self.read("in.dcm").values
        with open(self.path("in.dcm"), "r+b") as file:
            content = file.read()
            file.seek(0)
            file.write(content[132:])
            file.truncate()
        self.assertEqual(self.read("in.dcm").values, expected)


if __name__ == "__main__":
    unittest.main()
