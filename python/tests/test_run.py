# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C, progress, and the interpreter's lock while a run goes on."""

import signal
import threading

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
    assert not out[-1, -1, -1], "the run went on to the last voxel"
    subdivide(large[:20], threads=2)


def test_all_threads_end_within_their_tiles():
    """Tiles reach along the whole first axis."""

    def stop(fraction):
        raise RuntimeError(f"stopped at {fraction}")

    out = np.zeros((80_000, 60, 60), np.uint8)
    with pytest.raises(RuntimeError, match="stopped at"):
        subdivide(np.ones((40_000, 30, 30), np.uint8), progress=stop, threads=2, out=out)
    assert out[0].any()
    assert not out[-1].any(), "a tile was computed to its end"


def test_a_signal_ends_a_run(large):
    """As Ctrl-C does. It comes after some of the process's own time, so that a busy machine does not matter."""

    def interrupt(number, frame):
        raise KeyboardInterrupt

    out = np.zeros((400, 400, 400), np.float32)
    before = signal.signal(signal.SIGVTALRM, interrupt)
    try:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.05)
        with pytest.raises(KeyboardInterrupt):
            subdivide(large, threads=1, out=out)
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)
    assert not out[-1, -1, -1], "the run went on to the last voxel"


def test_others_run_meanwhile(large):
    """Another thread of the interpreter sees a run half done."""
    out = np.zeros((400, 400, 400), np.float32)
    is_seen, is_over = threading.Event(), threading.Event()

    def watch():
        while not is_over.is_set() and not is_seen.is_set():
            if out[0, 0, 0] and not out[-1, -1, -1]:
                is_seen.set()

    thread = threading.Thread(target=watch)
    thread.start()
    for _ in range(50):
        out[0, 0, 0] = out[-1, -1, -1] = 0
        subdivide(large, out=out)
        if is_seen.is_set():
            break
    is_over.set()
    thread.join()
    assert is_seen.is_set()


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
