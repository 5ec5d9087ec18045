# SPDX-License-Identifier: Apache-2.0
"""Images in Zarr stores: plain arrays, and OME-Zarr 0.4 (Zarr 2) and 0.5 (Zarr 3)."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import zarr

from . import _arguments
from ._grid import first_child
from ._run import doubled_shape


@dataclass(frozen=True)
class Image:
    """An array in a store and, if it is the finest level of an OME-Zarr image, what the group says of it."""

    path: str
    array: Any
    array_path: str
    # The group's attributes and, within them, the image; None for a plain array.
    attributes: dict[str, Any] | None = None
    multiscale: dict[str, Any] | None = None

    @property
    def is_version_5(self) -> bool:
        return self.attributes is not None and "ome" in self.attributes

    def axes_to_subdivide(self, names: Sequence[str] | None) -> tuple[int, ...]:
        """The positions of the named axes. Default: those of space, or the last three of a plain array."""
        if self.multiscale is None:
            positions = None if names is None else [_position(name) for name in names]
            return _arguments.checked_axes(positions, self.array.ndim, None)
        described = self.multiscale["axes"]
        known = [axis["name"] for axis in described]
        if names is None:
            names = [axis["name"] for axis in described if axis.get("type") == "space"]
        for name in names:
            if name not in known:
                raise ValueError(f"axis {name!r} is none of {', '.join(known)}")
        return _arguments.checked_axes([known.index(name) for name in names], self.array.ndim, None)


def _position(name: str) -> int:
    try:
        return int(name)
    except ValueError:
        raise ValueError(f"axis {name!r}: axes of a plain array are numbers, 0 is the first") from None


def open_image(path: str, is_labels: bool) -> Image:
    try:
        node = zarr.open(path, mode="r")
    except (FileNotFoundError, zarr.errors.NodeNotFoundError):
        raise ValueError(f"{path} is neither a Zarr array nor a Zarr group") from None
    if isinstance(node, zarr.Array):
        return Image(path, node, path)
    attributes: dict[str, Any] = node.attrs.asdict()
    described: dict[str, Any] = attributes.get("ome", attributes)
    if "image-label" in described and not is_labels:
        raise ValueError(f"{path} is a label image, whose labels would be blended: say that they are labels")
    if not described.get("multiscales"):
        raise ValueError(
            f"{path} is a group without an image (no 'multiscales'): name the group of one image, or an array"
        )
    multiscale: dict[str, Any] = described["multiscales"][0]
    axes = multiscale.get("axes", [])
    if not axes or not all(isinstance(axis, dict) and "name" in axis for axis in axes):
        raise ValueError(f"{path} does not describe its axes as OME-Zarr 0.4 and 0.5 do")
    if "ome" in attributes and "version" not in described:
        raise ValueError(f"{path} does not say its version of OME-Zarr")
    datasets = multiscale.get("datasets")
    name = datasets[0].get("path") if datasets else None
    array = node[name] if name is not None and name in node else None
    if not isinstance(array, zarr.Array):
        raise ValueError(f"{path} has no array at the path of its finest level, {name}")
    if array.ndim != len(axes):
        raise ValueError(f"{path} describes {len(axes)} axes, but {name} has {array.ndim}")
    return Image(path, array, f"{path.rstrip('/')}/{name}", attributes, multiscale)


def state_of(array_path: str) -> str:
    """What changes where the files of an array do: a checksum of their names, sizes and times. Empty for an array that
    is not one of the file system."""
    path = Path(array_path)
    if not path.exists():
        return ""
    checksum = hashlib.sha256()
    for file in [path] if path.is_file() else sorted(path.rglob("*")):
        status = file.stat()
        if not file.is_dir():
            checksum.update(f"{file.relative_to(path)} {status.st_size} {status.st_mtime_ns}\n".encode())
    return checksum.hexdigest()


def create_array(
    path: str, image: Image, axes: Sequence[int], levels: int, chunks: Sequence[int] | None, is_labels: bool
) -> Any:
    """An empty array for the result, like that of the image in all but its shape; chunks, if any are given."""
    source = image.array
    dtype = (_arguments.label_type if is_labels else _arguments.result_type)(source.dtype, None)
    same_type = dtype == source.dtype.newbyteorder("=")
    metadata = source.metadata
    options: dict[str, Any] = {}
    if source.metadata.zarr_format == 2:
        options["chunk_key_encoding"] = {"name": "v2", "separator": metadata.dimension_separator}
        options["order"] = metadata.order
    else:
        options["chunk_key_encoding"] = metadata.chunk_key_encoding
        options["dimension_names"] = metadata.dimension_names
        if same_type:
            options["serializer"] = source.serializer
    if same_type:
        options |= {"filters": source.filters, "fill_value": source.fill_value}
    # The names of the axes; other attributes of an array may describe the old grid.
    kept = {name: value for name, value in source.attrs.items() if name == "_ARRAY_DIMENSIONS"}
    return zarr.create_array(
        path,
        shape=doubled_shape(source.shape, axes, levels),
        chunks=tuple(source.chunks if chunks is None else chunks),
        shards=source.shards if chunks is None else None,
        dtype=source.dtype if same_type else dtype,
        zarr_format=metadata.zarr_format,
        compressors=source.compressors,
        attributes=kept,
        **options,
    )


def write_new_group(path: str, image: Image, axes: Sequence[int], levels: int, array_name: str) -> None:
    """Describes the result, an array in a group of its own, as an image of one level."""
    assert image.attributes is not None and image.multiscale is not None
    described = image.attributes.get("ome", image.attributes)
    multiscale: dict[str, Any] = {key: image.multiscale[key] for key in ("version", "name") if key in image.multiscale}
    multiscale["axes"] = image.multiscale["axes"]
    multiscale["datasets"] = [dataset(image, axes, levels, array_name)]
    if "coordinateTransformations" in image.multiscale:
        multiscale["coordinateTransformations"] = image.multiscale["coordinateTransformations"]
    result: dict[str, Any] = {"multiscales": [multiscale]}
    if "omero" in described:
        # How channels are shown; the slice to show first is left out, as it is one of the old grid.
        result["omero"] = {key: value for key, value in described["omero"].items() if key != "rdefs"}
    if "image-label" in described:
        # Colours and the like; the image that the labels belong to is another one.
        result["image-label"] = {key: value for key, value in described["image-label"].items() if key != "source"}
    if image.is_version_5:
        result = {"ome": {"version": described["version"]} | result}
    zarr.open_group(path, mode="r+").attrs.update(result)


def prepend_level(image: Image, axes: Sequence[int], levels: int, array_name: str) -> None:
    """Makes the result, an array in the image's own group, the finest level of its pyramid."""
    attributes = deepcopy(image.attributes)
    assert attributes is not None
    described = attributes.get("ome", attributes)
    described["multiscales"][0]["datasets"].insert(0, dataset(image, axes, levels, array_name))
    group = zarr.open_group(image.path, mode="r+")
    # A copy of all descriptions, where there is one, comes first for readers, and would not know of the level.
    is_consolidated = group.metadata.consolidated_metadata is not None
    zarr.open_group(image.path, mode="r+", use_consolidated=False).attrs.update(attributes)
    if is_consolidated:
        zarr.consolidate_metadata(image.path)


