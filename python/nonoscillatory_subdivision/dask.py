# SPDX-License-Identifier: Apache-2.0
"""Subdivision of Dask arrays, chunk by chunk: the bytes of the whole array. Needs the extra ``zarr``, or dask alone."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import dask.array
import numpy as np
from numpy.typing import DTypeLike, NDArray

from . import _arguments, _core
from . import subdivide as subdivide_array
from ._arguments import Boundary
from ._run import real_type

__all__ = ["subdivide"]


def subdivide(
    array: Any,
    *,
    scheme: str = "nonoscillatory",
    tension: float = 2.0,
    boundary: Boundary = "nearest",
    axes: int | Sequence[int] | None = None,
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
    if np.isnan(array.shape).any():
        raise ValueError(f"the array has chunks of unknown size: shape {array.shape}; call compute_chunk_sizes() first")
    empty = np.empty((1,) * array.ndim, array.dtype)
    checked_channel = _arguments.checked_dimension(array.ndim, channel_axis)
    checked = _arguments.checked_axes(axes, array.ndim, checked_channel)
    kind = _arguments.result_type(_arguments.checked_volume(empty, "array"), dtype, None)
    options = {"scheme": scheme, "tension": tension, "boundary": boundary, "axes": checked}
    options["channel_axis"] = checked_channel
    subdivide_array(empty, threads=1, dtype=kind, **options)  # type: ignore[call-overload] # complains of wrong options
    levels = _arguments.checked_levels(levels)
    between = real_type(array.dtype, kind)
    for level in range(levels):
        array = _one_level(array, kind if level == levels - 1 else between, options)
    return array


def _one_level(array: Any, dtype: np.dtype[Any], options: dict[str, Any]) -> Any:
    radius = _core.radius(options["scheme"])
    is_periodic = options["boundary"] == "periodic"
    chunks = list(array.chunks)
    # An axis of one chunk is whole, and its boundary is applied by the scheme itself.
    depth = dict.fromkeys(range(array.ndim), 0)
    for axis in options["axes"]:
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
        dtype=dtype,
        meta=np.empty((0,) * array.ndim, dtype),
        chunks=tuple(
            tuple(2 * size for size in sizes) if axis in options["axes"] else sizes
            for axis, sizes in enumerate(array.chunks)
        ),
        result_type=dtype,
        depth_of_axis=depth,
        options=options,
    )


def _thick_chunks(sizes: tuple[int, ...], thinnest: int) -> tuple[int, ...]:
    """Joins chunks that are too thin with their neighbours."""
    if sum(sizes) < 2 * thinnest:
        return (sum(sizes),)
    return tuple(dask.array.overlap.ensure_minimum_chunksize(thinnest, sizes))


def subdivide_chunk(
    chunk: NDArray[Any],
    result_type: np.dtype[Any],
    depth_of_axis: dict[int, int],
    options: dict[str, Any],
    block_info: Any = None,
) -> NDArray[Any]:
    """The children of a chunk with its overlap, which is missing where the array ends, unless it is periodic."""
    location, numbers = block_info[0]["chunk-location"], block_info[0]["num-chunks"]
    is_periodic = options["boundary"] == "periodic"
    region = []
    for axis, size in enumerate(chunk.shape):
        depth = 2 * depth_of_axis[axis]
        low = depth if location[axis] > 0 or is_periodic else 0
        high = depth if location[axis] < numbers[axis] - 1 or is_periodic else 0
        region.append(slice(low, (2 * size if axis in options["axes"] else size) - high))
    return subdivide_array(chunk, region=tuple(region), dtype=result_type, threads=1, **options)
