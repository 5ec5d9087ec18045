# SPDX-License-Identifier: Apache-2.0
"""Runs over Zarr stores: workers that die, runs that go on, what is refused."""

import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from nonoscillatory_subdivision import subdivide
from zarr_stores import multiscale, write_ome, write_plain

zarr = pytest.importorskip("zarr")
zarr_subdivision = pytest.importorskip("nonoscillatory_subdivision.zarr")


@pytest.fixture(scope="module")
def volume():
    return np.random.default_rng(10).integers(0, 4000, (40, 50, 60), dtype=np.uint16)


def test_a_worker_is_killed(tmp_path, volume, small_blocks):
    """The process that computes is killed in the middle of the run; the other one, and its successor, do the rest."""
    distributed = pytest.importorskip("distributed")
    source, target = str(tmp_path / "in.zarr"), str(tmp_path / "out.zarr")
    write_plain(source, volume, chunks=(20, 20, 20))
    killed = []
    with distributed.Client(n_workers=2, threads_per_worker=1, dashboard_address=":0") as client:

        def kill_one(done, total):
            if done == 20 and not killed:
                assert total == 120
                killed.append(next(iter(client.run(os.getpid).values())))
                os.kill(killed[0], signal.SIGKILL)

        zarr_subdivision.subdivide(source, target, client, report=kill_one)
    assert len(killed) == 1
    np.testing.assert_array_equal(zarr.open_array(target)[...], subdivide(volume))


def command(*arguments):
    return [sys.executable, "-m", "nonoscillatory_subdivision.zarr", *map(str, arguments)]


def test_the_command_is_killed_and_goes_on(tmp_path, volume):
    source, target = tmp_path / "in.zarr", tmp_path / "out.zarr"
    large = np.tile(volume, (4, 3, 3))
    write_plain(str(source), large, chunks=(100, 100, 120))
    arguments = command(source, target, "--workers", 2, "--chunks", "50,50,60")
    process = subprocess.Popen(arguments, stderr=subprocess.DEVNULL, start_new_session=True)
    folder = tmp_path / "out.zarr.unfinished"
    deadline = time.monotonic() + 60
    while not folder.exists() or len(os.listdir(folder)) < 3:
        assert process.poll() is None and time.monotonic() < deadline
        time.sleep(0.005)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    finished = len(os.listdir(folder)) - 1
    assert finished > 0

    other = subprocess.run([*arguments, "--scheme", "linear"], capture_output=True, text=True, timeout=60)
    assert other.returncode == 1 and "another scheme" in other.stderr

    again = subprocess.run(arguments, capture_output=True, text=True, timeout=120)
    assert again.returncode == 0, again.stderr
    np.testing.assert_array_equal(zarr.open_array(str(target))[...], subdivide(large))
    assert not folder.exists()


def test_finished_blocks_are_not_computed_again(tmp_path, client, volume, small_blocks):
    source, target = str(tmp_path / "in.zarr"), str(tmp_path / "out.zarr")
    write_plain(source, volume)

    def stop(done, total):
        if done == 30:
            raise InterruptedError

    with pytest.raises(InterruptedError):
        zarr_subdivision.subdivide(source, target, client, report=stop)
    first_reports = []
    zarr_subdivision.subdivide(source, target, client, report=lambda done, total: first_reports.append(done))
    assert first_reports[0] >= 30
    assert first_reports[-1] == 5 * 7 * 8
    np.testing.assert_array_equal(zarr.open_array(target)[...], subdivide(volume))


@pytest.mark.parametrize(
    "other",
    [
        {"scheme": "linear"},
        {"tension": 3.0},
        {"boundary": "mirror"},
        {"axes": ["0"]},
        {"levels": 2},
        {"chunks": (8, 8, 8)},
        {"labels": True},
    ],
    ids=str,
)
def test_a_run_is_not_taken_up_with_other_options(tmp_path, client, volume, small_blocks, other):
    source, target = str(tmp_path / "in.zarr"), str(tmp_path / "out.zarr")
    write_plain(source, volume[:16])

    def stop(done, total):
        if done == 5:
            raise InterruptedError

    with pytest.raises(InterruptedError):
        zarr_subdivision.subdivide(source, target, client, report=stop)
    with pytest.raises(ValueError, match=f"another .*{next(iter(other))}"):
        zarr_subdivision.subdivide(source, target, client, **other)
    zarr_subdivision.subdivide(source, target, client)
    np.testing.assert_array_equal(zarr.open_array(target)[...], subdivide(volume[:16]))


