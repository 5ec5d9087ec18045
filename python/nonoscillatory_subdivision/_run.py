# SPDX-License-Identifier: Apache-2.0
"""Runs the array layer: one level after the other, on the parts that a region needs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._arguments import NATIVE_TYPES

# Results of no more elements are computed by one thread: to begin another one takes longer.
FEW_ELEMENTS = 2**14

Progress = Callable[[float], object]
Indices = Sequence[int]
# Gives the part of the input with these first indices and sizes.
Reader = Callable[[Indices, Indices], NDArray[Any]]


def is_native(array: NDArray[Any]) -> bool:
    """Whether the array layer can use the memory of an array as it is."""
    return (
        array.dtype in NATIVE_TYPES
        and array.flags.aligned
        and all(stride % array.itemsize == 0 for stride in array.strides)
    )


def as_integers(array: NDArray[Any]) -> NDArray[Any]:
    """The memory of bool as integers, 0 and 1."""
    return array.view(np.uint8) if array.dtype.kind == "b" else array


def is_in_order(array: NDArray[Any]) -> bool:
    """Whether memory runs along the last axis first. The array layer goes through an input along its memory, and sums
    in another order have other last digits."""
    distances = [abs(stride) for stride in array.strides]
    return all(outer >= inner > 0 for outer, inner in zip(distances, distances[1:]))


def to_native(array: NDArray[Any]) -> NDArray[Any]:
    """The same values as the array layer takes them from an array in C's order; a copy only where it must be."""
    if array.dtype.kind == "b" and as_integers(array).max() > 1:
        array = as_integers(array) != 0  # any byte but 0 is True
    array = as_integers(array)
    if is_native(array) and is_in_order(array):
        return array
    # In a line and back, as NumPy leaves any strides to axes of one voxel.
    return np.ascontiguousarray(array, dtype=native_type(array.dtype)).reshape(-1).reshape(array.shape)


def native_type(dtype: np.dtype[Any]) -> np.dtype[Any]:
    """The type that stands for another one in the array layer: float32 for float16, float64 for longdouble."""
    if dtype.kind == "b":
        return np.dtype(np.uint8)
    if dtype.kind == "f" and dtype.itemsize not in (4, 8):
        return np.dtype(np.float32 if dtype.itemsize < 4 else np.float64)
    return dtype.newbyteorder("=")


def real_type(*dtypes: np.dtype[Any]) -> np.dtype[Any]:
    """The type of the values between levels: float64 where any of the types needs it, else float32."""
    needs_double = any(dtype.itemsize > (4 if dtype.kind == "f" else 2) for dtype in map(native_type, dtypes))
    return np.dtype(np.float64 if needs_double else np.float32)


def doubled_shape(shape: Sequence[int], axes: Sequence[int], levels: int) -> tuple[int, ...]:
    return tuple(size << levels if axis in axes else size for axis, size in enumerate(shape))


@dataclass(frozen=True)
class Run:
    """Subdivision of a whole of a given shape, of which any part can be computed."""

    options: _core.Options
    shape: tuple[int, ...]
    axes: tuple[int, ...]
    levels: int
    input_type: np.dtype[Any]
    is_labels: bool = False
    threads: int = 1
    progress: Progress | None = None

    def compute(self, read: Reader, first: Indices, out: NDArray[Any]) -> None:
        """Fills out with the part of the final output that begins at first."""
        out = as_integers(out)
        target = out if is_native(out) else np.empty(out.shape, self._target_type(out.dtype))
        self._compute_levels(read, first, target)
        if target is not out:
            out[...] = target

    def _target_type(self, dtype: np.dtype[Any]) -> np.dtype[Any]:
        """The type to compute a result of that type in, before it is rounded, once, by a copy."""
        native = native_type(dtype)
        return native if native.itemsize == dtype.itemsize else real_type(self.input_type, native)

    def _compute_levels(self, read: Reader, first: Indices, out: NDArray[Any]) -> None:
        wholes = [doubled_shape(self.shape, self.axes, level) for level in range(self.levels)]
        boxes: list[tuple[Indices, Indices]] = [(first, out.shape)]
        for whole in reversed(wholes):
            boxes.insert(0, self.options.input_request(*boxes[0], whole))
        work = sum(prod(size) for _, size in boxes[1:])
        between = native_type(self.input_type) if self.is_labels else real_type(self.input_type, out.dtype)
        compute_level = _core.subdivide_labels if self.is_labels else _core.subdivide

        part, begin = to_native(read(*boxes[0])), 0.0
        for level, whole in enumerate(wholes):
            target_first, target_size = boxes[level + 1]
            target = out if level == self.levels - 1 else np.empty(target_size, between)
            end = begin + prod(target_size) / work
            threads = 1 if target.size <= FEW_ELEMENTS else self.threads
            compute_level(
                self.options, part, boxes[level][0], whole, target, target_first, threads, self.progress, begin, end
            )
            part, begin = target, end
        if self.progress is not None:
            self.progress(1.0)
