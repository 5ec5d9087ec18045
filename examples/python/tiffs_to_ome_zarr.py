# SPDX-License-Identifier: Apache-2.0
"""A folder of TIFF slices as a doubled OME-Zarr image: tiffs_to_ome_zarr.py FOLDER OUT.zarr VOXEL_SIZE_IN_MM

Nothing but a few chunks is in memory at once. OUT.zarr is a group with one level; other programs can add coarser ones.
"""

import re
import sys
from pathlib import Path

import dask.array
import tifffile
import zarr
from dask.diagnostics import ProgressBar
from nonoscillatory_subdivision import subdivide, subdivided_grid


def natural_order(path):
    """slice_9 comes before slice_10."""
    return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", path.name)]


def read_slices(folder):
    """A lazy volume with a chunk for each slice."""
    paths = sorted((path for path in folder.iterdir() if path.suffix.lower() in (".tif", ".tiff")), key=natural_order)
    if not paths:
        sys.exit(f"{folder} has no TIFF files")
    with tifffile.TiffSequence(paths).aszarr() as store:
        return dask.array.from_zarr(store)


def write_ome_zarr(volume, path, spacing, origin):
    group = zarr.create_group(path, zarr_format=3)
    chunks = tuple(min(128, size) for size in volume.shape)
    array = group.create_array("0", shape=volume.shape, dtype=volume.dtype, chunks=chunks, dimension_names=list("zyx"))
    with ProgressBar():
        dask.array.store(volume.rechunk(chunks), array, lock=False)
    transformations = [
        {"type": "scale", "scale": spacing.tolist()},
        {"type": "translation", "translation": origin.tolist()},
    ]
    image = {
        "axes": [{"name": name, "type": "space", "unit": "millimeter"} for name in "zyx"],
        "datasets": [{"path": "0", "coordinateTransformations": transformations}],
    }
    group.attrs["ome"] = {"version": "0.5", "multiscales": [image]}


slices = read_slices(Path(sys.argv[1]))
# Chunks of some size keep the halo small.
doubled = subdivide(slices.rechunk(tuple(min(64, size) for size in slices.shape)))
write_ome_zarr(doubled, sys.argv[2], *subdivided_grid([float(sys.argv[3])] * 3, [0, 0, 0]))
print(f"{slices.shape} -> {doubled.shape} {doubled.dtype}")
