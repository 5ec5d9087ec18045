# SPDX-License-Identifier: Apache-2.0
"""Images with a grid: what subdivide() needs to know of each library's. None of them is imported here."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ._grid import first_child, subdivided_grid


class Adapter(Protocol):
    """How to take an image apart and make one of the same kind again."""

    def to_array(self, image: Any) -> tuple[NDArray[Any], int | None]:
        """The voxels in NumPy's order of axes, and the axis of the components, if there is one."""

    def from_array(self, array: NDArray[Any], image: Any, axes: Sequence[int], levels: int) -> Any:
        """An image of the subdivided voxels, on the doubled grid of the original."""


def find_adapter(image: object) -> Adapter | None:
    """The adapter of an image, if it is one: only a library that is loaded can have made it."""
    simple_itk = sys.modules.get("SimpleITK")
    if simple_itk is not None and isinstance(image, simple_itk.Image):
        return SimpleITKAdapter()
    xarray = sys.modules.get("xarray")
    if xarray is not None and isinstance(image, xarray.DataArray):
        return XarrayAdapter()
    if type(image).__module__.startswith("itk."):
        if hasattr(image, "GetLargestPossibleRegion"):
            return ITKAdapter()
        if hasattr(image, "GetOutput"):
            raise TypeError(f"{type(image).__name__} is a filter of ITK: update it and pass its output")
    return None


def is_dask_array(volume: object) -> bool:
    dask_array = sys.modules.get("dask.array")
    return dask_array is not None and isinstance(volume, dask_array.Array)


def _itk_grid(image: Any, axes: Sequence[int], levels: int, first: Sequence[int]) -> tuple[list[float], list[float]]:
    """Spacing and origin in ITK's order, of axes in NumPy's; first is the index of the first voxel."""
    dimension = len(image.GetSpacing())
    direction = np.asarray(image.GetDirection(), dtype=float).reshape(dimension, dimension)
    itk_axes = [dimension - 1 - axis for axis in axes]
    old_spacing = np.asarray(image.GetSpacing(), dtype=float)
    start = np.asarray(image.GetOrigin(), dtype=float) + direction @ (old_spacing * first)
    spacing, origin = subdivided_grid(old_spacing, start, direction, axes=itk_axes, levels=levels)
    return spacing.tolist(), origin.tolist()


class SimpleITKAdapter:
    def to_array(self, image: Any) -> tuple[NDArray[Any], int | None]:
        import SimpleITK

        kind = image.GetPixelIDTypeAsString()
        if "label" in kind:
            raise TypeError(f"the image is a {kind}, which has no array: pass SimpleITK.LabelMapToLabel(image)")
        array = SimpleITK.GetArrayViewFromImage(image)
        if "vector" not in kind:
            return array, None
        if array.ndim == image.GetDimension():  # a single component has no axis there
            array = array[..., np.newaxis]
        return array, array.ndim - 1

    def from_array(self, array: NDArray[Any], image: Any, axes: Sequence[int], levels: int) -> Any:
        import SimpleITK

        is_vector = array.ndim > image.GetDimension()
        result = SimpleITK.GetImageFromArray(array, isVector=is_vector)
        spacing, origin = _itk_grid(image, axes, levels, [0] * image.GetDimension())
        result.SetSpacing(spacing)
        result.SetOrigin(origin)
        result.SetDirection(image.GetDirection())
        return result


class ITKAdapter:
    def to_array(self, image: Any) -> tuple[NDArray[Any], int | None]:
        import itk

        region = image.GetBufferedRegion()
        if region != image.GetLargestPossibleRegion() or 0 in region.GetSize():
            raise ValueError("the image holds only a part of itself: call UpdateLargestPossibleRegion() first")
        array = itk.array_view_from_image(image)
        return array, array.ndim - 1 if array.ndim > image.GetImageDimension() else None

    def from_array(self, array: NDArray[Any], image: Any, axes: Sequence[int], levels: int) -> Any:
        import itk

        dimension = image.GetImageDimension()
        is_same_type = array.dtype == itk.array_view_from_image(image).dtype
        kind = {"ttype": type(image)} if is_same_type else {"is_vector": array.ndim > dimension}
        try:
            result = itk.image_from_array(array, **kind)
        except KeyError:
            raise TypeError(f"dtype {array.dtype} is none of which ITK has images in Python") from None
        # The indices are doubled as well, so the origin is that of index 0, wherever the first voxel is.
        spacing, origin = _itk_grid(image, axes, levels, [0] * dimension)
        region = result.GetLargestPossibleRegion()
        start = list(image.GetLargestPossibleRegion().GetIndex())
        for axis in axes:
            start[dimension - 1 - axis] <<= levels
        region.SetIndex(start)
        result.SetRegions(region)
        result.SetSpacing(spacing)
        result.SetOrigin(origin)
        result.SetDirection(image.GetDirection())
        return result


class XarrayAdapter:
    def to_array(self, image: Any) -> tuple[Any, int | None]:
        return image.data, None

    def from_array(self, array: NDArray[Any], image: Any, axes: Sequence[int], levels: int) -> Any:
        import xarray

        subdivided = {image.dims[axis] for axis in axes}
        coordinates = {}
        for name, coordinate in image.coords.items():
            if subdivided.isdisjoint(coordinate.dims):
                coordinates[name] = coordinate
            else:
                coordinates[name] = (coordinate.dims, self._subdivided(coordinate, levels), coordinate.attrs)
        return xarray.DataArray(array, coordinates, image.dims, image.name, image.attrs)

    @staticmethod
    def _subdivided(coordinate: Any, levels: int) -> NDArray[Any]:
        """The coordinate at the centres of the children, straight on beyond the first and the last voxel."""
        values = coordinate.values
        if values.ndim != 1 or values.dtype.kind not in "iufmM" or values.size < 2:
            raise ValueError(
                f"coordinate {coordinate.name!r} ({values.dtype}, shape {values.shape}) cannot be subdivided: drop it"
            )
        if values.dtype.kind in "mM":
            # The centres of the new cells lie between coarser units.
            nanoseconds = values.astype(f"{values.dtype.kind}8[ns]")
            if (nanoseconds.astype(values.dtype) != values).any():
                raise ValueError(f"coordinate {coordinate.name!r} has NaT, or times beyond those of nanoseconds: drop it")
            values = nanoseconds
        # Relative to the first one, so that times keep their precision; integers, which may not hold a difference, as floats.
        relative = ((values.astype(np.float64) if values.dtype.kind in "iu" else values) - values[0]).astype(np.float64)
        position = np.arange(values.size << levels) / 2**levels + first_child(levels)
        cell = np.clip(np.floor(position).astype(int), 0, values.size - 2)
        offset = relative[cell] + (position - cell) * (relative[cell + 1] - relative[cell])
        if values.dtype.kind in "mM":
            return np.asarray(values[0] + np.rint(offset).astype("m8[ns]"))
        return np.asarray(values[0] + offset)
