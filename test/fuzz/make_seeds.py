# SPDX-License-Identifier: Apache-2.0
"""Writes what the fuzzers begin with, small and of every kind: make_seeds.py FOLDER, for test/fuzz/corpus."""
import gzip
import struct
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
    yield meta(voxels=b"1 -2 3\n" + b"4 " * 9).replace(b"BinaryData = True", b"BinaryData = False")
    yield nrrd(voxels=b"1 -2,3\n" + b"4 " * 9, encoding="text")
    yield nrrd(voxels=VOXELS.hex(" ").encode(), endian="big", encoding="hex")
    yield nrrd(axes=4, sizes="6 2 3 2", space=LPS.format("LPS", "none "), kind="uchar",
               more="kinds: 3D-symmetric-matrix domain domain domain\n", voxels=VOXELS * 3)


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


def nifti(order="<", code=4, bits=16, sizes=(2, 3, 2), slope=0.0, intercept=0.0, magic=b"n+1", offset=352.0, intent=0):
    """A header of NIfTI-1 with both placements, and what stands between it and the voxels of a single file."""
    header = bytearray(352)
    pack = lambda place, kinds, *numbers: struct.pack_into(order + kinds, header, place, *numbers)
    pack(0, "i", 348)
    pack(40, "8h", len(sizes), *sizes, *[1] * (7 - len(sizes)))
    pack(68, "3h", intent, code, bits)
    pack(76, "8f", 1, *[0.5] * 7)
    pack(108, "3f", offset, slope, intercept)
    header[123] = 2 | 8
    pack(252, "2h", 1, 1)
    pack(256, "6f", 0, 0, 0, 1, -2, 3)
    pack(280, "12f", 0.5, 0, 0, 1, 0, 0.5, 0, -2, 0, 0, 0.5, 3)
    header[344:347] = magic
    return bytes(header)


def jpeg(width, height, scan, components=1, frame=0xC0, spectrum=(0, 63)):
    """A JPEG file whose Huffman tables know the codes 0 (nothing more, no difference) and 10 (a difference of a bit)."""
    def segment(marker, content):
        return bytes([0xFF, marker]) + struct.pack(">H", len(content) + 2) + content

    ones = segment(0xDB, b"\0" + b"\1" * 64)
    tables = b"".join(segment(0xC4, number + bytes([1, 1]) + bytes(14) + b"\0\1") for number in (b"\0", b"\x10"))
    numbers = range(1, components + 1)
    size = struct.pack(">BHHB", 8, height, width, components)
    start = segment(frame, size + b"".join(bytes([number, 0x11, 0]) for number in numbers))
    chosen = b"".join(bytes([number, 0]) for number in numbers)
    order = segment(0xDA, bytes([components]) + chosen + bytes([*spectrum, 0]))
    return b"\xff\xd8" + ones + start + tables + order + scan + b"\xff\xd9"


def vtk(values, kind="SCALARS v short\nLOOKUP_TABLE default\n", points=4, after=b"", encoding="ASCII"):
    header = (f"# vtk DataFile Version 3.0\ntitle\n{encoding}\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 1\n"
              f"SPACING 1 1 1\nORIGIN 0 0 0\nPOINT_DATA {points}\n{kind}")
    return header.encode() + values + after


