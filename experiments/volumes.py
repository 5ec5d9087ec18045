# SPDX-License-Identifier: Apache-2.0
"""Volumes on disk and as arrays.

An array's axes are [z, y, x], and a spacing is given in the same order, so `spacing[0]` belongs to axis 0.
Formats: MetaImage (MHA, MHD) and NRRD (attached and detached header), raw or zlib, scalar, three axes.
"""
import gzip
import os
import pathlib
import tarfile
import zlib
from dataclasses import dataclass

import numpy as np

CRANIUM = pathlib.Path("/usr/share/doc/invesalius-examples/examples/Cranium.inv3")
TRABECULAR = pathlib.Path(
    os.environ.get("TRABECULAR_VOLUME")
    or pathlib.Path(__file__).resolve().parents[2] / "shared/data/trabecular_uct_LHDL.mha"
)

META_TYPES = {
    "MET_CHAR": "i1", "MET_UCHAR": "u1", "MET_SHORT": "i2", "MET_USHORT": "u2",
    "MET_INT": "i4", "MET_UINT": "u4", "MET_FLOAT": "f4", "MET_DOUBLE": "f8",
}  # fmt: skip
NRRD_TYPES = {
    "signed char": "i1", "int8": "i1", "uchar": "u1", "unsigned char": "u1", "uint8": "u1",
    "short": "i2", "int16": "i2", "ushort": "u2", "unsigned short": "u2", "uint16": "u2",
    "int": "i4", "int32": "i4", "uint": "u4", "unsigned int": "u4", "uint32": "u4",
    "float": "f4", "double": "f8",
}  # fmt: skip


class VolumeError(Exception):
    """A volume that cannot be read, in one line."""


@dataclass
class Volume:
    """A name, the voxels [z, y, x] and the spacing (z, y, x) in millimetres."""

    name: str
    data: np.ndarray
    spacing: tuple


def _as_array(content, kind, big_endian, sizes_xyz):
    """The voxels as [z, y, x] in the machine's byte order."""
    expected = int(np.prod(sizes_xyz)) * np.dtype(kind).itemsize
    if len(content) < expected:
        raise VolumeError(f"truncated: {len(content)} bytes of voxels where {expected} are needed")
    stored = np.frombuffer(content[:expected], dtype=(">" if big_endian else "<") + kind)
    return stored.reshape(sizes_xyz[::-1]).astype(kind)


def _lookup(table, key, what):
    if key not in table:
        raise VolumeError(f"{what} '{key}' is not one of: {', '.join(table)}")
    return table[key]


def _read_meta(path):
    header = {}
    with open(path, "rb") as stream:
        while "ElementDataFile" not in header:
            line = stream.readline()
            if b"=" not in line:
                raise VolumeError("not a MetaImage header")
            key, value = line.decode("latin-1").split("=", 1)
            header[key.strip()] = value.strip()
        content = stream.read()
    if header["ElementDataFile"] != "LOCAL":
        content = (path.parent / header["ElementDataFile"]).read_bytes()
    if header.get("CompressedData", "False") == "True":
        content = zlib.decompress(content)
    kind = _lookup(META_TYPES, header.get("ElementType"), "ElementType")
    big_endian = header.get("BinaryDataByteOrderMSB", header.get("ElementByteOrderMSB", "False")) == "True"
    sizes = [int(n) for n in header["DimSize"].split()]
    spacing = [float(s) for s in header.get("ElementSpacing", "1 " * len(sizes)).split()]
    return _as_array(content, kind, big_endian, sizes), tuple(spacing[::-1])


def _nrrd_spacing(header, dimension):
    if "spacings" in header:
        return [float(s) for s in header["spacings"].split()]
    if "space directions" in header:
        vectors = header["space directions"].replace(" ", "").strip("()").split(")(")
        return [float(np.linalg.norm([float(v) for v in vector.split(",")])) for vector in vectors]
    return [1.0] * dimension


