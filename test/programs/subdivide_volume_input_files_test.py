# SPDX-License-Identifier: Apache-2.0
"""An output never takes the place of a file of its input, by whatever name: it is refused, and every file stays. Only
where all of an image, one file or a pair, gives way to the output that was named, it is made in place."""

import array
import os
import struct
import unittest

from subdivide_volume_case import ProgramTest, noise
from subdivide_volume_files import meta_header, write_dicom_slice, write_meta

SIZE = [7, 6, 5]
VOXELS = array.array("H", noise(210)).tobytes()
PLANES = [VOXELS[84 * z:84 * z + 84] for z in range(5)]


def nrrd_header(*fields):
    lines = ["NRRD0004", "type: ushort", "dimension: 3", "sizes: 7 6 5", "encoding: raw", "endian: little", *fields]
    return ("\n".join(lines) + "\n").encode()


def bitmap(plane):
    """A grey picture of 7 by 6."""
    palette = b"".join(bytes([grey] * 3 + [0]) for grey in range(256))
    rows = b"".join(plane[7 * y:7 * y + 7] + b"\0" for y in range(6))
    size = 54 + len(palette) + len(rows)
    return (struct.pack("<2sIHHI", b"BM", size, 0, 0, 54 + len(palette)) +
            struct.pack("<IiiHHIIiiII", 40, 7, 6, 1, 8, 0, len(rows), 2835, 2835, 256, 0) + palette + rows)


