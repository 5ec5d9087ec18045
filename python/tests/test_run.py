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


def test_ctrl_c_ends_a_run_soon(large):
    begin = time.monotonic()
    subdivide(large, threads=1)
    whole = time.monotonic() - begin

    threading.Timer(whole / 5, _thread.interrupt_main).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        subdivide(large, threads=1)
    assert time.monotonic() - begin < 0.8 * whole


def test_others_run_meanwhile(large):
    """Another thread of the interpreter counts while this one computes."""
    count = 0
    done = threading.Event()

    def counter():
        nonlocal count
        while not done.wait(0.001):
            count += 1

    thread = threading.Thread(target=counter)
    thread.start()
    try:
        before = count
        subdivide(large, threads=1)
        assert count - before > 10
    finally:
        done.set()
        thread.join()


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


def test_a_small_call_is_cheap():
    """Well below a tenth of a millisecond on an idle machine; the best of many calls, with room for a slow one."""
    volume = np.zeros((4, 4, 4), np.float32)
    best = 1.0
    for _ in range(300):
        begin = time.perf_counter()
        subdivide(volume)
        best = min(best, time.perf_counter() - begin)
    assert best < 100e-6