def test_a_run_is_not_taken_up_when_the_input_has_changed(tmp_path, client, volume, small_blocks):
    source, target = str(tmp_path / "in.zarr"), str(tmp_path / "out.zarr")
    write_plain(source, volume[:16])

    def stop(done, total):
        if done == 5:
            raise InterruptedError

    with pytest.raises(InterruptedError):
        zarr_subdivision.subdivide(source, target, client, report=stop)
    zarr.open_array(source, mode="r+")[...] = volume[16:32]
    with pytest.raises(ValueError, match="another state of input"):
        zarr_subdivision.subdivide(source, target, client)


def test_an_input_that_changes_meanwhile(tmp_path, client, volume, small_blocks):
    pytest.importorskip("ome_zarr")
    source, target = str(tmp_path / "in.zarr"), str(tmp_path / "out.zarr")
    write_ome(source, volume[:16], "0.5")

    def change(done, total):
        if done == 5:
            zarr.open_array(source + "/" + multiscale(source)["datasets"][0]["path"], mode="r+")[0, 0, 0] += 1

    with pytest.raises(ValueError, match="changed while it was read"):
        zarr_subdivision.subdivide(source, target, client, report=change)
    assert "ome" not in zarr.open_group(target).attrs, "described as a complete image"


@pytest.mark.parametrize("target_name", ["out.zarr", None])
def test_a_run_that_ended_among_its_notes(tmp_path, client, volume, small_blocks, monkeypatch, target_name):
    """All is computed and described, but the notes of the run were not removed."""
    source = str(tmp_path / "in.zarr")
    target = target_name and str(tmp_path / target_name)
    write_ome(source, volume, "0.5")
    with monkeypatch.context() as patch:
        patch.setattr("nonoscillatory_subdivision._zarr_blocks.Progress.end", lambda self: None)
        zarr_subdivision.subdivide(source, target, client)
    notes = tmp_path / f"{target_name or 'in.zarr'}.unfinished"
    assert notes.exists()
    if target is None:
        with pytest.raises(ValueError, match="was complete"):
            zarr_subdivision.subdivide(source, target, client)
        assert len(multiscale(source)["datasets"]) == 3
    else:
        zarr_subdivision.subdivide(source, target, client)
    assert not notes.exists()
    finest = zarr.open_group(target or source)[multiscale(target or source)["datasets"][0]["path"]]
    np.testing.assert_array_equal(finest[...], subdivide(volume))


def test_the_command_with_a_scheduler(tmp_path, client, volume):
    source, target = tmp_path / "in.zarr", tmp_path / "out.zarr"
    write_plain(str(source), volume)
    address = client.scheduler_info()["address"]
    options = ["--scheduler", address, "--scheme", "restored", "--tension", "0.5", "--levels", "2"]
    result = subprocess.run(command(source, target, *options), capture_output=True, text=True, timeout=120)
    assert result.returncode == 0, result.stderr
    assert "100%" in result.stderr
    expected = subdivide(volume, scheme="restored", tension=0.5, levels=2)
    np.testing.assert_array_equal(zarr.open_array(str(target))[...], expected)


def write_labels(path):
    write_plain(path, np.zeros((4, 4), np.uint8), chunks=(4, 4))


def write_described(path, kind="scale", version="0.5", name="0", axes="yx", datasets=None):
    """An OME-Zarr image with an array at 0, described in one wrong way."""
    transformations = [{"type": kind, kind: [1, 1]}]
    level = {"path": name, "coordinateTransformations": transformations}
    image = {"axes": [{"name": axis, "type": "space"} for axis in axes]}
    image["datasets"] = [level] if datasets is None else datasets
    described = {"multiscales": [image]} | ({"version": version} if version else {})
    zarr.create_group(path, attributes={"ome": described}).create_array("0", data=np.zeros((4, 4)))


