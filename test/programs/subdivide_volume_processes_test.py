#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""SubdivideVolume --piece: one output made by many processes. The environment variable SUBDIVIDE_VOLUME holds the path
of the program."""

import hashlib
import json
import os
import random
import re
import signal
import subprocess
import time
import unittest

from subdivide_volume_case import PROGRAM, ProgramTest, noise
from subdivide_volume_files import Meta, meta_header, write_meta

ENDINGS = ("mha", "mhd", "nrrd", "nhdr")
RANKS = ("OMPI_COMM_WORLD_", "PMI_", "SLURM_")


class Processes(ProgramTest):
    def snapshot(self, *names):
        """Checksums of files, and of all files of folders; the name itself is left out of the names."""
        contents = {}
        for name in names:
            path = self.path(name).rstrip("/")
            own = os.path.basename(path)
            for file in ([os.path.join(path, n) for n in sorted(os.listdir(path))] if os.path.isdir(path) else [path]):
                with open(file, "rb") as opened:
                    contents[os.path.basename(file).replace(own, "NAME")] = hashlib.sha256(opened.read()).hexdigest()
        return contents

    def start(self, piece, source, target, *arguments, **keywords):
        command = [PROGRAM, "--piece", piece, self.path(source), self.path(target), *map(str, arguments)]
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **keywords)

    def wait(self, processes):
        """What they print; all must succeed."""
        texts = []
        for process in processes:
            out, err = process.communicate(timeout=600)
            self.assertEqual(process.returncode, 0, err)
            texts.append(out)
        return texts

    def piece(self, number, *arguments):
        return self.run_program("--piece", number, *map(str, arguments))

    def assert_nothing_else(self):
        self.assertEqual([name for name in os.listdir(self.folder) if name.startswith(".")], [])

    def assert_same_at_once(self, source, name, number, *arguments):
        """All pieces at once against one run."""
        whole, target = f"whole/{name}", f"pieces/{name}"
        for folder in ("whole", "pieces"):
            os.makedirs(self.path(folder), exist_ok=True)
        self.assertEqual(self.run_program(self.path(source), self.path(whole), *arguments).returncode, 0)
        order = list(range(1, number + 1))
        random.Random(number).shuffle(order)
        texts = self.wait([self.start(f"{k}/{number}", source, target, "--threads", 1, "--quiet" if k % 2 else "--json",
                                      *arguments) for k in order])
        self.assertTrue(number == 1 or any('"number_of_pieces"' in text for text in texts))
        self.assertEqual(sorted(os.listdir(self.path("pieces"))), sorted(os.listdir(self.path("whole"))))
        for entry in os.listdir(self.path("whole")):
            self.assertEqual(self.snapshot(f"pieces/{entry}"), self.snapshot(f"whole/{entry}"),
                             (name, number, arguments))

    def test_formats(self):
        write_meta(self.path("in.mha"), [9, 8, 7], "H", noise(504))
        for ending in ENDINGS:
            for number in (1, 2, 3, 7):
                self.assert_same_at_once("in.mha", f"{ending}.{ending}", number)
        for number in (1, 3, 7, 20):
            self.assert_same_at_once("in.mha", "slices/", number)

    def test_two_runs_to_one_output_leave_that_of_one(self):
        """A header never stands beside the voxels of the other run."""
        size = [9, 8, 7]
        for value in (0, 7):
            write_meta(self.path(f"{value}.mha"), size, "B", [value] * 504, spacing=[value + 1] * 3)
        for ending in ("mhd", "nhdr"):
            for _ in range(15):
                for name in os.listdir(self.folder):
                    if name.startswith("out."):
                        os.remove(self.path(name))
                runs = [subprocess.Popen([PROGRAM, "--quiet", self.path(f"{value}.mha"), self.path(f"out.{ending}")],
                                         stderr=subprocess.PIPE, text=True) for value in (0, 7)]
                self.wait(runs)
                with open(self.path("out.raw"), "rb") as file:
                    voxels = file.read()
                with open(self.path(f"out.{ending}"), encoding="ascii") as file:
                    spacing = re.search(r"ElementSpacing = ([0-9.]+)|space directions: \(([0-9.]+)", file.read())
                self.assertEqual(len(voxels), 8 * 504)
                self.assertEqual(2 * float(spacing.group(1) or spacing.group(2)), voxels[0] + 1)
                self.assert_nothing_else()

    def test_schemes_levels_and_labels(self):
        write_meta(self.path("in.mha"), [9, 8, 7], "H", noise(504, 0, 5))
        for scheme in ("nonoscillatory", "linear", "bounded", "bspline", "restored"):
            self.assert_same_at_once("in.mha", "out.mha", 3, "--scheme", scheme)
        self.assert_same_at_once("in.mha", "out.mha", 7, "--levels", 2, "--boundary", "periodic")
        self.assert_same_at_once("in.mha", "out.mha", 3, "--labels", "--levels", 2)

    def test_other_images_and_more_pieces_than_planes(self):
        write_meta(self.path("plane.mha"), [9, 8], "f", noise(72))
        write_meta(self.path("series.mha"), [5, 4, 3, 2], "h", noise(120))
        write_meta(self.path("colours.mha"), [5, 4, 3], "B", noise(180, 0, 256), channels=3)
        for name in ("plane.mha", "series.mha", "colours.mha"):
            for number in (2, 7, 40):
                self.assert_same_at_once(name, "out.mha", number, "--output-type", "float")

    def test_one_after_the_other_in_any_order_and_within_memory(self):
        write_meta(self.path("in.mha"), [20, 18, 16], "h", noise(5760))
        whole = self.meta("in.mha", "whole.mha").data
        with open(self.path("out.mha"), "wb") as file:
            file.write(b"old")
        for done, k in enumerate((3, 1, 4, 2), 1):
            result = self.piece(f"{k}/4", self.path("in.mha"), self.path("out.mha"), "--streams", 3)
            self.assertEqual(result.returncode, 0, result.stderr)
            if done < 4:
                missing = {1: "1 2 4", 2: "2 4", 3: "2"}[done]
                self.assertEqual(result.stdout, f"missing {missing} of 4\n")
                with open(self.path("out.mha"), "rb") as file:
                    self.assertEqual(file.read(), b"old")
                status = self.piece("status", self.path("in.mha"), self.path("out.mha"))
                self.assertEqual((status.returncode, status.stdout), (0, f"missing {missing} of 4\n"))
                report = json.loads(self.piece("status", self.path("in.mha"), self.path("out.mha"), "--json").stdout)
                self.assertEqual((report["missing"], report["complete"]), ([int(m) for m in missing.split()], False))
        self.assertEqual(result.stdout, f"complete {self.path('out.mha')}\n")
        self.assertEqual(Meta(self.path("out.mha")).data, whole)
        self.assert_nothing_else()
        os.remove(self.path("out.mha"))
        self.assert_fails(self.piece("status", self.path("in.mha"), self.path("out.mha")), 1, "no pieces")

    def test_a_piece_reads_only_what_it_needs(self):
        """What is beyond the reach of a piece is not even there."""
        size = [16, 16, 200]
        write_meta(self.path("full.mha"), size, "H", noise(51200))
        with open(self.path("in.raw"), "wb") as file:
            file.write(Meta(self.path("full.mha")).data)
        with open(self.path("in.mhd"), "wb") as file:
            file.write(meta_header(size, "H", data_file="in.raw"))
        trace = self.path("trace")
        try:
            result = subprocess.run(["strace", "-f", "-e", "trace=pread64", "-o", trace, PROGRAM, "--piece", "2/10",
                                     self.path("in.mhd"), self.path("out.mha")], capture_output=True, check=False)
        except FileNotFoundError:
            self.skipTest("for want of strace")
        self.assertEqual(result.returncode, 0)
        with open(trace, encoding="ascii", errors="replace") as file:
            read = sum(int(line.rsplit("= ", 1)[1]) for line in file if "pread64" in line and "= " in line)
        self.assertLess(read, 512 * 45 + 16 * 16 * 8 * 50 + 100000)

    def test_a_killed_piece_is_run_again(self):
        size = [120, 120, 120]
        with open(self.path("in.mha"), "wb") as file:
            file.write(meta_header(size, "H") + random.Random(1).randbytes(2 * size[0] ** 3))
        for name in ("out.mha", "slices/"):
            self.assertEqual(self.run_program(self.path("in.mha"), self.path("whole-" + name), "--quiet").returncode, 0)
            for number in (signal.SIGKILL, signal.SIGTERM, signal.SIGINT):
                process = self.start("2/3", "in.mha", name, "--threads", 1, "--streams", 100, start_new_session=True)
                grown = self.path("." + name.rstrip("/") + ".pieces/temporary")
                while process.poll() is None and not (os.path.isdir(grown) and os.listdir(grown)):
                    time.sleep(0.001)
                time.sleep(0.05)
                os.killpg(process.pid, number)
                process.communicate(timeout=60)
                self.assertNotEqual(process.returncode, 0)
                status = self.piece("status", self.path("in.mha"), self.path(name))
                self.assertEqual(status.stdout, "missing 1 2 3 of 3\n", status.stderr)
                self.assertFalse(os.path.exists(self.path(name)))
            self.wait([self.start(f"{k}/3", "in.mha", name, "--threads", 1) for k in (1, 2, 3)])
            self.assertEqual(self.snapshot(name), self.snapshot("whole-" + name))
            self.assert_nothing_else()

    def test_the_same_piece_twice_at_once_and_both_the_last(self):
        size = [100, 100, 100]
        with open(self.path("in.mha"), "wb") as file:
            file.write(meta_header(size, "H") + random.Random(1).randbytes(2 * size[0] ** 3))
        for name in ("out.mha", "out.mhd", "slices/"):
            self.assertEqual(self.run_program(self.path("in.mha"), self.path("whole-" + name), "--quiet").returncode, 0)
            for _ in range(2):
                self.assertEqual(self.piece("1/3", self.path("in.mha"), self.path(name)).returncode, 0)
                pieces = ("2/3", "2/3", "3/3", "3/3")
                self.wait([self.start(piece, "in.mha", name, "--threads", 1, "--streams", 40) for piece in pieces])
                if name == "out.mhd":
                    self.assertTrue(Meta(self.path(name)).data == Meta(self.path("whole-" + name)).data)
                else:
                    self.assertEqual(self.snapshot(name), self.snapshot("whole-" + name))
                self.assert_nothing_else()

    def test_a_damaged_piece_is_made_again(self):
        write_meta(self.path("in.mha"), [9, 8, 7], "H", noise(504))
        whole = self.meta("in.mha", "whole.mha").data
        files = [self.path("in.mha"), self.path("out.mha")]
        self.assertEqual(self.piece("1/2", *files).returncode, 0)
        with open(self.path(".out.mha.pieces/output/out.mha"), "r+b") as file:
            file.seek(-len(whole), os.SEEK_END)
            file.write(b"damage")
        self.assertEqual(self.piece("1/2", *files).returncode, 0)
        self.assertEqual(self.piece("2/2", *files).returncode, 0)
        self.assertEqual(Meta(self.path("out.mha")).data, whole)

    def test_another_agreement_is_refused(self):
        write_meta(self.path("in.mha"), [9, 8, 7], "H", noise(504))
        write_meta(self.path("other.mha"), [9, 8, 7], "H", noise(504))
        files = [self.path("in.mha"), self.path("out.mha")]
        self.assertEqual(self.piece("1/2", *files).returncode, 0)
        before = self.snapshot(".out.mha.pieces/notes")
        for arguments, words in ((["1/3", *files], ("number of pieces: 2, not 3",)),
                                 (["2/2", *files, "--scheme", "linear"], ("scheme: nonoscillatory, not linear",)),
                                 (["2/2", *files, "--tension", 3], ("tension: 2, not 3",)),
                                 (["2/2", *files, "--boundary", "mirror"], ("boundary", "mirror")),
                                 (["2/2", *files, "--axes", "xy"], ("grid of the output",)),
                                 (["2/2", *files, "--levels", 2], ("grid of the output",)),
                                 (["2/2", *files, "--output-type", "float"], ("grid of the output", "float")),
                                 (["2/2", *files, "--spacing", 2], ("grid of the input",)),
                                 (["2/2", *files, "--target", "portable"], ("--target", "portable")),
                                 (["2/2", *files, "--keep-metadata"], ("metadata",)),
                                 (["2/2", self.path("other.mha"), files[1]], ("input", "other.mha"))):
            result = self.piece(*arguments, "--quiet")
            self.assertEqual(result.returncode, 1)
            self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
            for word in (*words, ".out.mha.pieces"):
                self.assertIn(word, result.stderr)
        os.utime(files[0], ns=(1, 1))
        self.assertIn("state of the input", self.piece("2/2", *files).stderr)
        self.assertEqual(self.snapshot(".out.mha.pieces/notes"), before)
        self.assertFalse(os.path.exists(files[1]))

    def test_ranks_from_the_environment(self):
        write_meta(self.path("in.mha"), [9, 8, 7], "H", noise(504))
        array = {"SLURM_ARRAY_TASK_COUNT": "3", "SLURM_ARRAY_TASK_MIN": "4", "SLURM_ARRAY_TASK_MAX": "8",
                 "SLURM_ARRAY_TASK_STEP": "2", "SLURM_PROCID": "0", "SLURM_NTASKS": "1"}
        clean = {key: value for key, value in os.environ.items() if not key.startswith(RANKS)}
        for variables, piece, number in (({**array, "SLURM_ARRAY_TASK_ID": "6"}, 2, 3),
                                         ({**array, "SLURM_ARRAY_TASK_ID": "8", "PMI_RANK": "0", "PMI_SIZE": "1"},
                                          3, 3),
                                         ({"SLURM_PROCID": "4", "SLURM_NTASKS": "5"}, 5, 5),
                                         ({"OMPI_COMM_WORLD_RANK": "0", "OMPI_COMM_WORLD_SIZE": "2",
                                           "SLURM_PROCID": "1", "SLURM_NTASKS": "4"}, 1, 2),
                                         ({"PMI_RANK": "3", "PMI_SIZE": "4"}, 4, 4)):
            name = f"out{piece}of{number}.mha"
            result = self.run_program("--piece", "rank", self.path("in.mha"), self.path(name), "--json", "--quiet",
                                      env={**clean, **variables})
            self.assertEqual(result.returncode, 0, result.stderr)
            report = json.loads(result.stdout)
            self.assertEqual((report["piece"], report["number_of_pieces"]), (piece, number))
            self.assertEqual(report["missing"], [k for k in range(1, number + 1) if k != piece])
        for variables in ({}, {**array, "SLURM_ARRAY_TASK_ID": "5"}, {"PMI_RANK": "4", "PMI_SIZE": "4"}):
            result = self.run_program("--piece", "rank", self.path("in.mha"), self.path("no.mha"),
                                      env={**clean, **variables})
            self.assertEqual(result.returncode, 2)
            self.assertIn("--piece", result.stderr)

    def test_under_mpirun(self):
        write_meta(self.path("in.mha"), [20, 18, 16], "h", noise(5760))
        whole = self.meta("in.mha", "whole.mha").data
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "3", PROGRAM, "--piece", "rank", "--threads",
                   "1", self.path("in.mha"), self.path("out.mha")]
        try:
            result = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
        except FileNotFoundError:
            self.skipTest("for want of mpirun")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(f"complete {self.path('out.mha')}\n", result.stdout)
        self.assertTrue(Meta(self.path("out.mha")).data == whole)

    def test_what_is_refused(self):
        write_meta(self.path("in.mha"), [9, 8, 7], "H", noise(504))
        files = [self.path("in.mha"), self.path("out.mha")]
        for piece in ("0/3", "4/3", "1", "a/b", "1/0", "-1/3", "1/3/4", "1/1000001", ""):
            self.assert_fails(self.piece(piece, *files), 2, "--piece")
        self.assert_fails(self.piece("1/2", *files, "--compress"), 2, "compressed")
        self.assert_fails(self.piece("1/2", *files, "--info"), 2, "--piece")
        self.assert_fails(self.piece("1/2", files[0], files[0]), 1, "the input")
        for name in ("out.nii", "out.tif", "out"):
            self.assert_fails(self.piece("1/2", files[0], self.path(name)), 1, ".nhdr")
        with open(self.path("two.raw"), "wb") as file:
            file.write(b"precious")
        self.assert_fails(self.piece("1/2", files[0], self.path("two.mhd")), 1, "two.raw")
        os.mkdir(self.path("full"))
        with open(self.path("full/note.txt"), "wb") as file:
            file.write(b"precious")
        self.assert_fails(self.piece("1/2", files[0], self.path("full/"), "--quiet"), 1, "note.txt")

    def test_the_data_file_of_the_old_output_goes(self):
        write_meta(self.path("in.mha"), [9, 8, 7], "H", noise(504))
        os.mkdir(self.path("more"))
        self.subdivide("in.mha", "more/scan.mhd", "--compress")
        for k in (1, 2):
            self.assertEqual(self.piece(f"{k}/2", self.path("in.mha"), self.path("more/scan.mhd")).returncode, 0)
        self.assertEqual(sorted(os.listdir(self.path("more"))), ["scan.mhd", "scan.raw"])

    def test_a_process_that_died_after_the_last_rename(self):
        """The folder of pieces is still there, and the output has its name already."""
        write_meta(self.path("in.mha"), [9, 8, 7], "H", noise(504))
        whole = self.meta("in.mha", "whole.mha").data
        files = [self.path("in.mha"), self.path("out.mha")]
        for k in (1, 2):
            self.assertEqual(self.piece(f"{k}/3", *files).returncode, 0)
        folder = self.path(".out.mha.pieces")
        with open(os.path.join(folder, "notes/1"), encoding="ascii") as file:
            note = file.read()
        self.assertTrue(note.strip().isdigit())
        # As if piece 3 had been noted and the process had died after it gave the name.
        copy = self.path("copy")
        self.assertEqual(subprocess.run(["cp", "-a", "--link", folder, copy], check=False).returncode, 0)
        self.assertEqual(self.piece("3/3", *files).returncode, 0)
        os.rename(copy, folder)
        os.remove(os.path.join(folder, "output/out.mha"))
        for k in (1, 2, 3):
            result = self.piece(f"{k}/3", *files)
            if not os.path.exists(folder):
                break
        self.assertEqual((result.returncode, result.stdout), (0, f"complete {files[1]}\n"), result.stderr)
        self.assertEqual(Meta(files[1]).data, whole)


if __name__ == "__main__":
    if not PROGRAM:
        raise SystemExit("SUBDIVIDE_VOLUME is not set")
    unittest.main()