def files():
    """Files of FileFuzz: a byte that chooses the format, choices of each, and the file."""
    def volume(form, header, voxels=VOXELS, fits=0):
        return b"\0" + bytes(range(1, 17)) + bytes([form, fits]) + header + voxels

    for order in "<>":
        yield volume(0, nifti(order))
        yield volume(1, nifti(order, slope=0.5, intercept=-3))
        yield volume(3, nifti(order, magic=b"ni1", offset=0)[:348])
        for code, bits in ((2, 8), (8, 32), (16, 32), (32, 64), (64, 64), (128, 24), (256, 8), (512, 16), (768, 32),
                           (1024, 64), (1280, 64), (1792, 128), (2304, 32)):
            yield volume(0, nifti(order, code, bits), fits=1)
        for code, bits in ((2, 8), (8, 32), (16, 32), (64, 64), (1280, 64)):
            yield volume(0, nifti(order, code, bits, slope=-1.5, intercept=1000), fits=1)
        yield volume(0, nifti(order, sizes=(2, 3, 2, 1, 3), intent=1007), fits=1)
        yield volume(0, nifti(order, 16, 32, sizes=(2, 2, 1, 2, 2), slope=2), fits=1)
        yield volume(3, nifti(order, 16, 32, magic=b"ni1", offset=16, slope=2)[:348], fits=1)
        yield volume(3, nifti(order, magic=b"\0\0\0", offset=0, slope=7)[:348], fits=1)  # Analyze
    yield volume(2, gzip.compress(nifti() + VOXELS, mtime=0), b"")
    yield volume(2, gzip.compress(nifti() + VOXELS[:-1], mtime=0), b"")
    yield volume(4, nifti(magic=b"ni1", offset=0)[:348])
    yield volume(5, nifti(magic=b"ni1", offset=0)[:348])
    yield volume(0, nifti(), VOXELS[:-1])
    yield volume(0, nifti(), VOXELS + b"x")
    yield volume(1, nifti(), VOXELS + b"x")
    yield volume(0, nifti(offset=300), VOXELS)
    yield volume(0, nifti(intercept=1), VOXELS)
    yield volume(0, nifti(bits=32), VOXELS * 2)
    # A single file's header in a pair, the other way round, and one of a magic that is nobody's.
    yield volume(3, nifti()[:348], bytes(352) + VOXELS)
    yield volume(5, nifti()[:348], bytes(352) + VOXELS)
    yield volume(0, nifti(magic=b"ni1"))
    yield volume(0, nifti(magic=b"\0\0\0", offset=0))
    yield volume(0, nifti(magic=b"n+2"))
    yield volume(3, nifti(magic=b"ni2", offset=0, slope=7)[:348])
    # More voxels than 64 bits count, none of them there.
    yield volume(0, nifti(sizes=(32767,) * 7), VOXELS)

    def picture(*arguments, **names):
        return b"\3\x64\0" + jpeg(*arguments, **names)

    yield picture(8, 8, b"\x3f")
    yield picture(16, 16, b"\x00")
    yield picture(9, 8, b"\xbb\x0f")
    yield picture(8, 8, b"\x03", components=3)
    yield picture(8, 8, b"\x7f", frame=0xC2, spectrum=(0, 0))
    yield picture(8, 16, b"\x3f")
    yield picture(16, 8, b"")

    def grid(is_binary, kind, number, sizes, text):
        return b"\1" + bytes([is_binary, number, kind]) + bytes(size - 1 for size in sizes) + text

    vectors, tensors = "VECTORS v float\n", "TENSORS v float\n"
    yield grid(0, 0, 3, (2, 2, 1), vtk(b"1 -2 3e2 +4\n"))
    yield grid(0, 0, 3, (2, 2, 1), vtk(b"1 2 3 4 ", after=b"METADATA\nINFORMATION 0\n\n"))
    yield grid(0, 0, 0, (2, 2, 1), vtk(b"1 2 3 256"))
    yield grid(0, 0, 3, (2, 2, 1), vtk(b"1 2 3 4 5"))
    yield grid(0, 0, 3, (2, 2, 1), vtk(b"1 2 3 4", points=5))
    yield grid(0, 2, 8, (2, 2, 1), vtk(b"0.5 1 1e-3 " * 4, vectors))
    yield grid(0, 3, 8, (2, 1, 1), vtk(b"1 2 3 2 4 5 3 5 6\n" * 2, tensors, points=2))
    yield grid(1, 0, 3, (2, 2, 1), vtk(bytes(8), encoding="BINARY"))
    yield grid(1, 0, 3, (2, 2, 1), vtk(bytes(8), after=b"\nMETADATA\n", encoding="BINARY"))
    yield grid(1, 0, 3, (2, 2, 1), vtk(bytes(7), encoding="BINARY"))
    yield grid(1, 3, 8, (2, 1, 1), vtk(bytes(72), tensors, points=2, encoding="BINARY"))
    yield grid(1, 1, 0, (2, 2, 1), vtk(bytes(12), "COLOR_SCALARS v 3\n", encoding="BINARY"))
    yield grid(0, 0, 3, (2, 2, 1), vtk(b"1 2 3 4").replace(b"POINT_DATA", b"CELL_DATA"))

    def numbers(number, count, text, separators=0, parts=(3, 0, 7, 1)):
        return b"\2" + bytes([number, count, separators, *parts]) + text

    yield numbers(0, 4, b"0 255 1e2 5.0 ")
    yield numbers(1, 2, b"-128\n127\n")
    yield numbers(3, 3, b"1,2, -3", 1)
    yield numbers(4, 1, b"4294967296")
    yield numbers(6, 3, b"18446744073709551615 0 +7")
    yield numbers(7, 3, b"-9223372036854775808 9007199254740993 9007199254740993.0")
    yield numbers(8, 5, b"3.4028235e38 1e-45 0.1 nan -inf")
    yield numbers(9, 5, b"1.7976931348623157e308 5e-324 1e-400 1e-5000 0.1")
    yield numbers(9, 1, b"1e400")
    yield numbers(9, 1, b"1" + b"0" * 320 + b"e-5")
    yield numbers(9, 2, b"0." + b"0" * 350 + b"1 -0." + b"0" * 350 + b"1e5")
    yield numbers(9, 2, b"0." + b"3" * 390 + b" " + b"1" * 401)
    yield numbers(2, 2, b"1 2 SCALARS")

    def length(number, size, text):
        return b"\4" + bytes([number, size % 256, size // 256]) + text

    yield length(0, 0, b"BM" + struct.pack("<I", 60) + bytes(54))
    yield length(0, 0, b"BM" + struct.pack("<I", 61) + bytes(54))
    yield length(1, 24, bytes(256) + VOXELS)
    mrc = bytearray(1024)
    struct.pack_into("<3i", mrc, 64, 1, 2, 3)
    yield length(2, 24, bytes(mrc) + VOXELS)
    struct.pack_into("<i", mrc, 92, 8)
    yield length(2, 16, bytes(mrc) + VOXELS)
    mrc[212] = 0x11
    yield length(2, 16, bytes(mrc) + VOXELS)
    for number in range(9):
        yield b"\5" + bytes([number]) + b"scan.img"
    yield b"\5\x08scan.Img.Gz"
    yield b"\5\x08scan.nii.gz"


def runs():
    """Choices of SubdividerFuzz, which makes sense of any bytes."""
    for kind in (0, 20, 31):
        for seed in range(8):
            yield bytes([kind]) + bytes((97 * seed + 31 * i * i + 7 * i) % 256 for i in range(60))


def main():
    for name, seeds in (("header", headers()), ("text", texts()), ("subdivider", runs()), ("file", files())):
        folder = Path(sys.argv[1], name)
        folder.mkdir(parents=True, exist_ok=True)
        for number, seed in enumerate(seeds):
            (folder / f"seed{number:02}").write_bytes(seed)


if __name__ == "__main__":
    main()
