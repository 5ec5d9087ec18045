# SPDX-License-Identifier: Apache-2.0
"""A task applied to whatever kind of volume is given: an array, an image of a library's, or a Dask array."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _arguments, images
from ._arguments import Region
from ._run import Progress
from ._task import Task


def apply(
    task: Task,
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
            return dask.apply(task, volume)
        adapter = images.find_adapter(volume)
        if adapter is not None:
            _refuse({"region": region, "out": out}, volume)
            return _apply_to_image(task, adapter, volume, threads, progress)
    return task.apply_to_array(_arguments.checked_volume(volume), region, out, threads, progress)


def _apply_to_image(
    task: Task, adapter: images.Adapter, image: Any, threads: int | None, progress: Progress | None
) -> Any:
    array, components = adapter.to_array(image)
    if components is not None and task.channel_axis is not None:
        raise TypeError(f"channel_axis {task.channel_axis}: the image has its components apart from its axes")
    task = task if components is None else replace(task, channel_axis=components)
    axes = task.checked_axes(array.ndim)
    return adapter.from_array(apply(task, array, None, None, threads, progress), image, axes, task.levels)


def _refuse(options: dict[str, Any], volume: object) -> None:
    """Options that only arrays in memory have."""
    for name, value in options.items():
        if value is not None:
            raise TypeError(f"{name} is for arrays in memory, not for {type(volume).__name__}")
