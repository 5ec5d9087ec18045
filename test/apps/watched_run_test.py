# SPDX-License-Identifier: Apache-2.0
"""Runs that a library takes down; the environment variable WATCHED_PROGRAM holds the path of the program."""

import os
import signal
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.environ.get("WATCHED_PROGRAM")


class WatchedRun(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.file = os.path.join(self.folder, "out.mha")

    def run_program(self, way, **keywords):
        return subprocess.run([PROGRAM, way, self.file], capture_output=True, text=True, check=False, timeout=60,
                              **keywords)

    def assert_dies(self, way, *words):
        result = self.run_program(way)
        self.assertEqual((result.returncode, result.stdout), (1, ""), result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertTrue(result.stderr.startswith("WatchedProgram: "), result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertEqual(os.listdir(self.folder), [])

    def test_what_the_run_returns_and_prints_is_passed_on(self):
        result = self.run_program("return")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (7, "", ""))
        result = self.run_program("print")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "result", "progress\n"))

    def test_an_exception_is_told_in_one_line(self):
        self.assert_dies("throw", "WatchedProgram: reason of two lines\n")

    def test_a_crash_is_told_with_what_the_library_said(self):
        self.assert_dies("segv", "cannot read in.tif: ", "Segmentation fault", "strip 7 is odd")
        self.assert_dies("segv-thread", "cannot read in.tif: ", "Segmentation fault")
        self.assert_dies("abort", "cannot read in.tif: ", "Aborted", "assertion failed: rows == 3")
        self.assert_dies("kill", "cannot read in.tif: ", "killed", "memory")

    def test_an_exit_that_is_not_the_programs_own_is_a_failure(self):
        for way in ("exit", "exit-3"):
            self.assert_dies(way, "cannot read in.tif: ", "ended the program")

    def test_an_endless_opening_is_ended(self):
        self.assert_dies("loop", "cannot read loop.dcm: ", "no end")

    def test_an_opening_that_makes_steps_is_left_alone(self):
        with self.assertRaises(subprocess.TimeoutExpired):
            subprocess.run([PROGRAM, "loop-with-steps"], capture_output=True, check=False, timeout=3)

    def start(self, way, **keywords):
        process = subprocess.Popen([PROGRAM, way, self.file], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   **keywords)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.stdout.close)
        self.assertEqual(process.stdout.readline(), "ready\n")
        return process

    def test_interrupts_end_the_run_and_remove_its_files(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            process = self.start("sleep")
            self.assertEqual(os.listdir(self.folder), [".partial"])
            process.send_signal(number)
            self.assertEqual(process.wait(timeout=30), -number)
            self.assertEqual((process.stderr.read(), os.listdir(self.folder)), ("", []))

    def test_an_interrupt_from_the_terminal_reaches_all_processes(self):
        process = self.start("sleep", start_new_session=True)
        os.killpg(process.pid, signal.SIGINT)
        self.assertEqual(process.wait(timeout=30), -signal.SIGINT)
        self.assertEqual(os.listdir(self.folder), [])

    def test_an_interrupt_that_was_ignored_stays_so(self):
        process = self.start("commit", preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        process.send_signal(signal.SIGHUP)
        self.assertEqual(process.wait(timeout=30), 0)

    def test_an_interrupt_waits_for_a_commit(self):
        process = self.start("commit")
        process.terminate()
        self.assertEqual(process.wait(timeout=30), -signal.SIGTERM)
        self.assertEqual(os.listdir(self.folder), ["committed"])

    def test_the_run_does_not_outlive_its_watcher(self):
        process = self.start("sleep")
        with open(f"/proc/{process.pid}/task/{process.pid}/children", encoding="ascii") as file:
            child = int(file.read())
        process.kill()
        process.wait(timeout=30)
        end = time.monotonic() + 30
        while self.is_running(child):
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)

    @staticmethod
    def is_running(number):
        try:
            with open(f"/proc/{number}/cmdline", encoding="ascii") as file:
                return file.read() != ""  # a zombie has none
        except FileNotFoundError:
            return False


if __name__ == "__main__":
    unittest.main()
