# SPDX-License-Identifier: Apache-2.0
"""Writes what the fuzzers begin with, small and of every kind: make_seeds.py FOLDER, for test/fuzz/corpus."""
import gzip
import sys
import zlib
from pathlib import Path

META = ("ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = {packed}\n"
        "{more}TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 1 -2 0.5\nElementSpacing = 0.5 0.5 2\nDimSize = 2 3 2\n"
        "ElementType = MET_SHORT\nElementDataFile = {data}\n")
NRRD = ("NRRD0005\ntype: {kind}\ndimension: {axes}\n{space}sizes: {sizes}\n{more}endian: {endian}\n"
        "encoding: {encoding}\n")
LPS = ("space: {}\nspace directions: {}(0.5,0,0) (0,0.5,0) (0,0,2)\nspace origin: (1,-2,0.5)\n")
VOXELS = bytes(range(24))
OME = ('<?xml version="1.0"?><OME><Image><Pixels DimensionOrder="XYCZT" SizeX="4" SizeY="4" SizeZ="2" SizeC="2" '
       'SizeT="1" PhysicalSizeX="0.5" PhysicalSizeXUnit="mm">{}</Pixels></Image></OME>')


def headers():
    """Files of HeaderFuzz: a byte that chooses the format, and the file."""
    def meta(data="LOCAL", packed="False", more="", voxels=VOXELS):
        return b"\0" + META.format(data=data, packed=packed, more=more).encode() + voxels

    def nrrd(voxels=VOXELS, kind="int16", axes=3, space="", sizes="2 3 2", more="", endian="little", encoding="raw"):
        text = NRRD.format(kind=kind, axes=axes, space=space, sizes=sizes, more=more, endian=endian, encoding=encoding)
        return b"\3" + text.encode() + b"\n" + voxels

    yield meta()
    yield meta(packed="True", voxels=zlib.compress(VOXELS))
    yield meta(more="HeaderSize = -1\nModality = MET_MOD_CT\nDistanceUnits = um\nName = a\n")
    yield meta(data="data.raw", more="HeaderSize = 40\n", voxels=b"")
    yield meta(data="LIST\n" + "data.raw\n" * 2, voxels=b"")
    yield meta(more="ElementNumberOfChannels = 3\n", voxels=VOXELS * 3)
    yield nrrd()
    yield nrrd(space=LPS.format("left-posterior-superior", ""))
    yield nrrd(space=LPS.format("RAS", ""), endian="big", more="Segment0_LabelValue:=1\nkey:=a\\nb\n")
    yield nrrd(axes=4, sizes="3 2 3 2", space=LPS.format("LAS", "none "), more="kinds: RGB-color domain domain domain\n",
               voxels=VOXELS * 3)
    yield nrrd(more="spacings: 0.5 0.5 2\naxis mins: 0 0 0\ncenters: cell cell node\nunits: \"mm\" \"mm\" \"mm\"\n")
    yield nrrd(voxels=gzip.compress(VOXELS, mtime=0), encoding="gzip", more="byte skip: 0\n")
    yield nrrd(voxels=b"", more="byte skip: -1\ndata file: data.raw\n")
    yield nrrd(voxels=b"data.raw\n", kind="uchar", sizes="4 4 4", more="data file: LIST\n").replace(b"\n\n", b"\n")


def texts():
    """Texts of TextFuzz: a byte that chooses the parser, and what it reads."""
    for layout in ("4x3x2:uint16", "4x3:float:3:big+512", "1x1x1x1:int8"):
        yield b"\0" + layout.encode()
    for size in ("500M", "0.5G", "1.5GiB", "1e3"):
        yield b"\1" + size.encode()
    for piece in ("3/16", "status", "rank"):
        yield b"\2" + piece.encode()
    for number, value in enumerate(("1.2.3", "0.5,0.5,2", "1,-2,3", "1", "0", "4x3x2:uint16")):
        yield bytes([3, number]) + value.encode()
    yield b"\4ImageJ=1.53\nimages=6\nslices=3\nchannels=2\nunit=um\nspacing=-0.5\ncf=0\nc0=-32768\nc1=1\n"
    # More planes than 64 bits count.
    yield b"\4ImageJ=1.53\nimages=999999999\nslices=999999999\n"
    yield b"\5\4" + OME.format('<TiffData/>').encode()
    yield b"\5\4" + OME.format('<TiffData IFD="0" FirstZ="1" PlaneCount="2"/><TiffData IFD="2" PlaneCount="2"/>').encode()
    yield b"\5\4" + OME.format("").replace('"2"', '"8388608"').replace('SizeT="1"', 'SizeT="262144"').encode()
    yield b"\5\4" + OME.format('<TiffData FirstZ="9223372036854775808"/>').encode()
    yield b"\6" + b"1 2.5 -3e5"
    yield b"\6" + b"\xff\xff\xff\xff\xff\xff\xef\x7f"
    yield b"\7\1\5\2slice%03d.raw"
    yield b"\x08" + zlib.compress(bytes(100))
    yield b"\x08" + gzip.compress(bytes(range(100)), mtime=0)
    for shared in (2, 6, 10, 18, 46):
        yield bytes([9, shared, 3]) + bytes(range(120, 180))


def runs():
    """Choices of SubdividerFuzz, which makes sense of any bytes."""
    for kind in (0, 20, 31):
        for seed in range(8):
            yield bytes([kind]) + bytes((97 * seed + 31 * i * i + 7 * i) % 256 for i in range(60))


def main():
    for name, seeds in (("header", headers()), ("text", texts()), ("subdivider", runs())):
        folder = Path(sys.argv[1], name)
        folder.mkdir(parents=True, exist_ok=True)
        for number, seed in enumerate(seeds):
            (folder / f"seed{number:02}").write_bytes(seed)


if __name__ == "__main__":
    main()
