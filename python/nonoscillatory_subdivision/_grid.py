# SPDX-License-Identifier: Apache-2.0
"""Where the voxels of a subdivided image lie."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arguments import Axes, checked_axes, checked_levels


def first_child(levels: int) -> float:
    """The continuous input index of output index 0: a quarter voxel below the centre of voxel 0 for one level."""
    return -((1 << levels) - 1) / (2 << levels)


def subdivided_grid(
    spacing: ArrayLike,
    origin: ArrayLike,
    direction: ArrayLike | None = None,
    *,
    axes: Axes | None = None,
    levels: int = 1,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    r"""Spacing and origin of a subdivided image.

    Output index :math:`m` lies at the continuous input index :math:`m / 2^L - (2^L - 1) / 2^{L+1}` along each
    subdivided axis, so that both images cover the same physical box. The direction stays as it is.

    Parameters
    ----------
    spacing : array_like, shape (n,)
        The distance of neighbouring voxels along each axis; n is 1 to 4. Any order of the axes will do, (z, y, x) as in
        arrays or (x, y, z) as in ITK, as long as all arguments have the same.
    origin : array_like, shape (n,)
        The position of the centre of the first voxel.
    direction : array_like, shape (n, n), optional
        ITK's direction cosines: column i is the direction of axis i. Default: the identity.
    axes : int or sequence of int, optional
        The axes that were subdivided, as positions in `spacing`. Default: all, or the last three of four.
    levels : int, optional
        How many times the image was doubled, 1 to 3.

    Returns
    -------
    spacing, origin : numpy.ndarray of float64, shape (n,)

    Raises
    ------
    ValueError
        If the shapes do not fit each other, or a number is out of its range.

    Examples
    --------
    >>> subdivided_grid((1.0, 0.5, 0.5), (0.0, 10.0, 10.0))
    (array([0.5 , 0.25, 0.25]), array([-0.25 ,  9.875,  9.875]))
    """
    steps = np.array(spacing, dtype=np.float64)
    if steps.ndim != 1 or not 1 <= steps.size <= 4:
        raise ValueError(f"spacing {spacing!r} is not a sequence of 1 to 4 numbers")
    if not np.isfinite(steps).all():
        raise ValueError(f"spacing {spacing!r} is not finite")
    start = _with_shape(origin, steps.shape, "origin")
    cosines = np.eye(steps.size) if direction is None else _with_shape(direction, steps.shape * 2, "direction")
    subdivided = list(checked_axes(axes, steps.size, None))
    levels = checked_levels(levels)
    shift = np.zeros_like(steps)
    shift[subdivided] = steps[subdivided] * first_child(levels)
    steps[subdivided] /= 2**levels
    return steps, start + cosines @ shift


def _with_shape(values: ArrayLike, shape: tuple[int, ...], name: str) -> NDArray[np.float64]:
    array: NDArray[Any] = np.array(values, dtype=np.float64)
    if array.shape != shape:
        raise ValueError(f"{name} has shape {array.shape}, not {shape} as the spacing asks")
    return array
