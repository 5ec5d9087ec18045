# SPDX-License-Identifier: Apache-2.0
"""Zarr stores for tests, and how other libraries read them."""

import pytest

zarr = pytest.importorskip("zarr")

SCALE, TRANSLATION = [2.0, 0.5, 0.25], [10.0, 20.0, -30.0]
NEW_SCALE, NEW_TRANSLATION = [1.0, 0.25, 0.125], [9.5, 19.875, -30.0625]


def write_plain(path, volume, zarr_format=3, chunks=(16, 16, 16), **options):
    array = zarr.create_array(
        path, shape=volume.shape, dtype=volume.dtype, chunks=chunks, zarr_format=zarr_format, **options
    )
    array[...] = volume


def write_ome(path, volume, version):
    """A pyramid of two levels as OME-Zarr's own library writes it."""
    from ome_zarr.format import FormatV04, FormatV05
    from ome_zarr.writer import write_multiscale

    group = zarr.open_group(path, mode="w", zarr_format=2 if version == "0.4" else 3)
    coarse = [scale * 2 for scale in SCALE]
    write_multiscale(
        [volume, volume[::2, ::2, ::2]],
        group,
        fmt=FormatV04() if version == "0.4" else FormatV05(),
        axes=[{"name": name, "type": "space", "unit": "millimeter"} for name in "zyx"],
        coordinate_transformations=[
            [{"type": "scale", "scale": SCALE}, {"type": "translation", "translation": TRANSLATION}],
            [{"type": "scale", "scale": coarse}, {"type": "translation", "translation": TRANSLATION}],
        ],
        storage_options={"chunks": (16, 20, 32)},
    )


def multiscale(path):
    attributes = zarr.open_group(path, mode="r").attrs.asdict()
    return attributes.get("ome", attributes)["multiscales"][0]


def read_by_tensorstore(path, zarr_format):
    tensorstore = pytest.importorskip("tensorstore")
    driver = "zarr" if zarr_format == 2 else "zarr3"
    store = {"driver": driver, "kvstore": {"driver": "file", "path": str(path)}}
    return tensorstore.open(store, open=True, read=True).result().read().result()