class InputFiles(ProgramTest):
    def write(self, name, content):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "wb") as file:
            file.write(content)

    def snapshot(self):
        files = {}
        for folder, _, names in os.walk(self.folder):
            for name in names:
                path = os.path.join(folder, name)
                with open(path, "rb") as file:
                    files[path] = (os.lstat(path).st_ino, file.read())
        return files

    def assert_refused(self, source, output, *options, words=("belongs to the input",)):
        before = self.snapshot()
        with self.subTest(source=source, output=output, options=options):
            result = self.run_program(source, output, "--quiet", *options, cwd=self.folder)
            self.assert_fails(result, 1, f"cannot write {output}", *words)
            self.assertEqual(self.snapshot(), before)

    def assert_all_refused(self, source, *outputs):
        for output in outputs:
            self.assert_refused(source, output)
            if output.endswith(("mha", "mhd", "nrrd", "nhdr")):
                self.assert_refused(source, output, "--piece", "1/2")

    def test_a_slice_of_a_folder(self):
        for z, plane in enumerate(PLANES):
            self.write(f"s/slice_{z}.bmp", bitmap(plane[:42]))
        os.symlink("s/slice_2.bmp", self.path("link.bmp"))
        os.link(self.path("s/slice_3.bmp"), self.path("hard.bmp"))
        os.symlink("s", self.path("t"))
        self.assert_all_refused("s", "s/slice_3.bmp", "link.bmp", "hard.bmp", "t/slice_0.bmp",
                                self.path("s/slice_1.bmp"), "./s/../s/slice_4.bmp")
        self.assertEqual(self.run_program("s", "s/doubled.mha", cwd=self.folder).returncode, 0)

    def test_slices_that_are_links(self):
        for z, plane in enumerate(PLANES):
            self.write(f"elsewhere/old_{z:04d}.bmp", bitmap(plane[:42]))
            os.makedirs(self.path("s"), exist_ok=True)
            os.symlink(f"../elsewhere/old_{z:04d}.bmp", self.path(f"s/slice_{z}.bmp"))
        self.assert_all_refused("s", "s/slice_3.bmp", "elsewhere/old_0003.bmp")
        self.assert_refused("s", "elsewhere/")

    def test_a_slice_of_a_series(self):
        for z in range(5):
            os.makedirs(self.path("d/more"), exist_ok=True)
            write_dicom_slice(self.path(f"d/more/im{z}.img"), "1.2.3.4", z, [7, 6], noise(42, seed=z), [1, 1, 1])
        for source in ("d", "d/more"):
            self.assert_all_refused(source, "d/more/im3.img", "d/more/im0.hdr")
        self.assertEqual(self.run_program("d", "d/doubled.mha", cwd=self.folder).returncode, 0)

    def test_the_folder_that_holds_an_earlier_output(self):
        write_meta(self.path("in.mha"), SIZE, "H", noise(210))
        self.subdivide("in.mha", "old/")
        os.mkdir(self.path("s"))
        for name in os.listdir(self.path("old")):
            os.symlink(f"../old/{name}", self.path(f"s/{name}"))
        for options in ([], ["--piece", "1/2"]):
            self.assert_refused("s", "old/", *options)
            self.assert_refused("old", "old/", *options, words=("the input old is there",))

    def test_the_data_file_of_a_header(self):
        for name in ("o.mha", "o.nrrd", "o.nii", "o.nii.gz", "o.vtk", "o.img", "o.tif"):
            self.write(name, VOXELS)
            self.write("a.mhd", meta_header(SIZE, "H", data_file=name))
            self.write("b.nhdr", nrrd_header(f"data file: {name}", ""))
            self.write("d.nhdr", nrrd_header(f"data file: ./{name}"))
            os.symlink(name, self.path("voxels"))
            os.link(self.path(name), self.path("hard"))
            self.write("c.mhd", meta_header(SIZE, "H", data_file="voxels"))
            self.write("e.nhdr", nrrd_header("data file: hard"))
            for header in ("a.mhd", "b.nhdr", "c.mhd", "d.nhdr", "e.nhdr"):
                self.assert_all_refused(header, name)
            os.remove(self.path("voxels"))
            os.remove(self.path("hard"))
            os.remove(self.path(name))

    def test_one_of_several_data_files(self):
        for z, plane in enumerate(PLANES):
            self.write(f"s{z}.nrrd", plane)
        names = "".join(f"s{z}.nrrd\n" for z in range(5))
        self.write("list.mhd", meta_header(SIZE, "H", data_file="LIST") + names.encode())
        self.write("pattern.mhd", meta_header(SIZE, "H", data_file="s%d.nrrd 0 4 1"))
        self.write("list.nhdr", nrrd_header("data file: LIST") + names.encode())
        self.write("list2.nhdr", nrrd_header("data file: LIST 2") + names.encode())
        self.write("pattern.nhdr", nrrd_header("data file: s%d.nrrd 0 4 1"))
        self.write("pattern2.nhdr", nrrd_header("data file: s%d.nrrd 0 4 1 2"))
        for header in ("list.mhd", "pattern.mhd", "list.nhdr", "list2.nhdr", "pattern.nhdr", "pattern2.nhdr"):
            self.assert_all_refused(header, "s0.nrrd", "s3.nrrd", "s4.nrrd")
        # The header alone would be lost, and with it all that its data files mean.
        for header in ("list.mhd", "pattern.mhd", "list.nhdr", "pattern.nhdr"):
            self.assert_refused(header, header)

    def test_the_data_file_of_an_output(self):
        """The output's header stands there, and names a file that the input's header, in another folder, names, too."""
        self.write("old.raw", VOXELS)
        self.write("old.mhd", meta_header(SIZE, "H", data_file="old.raw"))
        self.write("in/a.mhd", meta_header(SIZE, "H", data_file="../old.raw"))
        self.write("in/b.nhdr", nrrd_header("data file: ../old.raw"))
        for source in ("in/a.mhd", "in/b.nhdr"):
            self.assert_refused(source, "old.mhd")
            self.assert_refused(source, "old.mhd", "--compress")
            self.assert_refused(source, "old.mhd", "--piece", "2/2")
        raw = ("--raw", "7x6x5:uint16")
        self.assert_refused("old.raw", "old.mhd", *raw)
        self.assert_refused("old.raw", "old.mhd", "--piece", "1/2", *raw)

    def test_a_pair_in_place(self):
        write_meta(self.path("in.mha"), SIZE, "H", noise(210))
        for named, output in (("a.hdr", "a.hdr"), ("a.img", "a.hdr"), ("a.hdr", "a.img"), ("b.img.gz", "b.img.gz")):
            self.subdivide("in.mha", named)
            self.subdivide(named, "expected.mha")
            self.subdivide(named, output)
            self.assertEqual(self.meta(output, "found.mha").data, self.meta("expected.mha", "due.mha").data)

    def test_a_detached_header_in_place(self):
        write_meta(self.path("in.mha"), SIZE, "H", noise(210))
        for ending in ("mhd", "nhdr"):
            for options in ([], ["--compress"]):
                for again in ([], ["--compress"]):
                    self.subdivide("in.mha", f"a.{ending}", *options)
                    self.subdivide(f"a.{ending}", "expected.mha")
                    self.subdivide(f"a.{ending}", f"a.{ending}", *again)
                    self.assertEqual(self.meta(f"a.{ending}", "found.mha").data,
                                     self.meta("expected.mha", "due.mha").data)


if __name__ == "__main__":
    unittest.main()
