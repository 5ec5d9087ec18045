# SPDX-License-Identifier: Apache-2.0
"""Memory, types and parts: the same bytes however the volume lies and whatever part is asked for."""

import nonoscillatory_subdivision
import numpy as np
import pytest
from nonoscillatory_subdivision import schemes, subdivide, subdivide_labels


@pytest.fixture(scope="module")
def volume():
    return np.random.default_rng(3).integers(0, 30000, (13, 11, 14), dtype=np.uint16)


def test_version():
    assert nonoscillatory_subdivision.__version__.count(".") == 2
    assert nonoscillatory_subdivision.targets()[-1] == "portable"
    assert schemes() == ["nonoscillatory", "linear", "bounded", "bspline", "restored"]


def read_only(volume):
    copy = volume.copy()
    copy.flags.writeable = False
    return copy


def unaligned(volume):
    memory = np.zeros(volume.nbytes + 1, np.uint8)[1:]
    array = memory.view(volume.dtype).reshape(volume.shape)
    array[...] = volume
    assert array.itemsize == 1 or not array.flags.aligned
    return array


def between_other_fields(volume):
    record = np.zeros(volume.shape, np.dtype([("other", "u1"), ("value", volume.dtype)]))
    record["value"] = volume
    return record["value"]


LAYOUTS = {
    "Fortran": np.asfortranarray,
    "reversed": lambda volume: volume[::-1, ::-1, ::-1].copy()[::-1, ::-1, ::-1],
    "transposed": lambda volume: volume.transpose(2, 0, 1).copy().transpose(1, 2, 0),
    "every other": lambda volume: np.repeat(np.repeat(volume, 2, 0), 3, 2)[::2, :, ::3],
    "other byte order": lambda volume: volume.astype(volume.dtype.newbyteorder()),
    "read-only": read_only,
    "unaligned": unaligned,
    "between other fields": between_other_fields,
    "list": lambda volume: volume,
}


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("dtype", ["uint8", "int16", "int64", "float16", "float32", "float64"])
def test_same_bytes_from_any_memory(volume, layout, dtype):
    original = volume.astype(dtype)
    laid_out = LAYOUTS[layout](original)
    np.testing.assert_array_equal(laid_out, original)
    before = laid_out.tobytes()
    result = subdivide(laid_out)
    assert result.tobytes() == subdivide(original).tobytes()
    assert result.dtype == np.dtype(dtype) and result.dtype.isnative
    assert laid_out.tobytes() == before


@pytest.mark.parametrize("scheme", schemes())
def test_strides_of_an_axis_of_one_voxel_mean_nothing(scheme):
    plane = np.random.default_rng(3).normal(size=(11, 30)).astype(np.float32)
    moved = np.moveaxis(plane[np.newaxis], 0, -1)
    original = plane.reshape(11, 30, 1)
    assert moved.strides != original.strides
    assert subdivide(moved, scheme=scheme).tobytes() == subdivide(original, scheme=scheme).tobytes()


def test_a_broadcast_axis(volume):
    repeated = np.broadcast_to(volume[0], volume.shape)
    np.testing.assert_array_equal(subdivide(repeated), subdivide(repeated.copy()))


def test_a_file_as_memory(volume, tmp_path):
    """Both ends are files that are mapped into memory; the volume's is read-only."""
    np.save(tmp_path / "in.npy", volume)
    mapped = np.load(tmp_path / "in.npy", mmap_mode="r")
    out = np.lib.format.open_memmap(tmp_path / "out.npy", "w+", np.uint16, (26, 22, 28))
    assert subdivide(mapped, out=out) is out
    out.flush()
    np.testing.assert_array_equal(np.load(tmp_path / "out.npy"), subdivide(volume))


def test_a_subclass_is_an_array(volume):
    class Labelled(np.ndarray):
        pass

    result = subdivide(volume.view(Labelled))
    assert type(result) is np.ndarray
    np.testing.assert_array_equal(result, subdivide(volume))


def test_axes_are_any_sequence(volume):
    expected = subdivide(volume, axes=(0, 2))
    for axes in ([0, 2], range(0, 3, 2), np.array([-1, 0]), (np.int8(2), 0)):
        np.testing.assert_array_equal(subdivide(volume, axes=axes), expected)
    np.testing.assert_array_equal(subdivide(volume, axes=np.array(1)), subdivide(volume, axes=1))


def test_a_channel_axis_counts_from_either_end(volume):
    expected = np.stack([subdivide(part) for part in volume], axis=1)
    channels = np.moveaxis(volume, 0, 1)
    for axis in (1, -2):
        np.testing.assert_array_equal(subdivide(channels, channel_axis=axis), expected)


