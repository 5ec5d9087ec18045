# SPDX-License-Identifier: Apache-2.0
"""A file that holds more than its header says is refused, whatever its format: the size or the type in the header is
wrong, and all of the voxels may be. So is one of which a part would be left out."""

import array
import gzip
import struct
import unittest
import zlib

from subdivide_volume_case import ProgramTest, noise
from subdivide_volume_files import joined, meta_header, write_meta, write_nifti

VALUES = noise(210)
TEXT = joined(VALUES).encode()
LITTLE = array.array("H", VALUES).tobytes()
BIG = b"".join(struct.pack(">H", value) for value in VALUES)
PLANE = 84


def nrrd(*fields, encoding="raw", sizes="7 6 5"):
    lines = ["NRRD0004", "type: ushort", f"dimension: {len(sizes.split())}", f"sizes: {sizes}", f"encoding: {encoding}",
             "endian: little", *fields]
    return ("\n".join(lines) + "\n").encode()


# Components after the axes are left to the image library.
LAST = ("kinds: domain domain domain vector", "space: left-posterior-superior",
        "space directions: (1,0,0) (0,1,0) (0,0,1) none")


def vtk(encoding, points=210):
    lines = ["# vtk DataFile Version 3.0", "t", encoding, "DATASET STRUCTURED_POINTS", "DIMENSIONS 7 6 5",
             "SPACING 1 1 1", "ORIGIN 0 0 0", f"POINT_DATA {points}", "SCALARS s unsigned_short",
             "LOOKUP_TABLE default"]
    return ("\n".join(lines) + "\n").encode()


def gipl():
    header = bytearray(256)
    struct.pack_into(">5H", header, 0, 7, 6, 5, 1, 16)
    struct.pack_into(">4f", header, 10, 1, 1, 1, 1)
    struct.pack_into(">I", header, 252, 719555000)
    return bytes(header)


def mrc(order="<", extension=0):
    header = bytearray(1024 + extension)
    struct.pack_into(order + "10i", header, 0, 7, 6, 5, 6, 0, 0, 0, 7, 6, 5)
    struct.pack_into(order + "6f", header, 40, 7, 6, 5, 90, 90, 90)
    struct.pack_into(order + "3i", header, 64, 1, 2, 3)
    struct.pack_into(order + "i", header, 92, extension)
    header[208:216] = b"MAP DD\0\0" if order == "<" else b"MAP \x11\x11\0\0"
    return bytes(header)


