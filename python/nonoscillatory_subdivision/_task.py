# SPDX-License-Identifier: Apache-2.0
"""What a user asks for, applied to whatever kind of volume is given."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from . import _arguments, images
from ._arguments import Axes, Boundary, Region
from ._run import Indices, Progress, Run, doubled_shape


@dataclass(frozen=True)
class Task:
    scheme: str
    tension: float
    boundary: Boundary
    axes: Axes | None
    levels: int
    channel_axis: int | None
    dtype: DTypeLike | None
    is_labels: bool = False

    def apply(
        self,
        volume: Any,
        region: Region | None,
        out: NDArray[Any] | None,
        threads: int | None,
        progress: Progress | None,
    ) -> Any:
        """An array, or an image of the volume's kind."""
        if not isinstance(volume, np.ndarray):
            if images.is_dask_array(volume):
                from . import dask

                _refuse({"region": region, "out": out, "threads": threads, "progress": progress}, volume)
                return dask.apply(self, volume)
            adapter = images.find_adapter(volume)
            if adapter is not None:
                _refuse({"region": region, "out": out}, volume)
                return self._apply_to_image(adapter, volume, threads, progress)
        return self.apply_to_array(_arguments.checked_volume(volume), region, out, threads, progress)

    def _apply_to_image(
        self, adapter: images.Adapter, image: Any, threads: int | None, progress: Progress | None
    ) -> Any:
        array, components = adapter.to_array(image)
        if components is not None and self.channel_axis is not None:
            raise TypeError(f"channel_axis {self.channel_axis}: the image has its components apart from its axes")
        task = self if components is None else replace(self, channel_axis=components)
        axes = task.checked_axes(array.ndim)
        return adapter.from_array(task.apply(array, None, None, threads, progress), image, axes, self.levels)

    def apply_to_array(
        self,
        array: NDArray[Any],
        region: Region | None = None,
        out: NDArray[Any] | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> NDArray[Any]:
        run = self._make_run(array, threads, progress)
        first, size = _arguments.checked_region(region, doubled_shape(run.shape, run.axes, run.levels))
        if out is not None:
            _arguments.checked_out(out, tuple(size))
        kind = self.result_type(array.dtype, out)
        if self.is_labels:
            _arguments.check_boundary_label(self.boundary, array.dtype)

        def read(part_first: Indices, part_size: Indices) -> NDArray[Any]:
            return array[tuple(slice(start, start + length) for start, length in zip(part_first, part_size))]

        # What is still to be read must not be written over.
        target = np.empty(size, kind) if out is None or np.may_share_memory(out, array) else out
        run.compute(read, first, target)
        if out is None:
            return target
        if target is not out:
            out[...] = target
        return out

    def _make_run(self, array: NDArray[Any], threads: int | None, progress: Progress | None) -> Run:
        if progress is not None and not callable(progress):
            raise TypeError(f"progress {progress!r} cannot be called")
        axes = self.checked_axes(array.ndim)
        return Run(
            options=_arguments.make_options(self.scheme, self.tension, self.boundary, axes, array.ndim, self.is_labels),
            shape=array.shape,
            axes=axes,
            levels=_arguments.checked_levels(self.levels),
            input_type=array.dtype,
            is_labels=self.is_labels,
            threads=_arguments.checked_threads(threads),
            progress=progress,
        )

    def checked_axes(self, dimension: int) -> tuple[int, ...]:
        """The axes to subdivide of a volume of that many, in rising order."""
        channel_axis = _arguments.checked_dimension(dimension, self.channel_axis)
        return _arguments.checked_axes(self.axes, dimension, channel_axis)

    def result_type(self, input_type: np.dtype[Any], out: NDArray[Any] | None = None) -> np.dtype[Any]:
        if self.is_labels:
            return _arguments.label_type(input_type, self.dtype, out)
        return _arguments.result_type(input_type, self.dtype, out)


def _refuse(options: dict[str, Any], volume: object) -> None:
    """Options that only arrays in memory have."""
    for name, value in options.items():
        if value is not None:
            raise TypeError(f"{name} is for arrays in memory, not for {type(volume).__name__}")
