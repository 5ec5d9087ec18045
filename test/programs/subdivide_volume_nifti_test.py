# SPDX-License-Identifier: Apache-2.0
"""SubdivideVolume on NIfTI's own ways: what its numbers, placements and components mean, and what is not finite."""

import array
import gzip
import math
import os
import struct
import unittest

from subdivide_volume_case import ProgramTest, noise
from subdivide_volume_files import Meta, write_meta, write_nifti

SIZE = [7, 6, 5]
VALUES = noise(7 * 6 * 5, -1000, 1000)
SLICE = noise(7 * 6)


def single(number):
    return struct.unpack("<f", struct.pack("<f", number))[0]


def read_nifti(path, kind):
    """The voxels of a NIfTI file, or of the two of a pair."""
    with (gzip.open if path.endswith(".gz") else open)(path.replace(".hdr", ".img"), "rb") as file:
        return array.array(kind, file.read()[0 if path.endswith(".hdr") else 352:])


def sform(columns, origin):
    """The numbers of a header with a matrix, whose columns are the axes' and the origin's."""
    rows = [[*(column[row] for column in columns), origin[row]] for row in range(3)]
    return ("<h", 254, 1), ("<12f", 280, *sum(rows, [])), ("<3f", 80, *(math.hypot(*column) for column in columns))


