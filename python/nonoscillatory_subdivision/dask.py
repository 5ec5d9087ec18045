# SPDX-License-Identifier: Apache-2.0
"""Subdivision of Dask arrays, chunk by chunk: the bytes of the whole array. Needs the extra ``zarr``, or dask alone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import dask.array
import numpy as np
from numpy.typing import DTypeLike, NDArray

from . import _arguments, _core, images
from ._arguments import Axes, Boundary
from ._run import real_type
from ._task import Task

__all__ = ["subdivide", "subdivide_labels"]


def subdivide(
    array: Any,
    *,
    scheme: str = "nonoscillatory",
    tension: float = 2.0,
    boundary: Boundary = "nearest",
    axes: Axes | None = None,
    levels: int = 1,
    dtype: DTypeLike | None = None,
    channel_axis: int | None = None,
) -> Any:
    """Double the resolution of a Dask array, lazily.

    Parameters
    ----------
    array : dask.array.Array
        As `nonoscillatory_subdivision.subdivide` takes it. Chunks thinner than the five voxels that a child depends on
        are joined with their neighbours.
    scheme, tension, boundary, axes, levels, dtype, channel_axis
        As for `nonoscillatory_subdivision.subdivide`. A part of the result is computed by indexing it.

    Returns
    -------
    dask.array.Array
        Its chunks are those of the array, doubled for each level along each subdivided axis. Each is computed by one
        thread.

    Raises
    ------
    ValueError, TypeError
        As `nonoscillatory_subdivision.subdivide`, and if the sizes of the chunks are unknown.

    Examples
    --------
    >>> import dask.array
    >>> volume = dask.array.ones((20, 20, 20), chunks=10)
    >>> subdivide(volume)
    dask.array<subdivide_chunk, shape=(40, 40, 40), dtype=float64, chunksize=(20, 20, 20), chunktype=numpy.ndarray>
    """
    return apply(Task(scheme, tension, boundary, axes, levels, channel_axis, dtype), array)


def subdivide_labels(
    array: Any,
    *,
    scheme: str = "restored",
    tension: float = 0.0,
    boundary: Boundary = "nearest",
    axes: Axes | None = None,
    levels: int = 1,
    dtype: DTypeLike | None = None,
    channel_axis: int | None = None,
) -> Any:
    """Double the resolution of a label map, lazily: as `nonoscillatory_subdivision.subdivide_labels`."""
    return apply(Task(scheme, tension, boundary, axes, levels, channel_axis, dtype, is_labels=True), array)


def apply(task: Task, array: Any) -> Any:
    if not images.is_dask_array(array):
        raise TypeError(f"array is a {type(array).__name__}, not a dask.array.Array")
    if np.isnan(array.shape).any():
        raise ValueError(f"the array has chunks of unknown size: shape {array.shape}; call compute_chunk_sizes() first")
    if 0 in array.shape:
        raise ValueError(f"array has shape {array.shape}: there is nothing to subdivide")
    if isinstance(array._meta, np.ma.MaskedArray):
        raise TypeError("array has masked chunks, whose masks would be lost: pass dask.array.ma.filled(array, value)")
    # One voxel is enough to find what is wrong with the options.
    task.apply_to_array(_arguments.checked_volume(np.zeros((1,) * array.ndim, array.dtype), "array"), threads=1)
    task = replace(task, axes=task.checked_axes(array.ndim))
    result_type = task.result_type(array.dtype)
    between = array.dtype.newbyteorder("=") if task.is_labels else real_type(array.dtype, result_type)
    for level in range(task.levels):
        is_last = level == task.levels - 1
        array = _one_level(replace(task, levels=1, dtype=result_type if is_last else between), array)
    return array


def _one_level(task: Task, array: Any) -> Any:
    radius = _core.radius(task.scheme)
    axes = task.checked_axes(array.ndim)
    is_periodic = task.boundary == "periodic"
    chunks = list(array.chunks)
    # An axis of one chunk is whole, and its boundary is applied by the scheme itself.
    depth = dict.fromkeys(range(array.ndim), 0)
    for axis in axes:
        chunks[axis] = _thick_chunks(chunks[axis], radius)
        if len(chunks[axis]) > 1:
            depth[axis] = radius
    array = array.rechunk(tuple(chunks))
    return dask.array.map_overlap(
        subdivide_chunk,
        array,
        depth=depth,
        boundary={axis: "periodic" if is_periodic else "none" for axis in depth},
        trim=False,
        allow_rechunk=False,
        dtype=task.dtype,
        meta=np.empty((0,) * array.ndim, task.dtype),
        chunks=tuple(
            tuple(2 * size for size in sizes) if axis in axes else sizes for axis, sizes in enumerate(array.chunks)
        ),
        task=task,
        depth_of_axis=depth,
    )


def _thick_chunks(sizes: tuple[int, ...], thinnest: int) -> tuple[int, ...]:
    """Joins chunks that are too thin with their neighbours."""
    if sum(sizes) < 2 * thinnest:
        return (sum(sizes),)
    return tuple(dask.array.overlap.ensure_minimum_chunksize(thinnest, sizes))


def subdivide_chunk(
    chunk: NDArray[Any], task: Task, depth_of_axis: dict[int, int], block_info: Any = None
) -> NDArray[Any]:
    """The children of a chunk with its overlap, which is missing where the array ends, unless it is periodic."""
    location, numbers = block_info[0]["chunk-location"], block_info[0]["num-chunks"]
    is_periodic = task.boundary == "periodic"
    axes = task.checked_axes(chunk.ndim)
    region = []
    for axis, size in enumerate(chunk.shape):
        depth = 2 * depth_of_axis[axis]
        low = depth if location[axis] > 0 or is_periodic else 0
        high = depth if location[axis] < numbers[axis] - 1 or is_periodic else 0
        region.append(slice(low, (2 * size if axis in axes else size) - high))
    return task.apply_to_array(_arguments.checked_volume(chunk, "a chunk"), tuple(region), threads=1)
