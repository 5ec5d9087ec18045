# SPDX-License-Identifier: Apache-2.0
"""Images in Zarr stores: the bytes of the whole array, the grid, other readers, workers that die, runs that go on."""

import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from nonoscillatory_subdivision import subdivide, subdivide_labels

zarr = pytest.importorskip("zarr")
zarr_subdivision = pytest.importorskip("nonoscillatory_subdivision.zarr")

SCALE, TRANSLATION = [2.0, 0.5, 0.25], [10.0, 20.0, -30.0]
NEW_SCALE, NEW_TRANSLATION = [1.0, 0.25, 0.125], [9.5, 19.875, -30.0625]


@pytest.fixture(scope="module")
def volume():
    return np.random.default_rng(10).integers(0, 4000, (40, 50, 60), dtype=np.uint16)


@pytest.fixture
def small_blocks(monkeypatch):
    """One chunk is a block, so that there are many blocks."""
    monkeypatch.setattr("nonoscillatory_subdivision._zarr_blocks.BLOCK_VOXELS", 1)


def write_plain(path, volume, zarr_format=3, chunks=(16, 16, 16), **options):
    array = zarr.create_array(
        path, shape=volume.shape, dtype=volume.dtype, chunks=chunks, zarr_format=zarr_format, **options
    )
    array[...] = volume


def write_ome(path, volume, version):
    """A pyramid of two levels as OME-Zarr's own library writes it."""
    from ome_zarr.format import FormatV04, FormatV05
    from ome_zarr.writer import write_multiscale

    group = zarr.open_group(path, mode="w", zarr_format=2 if version == "0.4" else 3)
    coarse = [scale * 2 for scale in SCALE]
    write_multiscale(
        [volume, volume[::2, ::2, ::2]],
        group,
        fmt=FormatV04() if version == "0.4" else FormatV05(),
        axes=[{"name": name, "type": "space", "unit": "millimeter"} for name in "zyx"],
        coordinate_transformations=[
            [{"type": "scale", "scale": SCALE}, {"type": "translation", "translation": TRANSLATION}],
            [{"type": "scale", "scale": coarse}, {"type": "translation", "translation": TRANSLATION}],
        ],
        storage_options={"chunks": (16, 20, 32)},
    )


def multiscale(path):
    attributes = zarr.open_group(path, mode="r").attrs.asdict()
    return attributes.get("ome", attributes)["multiscales"][0]


def read_by_tensorstore(path, zarr_format):
    tensorstore = pytest.importorskip("tensorstore")
    driver = "zarr" if zarr_format == 2 else "zarr3"
    store = {"driver": driver, "kvstore": {"driver": "file", "path": str(path)}}
    return tensorstore.open(store, open=True, read=True).result().read().result()


@pytest.mark.parametrize("zarr_format", [2, 3])
@pytest.mark.parametrize("boundary", ["nearest", "mirror", "periodic", 7.0])
def test_plain_arrays(tmp_path, client, volume, small_blocks, zarr_format, boundary):
    source, target = str(tmp_path / "in.zarr"), str(tmp_path / "out.zarr")
    write_plain(source, volume, zarr_format)
    zarr_subdivision.subdivide(source, target, client, boundary=boundary)
    result = zarr.open_array(target, mode="r")
    assert (result.chunks, result.dtype, result.metadata.zarr_format) == ((16, 16, 16), np.uint16, zarr_format)
    np.testing.assert_array_equal(result[...], subdivide(volume, boundary=boundary))
    np.testing.assert_array_equal(read_by_tensorstore(target, zarr_format), result[...])
    assert sorted(os.listdir(tmp_path)) == ["in.zarr", "out.zarr"]


@pytest.mark.parametrize("boundary", ["mirror", "periodic"])
def test_levels_axes_chunks_and_scheme(tmp_path, client, volume, small_blocks, boundary):
    source, target = str(tmp_path / "in.zarr"), str(tmp_path / "out.zarr")
    write_plain(source, volume[:6, :, :3])
    options = {"scheme": "linear", "levels": 2, "boundary": boundary}
    zarr_subdivision.subdivide(source, target, client, axes=["1", "2"], chunks=(3, 50, 7), **options)
    result = zarr.open_array(target, mode="r")
    assert result.chunks == (3, 50, 7)
    np.testing.assert_array_equal(result[...], subdivide(volume[:6, :, :3], axes=(1, 2), **options))


