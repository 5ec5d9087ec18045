# SPDX-License-Identifier: Apache-2.0
"""Checks what a user passes. Every error names the value."""

from __future__ import annotations

import os
from collections.abc import Sequence
from numbers import Real
from operator import index
from typing import Any, Protocol, SupportsIndex

import numpy as np
from numpy.typing import DTypeLike, NDArray

from . import _core

Axes = SupportsIndex | Sequence[SupportsIndex] | NDArray[np.integer[Any]]
Boundary = str | float | np.floating[Any] | np.integer[Any]
Region = Sequence[slice] | slice


class _Xarray(Protocol):
    @property
    def coords(self) -> Any: ...


class _Dask(Protocol):
    @property
    def chunks(self) -> Any: ...


# What is like an array, but comes back as one of its own kind: told by what NumPy's arrays have not.
ArrayOfAKind = _Xarray | _Dask

# What the array layer computes with directly.
NATIVE_TYPES = frozenset(np.dtype(name) for name in "bBhHiIqQfd")
SCHEMES = tuple(_core.schemes())
LABEL_SCHEMES = ("restored", "bspline", "linear")
BOUNDARIES = ("nearest", "mirror", "periodic")
LARGEST_DIMENSION = 4
LARGEST_LEVELS = 3
MOST_THREADS = 2**16


def checked_volume(volume: object, name: str = "volume") -> NDArray[Any]:
    """The volume as an array of a real type; no copy is made of one that is an array already."""
    if isinstance(volume, np.ma.MaskedArray):
        raise TypeError(f"{name} is a masked array, whose mask would be lost: pass {name}.filled(value)")
    array = np.asarray(volume)
    checked_type(array.dtype, name)
    if array.size == 0:
        raise ValueError(f"{name} has shape {array.shape}: there is nothing to subdivide")
    return array


def checked_type(dtype: DTypeLike, name: str) -> np.dtype[Any]:
    result = np.dtype(dtype)
    if result.kind not in "biuf":
        raise TypeError(f"{name} has the type {result}, which is no real one: integers, floats or bool are")
    return result


def checked_dimension(dimension: int, channel_axis: int | None) -> int | None:
    """The channel axis, counted from the first axis."""
    if channel_axis is not None:
        channel_axis = checked_axis(channel_axis, dimension, "channel_axis")
    spatial = dimension - (channel_axis is not None)
    if not 1 <= spatial <= LARGEST_DIMENSION:
        besides = " besides the channels" if channel_axis is not None else ""
        raise ValueError(f"the volume has {spatial} dimensions{besides}: 1 to {LARGEST_DIMENSION} are possible")
    return channel_axis


def checked_axis(axis: SupportsIndex, dimension: int, name: str) -> int:
    number = checked_index(axis, name)
    if not -dimension <= number < dimension:
        raise ValueError(f"{name} {axis} is none of the {dimension} axes")
    return number % dimension


def checked_axes(axes: Axes | None, dimension: int, channel_axis: int | None) -> tuple[int, ...]:
    """The axes to subdivide, in rising order. Default: all but the channels, the last three at most."""
    if axes is None:
        return tuple(axis for axis in range(dimension) if axis != channel_axis)[-3:]
    given = axes.tolist() if isinstance(axes, np.ndarray) else axes
    given = given if isinstance(given, Sequence) else (given,)
    result = sorted(checked_axis(axis, dimension, "axis") for axis in given)
    if len(set(result)) < len(result):
        raise ValueError(f"axes {axes} name an axis twice")
    if channel_axis in result:
        raise ValueError(f"axes {axes} contain the channel axis {channel_axis}")
    if len(result) > 3:
        raise ValueError(f"axes {axes} are more than three, which is the most that are subdivided at once")
    return tuple(result)


def checked_index(value: object, name: str) -> int:
    try:
        return index(value)  # type: ignore[arg-type]
    except TypeError:
        raise TypeError(f"{name} {value!r} is no integer") from None


def checked_levels(levels: int) -> int:
    number = checked_index(levels, "levels")
    if not 1 <= number <= LARGEST_LEVELS:
        raise ValueError(f"levels {levels} is not between 1 and {LARGEST_LEVELS}")
    return number


def checked_threads(threads: int | None, name: str = "threads") -> int:
    if threads is None:
        return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    number = checked_index(threads, name)
    if number < 1:
        raise ValueError(f"{name} {threads} is less than 1")
    return min(number, MOST_THREADS)


def checked_boundary(boundary: Boundary) -> tuple[str, float]:
    """The rule's name and the constant, if the rule is one."""
    if isinstance(boundary, str):
        if boundary not in BOUNDARIES:
            raise ValueError(f"boundary {boundary!r} is none of {', '.join(BOUNDARIES)}, nor a number")
        return boundary, 0.0
    if isinstance(boundary, (Real, np.number)) and not isinstance(boundary, (bool, np.complexfloating)):
        return "constant", _as_float(boundary, "boundary")
    raise TypeError(f"boundary {boundary!r} is none of {', '.join(BOUNDARIES)}, nor a number")


