# SPDX-License-Identifier: Apache-2.0
"""What a user asks for, applied to arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from . import _arguments
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