class Longer(ProgramTest):
    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content)

    def assert_refused(self, name, content, *words):
        with self.subTest(name=name, start=content[:60]):
            self.write(name, content)
            self.assert_fails(self.run_program(self.path(name), self.path("out.mha"), "--quiet"), 1, *words)

    def assert_exact(self, name, header, data, more, due=None):
        """The image alone is read; with more behind it, or less, it is not."""
        with self.subTest(name=name, header=header[:80]):
            self.write(name, header + data)
            found = self.meta(name, "found.mha").data
            self.assertEqual(found, due or found)
        self.assert_refused(name, header + data + more, "it holds")
        if data:
            self.assert_refused(name, header + data[:-3])

    def setUp(self):
        super().setUp()
        write_meta(self.path("in.mha"), [7, 6, 5], "H", VALUES)
        self.due = self.meta("in.mha", "due.mha").data

    def test_text(self):
        text = meta_header([7, 6, 5], "H").replace(b"BinaryData = True", b"BinaryData = False")
        self.assert_exact("a.mha", text, TEXT, b" 1", self.due)
        self.assert_exact("a.nrrd", nrrd(encoding="ascii") + b"\n", TEXT, b" 1", self.due)
        self.assert_exact("a.nrrd", nrrd(encoding="hex") + b"\n", LITTLE.hex().encode(), b"00", self.due)

    def test_vtk(self):
        for encoding, data, more in (("BINARY", BIG, BIG[:PLANE]), ("ASCII", TEXT, b" 1 2 3")):
            self.write("a.vtk", vtk(encoding) + data + b"\nMETADATA\nINFORMATION 0\n\n")
            self.assertEqual(self.meta("a.vtk", "found.mha").data, self.due)
            self.write("a.vtk", vtk(encoding) + data + b"\n")
            self.assertEqual(self.meta("a.vtk", "found.mha").data, self.due)
            self.assert_refused("a.vtk", vtk(encoding) + data + more, "more voxels than its header says")
            self.assert_refused("a.vtk", vtk(encoding) + data[:-3], "truncated")
            for points in (99, 211, 420):
                self.assert_refused("a.vtk", vtk(encoding, points) + data, "POINT_DATA")
            self.assert_refused("a.vtk", vtk(encoding).replace(b"POINT_DATA", b"CELL_DATA") + data, "CELL_DATA")

    def test_gipl_and_mrc(self):
        self.assert_exact("a.gipl", gipl(), BIG, BIG[:PLANE], self.due)
        self.assert_refused("a.gipl.gz", gzip.compress(gipl() + BIG + b"\0"), "more than")
        for extension in (0, 128):
            self.assert_exact("a.mrc", mrc(extension=extension), LITTLE, b"\0\0", self.due)

    def test_big_endian_mrc(self):
        self.assert_refused("a.mrc", mrc(">") + BIG, "cannot read", "big-endian")
        self.assert_refused("a.mrc", mrc(">")[:212] + b"DD" + mrc(">")[214:] + BIG, "cannot read", "big-endian")

    def test_nifti(self):
        write_nifti(self.path("a.nii"), [7, 6, 5], VALUES)
        with open(self.path("a.nii"), "rb") as file:
            content = file.read()
        for more in (b"\0", LITTLE[:PLANE]):
            self.assert_refused("b.nii", content + more, "more than")
            self.assert_refused("b.nii.gz", gzip.compress(content + more), "more than")
        for axis, data in ((0, b""), (1, b""), (2, b""), (2, VALUES), (0, VALUES)):
            empty = bytearray(content[:352] + (content[352:] if data else b""))
            struct.pack_into("<h", empty, 42 + 2 * axis, 0)
            self.assert_refused("b.nii", bytes(empty), "no voxels" if axis else "cannot read")
        for slices in (1, 4):
            shorter = bytearray(content)
            struct.pack_into("<h", shorter, 46, slices)
            self.assert_refused("b.nii", bytes(shorter), "more than")
        self.subdivide("in.mha", "c.hdr")
        with open(self.path("c.img"), "ab") as file:
            file.write(b"\0\0")
        self.assert_fails(self.run_program(self.path("c.hdr"), self.path("out.mha"), "--quiet"), 1, "c.img", "more than")

    def test_axes_that_the_library_reads(self):
        both = LITTLE + LITTLE
        last = nrrd(*LAST, sizes="7 6 5 2")
        self.assert_exact("a.nrrd", last + b"\n", both, b"\0\0")
        packed = nrrd(*LAST, sizes="7 6 5 2", encoding="gzip") + b"\n"
        self.assert_refused("a.nrrd", packed + gzip.compress(both + LITTLE), "1260 bytes")
        self.assert_refused("a.nrrd", packed + gzip.compress(LITTLE), "420 bytes")
        self.assert_refused("a.nrrd", packed + gzip.compress(both)[:-8] + bytes(8), "damaged")
        self.assert_refused("a.nrrd", nrrd(*LAST, sizes="7 6 5 2", encoding="ascii") + b"\n" + TEXT + b" " + TEXT, "text")

    def test_several_files(self):
        names = [f"s{z}.raw" for z in range(5)]
        planes = [LITTLE[PLANE * z:PLANE * z + PLANE] for z in range(5)]
        headers = {
            "a.nhdr": nrrd("data file: LIST") + "\n".join(names).encode(),
            "b.nhdr": nrrd("data file: LIST 2") + "\n".join(names).encode(),
            "c.nhdr": nrrd("data file: s%d.raw 0 4 1"), "d.nhdr": nrrd("data file: s%d.raw 0 4 1 2"),
            "e.mhd": meta_header([7, 6, 5], "H", data_file="LIST") + "\n".join(names).encode(),
            "f.mhd": meta_header([7, 6, 5], "H", data_file="s%d.raw 0 4 1"),
        }
        for name, header in headers.items():
            for file_name, plane in zip(names, planes):
                self.write(file_name, plane)
            self.write(name, header)
            self.assertEqual(self.meta(name, "found.mha").data, self.due)
            for other in (planes[2] + planes[2], planes[2] + b"\0", planes[2][:-1]):
                self.write(names[2], other)
                self.assert_refused(name, header, "s2.raw")
        packed = nrrd("data file: LIST", encoding="gzip") + "\n".join([*names, ""]).encode()
        for file_name, plane in zip(names, planes):
            self.write(file_name, gzip.compress(plane))
        self.write("g.nhdr", packed)
        self.assertEqual(self.meta("g.nhdr", "found.mha").data, self.due)
        self.write(names[2], gzip.compress(planes[2] + planes[3]))
        self.assert_refused("g.nhdr", packed, "s2.raw")

    def test_masked_matrices(self):
        for kind, size in (("3D-masked-symmetric-matrix", 7), ("3D-masked-matrix", 10), ("2D-masked-symmetric-matrix", 4),
                           ("2D-masked-matrix", 5)):
            values = array.array("f", noise(size * 210)).tobytes()
            header = nrrd(f"kinds: {kind} domain domain domain", sizes=f"{size} 7 6 5").replace(b"ushort", b"float")
            self.assert_refused("a.nrrd", header + b"\n" + values, kind, "mask")
        for kind, size in (("3D-symmetric-matrix", 6), ("3D-matrix", 9), ("2D-symmetric-matrix", 3), ("2D-matrix", 4),
                           ("quaternion", 4)):
            values = array.array("f", noise(size * 210)).tobytes()
            header = nrrd(f"kinds: {kind} domain domain domain", sizes=f"{size} 7 6 5").replace(b"ushort", b"float")
            self.write("a.nrrd", header + b"\n" + values)
            with self.subTest(kind=kind):
                self.assertEqual(self.meta("a.nrrd", "found.mha").fields["ElementNumberOfChannels"], str(size))


