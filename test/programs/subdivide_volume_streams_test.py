# SPDX-License-Identifier: Apache-2.0
"""Whatever the format of the input, --streams changes no voxel: the pieces are those of the whole run."""

import array
import gzip
import unittest

from subdivide_volume_case import ProgramTest, noise
from subdivide_volume_files import Meta, joined, meta_header, write_meta, write_nrrd

SIZE = [7, 6, 5]
VALUES = noise(210)
TEXT = joined(VALUES).encode()
BYTES = array.array("H", VALUES).tobytes()
BIG = array.array("H", VALUES)
BIG.byteswap()


def nrrd(encoding, data, *fields, sizes="7 6 5", dimension=3):
    lines = ["NRRD0004", "type: ushort", f"dimension: {dimension}", f"sizes: {sizes}", f"encoding: {encoding}",
             "endian: little", *fields]
    return ("\n".join(lines) + "\n\n").encode() + data


def vtk(encoding, data):
    lines = ["# vtk DataFile Version 3.0", "t", encoding, "DATASET STRUCTURED_POINTS", "DIMENSIONS 7 6 5",
             "SPACING 1 1 1", "ORIGIN 0 0 0", "POINT_DATA 210", "SCALARS s unsigned_short", "LOOKUP_TABLE default"]
    return ("\n".join(lines) + "\n").encode() + data


class Streams(ProgramTest):
    def assert_same_in_pieces(self, name, due=None):
        """The first run is that of the whole."""
        for streams in (1, 2, 3, 5, 12):
            with self.subTest(name=name, streams=streams):
                result = self.run_program(self.path(name), self.path("piece.mha"), "--streams", streams, "--quiet")
                self.assertEqual(result.returncode, 0, result.stderr)
                found = Meta(self.path("piece.mha")).data
                due = due or found
                self.assertEqual(found, due)

    def test_formats_that_are_written(self):
        for depth in (5, 1):
            write_meta(self.path("in.mha"), [7, 6, depth], "B", noise(42 * depth, high=256))
            for ending in ("mhd", "nrrd", "nhdr", "tif", "nii", "nii.gz", "hdr", "img.gz", "vtk", "h5", "gipl", "gipl.gz",
                           "mrc"):
                self.subdivide("in.mha", f"{ending[:3]}.{ending}", "--axes", "x")
                self.assert_same_in_pieces(f"{ending[:3]}.{ending}")
        write_meta(self.path("in.mha"), [7, 6], "B", noise(42, high=256))
        for ending in ("png", "bmp", "jpg"):
            self.run_program(self.path("in.mha"), self.path(f"{ending[:3]}.{ending}"))
            self.assert_same_in_pieces(f"{ending[:3]}.{ending}")

    def test_text_and_layouts_of_headers(self):
        write_meta(self.path("in.mha"), SIZE, "H", VALUES)
        due = self.meta("in.mha", "whole.mha").data
        text = meta_header(SIZE, "H").replace(b"BinaryData = True", b"BinaryData = False")
        for z in range(5):
            with open(self.path(f"s{z}.raw.gz"), "wb") as file:
                file.write(gzip.compress(BYTES[84 * z:84 * z + 84]))
            with open(self.path(f"s{z}.raw"), "wb") as file:
                file.write(BYTES[84 * z:84 * z + 84])
        names = b"".join(b"s%d.raw\n" % z for z in range(5))
        for name, content in (("text.mha", text + TEXT),
                              ("text.nrrd", nrrd("ascii", TEXT)), ("hex.nrrd", nrrd("hex", BYTES.hex().encode())),
                              ("list2.nhdr", nrrd("raw", b"")[:-1] + b"data file: LIST 2\n" + names),
                              ("list.nhdr", nrrd("gzip", b"")[:-1] + b"data file: LIST\n" + names.replace(b"raw", b"raw.gz")),
                              ("text.vtk", vtk("ASCII", TEXT)), ("big.vtk", vtk("BINARY", BIG.tobytes()))):
            with open(self.path(name), "wb") as file:
                file.write(content)
            self.assert_same_in_pieces(name, due)

    def test_vectors(self):
        write_nrrd(self.path("in.nrrd"), [3, 7, 6, 5], "f", [value / 7 for value in noise(630)],
                   more=["kinds: vector domain domain domain"])
        for ending in ("nrrd", "nii", "nii.gz", "vtk", "h5", "mha"):
            self.subdivide("in.nrrd", f"{ending[:3]}.{ending}", "--axes", "x")
            self.assert_same_in_pieces(f"{ending[:3]}.{ending}")


if __name__ == "__main__":
    unittest.main()
