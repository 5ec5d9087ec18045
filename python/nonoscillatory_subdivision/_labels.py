# SPDX-License-Identifier: Apache-2.0
"""subdivide_labels(), which users call."""

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
def subdivide_labels(
    labels: TArrayOfAKind,
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
def subdivide_labels(
    labels: ArrayLike,
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
def subdivide_labels(
    labels: TImage,
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
def subdivide_labels(
    labels: Any,
    *,
    scheme: str = "restored",
    tension: float = 0.0,
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
    r"""Double the resolution of a label map: no label appears that was not there.

    Each label's indicator, 1 where a voxel has the label and 0 elsewhere, is subdivided by the scheme. That is the
    label's vote; the largest vote wins a child, ties go to the label of the parent and then to the lowest.

    Parameters
    ----------
    labels : array_like, or itk.Image, SimpleITK.Image, xarray.DataArray or dask.array.Array
        Any integer type or bool; else as for `subdivide`.
    scheme : {"restored", "bspline", "linear"}, optional
        "restored" with tension 0 makes surfaces as smooth as "bspline" and keeps the volume of small bodies.
    tension : float, optional
        Of "restored", at least 0.
    boundary, axes, levels, region, threads, progress, channel_axis
        As for `subdivide`. A number as boundary is a label.
    out : numpy.ndarray, optional
        Where to write the result, of its shape and of any integer type.
    dtype : data-type, optional
        The type of the result, which must hold all labels. Default: that of the labels in native byte order.

    Returns
    -------
    numpy.ndarray, or an image of the labels' kind
        Twice the size along each subdivided axis for each level.

    Raises
    ------
    ValueError, TypeError
        If an argument is not as said here, or a label does not fit the type of the result.

    Examples
    --------
    >>> import numpy as np
    >>> labels = np.zeros((8, 8), dtype=np.uint8)
    >>> labels[2:6, 2:6] = 7
    >>> doubled = subdivide_labels(labels)
    >>> doubled.shape, np.unique(doubled).tolist()
    ((16, 16), [0, 7])
    >>> subdivide_labels(labels > 0).dtype
    dtype('bool')
    """
    task = Task(scheme, tension, boundary, axes, levels, channel_axis, dtype, is_labels=True)
    return apply(task, labels, region, out, threads, progress)
