# SPDX-License-Identifier: Apache-2.0
"""Dask arrays have the bytes of the whole array, whatever their chunks."""

import numpy as np
import pytest
from nonoscillatory_subdivision import schemes, subdivide, subdivide_labels

dask_array = pytest.importorskip("dask.array")
dask_subdivision = pytest.importorskip("nonoscillatory_subdivision.dask")


@pytest.fixture(scope="module")
def volume():
    return np.random.default_rng(8).normal(size=(29, 18, 23)).astype(np.float32)


def subdivide_in_chunks(volume, chunks, **options):
    lazy = dask_subdivision.subdivide(dask_array.from_array(volume, chunks=chunks), **options)
    result = lazy.compute(scheduler="threads")
    assert (lazy.shape, lazy.dtype) == (result.shape, result.dtype)
    return result


CHUNKS = [(10, 9, 8), ((5, 19, 5), (18,), (6, 12, 5)), ((1, 2, 26), 3, (20, 3)), (29, 18, 23), 7]


@pytest.mark.parametrize("chunks", CHUNKS, ids=str)
@pytest.mark.parametrize("boundary", ["nearest", "mirror", "periodic", 3.5])
def test_bytes_of_the_whole(volume, boundary, chunks):
    result = subdivide_in_chunks(volume, chunks, boundary=boundary)
    np.testing.assert_array_equal(result, subdivide(volume, boundary=boundary))


@pytest.mark.parametrize("boundary", ["mirror", "periodic"])
@pytest.mark.parametrize("scheme", schemes())
def test_bytes_of_every_scheme(volume, scheme, boundary):
    result = subdivide_in_chunks(volume, CHUNKS[1], scheme=scheme, boundary=boundary)
    np.testing.assert_array_equal(result, subdivide(volume, scheme=scheme, boundary=boundary))


@pytest.mark.parametrize("boundary", ["nearest", "mirror", "periodic", 100])
@pytest.mark.parametrize("dtype", ["uint8", "int32", "bool", "float16"])
def test_levels_and_types(volume, dtype, boundary):
    volume = (volume * 30).astype(dtype)
    result = subdivide_in_chunks(volume, 8, levels=2, boundary=boundary)
    expected = subdivide(volume, levels=2, boundary=boundary)
    assert result.dtype == expected.dtype
    np.testing.assert_array_equal(result, expected)


def test_axes_channels_and_dtype(volume):
    options = {"axes": (0, 2), "channel_axis": 1, "dtype": np.int16}
    result = subdivide_in_chunks(volume * 100, (8, 4, 9), **options)
    np.testing.assert_array_equal(result, subdivide(volume * 100, **options))


@pytest.mark.parametrize("boundary", ["periodic", "mirror"])
def test_volumes_thinner_than_the_halo(boundary):
    volume = np.random.default_rng(9).normal(size=(2, 40, 3))
    result = subdivide_in_chunks(volume, (1, 10, 2), boundary=boundary)
    np.testing.assert_array_equal(result, subdivide(volume, boundary=boundary))


def test_it_is_lazy_and_chunks_are_doubled():
    def fail(block):
        raise AssertionError("computed")

    array = dask_array.ones((20, 20, 30), chunks=(10, 20, 15)).map_blocks(fail, dtype=float)
    result = dask_subdivision.subdivide(array, axes=(0, 2))
    assert result.chunks == ((20, 20), (20,), (30, 30))
    assert result.dtype == np.float64


def test_errors_come_before_anything_is_computed():
    array = dask_array.ones((8, 8), chunks=4)
    for options, message in [({"scheme": "cubic"}, "cubic"), ({"tension": 0}, "0"), ({"levels": 5}, "5")]:
        with pytest.raises(ValueError, match=message):
            dask_subdivision.subdivide(array, **options)
    with pytest.raises(TypeError, match="complex"):
        dask_subdivision.subdivide(array.astype(complex))
    with pytest.raises(ValueError, match="unknown size"):
        dask_subdivision.subdivide(array[array[:, 0] > 0])
    with pytest.raises(ValueError, match=r"\(0, 8\)"):
        dask_subdivision.subdivide(array[:0])
    with pytest.raises(TypeError, match="masked"):
        dask_subdivision.subdivide(dask_array.ma.masked_greater(array, 0))


@pytest.mark.parametrize("dtype", ["?", ">u2", "i8"])
def test_label_maps_of_several_levels(volume, dtype):
    labels = (volume > 0).astype(dtype)
    lazy = dask_subdivision.subdivide_labels(dask_array.from_array(labels, chunks=9), levels=2)
    result = lazy.compute(scheduler="threads")
    expected = subdivide_labels(labels, levels=2)
    assert lazy.dtype == result.dtype == expected.dtype
    np.testing.assert_array_equal(result, expected)


@pytest.mark.parametrize("volume", [np.zeros((3, 3)), [1.0, 2.0], None], ids=["numpy", "list", "None"])
def test_what_is_no_dask_array(volume):
    for function in (dask_subdivision.subdivide, dask_subdivision.subdivide_labels):
        with pytest.raises(TypeError, match=f"array is a {type(volume).__name__}, not a dask.array.Array"):
            function(volume)


def test_chunks_that_turn_out_to_be_masked():
    """The array does not know it, as its chunks are made by a function."""

    def mask(chunk):
        return np.ma.masked_greater(chunk, 0) if chunk.size else chunk

    array = dask_array.ones((8, 8), chunks=8).map_blocks(mask, meta=np.empty((0, 0)))
    lazy = dask_subdivision.subdivide(array)
    with pytest.raises(TypeError, match="masked"):
        lazy.compute(scheduler="synchronous")


def test_two_worker_processes(client):
    volume = np.random.default_rng(8).normal(size=(40, 50, 60))
    lazy = dask_subdivision.subdivide(dask_array.from_array(volume, chunks=20))
    np.testing.assert_array_equal(client.compute(lazy).result(), subdivide(volume))