class Nifti(ProgramTest):
    def read(self, name, *words):
        """Reads a file, with a warning that has the words, if there are any."""
        result = self.run_program(self.path(name), self.path("read.mha"), "--scheme", "linear")
        self.assertEqual(result.returncode, 0, result.stderr)
        warnings = [line for line in result.stderr.splitlines() if "warning" in line]
        self.assertEqual(len(warnings), 1 if words else 0, result.stderr)
        for word in words:
            self.assertIn(word, warnings[0])
        return Meta(self.path("read.mha"))

    def refuse(self, name, *words):
        self.assert_fails(self.run_program(self.path(name), self.path("out.mha")), 1, name, *words)

    def test_what_is_not_finite_is_written(self):
        for kind in "fd":
            for place, value in ((0, math.nan), (209, math.inf), (100, -math.inf)):
                values = [float(number) for number in noise(210)]
                values[place] = value
                write_meta(self.path("in.mha"), SIZE, kind, values)
                self.subdivide("in.mha", "truth.mha")
                truth = Meta(self.path("truth.mha")).data
                for ending in (".nii", ".nii.gz", ".hdr"):
                    with self.subTest(kind=kind, value=value, ending=ending):
                        self.subdivide("in.mha", "written" + ending)
                        self.assertEqual(read_nifti(self.path("written" + ending), kind).tobytes(), truth)

    def test_small_slopes(self):
        for slope, intercept in ((1e-15, 0), (6e-17, 0), (-6e-17, 1e-12), (1e-30, 0), (1.2e-38, 0), (1, 1e-20)):
            with self.subTest(slope=slope, intercept=intercept):
                write_nifti(self.path("in.nii"), SIZE, VALUES, [("<2f", 112, slope, intercept)])
                meant = [single(single(slope) * value + single(intercept)) for value in VALUES]
                write_meta(self.path("truth.mha"), SIZE, "f", meant)
                self.assertEqual(self.read("in.nii").data, self.meta("truth.mha", "t.mha", "--scheme", "linear").data)
                write_nifti(self.path("in.nii.gz"), SIZE, VALUES, [("<2f", 112, slope, intercept)])
                os.remove(self.path("in.nii"))
                if slope == 1e-15:
                    self.assertEqual(self.read("in.nii.gz").data, Meta(self.path("t.mha")).data)
                else:
                    self.refuse("in.nii.gz", "scl_slope", "uncompress")

    def test_slopes_beyond_single_precision(self):
        for slope in (1e-38, 1e-45, -1e-40, 1e35, 3e38):
            for name in ("in.nii", "in.nii.gz"):
                write_nifti(self.path(name), SIZE, VALUES, [("<f", 112, slope)])
                self.refuse(name, "scl_slope", "single precision")
                os.remove(self.path(name))

    def write_slice(self, *numbers, vectors):
        """An image of two axes, or of one slice of vectors, in which ITK sees two axes."""
        numbers = [*numbers, ("<h", 68, 1007)] if vectors else numbers
        write_nifti(self.path("in.nii"), [7, 6, 1, 1, 3] if vectors else [7, 6], SLICE * (3 if vectors else 1), numbers)

    def test_images_of_two_axes_in_space(self):
        across = {"axial": ([2, 0, 0], [0, 3, 0], [0, 0, 1]), "sagittal": ([0, 2, 0], [0, 0, 3], [1, 0, 0]),
                  "coronal": ([2, 0, 0], [0, 0, 3], [0, -1, 0]), "oblique": ([2, 0, 0], [0, 1.8, 2.4], [0, -0.8, 0.6])}
        for vectors in (False, True):
            for name, columns in across.items():
                with self.subTest(name=name, vectors=vectors):
                    self.write_slice(*sform(columns, [10, 20, 30]), vectors=vectors)
                    meta = self.read("in.nii", "left out")
                    self.assertEqual(meta.numbers("ElementSpacing"), [1, 1.5])
                    if name == "axial":  # NIfTI's x and y point the other way
                        self.assertEqual(meta.numbers("TransformMatrix"), [-1, 0, 0, -1])
                        self.assertEqual(meta.numbers("Offset"), [-9.5, -19.25])
                    else:
                        self.assertEqual(meta.numbers("TransformMatrix"), [1, 0, 0, 1])
                        self.assertEqual(meta.numbers("Offset"), [-0.5, -0.75])
            turned = ([1.2, 1.6, 0], [-2.4, 1.8, 0], [0, 0, 1])
            self.write_slice(*sform(turned, [10, 20, 0]), vectors=vectors)
            meta = self.read("in.nii")
            for found, expected in zip(meta.numbers("TransformMatrix"), [-0.6, -0.8, 0.8, -0.6]):
                self.assertAlmostEqual(found, expected, 6)
            # A quarter of a voxel before the first one's centre, along both axes.
            for found, expected in zip(meta.numbers("Offset"), [-10 + 0.3 - 0.6, -20 + 0.4 + 0.45]):
                self.assertAlmostEqual(found, expected, 5)

    def test_a_quaternion_that_turns_a_slice(self):
        half = math.sqrt(0.5)
        for quaternion, words in (((0, 0, half), ()), ((half, 0, 0), ("directions are left out",))):
            self.write_slice(("<h", 252, 1), ("<3f", 256, *quaternion), vectors=False)
            found = self.read("in.nii", *words).numbers("TransformMatrix")
            for number, expected in zip(found, [1, 0, 0, 1] if words else [0, -1, 1, 0]):
                self.assertAlmostEqual(number, expected, 6)

    def test_images_of_two_axes_are_read_back_as_written(self):
        write_meta(self.path("flat.mha"), [7, 6], "h", SLICE, spacing=[2, 3],
                   more=["TransformMatrix = 0.6 0.8 -0.8 0.6", "Offset = 5 7"])
        self.subdivide("flat.mha", "written.nii", "--axes", "x")
        self.subdivide("flat.mha", "truth.mha", "--axes", "x")
        found = self.read("written.nii")
        expected = self.meta("truth.mha", "t.mha", "--scheme", "linear")
        self.assertEqual(found.data, expected.data)
        for field in ("ElementSpacing", "Offset", "TransformMatrix"):
            for a, b in zip(found.numbers(field), expected.numbers(field)):
                self.assertAlmostEqual(a, b, 5)

    def test_matrices_that_itk_does_not_take(self):
        upright = ([0.5, 0, 0], [0, 0.6, 0], [0, 0, 0.7])
        sheared = ([0.5, 0, 0], [0.36, 0.48, 0], [0, 0, 0.7])
        for columns, pixdim, word in ((sheared, (0.5, 0.6, 0.7), "sheared"), (upright, (0.5, 1.2, 0.7), "0.6 x 0.7"),
                                      (upright, (0.5, 0.6, 1), "0.5 x 0.6 x 1;"),
                                      ((*upright[:2], (0, 0, 0)), (0.5, 0.6, 0), "without length")):
            matrix = sform(columns, [1, 2, 3])[:2]
            write_nifti(self.path("in.nii"), SIZE, VALUES, [*matrix, ("<3f", 80, *pixdim)])
            self.refuse("in.nii", word, "sform_code to 0")
            write_nifti(self.path("in.nii"), SIZE, VALUES, [*matrix, ("<3f", 80, *pixdim), ("<h", 254, 0)])
            self.read("in.nii")
        # In metres, ITK takes a scale of twice the length for rounding.
        write_nifti(self.path("in.nii"), SIZE, VALUES,
                    [("B", 123, 1), *sform(([1e-3, 0, 0], [0, 1e-3, 0], [0, 0, 1e-3]), [0, 0, 0])[:2],
                     ("<3f", 80, 5e-4, 5e-4, 5e-4)])
        self.refuse("in.nii", "0.001 x 0.001 x 0.001", "0.0005")

    def test_symmetric_matrices(self):
        for components in range(1, 12):
            values = sum(([100 * component] * 24 for component in range(components)), [])
            write_nifti(self.path("in.nii"), [4, 3, 2, 1, components], values, [("<h", 68, 1005)])
            write_nifti(self.path("in.nii.gz"), [4, 3, 2, 1, components], values, [("<h", 68, 1005)])
            order = {1: [0], 3: [0, 1, 2], 6: [0, 1, 3, 2, 4, 5], 10: [0, 1, 3, 6, 2, 4, 7, 5, 8, 9]}.get(components)
            for name in ("in.nii", "in.nii.gz"):
                with self.subTest(name=name, components=components):
                    if order:  # rows of the lower triangle become those of the upper one
                        found = self.read(name).values[:components]
                        self.assertEqual(list(found), [100 * component for component in order])
                    else:
                        self.refuse(name, f"{components} components", "intent_code", "1007")
                os.remove(self.path(name))

    def write_voxels(self, name, order, size, intent, datatype, bits):
        """Voxels of 0 of any type, in a byte order, as one file or as two."""
        offset = 0 if ".hdr" in name else 352
        numbers = [("i", 0, 348), ("8h", 40, len(size), *size, *[1] * (7 - len(size))), ("h", 68, intent),
                   ("2h", 70, datatype, bits), ("8f", 76, *[1] * 8), ("f", 108, offset), ("f", 112, 1)]
        write_nifti(self.path("in.nii"), size, [0] * (math.prod(size) * bits // 16),
                    [(order + kind, *rest) for kind, *rest in numbers] + ([] if offset else [("4s", 344, b"ni1\0")]))
        with open(self.path("in.nii"), "rb") as file:
            content = file.read()
        os.remove(self.path("in.nii"))
        parts = [(name, content)] if offset else [(name, content[:348]), (name.replace("hdr", "img"), content[352:])]
        for part, data in parts:
            with open(self.path(part), "wb") as file:
                file.write(gzip.compress(data) if part.endswith(".gz") else data)
        return [self.path(part) for part, _ in parts]

    def test_vectors_of_complex_numbers_and_colours(self):
        cases = [(name, order, intent, type_of, components) for name in ("a.nii", "a.nii.gz", "a.hdr", "a.hdr.gz")
                 for order in "<>" for intent in (1005, 1006, 1007)
                 for type_of in ((32, 64), (1792, 128), (128, 24), (2304, 32)) for components in (1, 3)]
        for name, order, intent, type_of, components in cases[::5]:
            with self.subTest(name=name, order=order, intent=intent, type_of=type_of, components=components):
                files = self.write_voxels(name, order, [*SIZE, 1, components], intent, *type_of)
                # Some versions of ITK take displacements for an image of five axes.
                is_image = intent == 1006 and components > 1
                self.refuse(name, *(() if is_image else (f"intent_code {intent}", "complex numbers or colours")))
                for file in files:
                    os.remove(file)
        for name, order in (("a.nii", ">"), ("a.nii.gz", "<"), ("a.hdr", "<")):
            for type_of in ((32, 64), (128, 24)):
                files = self.write_voxels(name, order, [*SIZE, 1, 1], 0, *type_of)
                self.assertEqual(self.read(name).numbers("ElementNumberOfChannels"), [2 if type_of[0] == 32 else 3])
                for file in files:
                    os.remove(file)

    def test_vectors_of_more_than_five_axes(self):
        for intent in (1005, 1006, 1007):
            for size in ([7, 6, 5, 1, 1, 3], [7, 6, 5, 1, 3, 2], [7, 6, 5, 2, 3, 1, 2], [7, 6, 1, 1, 1, 1, 3]):
                for name in ("in.nii", "in.nii.gz"):
                    write_nifti(self.path(name), size, noise(math.prod(size)), [("<h", 68, intent)])
                    self.refuse(name, *(() if intent == 1006 else (f"intent_code {intent}",)), f"{len(size)} axes")
                    os.remove(self.path(name))
        write_nifti(self.path("in.nii"), [7, 6, 5, 1, 3], noise(630), [("<h", 68, 1007)])
        due = self.read("in.nii")
        self.assertEqual(due.numbers("ElementNumberOfChannels"), [3])
        for ones in ([1], [1, 1]):
            write_nifti(self.path("in.nii"), [7, 6, 5, 1, 3, *ones], noise(630), [("<h", 68, 1007)])
            self.assertEqual(self.read("in.nii").data, due.data)

    def test_negative_lengths(self):
        placements = ([], [("<h", 252, 1)], sform(([2, 0, 0], [0, 2, 0], [0, 0, 2]), [1, 2, 3])[:2])
        for numbers in placements:
            for axis in range(3):
                for name in ("in.nii", "in.nii.gz"):
                    lengths = [-2 if other == axis else 2 for other in range(3)]
                    write_nifti(self.path(name), SIZE, VALUES, [*numbers, ("<3f", 80, *lengths)])
                    self.refuse(name, "length of -2", f"pixdim[{axis + 1}] to 2")
                    os.remove(self.path(name))
        write_nifti(self.path("in.nii"), [7, 6], SLICE, [("<3f", 80, 2, 2, -2)])
        self.assertEqual(self.read("in.nii").numbers("ElementSpacing"), [1, 1])

    def test_what_spm_writes_into_analyze(self):
        def warnings(*numbers):
            analyze = [("<f", 108, 0), ("<f", 112, 0), ("4s", 344, bytes(4))]
            write_nifti(self.path("in.nii"), SIZE, VALUES, [*analyze, *numbers])
            with open(self.path("in.nii"), "rb") as file:
                content = file.read()
            for name, part in (("in.hdr", content[:348]), ("in.img", content[352:])):
                with open(self.path(name), "wb") as file:
                    file.write(part)
            result = self.run_program(self.path("in.hdr"), self.path("read.mha"))
            self.assertEqual(result.returncode, 0, result.stderr)
            return [line for line in result.stderr.splitlines() if "SPM" in line]

        self.assertEqual(warnings(), [])
        self.assertEqual(warnings(("<f", 112, 1), ("10s", 253, b"a program")), [])
        for numbers, words in (([("<f", 112, 0.25)], "with a scale factor of 0.25 as"),
                               ([("<3h", 253, 4, 3, 5)], "with an origin as"),
                               ([("<f", 112, 2), ("<3h", 253, 4, 3, 5)], "with a scale factor of 2 and an origin as")):
            found = warnings(*numbers)
            self.assertEqual(len(found), 1, found)
            self.assertIn(words, found[0])


if __name__ == "__main__":
    unittest.main()
