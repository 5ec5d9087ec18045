# SPDX-License-Identifier: Apache-2.0
"""Label maps against an election of the reference's votes, and the rest as for volumes."""

import numpy as np
import pytest
import reference
from nonoscillatory_subdivision import subdivide_labels

TYPES = ["uint8", "int8", "uint16", "int16", "uint32", "int32", "uint64", "int64"]


def elected(labels, scheme="restored", tension=0.0, boundary="nearest", axes=None):
    """The label with the largest vote, and whether it won clearly."""
    axes = tuple(range(labels.ndim)) if axes is None else axes
    is_constant = boundary not in reference.PAD_MODES
    names = np.unique(np.append(labels, [boundary] if is_constant else []).astype(labels.dtype))
    votes = []
    for name in names:
        outside = float(boundary == name) if is_constant else boundary
        votes.append(reference.subdivided(labels == name, scheme, tension, outside, axes))
    ranked = np.sort(votes, axis=0)
    is_clear = ranked[-1] - ranked[-2] > 1e-5 if len(names) > 1 else np.full(ranked[0].shape, True)
    return names[np.argmax(votes, axis=0)], is_clear


@pytest.fixture(scope="module")
def labels():
    """Bodies of a few voxels, in contact, and single voxels."""
    generator = np.random.default_rng(11)
    points = generator.uniform(0, 18, (9, 3))
    grid = np.stack(np.meshgrid(*map(np.arange, (15, 17, 16)), indexing="ij"), axis=-1)
    distance = np.linalg.norm(grid[..., None, :] - points, axis=-1)
    result = distance.argmin(-1) * 11
    result[distance.min(-1) > 6] = 0
    result[generator.random(result.shape) < 0.01] = 100
    return result.astype(np.uint8)


@pytest.mark.parametrize("scheme", ["restored", "bspline", "linear"])
@pytest.mark.parametrize("boundary", ["nearest", "mirror", "periodic", 22, 77])
def test_the_largest_vote_wins(labels, scheme, boundary):
    result = subdivide_labels(labels, scheme=scheme, boundary=boundary)
    expected, is_clear = elected(labels, scheme, boundary=boundary)
    assert is_clear.mean() > 0.9
    np.testing.assert_array_equal(result[is_clear], expected[is_clear])


@pytest.mark.parametrize("axes", [(0,), (1, 2), (0, 2)])
def test_axes(labels, axes):
    expected, is_clear = elected(labels, axes=axes)
    result = subdivide_labels(labels, axes=axes)
    np.testing.assert_array_equal(result[is_clear], expected[is_clear])


def test_ties_go_to_the_parent_then_to_the_lowest():
    assert subdivide_labels(np.array([3, 3, 3, 3, 3, 9, 9, 9, 9, 9])).tolist() == [3] * 10 + [9] * 10


@pytest.mark.parametrize("dtype", TYPES)
def test_types_and_large_labels(labels, dtype):
    limits = np.iinfo(dtype)
    names = np.array(
        [int(limits.min) + number * (int(limits.max) - int(limits.min)) // 127 for number in range(128)], dtype
    )
    result = subdivide_labels(names[labels])
    assert result.dtype == dtype
    order = np.argsort(names[np.unique(labels)])
    assert (np.diff(order) == 1).all()
    np.testing.assert_array_equal(result, names[subdivide_labels(labels)])


def test_masks(labels):
    result = subdivide_labels(labels > 20)
    assert result.dtype == bool
    np.testing.assert_array_equal(result, subdivide_labels((labels > 20).astype(np.uint8)))
    out = np.zeros((30, 34, 32), bool)
    assert subdivide_labels(labels > 20, out=out) is out
    np.testing.assert_array_equal(out, result)


@pytest.mark.parametrize("levels", [1, 2])
def test_regions_memory_and_threads(labels, levels):
    whole = subdivide_labels(labels, levels=levels)
    region = np.s_[3:20, 7:, :11]
    np.testing.assert_array_equal(subdivide_labels(labels, levels=levels, region=region), whole[region])
    for other in (np.asfortranarray(labels), labels[::-1].copy()[::-1], labels.astype(">i4")):
        np.testing.assert_array_equal(subdivide_labels(other, levels=levels, threads=1), whole)
    if levels == 2:
        np.testing.assert_array_equal(subdivide_labels(subdivide_labels(labels)), whole)


def test_dask(labels):
    dask_array = pytest.importorskip("dask.array")
    lazy = subdivide_labels(dask_array.from_array(labels, chunks=6), boundary="periodic")
    assert isinstance(lazy, dask_array.Array)
    np.testing.assert_array_equal(lazy.compute(), subdivide_labels(labels, boundary="periodic"))


def test_simpleitk(labels):
    sitk = pytest.importorskip("SimpleITK")
    result = subdivide_labels(sitk.GetImageFromArray(labels))
    assert result.GetSpacing() == (0.5, 0.5, 0.5)
    np.testing.assert_array_equal(sitk.GetArrayViewFromImage(result), subdivide_labels(labels))


@pytest.mark.parametrize(
    ("array", "options", "error", "message"),
    [
        (np.zeros(4), {}, TypeError, "float64"),
        (np.zeros(4, int), {"dtype": np.float32}, TypeError, "float32"),
        (np.zeros(4, int), {"dtype": bool}, TypeError, "int64"),
        (np.full(4, 300), {"dtype": np.uint8}, ValueError, "300"),
        (np.zeros(4, int), {"scheme": "nonoscillatory"}, ValueError, "nonoscillatory"),
        (np.zeros(4, int), {"tension": -1}, ValueError, "-1"),
        (np.zeros(4, np.uint8), {"boundary": 0.5}, ValueError, "0.5"),
        (np.zeros(4, np.uint8), {"boundary": -1}, ValueError, "-1"),
        (np.zeros(4, bool), {"boundary": 2}, ValueError, "boundary 2"),
        (np.zeros((0, 4), int), {}, ValueError, r"\(0, 4\)"),
    ],
)
def test_errors(array, options, error, message):
    with pytest.raises(error, match=message):
        subdivide_labels(array, **options)