def test_shards_and_codecs_are_kept(tmp_path, client, volume, small_blocks):
    source, target = str(tmp_path / "in.zarr"), str(tmp_path / "out.zarr")
    codec = zarr.codecs.BloscCodec(cname="lz4")
    write_plain(
        source, volume, chunks=(8, 8, 8), shards=(32, 32, 32), compressors=codec, dimension_names=["a", "b", "c"]
    )
    zarr_subdivision.subdivide(source, target, client)
    result = zarr.open_array(target, mode="r")
    assert (result.chunks, result.shards) == ((8, 8, 8), (32, 32, 32))
    assert result.compressors[0].cname.value == "lz4"
    assert result.metadata.dimension_names == ("a", "b", "c")
    np.testing.assert_array_equal(result[...], subdivide(volume))


ODD_STORES = [
    {"zarr_format": 3, "chunks": (5, 7, 6), "shards": (30, 28, 36)},
    {"zarr_format": 3, "chunks": (5, 25, 32), "shards": (50, 75, 96)},
    {"zarr_format": 3, "chunks": (64, 64, 64)},
    {"zarr_format": 3, "chunks": (9, 50, 60), "serializer": zarr.codecs.BytesCodec(endian="big"), "fill_value": 9},
    {"zarr_format": 2, "chunks": (64, 9, 31), "order": "F", "compressors": None},
    {"zarr_format": 2, "chunks": (13, 33, 33), "fill_value": None},
]


@pytest.mark.parametrize("store", ODD_STORES, ids=str)
@pytest.mark.parametrize("chunks", [None, (17, 100, 31), (200, 200, 200)])
def test_odd_chunks_and_shards(tmp_path, client, volume, store, chunks):
    source, target = str(tmp_path / "in.zarr"), str(tmp_path / "out.zarr")
    write_plain(source, volume, **store)
    zarr_subdivision.subdivide(source, target, client, chunks=chunks, boundary="periodic")
    result = zarr.open_array(target, mode="r")
    assert result.chunks == (chunks or store["chunks"])
    np.testing.assert_array_equal(result[...], subdivide(volume, boundary="periodic"))
    np.testing.assert_array_equal(read_by_tensorstore(target, store["zarr_format"]), result[...])


def test_a_big_endian_array_of_version_2(tmp_path, client, volume):
    source, target = str(tmp_path / "in.zarr"), str(tmp_path / "out.zarr")
    write_plain(source, volume.astype(">u2"), 2)
    zarr_subdivision.subdivide(source, target, client)
    np.testing.assert_array_equal(zarr.open_array(target)[...], subdivide(volume))


def test_masks_become_real(tmp_path, client, volume):
    source, target = str(tmp_path / "in.zarr"), str(tmp_path / "out.zarr")
    write_plain(source, volume > 2000, 2)
    zarr_subdivision.subdivide(source, target, client)
    np.testing.assert_array_equal(zarr.open_array(target)[...], subdivide(volume > 2000))


@pytest.mark.parametrize("version", ["0.4", "0.5"])
def test_ome_zarr(tmp_path, client, volume, small_blocks, version):
    pytest.importorskip("ome_zarr")
    from ome_zarr.io import parse_url
    from ome_zarr.reader import Reader

    source, target = str(tmp_path / "in.zarr"), str(tmp_path / "out.zarr")
    write_ome(source, volume, version)
    zarr_subdivision.subdivide(source, target, client)
    expected = subdivide(volume)
    image = multiscale(target)
    assert image["axes"] == multiscale(source)["axes"]
    (dataset,) = image["datasets"]
    assert dataset["coordinateTransformations"] == [
        {"type": "scale", "scale": NEW_SCALE},
        {"type": "translation", "translation": NEW_TRANSLATION},
    ]
    (node,) = Reader(parse_url(target))()
    np.testing.assert_array_equal(np.asarray(node.data[0]), expected)
    zarr_format = 2 if version == "0.4" else 3
    np.testing.assert_array_equal(read_by_tensorstore(tmp_path / "out.zarr" / "0", zarr_format), expected)