def _read_nrrd(path):
    header = {}
    with open(path, "rb") as stream:
        if not stream.readline().startswith(b"NRRD"):
            raise VolumeError("not an NRRD header")
        for line in iter(stream.readline, b""):
            text = line.decode("latin-1").strip()
            if not text:
                break
            if not text.startswith("#") and ": " in text:
                key, value = text.split(": ", 1)
                header[key.lower()] = value.strip()
        content = stream.read()
    detached = header.get("data file", header.get("datafile"))
    if detached:
        content = (path.parent / detached).read_bytes()
    if header["encoding"] in ("gzip", "gz"):
        content = gzip.decompress(content)
    elif header["encoding"] != "raw":
        raise VolumeError(f"NRRD encoding '{header['encoding']}' is neither raw nor gzip")
    kind = _lookup(NRRD_TYPES, header["type"], "NRRD type")
    sizes = [int(n) for n in header["sizes"].split()]
    spacing = _nrrd_spacing(header, len(sizes))
    return _as_array(content, kind, header.get("endian") == "big", sizes), tuple(spacing[::-1])


def read_volume(path):
    """Read an MHA, MHD, NRRD or NHDR file. Raises VolumeError, in one line, where that fails."""
    path = pathlib.Path(path)
    readers = {".mha": _read_meta, ".mhd": _read_meta, ".nrrd": _read_nrrd, ".nhdr": _read_nrrd}
    try:
        data, spacing = _lookup(readers, path.suffix.lower(), "file type")(path)
        if data.ndim != 3:
            raise VolumeError(f"has {data.ndim} axes where three are needed")
    except (VolumeError, OSError, KeyError, ValueError, zlib.error) as error:
        raise VolumeError(f"{path}: {error}") from None
    return Volume(path.stem, data, spacing)


def write_volume(path, data, spacing=(1.0, 1.0, 1.0)):
    """Write an uncompressed MHA; the pixel type is the array's."""
    kinds = {kind: name for name, kind in META_TYPES.items()}
    data = np.ascontiguousarray(data, dtype=data.dtype.newbyteorder("<"))
    header = (
        f"ObjectType = Image\nNDims = {data.ndim}\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
        f"ElementSpacing = {' '.join(repr(float(s)) for s in spacing[::-1])}\n"
        f"DimSize = {' '.join(str(n) for n in data.shape[::-1])}\n"
        f"ElementType = {kinds[data.dtype.str[1:]]}\nElementDataFile = LOCAL\n"
    )
    with open(path, "wb") as stream:
        stream.write(header.encode("ascii"))
        stream.write(data.tobytes())


def cranium():
    """The CT of Debian's package invesalius-examples: 108 slices of 256 by 256, signed 16 bit."""
    with tarfile.open(CRANIUM) as archive:
        member = next(m for m in archive.getmembers() if m.name.endswith("matrix.dat"))
        content = archive.extractfile(member).read()
    return Volume("cranium", _as_array(content, "i2", False, (256, 256, 108)), (1.5, 0.95703, 0.95703))


def sample_volumes(paths=()):
    """The volumes that the CT experiments run on, and a note for each one that is absent."""
    volumes, notes = [], []
    if CRANIUM.exists():
        volumes.append(cranium())
    else:
        notes.append("Skipped: the cranium CT; install Debian's package invesalius-examples to have it.")
    if TRABECULAR.exists():
        volumes.append(read_volume(TRABECULAR))
    else:
        notes.append("Skipped: the trabecular bone micro-CT; its file is not on this machine.")
    return volumes + [read_volume(path) for path in paths], notes


def central_region(volume, size):
    """The central box of at most `size` voxels along each axis, even in every axis."""
    kept = [min(n, size) // 2 * 2 for n in volume.data.shape]
    box = tuple(slice((n - k) // 2, (n - k) // 2 + k) for n, k in zip(volume.data.shape, kept))
    return Volume(volume.name, np.ascontiguousarray(volume.data[box]), volume.spacing)
