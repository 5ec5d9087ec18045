# SPDX-License-Identifier: Apache-2.0
"""Images in Zarr stores: the bytes of the whole array, the grid, other readers."""

import os

import numpy as np
import pytest
from nonoscillatory_subdivision import subdivide, subdivide_labels
from zarr_stores import NEW_SCALE, NEW_TRANSLATION, multiscale, read_by_tensorstore, write_ome, write_plain

zarr = pytest.importorskip("zarr")
zarr_subdivision = pytest.importorskip("nonoscillatory_subdivision.zarr")


@pytest.fixture(scope="module")
def volume():
    return np.random.default_rng(10).integers(0, 4000, (40, 50, 60), dtype=np.uint16)


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


@pytest.mark.parametrize("version", ["0.4", "0.5"])
@pytest.mark.filterwarnings("ignore:Consolidated metadata")
def test_a_level_in_consolidated_metadata(tmp_path, client, volume, version):
    pytest.importorskip("ome_zarr")
    source = str(tmp_path / "in.zarr")
    write_ome(source, volume, version)
    zarr.consolidate_metadata(source)
    zarr_subdivision.subdivide(source, None, client)
    group = zarr.open_group(source, mode="r")
    assert group.metadata.consolidated_metadata is not None
    finest = multiscale(source)["datasets"][0]["path"]
    np.testing.assert_array_equal(group[finest][...], subdivide(volume))


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