def dataset(image: Image, axes: Sequence[int], levels: int, array_name: str) -> dict[str, Any]:
    """The description of the result as a level of the image.

    Raises ValueError if the image's transformations are not of a kind that can be taken along."""
    assert image.multiscale is not None
    scale, translation = _scale_and_translation(image.multiscale["datasets"][0], image.array.ndim)
    for axis in axes:
        translation[axis] += scale[axis] * first_child(levels)
        scale[axis] /= 2**levels
    transformations = [{"type": "scale", "scale": scale}, {"type": "translation", "translation": translation}]
    return {"path": array_name, "coordinateTransformations": transformations}


def _scale_and_translation(dataset: dict[str, Any], dimension: int) -> tuple[list[float], list[float]]:
    scale, translation = [1.0] * dimension, [0.0] * dimension
    for transformation in dataset.get("coordinateTransformations", []):
        kind = transformation.get("type")
        if kind == "scale" and "scale" in transformation:
            scale = [float(value) for value in transformation["scale"]]
        elif kind == "translation" and "translation" in transformation:
            translation = [float(value) for value in transformation["translation"]]
        elif kind != "identity":
            raise ValueError(f"coordinate transformation {transformation} is neither a scale nor a translation")
    if len(scale) != dimension or len(translation) != dimension:
        raise ValueError(f"the coordinate transformations of level {dataset['path']!r} do not have {dimension} numbers")
    return scale, translation