def test_lists():
    assert subdivide([[1.0, 1.0], [1.0, 1.0]]).tolist() == [[1.0] * 4] * 4


REGIONS = [
    np.s_[:, :, :],
    np.s_[3:4, 7:19, 1:28],
    np.s_[25:, :1],
    np.s_[-5:-2, 5:],
    (slice(0, 2),),
    np.s_[9:17, 2:3, 27:99],
]


@pytest.mark.parametrize("region", REGIONS, ids=str)
@pytest.mark.parametrize("boundary", ["nearest", "mirror", "periodic", 7])
@pytest.mark.parametrize("levels", [1, 2, 3])
def test_a_region_has_the_bytes_of_the_whole(volume, region, boundary, levels):
    whole = subdivide(volume, boundary=boundary, levels=levels)
    part = subdivide(volume, boundary=boundary, levels=levels, region=region)
    np.testing.assert_array_equal(part, whole[region])


def test_regions_of_other_schemes_and_axes(volume):
    for scheme in schemes():
        whole = subdivide(volume, scheme=scheme, axes=(0, 2))
        np.testing.assert_array_equal(subdivide(volume, scheme=scheme, axes=(0, 2), region=np.s_[5:9]), whole[5:9])
    line = np.arange(20.0)
    np.testing.assert_array_equal(subdivide(line, region=slice(3, 9)), subdivide(line)[3:9])


@pytest.mark.parametrize("threads", [1, 2, 5, np.int64(3), 10**12])
def test_threads_do_not_matter(threads):
    volume = np.random.default_rng(1).normal(size=(60, 70, 80)).astype(np.float32)
    np.testing.assert_array_equal(subdivide(volume, threads=threads), subdivide(volume))


@pytest.mark.parametrize("dtype", ["uint8", "int32", "float16", ">f8", "float32", "longdouble"])
def test_out_has_the_bytes_of_dtype(volume, dtype):
    expected = subdivide(volume, dtype=dtype)
    assert expected.dtype == np.dtype(dtype)
    out = np.zeros((28, 22, 26), dtype).transpose(2, 1, 0)
    assert subdivide(volume, out=out) is out
    np.testing.assert_array_equal(out, expected)
    part = np.zeros((4, 22, 28), dtype)
    subdivide(volume, out=part, region=np.s_[8:12])
    np.testing.assert_array_equal(part, expected[8:12])


def test_integers_round_and_saturate():
    step = np.repeat([0.0, 100.0], 5)
    real = subdivide(step, scheme="linear")
    assert real.min() < -10 and real.max() > 110
    np.testing.assert_array_equal(subdivide(step, scheme="linear", dtype=np.int8), np.rint(real).clip(-128, 127))
    np.testing.assert_array_equal(subdivide(step * 2.5, scheme="linear", dtype=np.uint8).max(), 255)
    assert subdivide(np.full(4, np.nan), dtype=np.int16).tolist() == [0] * 8


@pytest.mark.parametrize("view", [np.s_[:20], np.s_[20:], np.s_[10:30], np.s_[19::-1], np.s_[::2]], ids=str)
@pytest.mark.parametrize("levels", [1, 2])
def test_out_overlaps_the_volume(view, levels):
    memory = np.arange(20.0 * 2**levels) ** 1.5
    part = memory[view][:20]
    expected = subdivide(part.copy(), levels=levels)
    assert subdivide(part, out=memory, levels=levels) is memory
    np.testing.assert_array_equal(memory, expected)


def test_out_over_the_volume():
    memory = np.arange(40.0)
    expected = subdivide(memory[:20].copy())
    subdivide(memory[:20], out=memory)
    np.testing.assert_array_equal(memory, expected)


def test_bool_is_computed_in_single_precision():
    mask = np.random.default_rng(5).random((8, 9)) < 0.5
    np.testing.assert_array_equal(subdivide(mask), subdivide(mask.astype(np.float32)))


def test_any_byte_of_bool_but_0_is_true():
    mask = np.zeros((12, 9), np.uint8)
    mask[4:8] = np.arange(1, 37).reshape(4, 9) * 7
    clean = mask != 0
    assert subdivide(mask.view(bool)).tobytes() == subdivide(clean).tobytes()
    result = subdivide_labels(mask.view(bool))
    assert result.tobytes() == subdivide_labels(clean).tobytes()


def test_half_precision_is_rounded_once():
    volume = np.random.default_rng(5).normal(size=(8, 9)).astype(np.float16)
    np.testing.assert_array_equal(subdivide(volume), subdivide(volume.astype(np.float32)).astype(np.float16))


def test_integers_of_64_bits_are_exact_along_axes_that_are_not_subdivided():
    volume = np.array([[2**53 + 1, -(2**63)]])
    assert subdivide(volume, axes=()).tolist() == volume.tolist()