@pytest.mark.parametrize(
    ("prepare", "options", "message"),
    [
        (lambda path: None, {}, "neither"),
        (lambda path: zarr.create_group(path), {}, "multiscales"),
        (lambda path: zarr.create_group(path, attributes={"image-label": {}}), {}, "label image"),
        (lambda path: write_plain(path, np.zeros((4, 4), complex), chunks=(4, 4)), {}, "complex"),
        (lambda path: write_plain(path, np.zeros((4, 4)), chunks=(4, 4)), {"scheme": "cubic"}, "cubic"),
        (lambda path: write_plain(path, np.zeros((4, 4)), chunks=(4, 4)), {"levels": 4}, "4"),
        (lambda path: write_plain(path, np.zeros((4, 4)), chunks=(4, 4)), {"axes": ["y"]}, "'y'"),
        (lambda path: write_plain(path, np.zeros((4, 4)), chunks=(4, 4)), {"chunks": (4,)}, "2 positive"),
        (lambda path: zarr.create_array(path, shape=(), dtype="f4"), {}, "nothing to subdivide"),
        (lambda path: write_labels(path), {"labels": True, "boundary": 300.0}, "300"),
        (lambda path: write_described(path, kind="affine"), {}, "affine"),
        (lambda path: write_described(path, version=None), {}, "version"),
        (lambda path: write_described(path, name="1"), {}, "no array at the path of its finest level, 1"),
        (lambda path: write_described(path, datasets=[]), {}, "no array"),
        (lambda path: write_described(path, axes="zyx"), {}, "3 axes, but 0 has 2"),
    ],
)
def test_errors(tmp_path, client, prepare, options, message):
    source, target = str(tmp_path / "in.zarr"), tmp_path / "out.zarr"
    prepare(source)
    with pytest.raises((ValueError, TypeError), match=message):
        zarr_subdivision.subdivide(source, str(target), client, **options)
    assert not target.exists()
    assert not (tmp_path / "out.zarr.unfinished").exists()


def test_nothing_is_overwritten(tmp_path, client, volume):
    source, target = str(tmp_path / "in.zarr"), tmp_path / "out.zarr"
    write_plain(source, volume)
    target.mkdir()
    (target / "mine").write_text("mine")
    with pytest.raises(ValueError, match="exists"):
        zarr_subdivision.subdivide(source, str(target), client)
    with pytest.raises(ValueError, match="exists"):
        zarr_subdivision.subdivide(source, source, client)
    with pytest.raises(ValueError, match="within the input"):
        zarr_subdivision.subdivide(source, source + "/doubled", client)
    with pytest.raises(ValueError, match="no folder"):
        zarr_subdivision.subdivide(source, "s3://bucket/out", client)
    with pytest.raises(ValueError, match="no pyramid"):
        zarr_subdivision.subdivide(source, None, client)
    assert (target / "mine").read_text() == "mine"
    np.testing.assert_array_equal(zarr.open_array(source)[...], volume)


def test_the_commands_errors_are_one_line(tmp_path):
    missing = subprocess.run(
        command(tmp_path / "none", tmp_path / "out", "--workers", 1), capture_output=True, text=True
    )
    assert missing.returncode == 1
    assert missing.stderr.count("\n") == 1 and "neither" in missing.stderr
    for wrong in (["in"], ["in", "out", "--append-level"], ["in", "out", "--scheme", "cubic"]):
        assert subprocess.run(command(*wrong), capture_output=True).returncode == 2


def test_the_job_is_described_in_json(tmp_path, client, volume, small_blocks):
    source, target = str(tmp_path / "in.zarr"), str(tmp_path / "out.zarr")
    write_plain(source, volume)
    jobs = []

    def look(done, total):
        jobs.append(json.loads((tmp_path / "out.zarr.unfinished" / "job.json").read_text()))

    zarr_subdivision.subdivide(source, target, client, report=look)
    assert jobs[0]["scheme"] == "nonoscillatory" and jobs[0]["block"] == [16, 16, 16]
