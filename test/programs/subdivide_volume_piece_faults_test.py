#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""SubdivideVolume --piece where processes die, come twice or come late, under mpirun and without. The environment
variable SUBDIVIDE_VOLUME holds the path of the program."""

import glob
import hashlib
import os
import random
import shutil
import signal
import subprocess
import time
import unittest

from subdivide_volume_case import PROGRAM, ProgramTest, noise, skip_under_sanitizers
from subdivide_volume_files import meta_header, write_meta

OUTPUTS = ("out.mha", "out.mhd", "slices/")
MPIRUN = ["mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none"]


def contents(folder):
    found = {}
    for root, _, names in os.walk(folder):
        for name in names:
            with open(os.path.join(root, name), "rb") as file:
                relative = os.path.relpath(os.path.join(root, name), folder)
                found[relative] = hashlib.sha256(file.read()).hexdigest()
    return found


class PieceFaults(ProgramTest):
    def setUp(self):
        super().setUp()
        for folder in ("whole", "pieces"):
            os.mkdir(self.path(folder))
        write_meta(self.path("in.mha"), [13, 12, 11], "H", noise(1716))

    def write_large_input(self, size=100):
        with open(self.path("in.mha"), "wb") as file:
            file.write(meta_header([size] * 3, "H") + random.Random(1).randbytes(2 * size ** 3))

    def make_whole(self, name, *options):
        shutil.rmtree(self.path("whole"))
        shutil.rmtree(self.path("pieces"))
        os.mkdir(self.path("whole"))
        result = self.run_program(self.path("in.mha"), self.path(f"whole/{name}"), "--quiet", *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        # An older output, which is to be replaced.
        os.mkdir(self.path("pieces"))
        old = self.run_program(self.path("in.mha"), self.path(f"pieces/{name}"), "--quiet", "--spacing", 3, "--scheme",
                               "linear")
        self.assertEqual(old.returncode, 0, old.stderr)
        return contents(self.path("pieces"))

    def assert_complete(self, what):
        """The bytes of one run, and no other file."""
        self.assertEqual(contents(self.path("pieces")), contents(self.path("whole")), what)
        self.assertEqual(sorted(os.listdir(self.path("pieces"))), sorted(os.listdir(self.path("whole"))), what)

    def get_command(self, piece, name, *options):
        return [PROGRAM, "--piece", piece, "--threads", "1", self.path("in.mha"), self.path(f"pieces/{name}"), *options]

    def piece(self, piece, name, *options):
        return subprocess.run(self.get_command(piece, name, *options), capture_output=True, text=True, check=False,
                              timeout=300)

    def start_and_stop(self, piece, name):
        """A process that was stopped in the middle of its piece; run_on() lets it run on."""
        pieces = self.path(f"pieces/.{name.rstrip('/')}.pieces")
        while True:
            process = subprocess.Popen(self.get_command(piece, name, "--streams", "100", "--quiet"),
                                       stderr=subprocess.PIPE, text=True, start_new_session=True)
            while process.poll() is None and not (os.path.isdir(pieces) and os.listdir(pieces + "/temporary")):
                time.sleep(0.001)
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGSTOP)
                if os.listdir(pieces + "/temporary") and not os.listdir(pieces + "/notes"):
                    return process
            self.run_on(process)
            shutil.rmtree(pieces)

    @staticmethod
    def run_on(process):
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGCONT)
        return process.communicate(timeout=120)[1]

    @unittest.skipUnless(shutil.which("mpirun"), "for want of mpirun")
    def test_under_mpirun(self):
        for number, name, options in ((1, "out.mha", ()), (2, "out.mhd", ("--levels", "2")),
                                      (3, "out.nrrd", ("--scheme", "restored")),
                                      (7, "slices/", ("--scheme", "bounded")), (7, "out.nhdr", ("--labels",))):
            self.make_whole(name, *options)
            result = subprocess.run([*MPIRUN, "-n", str(number), *self.get_command("rank", name, *options)],
                                    capture_output=True, text=True, check=False, timeout=300)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("complete ", result.stdout)
            self.assert_complete((number, name))

    @unittest.skipUnless(shutil.which("mpirun"), "for want of mpirun")
    def test_one_of_mpirun_is_killed_and_all_are_run_again(self):
        """mpirun ends the others, too."""
        self.write_large_input()
        for name in ("out.mhd", "slices/"):
            before = self.make_whole(name)
            while not self.is_killed_in_the_middle(name):
                before = self.make_whole(name)
            names = [key for key in contents(self.path("pieces")) if not key.startswith(".")]
            self.assertEqual({key: contents(self.path("pieces"))[key] for key in names}, before)
            # A process that is killed while it begins leaves the folder that it was about to name.
            for begun in glob.glob(glob.escape(self.path(f"pieces/.{name.rstrip('/')}.pieces.")) + "??????"):
                shutil.rmtree(begun)
            subprocess.run([*MPIRUN, "-n", "3", *self.get_command("rank", name)], capture_output=True, check=True)
            self.assert_complete(name)

    def is_killed_in_the_middle(self, name):
        command = [*MPIRUN, "-n", "3", *self.get_command("rank", name, "--streams", "100")]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        temporary = self.path(f"pieces/.{name.rstrip('/')}.pieces/temporary")
        while process.poll() is None and not (os.path.isdir(temporary) and os.listdir(temporary)):
            time.sleep(0.001)
        with open(f"/proc/{process.pid}/task/{process.pid}/children", encoding="ascii") as file:
            children = file.read().split()
        if children:
            os.kill(int(children[0]), signal.SIGKILL)
        return process.wait(timeout=60) != 0

    def test_a_piece_again_after_the_end(self):
        """A scheduler may start a task twice. Where the file system has no extended attributes it begins anew."""
        for name in OUTPUTS:
            self.make_whole(name)
            for k in (1, 2, 3):
                self.assertEqual(self.piece(f"{k}/3", name).returncode, 0)
            self.assert_complete(name)
            try:
                os.getxattr(self.path(f"pieces/{name}"), "user.SubdivideVolume.pieces")
            except OSError:
                self.skipTest("the file system has no extended attributes")
            for piece in ("2/3", "status"):
                again = self.piece(piece, name)
                self.assertEqual((again.returncode, again.stdout), (0, f"complete {self.path('pieces/' + name)}\n"))
                self.assert_complete(name)
            # Other options, another number of pieces and a changed output begin anew.
            for piece, options in (("2/3", ("--tension", "3")), ("1/2", ())):
                anew = self.piece(piece, name, *options)
                self.assertIn("missing", anew.stdout, anew.stderr)
                shutil.rmtree(self.path(f"pieces/.{name.rstrip('/')}.pieces"))
            changed = self.path(f"pieces/{name}" + ("slices_0003.tif" if name == "slices/" else ""))
            os.utime(changed, ns=(1 << 61, 1 << 61))
            self.assertIn("missing", self.piece("2/3", name).stdout)

    @unittest.skipUnless(shutil.which("strace"), "for want of strace")
    def test_both_are_the_last_where_the_file_system_has_no_locks(self):
        for name in OUTPUTS:
            self.make_whole(name)
            self.assertEqual(self.piece("1/2", name).returncode, 0)
            command = ["strace", "-f", "-o", "/dev/null", "-e", "trace=flock", "-e", "inject=flock:error=ENOSYS",
                       *self.get_command("2/2", name)]
            processes = [subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                         for _ in range(3)]
            said = []
            for process in processes:
                out, err = process.communicate(timeout=120)
                self.assertEqual(process.returncode, 0, err)
                said.append(out.split()[0])
            self.assertIn("complete", said)
            if "missing" in said:  # one came after the end, while another one still wrote: it began anew
                self.assertEqual(self.piece("status", name).stdout, "missing 1 of 2\n")
                self.assertEqual(self.piece("1/2", name).returncode, 0)
            self.assert_complete(name)

    @unittest.skipUnless(shutil.which("strace"), "for want of strace")
    def test_the_disk_is_full_for_one_of_them(self):
        for name in OUTPUTS:
            with self.subTest(name):
                self.check_a_full_disk(name)

    def check_a_full_disk(self, name):
        call = "write" if name == "slices/" else "fallocate"
        if call == "write":
            skip_under_sanitizers(self, "sanitizers write to pipes of their own")
        before = self.make_whole(name)
        result = subprocess.run(["strace", "-f", "-qq", "-o", "/dev/null", "-e", f"trace={call}", "-e",
                                 f"inject={call}:error=ENOSPC:when=1", *self.get_command("2/3", name, "--quiet")],
                                capture_output=True, text=True, check=False)
        self.assertEqual((result.returncode, len(result.stderr.splitlines())), (1, 1), result.stderr)
        for k in (1, 3):
            self.assertEqual(self.piece(f"{k}/3", name).returncode, 0)
        self.assertEqual(self.piece("status", name).stdout, "missing 2 of 3\n")
        after = contents(self.path("pieces"))
        self.assertEqual({key: after[key] for key in before}, before)
        self.assertEqual(self.piece("2/3", name).returncode, 0)
        self.assert_complete(name)

    def test_the_folder_of_pieces_goes_in_the_middle(self):
        """Removed by hand, while one process is at work and perhaps another has begun anew: it fails, and the others'
        output is not touched."""
        self.write_large_input()
        for name in ("out.mhd", "slices/"):
            for begins_anew in (False, True):
                before = self.make_whole(name)
                pieces = self.path(f"pieces/.{name.rstrip('/')}.pieces")
                process = self.start_and_stop("1/2", name)
                os.rename(pieces, self.path("aside"))
                shutil.rmtree(self.path("aside"))
                if begins_anew:
                    self.assertEqual(self.piece("2/2", name).returncode, 0)
                error = self.run_on(process)
                self.assertEqual((process.returncode, len(error.splitlines())), (1, 1), error)
                after = contents(self.path("pieces"))
                self.assertEqual({key: after[key] for key in before}, before)
                if begins_anew:
                    self.assertEqual(self.piece("status", name).stdout, "missing 1 of 2\n")
                for k in (1, 2):
                    self.piece(f"{k}/2", name)
                self.assert_complete(name)

    def test_the_output_is_in_the_folder_of_the_input(self):
        os.mkdir(self.path("scan"))
        self.assertEqual(self.run_program(self.path("in.mha"), self.path("scan/"), "--axes", "x").returncode, 0)
        source, output = self.path("scan"), self.path("scan/out.mha")
        self.assertEqual(self.run_program(source, self.path("whole/out.mha")).returncode, 0)
        for k in (1, 2):
            result = self.run_program("--piece", f"{k}/2", source, output)
            self.assertEqual(result.returncode, 0, result.stderr)
        os.rename(output, self.path("pieces/out.mha"))
        self.assert_complete("in the input's folder")

    def test_an_input_that_changes_between_pieces_and_within_one(self):
        self.write_large_input()
        before = self.make_whole("out.mha")
        process = self.start_and_stop("1/2", "out.mha")
        with open(self.path("in.mha"), "r+b") as file:
            file.seek(-2, os.SEEK_END)
            file.write(b"!!")
        error = self.run_on(process)
        self.assertEqual(process.returncode, 1, error)
        self.assertIn("changed", error)
        self.assertIn("state of the input", self.piece("2/2", "out.mha").stderr)
        after = contents(self.path("pieces"))
        self.assertEqual({key: after[key] for key in before}, before)

    def test_slices_change_places_between_pieces(self):
        """Their number, sizes and the latest time stay."""
        os.mkdir(self.path("scan"))
        self.assertEqual(self.run_program(self.path("in.mha"), self.path("scan/"), "--axes", "x").returncode, 0)
        slices = sorted(glob.glob(self.path("scan/*")))
        self.assertGreater(len(slices), 4)
        for number, name in enumerate(slices):
            os.utime(name, (number, number))
        command = (self.path("scan"), self.path("pieces/out.mha"))
        self.assertEqual(self.run_program("--piece", "1/2", *command).returncode, 0)
        os.rename(slices[1], self.path("aside"))
        os.rename(slices[-2], slices[1])
        os.rename(self.path("aside"), slices[-2])
        result = self.run_program("--piece", "2/2", *command)
        self.assertEqual(result.returncode, 1)
        self.assertIn("another state of the input", result.stderr)

    def test_pieces_of_another_user(self):
        """What may not be joined, or not be read, is told as such, and stays."""
        as_user = {"user": 65534} if os.geteuid() == 0 else {}
        if as_user and subprocess.run([PROGRAM, "--version"], capture_output=True, check=False, **as_user).returncode:
            self.skipTest("root may write everywhere, and cannot become another user here")
        os.chmod(self.folder, 0o777)
        os.chmod(self.path("pieces"), 0o777)
        self.assertEqual(self.piece("1/2", "out.mha").returncode, 0)
        folder = self.path("pieces/.out.mha.pieces")
        for mode, status in ((0o555, 0), (0o000, 1)):
            os.chmod(os.path.join(folder, "agreement"), mode & 0o444)
            os.chmod(folder, mode)
            for piece, code in (("2/2", 1), ("status", status)):
                result = subprocess.run(self.get_command(piece, "out.mha", "--quiet"), capture_output=True, text=True,
                                        check=False, timeout=300, **as_user)
                self.assertEqual(result.returncode, code, (mode, piece, result.stderr))
                self.assertEqual("Permission denied" in result.stderr, code == 1, (mode, piece, result.stderr))
            os.chmod(folder, 0o755)
        os.chmod(os.path.join(folder, "agreement"), 0o644)
        self.assertEqual(self.piece("status", "out.mha").stdout, "missing 2 of 2\n")


if __name__ == "__main__":
    if not PROGRAM:
        raise SystemExit("SUBDIVIDE_VOLUME is not set")
    unittest.main()
