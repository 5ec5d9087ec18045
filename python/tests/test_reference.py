# SPDX-License-Identifier: Apache-2.0
"""Random arrays of every type, dimension, order and scheme against the reference."""

import numpy as np
import pytest
import reference
from nonoscillatory_subdivision import schemes, subdivide

INTEGERS = ["int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64"]
REALS = ["float16", "float32", "float64", "longdouble"]


def random_array(dtype, shape, seed=7):
    """Noise, and a block of the greatest value, so that integers saturate."""
    generator = np.random.default_rng(seed)
    dtype = np.dtype(dtype)
    if dtype.kind == "b":
        return generator.random(shape) < 0.5
    if dtype.kind == "f":
        return generator.normal(size=shape).astype(dtype)
    limits = np.iinfo(dtype)
    # Differences of 64-bit integers near their limits would be lost in double precision, in the reference, too.
    low, high = max(limits.min, -(2**52)), min(limits.max, 2**52)
    array = generator.integers(low, high, shape, dtype, endpoint=True)
    array[tuple(slice(size // 3, size // 2) for size in shape)] = high
    return array


def assert_close(result, expected, computed_in):
    """Within the rounding of the arithmetic, and of the result's type."""
    scale = np.abs(expected).max()
    tolerance = 40 * np.finfo(computed_in).eps * scale
    if result.dtype.kind in "iu":
        limits = np.iinfo(result.dtype)
        expected = np.clip(expected, limits.min, limits.max)
        tolerance += 0.5
    elif result.dtype == np.float16:
        tolerance += np.finfo(np.float16).eps * scale / 2
    error = np.abs(result.astype(np.float64) - expected).max()
    assert error <= tolerance, f"off by {error}, {tolerance} is allowed"


def real_type(dtype):
    dtype = np.dtype(dtype)
    small = dtype.itemsize <= (4 if dtype.kind == "f" else 2)
    return np.float32 if small else np.float64


@pytest.mark.parametrize("scheme", schemes())
@pytest.mark.parametrize("dtype", ["bool", *INTEGERS, *REALS])
def test_every_type(scheme, dtype):
    volume = random_array(dtype, (9, 7, 12))
    result = subdivide(volume, scheme=scheme)
    assert result.dtype == (np.float32 if dtype == "bool" else np.dtype(dtype))
    assert_close(result, reference.subdivided(volume, scheme), real_type(dtype))


@pytest.mark.parametrize("boundary", ["nearest", "mirror", "periodic", -1.5])
@pytest.mark.parametrize("scheme", schemes())
@pytest.mark.parametrize("shape", [(31,), (1,), (2, 3), (17, 12), (1, 6, 2), (12, 11, 13)])
def test_every_boundary(scheme, shape, boundary):
    volume = random_array("float64", shape)
    result = subdivide(volume, scheme=scheme, boundary=boundary, tension=3.25)
    assert_close(result, reference.subdivided(volume, scheme, 3.25, boundary), np.float64)


@pytest.mark.parametrize("axes", [(), (0,), (1,), (2,), (0, 1), (0, 2), (1, 2), (2, 0), (0, 1, 2)])
@pytest.mark.parametrize("scheme", schemes())
def test_every_choice_of_axes(scheme, axes):
    volume = random_array("float64", (7, 12, 9))
    result = subdivide(volume, scheme=scheme, axes=axes)
    assert_close(result, reference.subdivided(volume, scheme, axes=axes), np.float64)


def test_the_last_three_of_four_axes_are_subdivided():
    volume = random_array("float32", (3, 6, 7, 8))
    result = subdivide(volume)
    assert result.shape == (3, 12, 14, 16)
    for position in range(3):
        np.testing.assert_array_equal(result[position], subdivide(volume[position]))


def test_one_axis_given_as_a_number_and_from_the_end():
    volume = random_array("float32", (6, 7, 8))
    np.testing.assert_array_equal(subdivide(volume, axes=1), subdivide(volume, axes=[-2]))


@pytest.mark.parametrize("channel_axis", [0, 1, 2, 3, -1])
def test_channels_are_volumes_of_their_own(channel_axis):
    channels = random_array("float64", (3, 6, 7, 8))
    volume = np.moveaxis(channels, 0, channel_axis)
    result = np.moveaxis(subdivide(volume, channel_axis=channel_axis), channel_axis, 0)
    for channel, values in zip(channels, result, strict=True):
        assert_close(values, reference.subdivided(channel), np.float64)


def test_four_dimensions_and_channels():
    volume = random_array("float32", (2, 4, 5, 6, 3))
    result = subdivide(volume, channel_axis=4)
    assert result.shape == (2, 8, 10, 12, 3)
    assert_close(result[1, ..., 2], reference.subdivided(volume[1, ..., 2]), np.float32)


@pytest.mark.parametrize("levels", [2, 3])
@pytest.mark.parametrize("boundary", ["nearest", "mirror", "periodic", 100.0])
@pytest.mark.parametrize("scheme", schemes())
def test_levels_round_once(scheme, boundary, levels):
    volume = random_array("uint16", (6, 5, 7))
    result = subdivide(volume, scheme=scheme, boundary=boundary, levels=levels)
    assert_close(result, reference.subdivided(volume, scheme, boundary=boundary, levels=levels), np.float32)


@pytest.mark.parametrize("tension", [0.0, 0.5, 1.0, 8.0])
def test_tension_of_the_restored_scheme(tension):
    volume = random_array("float64", (9, 8, 10))
    result = subdivide(volume, scheme="restored", tension=tension)
    assert_close(result, reference.subdivided(volume, "restored", tension), np.float64)