class Longs(ProgramTest):
    """MET_LONG and MET_ULONG have four or eight bytes: the data tell."""

    def test_both_lengths(self):
        for kind, pixels in (("LONG", "iq"), ("ULONG", "IQ")):
            for pixel in pixels:
                values = noise(210, low=0 if kind == "ULONG" else -900)
                write_meta(self.path("in.mha"), [7, 6, 5], pixel, values)
                due = self.meta("in.mha", "due.mha")
                data = array.array(pixel, values).tobytes()
                packed = zlib.compress(data)
                for more, content in (([], data), (["CompressedData = True"], packed),
                                      (["CompressedData = True", f"CompressedDataSize = {len(packed)}"], packed),
                                      (["HeaderSize = -1"], data)):
                    header = meta_header([7, 6, 5], "i", more=more).replace(b"MET_INT", b"MET_" + kind.encode())
                    with self.subTest(kind=kind, pixel=pixel, more=more):
                        with open(self.path("a.mha"), "wb") as file:
                            file.write(header + content)
                        found = self.meta("a.mha", "found.mha")
                        self.assertEqual((found.pixel, found.data), (due.pixel, due.data))
                    for wrong in (content + b"\0" * 4, content[:-4], b"", data + data + data):
                        with open(self.path("a.mha"), "wb") as file:
                            file.write(header + (wrong if not more or "HeaderSize" in more[0] else zlib.compress(wrong)))
                        result = self.run_program(self.path("a.mha"), self.path("out.mha"), "--quiet")
                        self.assert_fails(result, 1, "cannot read")


if __name__ == "__main__":
    unittest.main()