@pytest.mark.parametrize("version", ["0.4", "0.5"])
def test_a_level_before_the_finest_one(tmp_path, client, volume, version):
    pytest.importorskip("ome_zarr")
    from ome_zarr.io import parse_url
    from ome_zarr.reader import Reader

    path = str(tmp_path / "image.zarr")
    write_ome(path, volume, version)
    before = multiscale(path)["datasets"]
    zarr_subdivision.subdivide(path, None, client)
    added, *rest = multiscale(path)["datasets"]
    assert rest == before
    assert added["coordinateTransformations"][0]["scale"] == NEW_SCALE
    (node,) = Reader(parse_url(path))()
    assert [level.shape for level in node.data] == [(80, 100, 120), (40, 50, 60), (20, 25, 30)]
    np.testing.assert_array_equal(np.asarray(node.data[0]), subdivide(volume))
    np.testing.assert_array_equal(np.asarray(node.data[1]), volume)


def test_time_and_channels_are_not_subdivided(tmp_path, client, volume):
    source, target = str(tmp_path / "in.zarr"), str(tmp_path / "out.zarr")
    series = volume[:24].reshape(2, 3, 4, 50, 60)
    group = zarr.open_group(source, mode="w", zarr_format=2)
    array = group.create_array("0", shape=series.shape, dtype=series.dtype, chunks=(1, 1, 4, 25, 60))
    array[...] = series
    kinds = {"t": "time", "c": "channel", "z": "space", "y": "space", "x": "space"}
    transformation = {"type": "scale", "scale": [5.0, 1.0, 2.0, 0.5, 0.5]}
    image = {
        "version": "0.4",
        "axes": [{"name": name, "type": kind} for name, kind in kinds.items()],
        "datasets": [{"path": "0", "coordinateTransformations": [transformation]}],
    }
    group.attrs.update({"multiscales": [image], "omero": {"channels": [{"label": "a"}], "rdefs": {"defaultZ": 2}}})
    zarr_subdivision.subdivide(source, target, client)
    scale, translation = multiscale(target)["datasets"][0]["coordinateTransformations"]
    assert scale["scale"] == [5.0, 1.0, 1.0, 0.25, 0.25]
    assert translation["translation"] == [0, 0, -0.5, -0.125, -0.125]
    result = zarr.open_array(target + "/0")[...]
    for time_point in range(2):
        for channel in range(3):
            np.testing.assert_array_equal(result[time_point, channel], subdivide(series[time_point, channel]))
    assert zarr.open_group(target).attrs["omero"] == {"channels": [{"label": "a"}]}


@pytest.mark.parametrize("version", ["0.4", "0.5"])
def test_labels(tmp_path, client, volume, small_blocks, version):
    source, target = str(tmp_path / "in.zarr"), str(tmp_path / "out.zarr")
    labels = (volume // 1000 * (volume > 2000)).astype(np.uint8)
    write_ome(source, labels, version)
    group = zarr.open_group(source)
    description = {"colors": [{"label-value": 2, "rgba": [255, 0, 0, 255]}], "source": {"image": "../../"}}
    described = {"image-label": description}
    group.attrs.update(described if version == "0.4" else {"ome": group.attrs["ome"] | described})
    with pytest.raises(ValueError, match="labels would be blended"):
        zarr_subdivision.subdivide(source, target, client)
    zarr_subdivision.subdivide(source, target, client, labels=True)
    np.testing.assert_array_equal(zarr.open_array(target + "/0")[...], subdivide_labels(labels))
    attributes = zarr.open_group(target).attrs.asdict()
    assert attributes.get("ome", attributes)["image-label"] == {"colors": description["colors"]}


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
    assert other.returncode == 1 and "other options" in other.stderr

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
    with pytest.raises(ValueError, match="other options"):
        zarr_subdivision.subdivide(source, target, client, **other)
    zarr_subdivision.subdivide(source, target, client)
    np.testing.assert_array_equal(zarr.open_array(target)[...], subdivide(volume[:16]))


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
    ],
)
def test_errors(tmp_path, client, prepare, options, message):
    source, target = str(tmp_path / "in.zarr"), tmp_path / "out.zarr"
    prepare(source)
    with pytest.raises((ValueError, TypeError), match=message):
        zarr_subdivision.subdivide(source, str(target), client, **options)
    assert not target.exists()


def test_nothing_is_overwritten(tmp_path, client, volume):
    source, target = str(tmp_path / "in.zarr"), tmp_path / "out.zarr"
    write_plain(source, volume)
    target.mkdir()
    (target / "mine").write_text("mine")
    with pytest.raises(ValueError, match="exists"):
        zarr_subdivision.subdivide(source, str(target), client)
    with pytest.raises(ValueError, match="exists"):
        zarr_subdivision.subdivide(source, source, client)
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