def check_boundary_label(boundary: Boundary, input_type: np.dtype[Any]) -> None:
    """Of bool, whose memory is taken as integers; labels of other types are checked by the array layer."""
    if input_type.kind == "b" and not isinstance(boundary, str) and boundary not in (0, 1):
        raise ValueError(f"boundary {boundary} is no label of the type bool")


def checked_tension(tension: float) -> float:
    if not isinstance(tension, (Real, np.number)) or isinstance(tension, np.complexfloating):
        raise TypeError(f"tension {tension!r} is no number")
    return _as_float(tension, "tension")


def _as_float(value: Any, name: str) -> float:
    try:
        return float(value)
    except OverflowError:
        raise ValueError(f"{name} {value} is too large") from None


def make_options(
    scheme: str, tension: float, boundary: Boundary, axes: Sequence[int], dimension: int, is_labels: bool
) -> _core.Options:
    if not isinstance(scheme, str):
        raise TypeError(f"scheme {scheme!r} is no string")
    if scheme not in SCHEMES:
        raise ValueError(f"scheme {scheme!r} is none of {', '.join(SCHEMES)}")
    number = checked_tension(tension)
    if is_labels:
        if scheme not in LABEL_SCHEMES:
            raise ValueError(f"scheme {scheme!r} is none of those for labels: {', '.join(LABEL_SCHEMES)}")
        if scheme != "restored":
            number = 2.0  # The default of labels, 0, is a tension of the restored scheme alone; the others have none.
    flags = [axis in axes for axis in range(dimension)]
    rule, constant = checked_boundary(boundary)
    try:
        return _core.Options(scheme, number, flags, rule, constant)
    except ValueError as error:
        raise ValueError(f"tension {tension}: {error}") from None


def checked_region(region: Region | None, shape: tuple[int, ...]) -> tuple[list[int], list[int]]:
    """First indices and sizes of a region of an output of that shape."""
    if region is None:
        return [0] * len(shape), list(shape)
    slices = (region,) if isinstance(region, slice) else region
    is_sequence = isinstance(slices, Sequence) and len(slices) <= len(shape)
    if not is_sequence or not all(isinstance(part, slice) for part in slices):
        raise TypeError(f"region {region} is not a tuple of at most {len(shape)} slices")
    try:
        ranges = [range(*part.indices(size)) for part, size in zip(slices, shape)]
    except TypeError:
        raise TypeError(f"region {region} has bounds that are no integers") from None
    ranges += [range(size) for size in shape[len(slices) :]]
    if any(part.step != 1 for part in ranges):
        raise ValueError(f"region {region} has a step other than 1")
    if not all(ranges):
        raise ValueError(f"region {region} is empty in an output of shape {shape}")
    return [part.start for part in ranges], [len(part) for part in ranges]


def result_type(input_type: np.dtype[Any], dtype: DTypeLike | None, out: NDArray[Any] | None = None) -> np.dtype[Any]:
    """The type of the result: what out or dtype say; else the input's, and float32 for bool."""
    asked = _asked_type(dtype, out)
    if asked is None:
        return np.dtype(np.float32) if input_type.kind == "b" else input_type.newbyteorder("=")
    if asked.kind == "b":
        raise TypeError("the result has values between those of the volume, which bool cannot hold")
    return asked


def label_type(input_type: np.dtype[Any], dtype: DTypeLike | None, out: NDArray[Any] | None = None) -> np.dtype[Any]:
    """The type of labels in the result: what out or dtype say; else the input's."""
    asked = _asked_type(dtype, out) or input_type.newbyteorder("=")
    for name, kind in (("labels", input_type), ("the result", asked)):
        if kind.kind not in "biu":
            raise TypeError(f"{name} cannot have the type {kind}: labels are integers or bool")
    if asked.kind == "b" and input_type.kind != "b":
        raise TypeError(f"bool cannot hold labels of the type {input_type}")
    return asked


def _asked_type(dtype: DTypeLike | None, out: NDArray[Any] | None) -> np.dtype[Any] | None:
    if out is None:
        return None if dtype is None else checked_type(dtype, "dtype")
    if dtype is not None and np.dtype(dtype) != out.dtype:
        raise ValueError(f"dtype {np.dtype(dtype)} is not that of out, {out.dtype}")
    return checked_type(out.dtype, "out")


def checked_out(out: NDArray[Any], shape: tuple[int, ...]) -> None:
    if not isinstance(out, np.ndarray) or isinstance(out, np.ma.MaskedArray):
        raise TypeError(f"out is no numpy.ndarray but {type(out).__name__}")
    if out.shape != shape:
        raise ValueError(f"out has shape {out.shape}, the result {shape}")
    if not out.flags.writeable:
        raise ValueError("out is read-only")
