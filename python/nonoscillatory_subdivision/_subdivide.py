# SPDX-License-Identifier: Apache-2.0
"""subdivide(), which users call."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeVar, overload

from numpy.typing import ArrayLike, DTypeLike, NDArray

from ._arguments import ArrayOfAKind, Axes, Boundary, Region
from ._dispatch import apply
from ._run import Progress
from ._task import Task

TImage = TypeVar("TImage")
TArrayOfAKind = TypeVar("TArrayOfAKind", bound=ArrayOfAKind)


@overload
def subdivide(
    volume: TArrayOfAKind,
    *,
    scheme: str = ...,
    tension: float = ...,
    boundary: Boundary = ...,
    axes: Axes | None = ...,
    levels: int = ...,
    dtype: DTypeLike | None = ...,
    threads: int | None = ...,
    progress: Progress | None = ...,
    channel_axis: int | None = ...,
) -> TArrayOfAKind: ...
@overload
def subdivide(
    volume: ArrayLike,
    *,
    scheme: str = ...,
    tension: float = ...,
    boundary: Boundary = ...,
    axes: Axes | None = ...,
    levels: int = ...,
    region: Region | None = ...,
    out: NDArray[Any] | None = ...,
    dtype: DTypeLike | None = ...,
    threads: int | None = ...,
    progress: Progress | None = ...,
    channel_axis: int | None = ...,
) -> NDArray[Any]: ...
@overload
def subdivide(
    volume: TImage,
    *,
    scheme: str = ...,
    tension: float = ...,
    boundary: Boundary = ...,
    axes: Axes | None = ...,
    levels: int = ...,
    dtype: DTypeLike | None = ...,
    threads: int | None = ...,
    progress: Progress | None = ...,
    channel_axis: int | None = ...,
) -> TImage: ...
def subdivide(
    volume: Any,
    *,
    scheme: str = "nonoscillatory",
    tension: float = 2.0,
    boundary: Boundary = "nearest",
    axes: Axes | None = None,
    levels: int = 1,
    region: Region | None = None,
    out: NDArray[Any] | None = None,
    dtype: DTypeLike | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    channel_axis: int | None = None,
) -> Any:
    r"""Double the resolution of a volume.

    Every voxel is the average over its cell, and is replaced by the averages over the halves of the cell along each
    axis. Along one axis, with the voxels :math:`f`, their second differences
    :math:`d_j = f_{j-1} - 2 f_j + f_{j+1}` and :math:`h_j = |f_j - f_{j-1}| + |f_{j+1} - f_j|`,

    .. math:: S_{2p+k} = \sum_i b^k_i f_{p-2+i} + \sum_i c^k_i \, \mathrm{clamp}(d_{p-1+i}, -K_{p-1+i}, K_{p-1+i}),
       \qquad K_j = \tau \min(h_{j-2}, \dots, h_{j+2}),

    where :math:`S_{2p}` is the upper half of cell p and :math:`S_{2p+1}` the lower half of cell p + 1. docs/scheme.md
    has the masks, several axes and the other schemes.

    Parameters
    ----------
    volume : array_like, or itk.Image, SimpleITK.Image, xarray.DataArray or dask.array.Array
        1-D to 4-D, axes in the order (z, y, x); any integer or floating type or bool, any strides and byte order. An
        image comes back as one of its own kind on the doubled grid; its axes are numbered in the same order. A Dask
        array stays lazy: see `nonoscillatory_subdivision.dask`.
    scheme : str, optional
        One of `schemes()`: "nonoscillatory", "linear", "bounded", "bspline", "restored".
    tension : float, optional
        :math:`\tau`, finite and greater than 1; for "restored" at least 0. The larger, the closer to the linear scheme.
    boundary : {"nearest", "mirror", "periodic"} or float, optional
        What lies outside the volume: the nearest voxel; the volume mirrored at its faces, the outermost voxel twice;
        the volume repeated; or that number.
    axes : int or sequence of int, optional
        The axes to subdivide, three at most. Each position along another axis is a volume of its own. Default: all but
        the channels; of four, the last three.
    levels : int, optional
        How many times to double, 1 to 3. Values between the levels are real: only the result is rounded.
    region : tuple of slice, optional
        The part of the result to compute, as if the whole had been indexed with it. Only what it needs is computed.
    out : numpy.ndarray, optional
        Where to write the result, of its shape and of any real type.
    dtype : data-type, optional
        The type of the result. Integers are rounded, half to even, and saturate; NaN becomes 0. Default: that of the
        volume in native byte order, float32 for bool.
    threads : int, optional
        Default: one for each processor that the process may use. The result does not depend on it.
    progress : callable, optional
        Called with the fraction that is done, at most fifty times a second, from the calling thread. What it raises
        ends the run.
    channel_axis : int, optional
        An axis of the array that holds the components of voxels. It is not subdivided and is no dimension.

    Returns
    -------
    numpy.ndarray, or an image of the volume's kind
        Twice the size along each subdivided axis for each level. `out`, if that is given.

    Raises
    ------
    ValueError, TypeError
        If an argument is not as said here; the message names the value.

    Notes
    -----
    64-bit and 32-bit integers and float64 are computed in double precision, smaller types in single. A voxel's value
    depends on the volume and the options alone: not on threads, region or memory layout. Local averages are kept to the
    sixth difference only, and with "nonoscillatory" they move at edges.

    Examples
    --------
    >>> import numpy as np
    >>> step = np.array([0, 0, 0, 0, 0, 1, 1, 1, 1, 1], dtype=np.float64)
    >>> (subdivide(step)[8:12] * 1024).tolist()
    [176.0, 386.0, 638.0, 848.0]
    >>> (subdivide(step, scheme="linear")[8:12] * 1024).tolist()
    [-112.0, 212.0, 812.0, 1136.0]
    >>> subdivide(step, levels=2, region=np.s_[18:22]).shape
    (4,)
    """
    task = Task(scheme, tension, boundary, axes, levels, channel_axis, dtype)
    return apply(task, volume, region, out, threads, progress)
