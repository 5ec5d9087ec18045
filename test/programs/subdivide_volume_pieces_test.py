#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""SubdivideVolume piece by piece: the same bytes for any pieces, threads and memory, and no other file is touched. The
environment variable SUBDIVIDE_VOLUME holds the path of the program."""

import array
import json
import os
import random
import resource
import unittest

from subdivide_volume_case import PROGRAM, ProgramTest, noise, skip_under_sanitizers
from subdivide_volume_files import Meta, meta_header, write_compressed_meta, write_meta, write_nrrd, write_tiff


class Pieces(ProgramTest):
    OPTIONS = (["--streams", "1"], ["--streams", "2"], ["--streams", "5"], ["--streams", "23"], ["--streams", "1000000"],
               ["--threads", "1"], ["--threads", "5", "--streams", "4"], ["--memory", "0.2G"], ["--memory", "20G"])

    def assert_same_bytes(self, name, *arguments):
        whole = self.meta(name, "whole.mha", "--threads", 1, "--streams", 1, *arguments).data
        for options in self.OPTIONS:
            self.assertEqual(self.meta(name, "out.mha", *options, *arguments).data, whole, (name, options, arguments))

    def test_axes_and_boundaries(self):
        write_meta(self.path("in.mha"), [11, 9, 14], "H", noise(1386))
        for axes in ("xyz", "xy", "z", "y", "xz"):
            for boundary in ("nearest", "periodic"):
                self.assert_same_bytes("in.mha", "--axes", axes, "--boundary", boundary)

    def test_schemes_and_types(self):
        write_meta(self.path("in.mha"), [11, 9, 14], "h", noise(1386, -500, 500))
        for scheme in ("nonoscillatory", "linear", "bounded", "bspline", "restored"):
            for output_type in ("same", "float", "uint8", "double"):
                self.assert_same_bytes("in.mha", "--scheme", scheme, "--output-type", output_type)

    def test_images_of_other_dimensions(self):
        write_meta(self.path("plane.mha"), [37, 29], "f", noise(1073))
        write_meta(self.path("series.mha"), [7, 6, 5, 4], "h", noise(840))
        write_meta(self.path("colours.mha"), [7, 6, 5], "B", noise(630, 0, 256), channels=3)
        for name in ("plane.mha", "series.mha", "colours.mha"):
            self.assert_same_bytes(name)
        self.assert_same_bytes("series.mha", "--axes", "xzt")

    def test_compressed_files(self):
        values = noise(1386)
        write_meta(self.path("in.mha"), [11, 9, 14], "h", values)
        whole = self.meta("in.mha", "whole.mha").data
        write_compressed_meta(self.path("packed.mha"), [11, 9, 14], "h", values)
        write_nrrd(self.path("packed.nrrd"), [11, 9, 14], "h", values, encoding="gzip")
        for name in ("packed.mha", "packed.nrrd"):
            for options in self.OPTIONS:
                self.assertEqual(self.meta(name, "out.mha", *options).data, whole, (name, options))
        packed = set()
        for options in self.OPTIONS:
            self.subdivide("in.mha", "packed-out.mha", "--compress", *options)
            self.assertEqual(Meta(self.path("packed-out.mha")).data, whole)
            with open(self.path("packed-out.mha"), "rb") as file:
                packed.add(file.read())
        self.assertEqual(len(packed), 1)

    def test_folders_of_slices(self):
        size, values = [11, 9, 12], noise(1188)
        write_meta(self.path("in.mha"), size, "H", values)
        whole = self.meta("in.mha", "whole.mha").data
        again = self.meta("whole.mha", "again.mha", "--axes", "x").data
        os.mkdir(self.path("slices"))
        for z in range(size[2]):
            write_tiff(self.path(f"slices/slice_{z + 1}.tif"), size[0], size[1], values[99 * z:99 * (z + 1)])
        for options in self.OPTIONS:
            self.assertEqual(self.meta("slices", "out.mha", *options).data, whole, options)
            self.subdivide("slices", "doubled/", *options)
            names = sorted(os.listdir(self.path("doubled")))
            self.assertEqual(names, [f"doubled_{z:04}.tif" for z in range(24)])
            self.assertEqual(self.meta("doubled", "out.mha", "--axes", "x").data, again, options)

    def test_more_pieces_than_rows(self):
        """Pieces are at least rows."""
        write_meta(self.path("in.mha"), [300, 3, 2], "H", noise(1800))
        result = self.subdivide("in.mha", "out.mha", "--streams", 1000)
        self.assertRegex(result.stdout, "(?m)^time .* 24 pieces$")


    def test_the_plan_of_a_very_large_volume(self):
        """It takes little memory itself."""
        skip_under_sanitizers(self)
        with open(self.path("in.raw"), "wb") as file:
            try:
                file.truncate(2 * 8192 ** 3)  # a size, and no bytes
            except OSError:
                self.skipTest("the file system has no files of such a size")
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))
        result = self.run_program("--info", "--json", "--raw", "8192x8192x8192:uint16", "--threads", 1, "--memory", "500M",
                                  self.path("in.raw"), self.path("out.mha"), preexec_fn=limit)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertLess(json.loads(result.stdout)["memory_bytes"], 500000000)


class Errors(ProgramTest):
    def test_an_error_in_the_middle_ends_all_stages(self):
        """The header promises more than the compressed stream holds, so that reading fails when others are at work."""
        values = noise(40 * 40 * 60, 0, 60000)
        write_compressed_meta(self.path("in.mha"), [40, 40, 60], "H", values)
        with open(self.path("in.mha"), "rb") as file:
            content = file.read()
        start = content.index(b"LOCAL\n") + 6
        broken = bytearray(content)
        place = start + (len(content) - start) * 3 // 4
        broken[place:place + 64] = bytes(64)
        with open(self.path("in.mha"), "wb") as file:
            file.write(broken)
        for options in (["--streams", "30"], ["--streams", "1"], ["--streams", "30", "--threads", "1"]):
            self.assert_fails(self.run_program(self.path("in.mha"), self.path("out.mha"), *options), 1, "in.mha")


class Decoys(ProgramTest):
    """Files of every name that a run might use for itself stay as they are, in the current folder and the output's."""

    NAMES = ("scan.raw", "scan.zraw", "scan.mhd", "scan.mha", "scan.nrrd", "scan.nhdr", "scan.raw.gz", "probe", "out",
             "out.raw", "out.zraw", "out.raw.gz", ".out.mha.partial", "out.tmp", "partial", "in.raw")

    def write_decoys(self, folder, skip):
        contents = {}
        for number, name in enumerate(self.NAMES):
            path = os.path.join(folder, name)
            if name not in skip:
                contents[path] = random.Random(number).randbytes(1000 + number)
                with open(path, "wb") as file:
                    file.write(contents[path])
        return contents

    def test_all_other_files_are_left_alone(self):
        values = noise(6 * 5 * 4)
        inputs = os.path.join(self.folder, "inputs")
        current = os.path.join(self.folder, "current")
        os.mkdir(inputs)
        os.mkdir(current)
        with open(os.path.join(inputs, "scan.mhd"), "wb") as file:
            file.write(meta_header([6, 5, 4], "h", data_file="scan.raw"))
        with open(os.path.join(inputs, "scan.raw"), "wb") as file:
            file.write(array.array("h", values).tobytes())
        source = os.path.join(inputs, "scan.mhd")
        write_meta(self.path("in.mha"), [6, 5, 4], "h", values)
        whole = self.meta("in.mha", "whole.mha").data
        runs = 0
        for ending, data in (("mha", None), ("mhd", "raw"), ("nrrd", None), ("nhdr", "raw")):
            for options in (["--streams", "1"], ["--streams", "8"], ["--compress"], ["--compress", "--streams", "3"]):
                runs += 1
                target = os.path.join(self.folder, f"target{runs}")
                os.mkdir(target)
                before = self.write_decoys(current, ())
                name = f"new.{ending}"
                before.update(self.write_decoys(target, ()))
                before.update(self.snapshot(inputs))
                result = self.run_program(source, os.path.join(target, name), *options, cwd=current)
                self.assertEqual(result.returncode, 0, result.stderr)
                after = {**self.snapshot(current), **self.snapshot(target), **self.snapshot(inputs)}
                added = set(after) - set(before)
                self.assertEqual({path: after[path] for path in before}, before, (ending, options))
                self.assertEqual(len(added), 1 if data is None else 2, added)
                self.assertTrue(all(os.path.basename(path).startswith("new.") for path in added), added)
                if ending in ("mha", "mhd"):
                    self.assertEqual(Meta(os.path.join(target, name)).data, whole)

    def test_the_old_data_file_of_a_header_that_is_replaced_goes(self):
        write_meta(self.path("in.mha"), [6, 5, 4], "h", noise(120))
        for ending, packed in (("mhd", "zraw"), ("nhdr", "raw.gz")):
            header = f"scan.{ending}"
            for options, data in (([], "scan.raw"), (["--compress"], f"scan.{packed}"), ([], "scan.raw")):
                folder = self.path(ending)
                os.makedirs(folder, exist_ok=True)
                self.subdivide("in.mha", f"{ending}/{header}", *options)
                self.assertEqual(sorted(os.listdir(folder)), sorted([header, data]))

    def test_a_data_file_that_another_header_may_name_stays(self):
        write_meta(self.path("in.mha"), [6, 5, 4], "h", noise(120))
        others = {"other.mhd": meta_header([12, 10, 8], "h", data_file="scan.raw"),
                  "list.mhd": meta_header([12, 10, 8], "h", data_file="LIST") + b"scan.raw\n",
                  "pattern.mha": meta_header([12, 10, 8], "h", data_file="scan%d.raw 1 3 1"),
                  "other.nhdr": b"NRRD0004\ntype: short\ndimension: 3\nsizes: 12 10 8\nencoding: raw\nendian: little\n"
                                b"data file: ./scan.raw\n"}
        for name, content in others.items():
            folder = self.path(name + ".d")
            os.mkdir(folder)
            self.subdivide("in.mha", f"{name}.d/scan.mhd")
            with open(os.path.join(folder, name), "wb") as file:
                file.write(content)
            before = self.snapshot(folder)
            self.subdivide("in.mha", f"{name}.d/scan.mhd", "--compress")
            after = self.snapshot(folder)
            self.assertEqual(sorted(os.listdir(folder)), sorted(["scan.mhd", "scan.raw", "scan.zraw", name]))
            for kept in (name, "scan.raw"):
                self.assertEqual(after[os.path.join(folder, kept)], before[os.path.join(folder, kept)])

    def test_data_that_the_replaced_header_does_not_name_by_the_rule_stays(self):
        write_meta(self.path("in.mha"), [6, 5, 4], "h", noise(120))
        os.mkdir(self.path("more"))
        for data in ("scan.raw.bak", "more/scan.raw", "voxels.raw", "scan.zraw2"):
            with open(self.path("scan.mhd"), "wb") as file:
                file.write(meta_header([6, 5, 4], "h", data_file=data))
            with open(self.path(data), "wb") as file:
                file.write(b"precious")
            self.subdivide("in.mha", "scan.mhd", "--compress")
            with open(self.path(data), "rb") as file:
                self.assertEqual(file.read(), b"precious")
            os.remove(self.path("scan.zraw"))
        os.symlink("voxels.raw", self.path("scan.raw"))
        with open(self.path("scan.mhd"), "wb") as file:
            file.write(meta_header([6, 5, 4], "h", data_file="scan.raw"))
        self.subdivide("in.mha", "scan.mhd", "--compress")
        self.assertTrue(os.path.islink(self.path("scan.raw")))

    def test_a_folder_that_is_read_is_not_replaced(self):
        write_meta(self.path("in.mha"), [6, 5, 4], "H", noise(120))
        self.subdivide("in.mha", "slices/")
        os.symlink("slices", self.path("link"))
        before = self.snapshot(self.path("slices"))
        for source in ("slices", "link", "slices/slices_0003.tif"):
            for output in ("slices/", "slices", "link/", "link/../slices/."):
                for task in ([], ["--info"]):
                    self.assert_fails(self.run_program(self.path(source), self.path(output), *task), 1, "is there")
        self.assertEqual(self.snapshot(self.path("slices")), before)
        self.subdivide("in.mha", "slices/", "--scheme", "linear")
        self.assertEqual(sorted(self.snapshot(self.path("slices"))), sorted(before))

    @staticmethod
    def snapshot(folder):
        contents = {}
        for name in os.listdir(folder):
            with open(os.path.join(folder, name), "rb") as file:
                contents[os.path.join(folder, name)] = file.read()
        return contents


if __name__ == "__main__":
    if not PROGRAM:
        raise SystemExit("SUBDIVIDE_VOLUME is not set")
    unittest.main()
