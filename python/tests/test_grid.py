# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from nonoscillatory_subdivision import subdivided_grid


@pytest.mark.parametrize("levels", [1, 2, 3])
def test_both_images_cover_the_same_box(levels):
    rotation, _ = np.linalg.qr(np.random.default_rng(4).normal(size=(3, 3)))
    old_spacing, old_origin = np.array([2.0, 0.5, 3.0]), np.array([10.0, -20.0, 5.0])
    spacing, origin = subdivided_grid(old_spacing, old_origin, rotation, levels=levels)
    sizes = np.array([7, 8, 9])
    for corner in ((0, 0, 0), (1, 1, 1), (1, 0, 1)):
        old_index = np.array(corner) * sizes - 0.5
        index = np.array(corner) * sizes * 2**levels - 0.5
        np.testing.assert_allclose(
            origin + rotation @ (spacing * index), old_origin + rotation @ (old_spacing * old_index)
        )


def test_axes_that_are_not_subdivided_stay():
    spacing, origin = subdivided_grid([1, 2, 3, 4], [0, 0, 0, 0])
    assert spacing.tolist() == [1, 1, 1.5, 2]
    assert origin.tolist() == [0, -0.5, -0.75, -1]
    spacing, origin = subdivided_grid([1.0, 2.0], [5.0, 5.0], axes=0)
    assert (spacing.tolist(), origin.tolist()) == ([0.5, 2], [4.75, 5])
