# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C, progress, and the interpreter's lock while a run goes on."""

import _thread
import threading
import time

import numpy as np
import pytest
from nonoscillatory_subdivision import subdivide


@pytest.fixture(scope="module")
def large():
    return np.random.default_rng(2).normal(size=(200, 200, 200)).astype(np.float32)


def test_progress_grows_to_one(large):
    fractions = []
    subdivide(large[:120], progress=fractions.append, levels=2, axes=(0, 1))
    assert fractions[-1] == 1
    assert len(fractions) > 2
    assert sorted(fractions) == fractions
    assert 0 < fractions[0] < 1


def test_what_progress_raises_ends_the_run(large):
    def stop(fraction):
        raise RuntimeError(f"stopped at {fraction}")

    out = np.zeros((400, 400, 400), np.float32)
    with pytest.raises(RuntimeError, match="stopped at"):
        subdivide(large, progress=stop, threads=2, out=out)
    assert (out[-1] == 0).all(), "the run went on to the last plane"
    subdivide(large[:20], threads=2)


def test_others_run_meanwhile_and_ctrl_c_ends_a_run(large):
    """Another thread of the interpreter sees the run at work, and interrupts it."""
    out = np.zeros((400, 400, 400), np.float32)

    def interrupt_when_begun():
        while not out[:8].any():
            time.sleep(0.001)
        _thread.interrupt_main()

    thread = threading.Thread(target=interrupt_when_begun)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        subdivide(large, threads=1, out=out)
    thread.join()
    assert (out[-1] == 0).all(), "the run went on to the last plane"


def test_calls_at_the_same_time(large):
    part = large[:60]
    expected = subdivide(part)
    results = [None] * 4

    def compute(number):
        results[number] = subdivide(part, threads=2)

    threads = [threading.Thread(target=compute, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for result in results:
        np.testing.assert_array_equal(result, expected)
