# SPDX-License-Identifier: Apache-2.0
"""SubdivideVolume where it cannot do what it is asked to."""

import math
import os
import random
import resource
import signal
import subprocess
import time
import unittest

from subdivide_volume_case import PROGRAM, ProgramTest, noise
from subdivide_volume_files import (Meta, meta_header, write_compressed_meta, write_meta, write_nifti, write_nrrd)


class Errors(ProgramTest):
    """One clear line, a code, and no half-written file."""

    def test_wrong_usage(self):
        write_meta(self.path("in.mha"), [6, 5, 4], "h", noise(120))
        files = [self.path("in.mha"), self.path("out.mha")]
        for arguments, word in (([], "INPUT"), (files[:1], "OUTPUT"), (files + ["--foo"], "--foo"),
                                (files + ["more"], "more"),
                                (files + ["--scheme", "cubic"], "cubic"), (files + ["--tension", "1"], "than 1"),
                                (files + ["--tension", "nan"], "nan"), (files + ["--tension", "inf"], "inf"),
                                (files + ["--boundary", "far"], "far"),
                                (files + ["--boundary", "1e400"], "1e400"), (files + ["--axes", "xx"], "xx"),
                                (files + ["--axes", "xyzt"], "xyzt"), (files + ["--axes", "a"], "axes"),
                                (files + ["--output-type", "int"], "int"), (files + ["--threads", "0"], "--threads"),
                                (files + ["--streams", "-1"], "--streams"), (files + ["--memory", "much"], "--memory"),
                                (files + ["--memory", "1G", "--streams", "2"], "--memory"),
                                (files + ["--scheme"], "--scheme")):
            self.assert_fails(self.run_program(*arguments), 2, word)

    def test_numbers_that_are_none(self):
        write_meta(self.path("in.mha"), [6, 5, 4], "f", noise(120))
        files = [self.path("in.mha"), self.path("out.mha")]
        for option in ("--tension", "--levels", "--threads", "--streams", "--memory", "--compression-level", "--channel",
                       "--frame", "--spacing", "--origin", "--raw", "--piece"):
            for value in ("nan", "-inf", "", "1e400", "1,nan", "two") + (() if option == "--origin" else ("-1",)):
                with self.subTest(option=option, value=value):
                    self.assert_fails(self.run_program(*files, option, value), 2, option)
        for value in ("nan", "inf", "-inf"):
            self.assert_fails(self.run_program(*files, f"--boundary={value}"), 1, value)

    def test_an_empty_tension_is_not_0(self):
        write_meta(self.path("in.mha"), [6, 5, 4], "f", noise(120))
        self.assert_fails(self.run_program("--scheme", "restored", "--tension", "", self.path("in.mha"),
                                           self.path("out.mha")), 2, "--tension: a number is missing")

    def test_an_unknown_option_alone_is_named(self):
        files = [self.path("in.mha"), self.path("out.mha")]
        for arguments, message in ((["--shceme", "linear"], "unknown argument: --shceme; is --scheme meant?"),
                                   (["--Tension=3"], "unknown argument: --Tension=3; is --tension meant?"),
                                   (["--frobnicate"], "unknown argument: --frobnicate (see --help)"),
                                   (["-q"], "unknown argument: -q (see --help)")):
            result = self.run_program(*arguments, *files)
            self.assert_fails(result, 2, message)
            self.assertNotIn("out.mha", result.stderr)
        self.assert_fails(self.run_program(*files, "--", "--quiet"), 2, "unknown argument: ./--quiet")

    def test_names_behind_two_dashes_are_no_options(self):
        write_meta(self.path("-in.mha"), [6, 5, 4], "h", noise(120))
        write_meta(self.path("in.mha"), [6, 5, 4], "h", noise(120))
        self.subdivide("in.mha", "truth.mha")
        for arguments in (["--", "-in.mha"], ["in.mha", "--"], ["--axes", "xyz", "--", "-in.mha"], ["--quiet", "--", "in.mha"]):
            result = self.run_program(*arguments, "--quiet.mha", cwd=self.folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            with open(self.path("--quiet.mha"), "rb") as output, open(self.path("truth.mha"), "rb") as truth:
                self.assertEqual(output.read(), truth.read(), arguments)
            os.remove(self.path("--quiet.mha"))

    def test_options_that_do_not_fit_the_image(self):
        write_meta(self.path("in.mha"), [6, 5], "B", noise(30, 0, 256))
        files = [self.path("in.mha"), self.path("out.mha")]
        self.assert_fails(self.run_program(*files, "--axes", "z"), 1, "xy")
        for value in ("-1", "256", "1.5", "nan"):
            self.assert_fails(self.run_program(*files, "--boundary", value), 1, value)

    def test_files_that_cannot_be_read(self):
        out = self.path("out.mha")
        self.assert_fails(self.run_program(self.path("none.mha"), out), 1, "none.mha", "No such file")
        self.assert_fails(self.run_program(self.folder, out), 1, "no DICOM series with images, and no slices")
        for name, content in (("empty.mha", b""), ("text.txt", b"hello"), ("a.nrrd", b"hello"), ("a.png", b"hello")):
            with open(self.path(name), "wb") as file:
                file.write(content)
            self.assert_fails(self.run_program(self.path(name), out), 1, name)

    def test_damaged_hdf5_is_the_input(self):
        write_meta(self.path("in.mha"), [6, 5, 4], "h", noise(120))
        self.subdivide("in.mha", "in.h5", "--axes", "x")
        with open(self.path("in.h5"), "rb") as file:
            whole = file.read()
        source = random.Random(7)
        refused = 0
        for _ in range(40):
            place = source.randrange(len(whole) - 40)
            with open(self.path("in.h5"), "wb") as file:
                file.write(whole[:place] + source.randbytes(40) + whole[place + 40:])
            result = self.run_program(self.path("in.h5"), self.path("out.mha"), "--quiet")
            if result.returncode != 0:
                self.assert_fails(result, 1, "cannot read " + self.path("in.h5"))
                refused += 1
            elif os.path.exists(self.path("out.mha")):
                os.remove(self.path("out.mha"))
        self.assertGreater(refused, 5)
        with open(self.path("in.h5"), "wb") as file:
            file.write(whole[:8] + bytes(1000))
        self.assert_fails(self.run_program(self.path("in.h5"), self.path("out.mha")), 1,
                          "it is an HDF5 file that holds no image as ITK writes it")

    def test_images_that_cannot_be(self):
        out = self.path("out.mha")
        for size in ([0, 5], [2000000000, 2000000000, 2000000000], [2, 2, 2, 2, 2]):
            with open(self.path("in.mha"), "wb") as file:
                file.write(meta_header(size, "h") + bytes(64))
            self.assert_fails(self.run_program(self.path("in.mha"), out), 1, "in.mha")

    def test_truncated_files(self):
        size, values = [20, 18, 16], noise(5760, -1000, 1000)
        writers = {"in.mha": lambda path: write_meta(path, size, "h", values),
                   "compressed.mha": lambda path: write_compressed_meta(path, size, "h", values),
                   "in.nrrd": lambda path: write_nrrd(path, size, "h", values),
                   "gzip.nrrd": lambda path: write_nrrd(path, size, "h", values, encoding="gzip"),
                   "in.nii": lambda path: write_nifti(path, size, values),
                   "in.nii.gz": lambda path: write_nifti(path, size, values)}
        for ending in ("vtk", "gipl", "tif", "hdf5", "mrc", "png"):
            flat = ["--axes", "x"] if ending != "png" else ["--axes", "y"]
            source = "flat.mha" if ending == "png" else "volume.mha"
            write_meta(self.path("volume.mha"), size, "h", values)
            write_meta(self.path("flat.mha"), [100, 50], "B", noise(5000, 0, 256))
            self.subdivide(source, f"in.{ending}", *flat)
            writers[f"in.{ending}"] = None
        for name, write in writers.items():
            if write:
                write(self.path(name))
            whole = os.path.getsize(self.path(name))
            for part in (whole // 2, whole - 40):
                os.truncate(self.path(name), part)
                for options in ([], ["--streams", "4"]):
                    result = self.run_program(self.path(name), self.path("out.mha"), "--quiet", *options)
                    with self.subTest(file=name, bytes=part, of=whole, options=options):
                        self.assert_fails(result, 1, name)
                if write:
                    write(self.path(name))

    def test_truncated_or_missing_data_file(self):
        write_meta(self.path("in.mha"), [20, 18, 16], "h", noise(5760))
        for options in ([], ["--compress"]):
            self.subdivide("in.mha", "two.mhd", *options)
            data = self.path(Meta(self.path("two.mhd")).fields["ElementDataFile"])
            os.truncate(data, os.path.getsize(data) - 1)
            self.assert_fails(self.run_program(self.path("two.mhd"), self.path("out.mha")), 1, "truncated")
            os.remove(data)
            self.assert_fails(self.run_program(self.path("two.mhd"), self.path("out.mha")), 1, os.path.basename(data))

    def test_damaged_compressed_data(self):
        write_compressed_meta(self.path("in.mha"), [20, 18, 16], "h", noise(5760))
        with open(self.path("in.mha"), "r+b") as file:
            file.seek(-2000, os.SEEK_END)
            file.write(bytes(500))
        self.assert_fails(self.run_program(self.path("in.mha"), self.path("out.mha")), 1, "damaged")

    def test_outputs_that_cannot_be_written(self):
        write_meta(self.path("in.mha"), [6, 5, 4], "f", noise(120))
        os.mkdir(self.path("folder.mha"))
        for name, word in (("none/out.mha", "No such file"), ("out", "ending"), ("out.xyz", ".xyz"),
                           ("in.mha/out.mha", "Not a"),
                           ("folder.mha", "Is a directory"), ("out.png", "float"), ("out.jpg", "float")):
            self.assert_fails(self.run_program(self.path("in.mha"), self.path(name)), 1, name, word)

    def test_a_folder_that_must_not_be_written(self):
        write_meta(self.path("in.mha"), [6, 5, 4], "h", noise(120))
        os.mkdir(self.path("locked"), 0o555)
        os.chmod(self.folder, 0o755)
        nobody = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
        for name in ("locked/out.mha", "locked/out.nii", "locked/out.tif", "locked/out/"):
            with self.subTest(name=name):
                result = self.run_program("--quiet", self.path("in.mha"), self.path(name), **nobody)
                self.assert_fails(result, 1, "Permission denied")
        self.assertEqual(os.listdir(self.path("locked")), [])

    def test_an_output_that_would_replace_the_data_of_another(self):
        write_meta(self.path("in.mha"), [6, 5, 4], "h", noise(120))
        with open(self.path("other.raw"), "w", encoding="ascii") as file:
            file.write("precious")
        self.assert_fails(self.run_program(self.path("in.mha"), self.path("other.mhd")), 1, "other.raw")
        with open(self.path("other.raw"), encoding="ascii") as file:
            self.assertEqual(file.read(), "precious")
        self.assertFalse(os.path.exists(self.path("other.mhd")))

    def test_a_file_size_limit_is_told_and_the_old_output_stays(self):
        write_meta(self.path("in.mha"), [40, 40, 40], "h", noise(64000))
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (300000, 300000))
        for ending in ("mha", "mhd", "nrrd", "nhdr", "nii", "nii.gz", "vtk", "tif", "hdf5", "gipl", "mrc"):
            for options in ([], ["--streams", "5"]):
                with open(self.path(f"old.{ending}"), "w", encoding="ascii") as file:
                    file.write("old")
                command = [self.path("in.mha"), self.path(f"old.{ending}"), "--quiet", *options]
                with self.subTest(ending=ending, options=options):
                    self.assert_fails(self.run_program(*command, preexec_fn=limit), 1, f"old.{ending}")
                with open(self.path(f"old.{ending}"), encoding="ascii") as file:
                    self.assertEqual(file.read(), "old")

    def test_a_full_disk_is_told(self):
        write_meta(self.path("in.mha"), [40, 40, 40], "h", noise(64000))
        os.mkdir(self.path("disk"))
        mount = ["mount", "-t", "tmpfs", "-o", "size=400k", "tmpfs", self.path("disk")]
        if os.geteuid() != 0 or subprocess.run(mount, capture_output=True, check=False).returncode != 0:
            self.skipTest("only root may mount a small disk")
        self.addCleanup(subprocess.run, ["umount", self.path("disk")], check=True)
        for ending in ("mha", "mhd", "nrrd", "nhdr", "nii", "nii.gz", "vtk", "tif", "hdf5", "gipl", "mrc"):
            for options in ([], ["--streams", "5"], ["--compress"]):
                command = [self.path("in.mha"), self.path(f"disk/out.{ending}"), "--quiet", *options]
                with self.subTest(ending=ending, options=options):
                    self.assert_fails(self.run_program(*command), 1, f"out.{ending}")
                self.assertEqual(os.listdir(self.path("disk")), [])

    def test_a_closed_pipe_leaves_nothing_behind(self):
        write_meta(self.path("in.mha"), [40, 40, 40], "h", noise(64000))
        reader, writer = os.pipe()
        os.close(reader)
        subprocess.run([PROGRAM, self.path("in.mha"), self.path("out.mha")], stdout=writer, stderr=writer, check=False)
        os.close(writer)
        self.assertFalse([name for name in os.listdir(self.folder) if name.startswith(".")])

    def test_an_interrupt_leaves_nothing_behind(self):
        size = [160, 160, 160]
        with open(self.path("in.mha"), "wb") as file:
            file.write(meta_header(size, "H") + random.Random(1).randbytes(2 * math.prod(size)))
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            for options in (["--streams", "160"], ["--compress"]):
                write_meta(self.path("old.mha"), [1, 1], "H", [7])
                command = [PROGRAM, self.path("in.mha"), self.path("old.mha"), "--quiet", *options]
                with subprocess.Popen(command) as process:
                    while process.poll() is None and "partial" not in "".join(os.listdir(self.folder)):
                        time.sleep(0.001)
                    process.send_signal(number)
                    process.wait(timeout=60)
                self.assertEqual(process.returncode, -number)
                self.assertEqual(sorted(os.listdir(self.folder)), ["in.mha", "old.mha"])
                self.assertEqual(list(Meta(self.path("old.mha")).values), [7])
