# SPDX-License-Identifier: Apache-2.0
"""Image files for the tests of SubdivideVolume, written and read without any image library."""

import array
import gzip
import struct
import zlib

# MetaImage's names for the types of the array module, and those of the command line.
META_TYPES = {"B": "UCHAR", "b": "CHAR", "H": "USHORT", "h": "SHORT", "I": "UINT", "i": "INT",
              "Q": "ULONG_LONG", "q": "LONG_LONG", "f": "FLOAT", "d": "DOUBLE"}
OPTION_TYPES = {"B": "uint8", "b": "int8", "H": "uint16", "h": "int16", "I": "uint32", "i": "int32",
                "Q": "uint64", "q": "int64", "f": "float", "d": "double"}
NRRD_TYPES = {"B": "uchar", "h": "short", "H": "ushort", "f": "float", "d": "double"}


def joined(numbers):
    return " ".join(str(number) for number in numbers)


def meta_header(size, pixel, channels=1, spacing=None, data_file="LOCAL", more=()):
    lines = ["ObjectType = Image", f"NDims = {len(size)}", "BinaryData = True", "BinaryDataByteOrderMSB = False",
             f"ElementSpacing = {joined(spacing or [1] * len(size))}", f"DimSize = {joined(size)}", *more]
    if channels > 1:
        lines.append(f"ElementNumberOfChannels = {channels}")
    return "\n".join(lines + [f"ElementType = MET_{META_TYPES[pixel]}", f"ElementDataFile = {data_file}", ""]).encode()


def write_meta(path, size, pixel, values, **header):
    with open(path, "wb") as file:
        file.write(meta_header(size, pixel, **header) + array.array(pixel, values).tobytes())


def write_compressed_meta(path, size, pixel, values):
    data = zlib.compress(array.array(pixel, values).tobytes())
    more = ["CompressedData = True", f"CompressedDataSize = {len(data)}"]
    with open(path, "wb") as file:
        file.write(meta_header(size, pixel, more=more) + data)


def write_nrrd(path, size, pixel, values, encoding="raw", more=()):
    lines = ["NRRD0004", f"type: {NRRD_TYPES[pixel]}", f"dimension: {len(size)}", f"sizes: {joined(size)}",
             f"encoding: {encoding}", "endian: little", *more, "", ""]
    data = array.array(pixel, values).tobytes()
    with open(path, "wb") as file:
        file.write("\n".join(lines).encode() + (gzip.compress(data) if encoding == "gzip" else data))


def write_nifti(path, size, values, numbers=()):
    """16-bit voxels, one file; the name's ending says whether it is compressed. Numbers that are put into the header: a
    format of struct, a place and values."""
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, len(size), *size, *[1] * (7 - len(size)))
    struct.pack_into("<2h", header, 70, 4, 16)
    struct.pack_into("<8f", header, 76, *[1] * 8)
    struct.pack_into("<f", header, 108, 352)
    struct.pack_into("<f", header, 112, 1)
    header[344:348] = b"n+1\0"
    for kind, place, *words in numbers:
        struct.pack_into(kind, header, place, *words)
    data = bytes(header) + array.array("h", values).tobytes()
    with open(path, "wb") as file:
        file.write(gzip.compress(data) if path.endswith(".gz") else data)


def write_tiff(path, width, height, values):
    """A page of 16-bit grey values in one strip."""
    data = array.array("H", values).tobytes()
    short, long = 3, 4
    tags = [(256, long, width), (257, long, height), (258, short, 16), (259, short, 1), (262, short, 1), (273, long, 8),
            (277, short, 1), (278, long, height), (279, long, len(data))]
    directory = struct.pack("<H", len(tags))
    for tag, kind, value in tags:
        directory += struct.pack("<HHI", tag, kind, 1) + struct.pack("<I" if kind == long else "<Hxx", value)
    with open(path, "wb") as file:
        file.write(struct.pack("<2sHI", b"II", 42, 8 + len(data)) + data + directory + bytes(4))


def dicom_element(group, element, kind, value):
    value += b"\0" * (len(value) % 2) if kind in ("UI", "OW") else b" " * (len(value) % 2)
    length = struct.pack("<HI", 0, len(value)) if kind == "OW" else struct.pack("<H", len(value))
    return struct.pack("<HH", group, element) + kind.encode() + length + value


def write_dicom_slice(path, series, number, size, values, spacing):
    """A CT slice of 16-bit signed voxels, explicit little endian, `number` slices above the first."""
    sop = b"1.2.840.10008.5.1.4.1.1.2"
    instance = f"{series}.{number + 1}".encode()
    meta = (dicom_element(2, 2, "UI", sop) + dicom_element(2, 3, "UI", instance) +
            dicom_element(2, 0x10, "UI", b"1.2.840.10008.1.2.1"))
    position = f"0\\0\\{number * spacing[2]}".encode()

    def short(value):
        return struct.pack("<H", value)

    data = b"".join([
        dicom_element(8, 0x16, "UI", sop), dicom_element(8, 0x18, "UI", instance),
        dicom_element(8, 0x60, "CS", b"CT"),
        dicom_element(0x20, 0x0D, "UI", b"1.2.3"), dicom_element(0x20, 0x0E, "UI", series.encode()),
        dicom_element(0x20, 0x13, "IS", str(number + 1).encode()), dicom_element(0x20, 0x32, "DS", position),
        dicom_element(0x20, 0x37, "DS", b"1\\0\\0\\0\\1\\0"),
        dicom_element(0x28, 2, "US", short(1)), dicom_element(0x28, 4, "CS", b"MONOCHROME2"),
        dicom_element(0x28, 0x10, "US", short(size[1])), dicom_element(0x28, 0x11, "US", short(size[0])),
        dicom_element(0x28, 0x30, "DS", f"{spacing[1]}\\{spacing[0]}".encode()),
        dicom_element(0x28, 0x100, "US", short(16)), dicom_element(0x28, 0x101, "US", short(16)),
        dicom_element(0x28, 0x102, "US", short(15)), dicom_element(0x28, 0x103, "US", short(1)),
        dicom_element(0x7FE0, 0x10, "OW", array.array("h", values).tobytes()),
    ])
    with open(path, "wb") as file:
        file.write(b"\0" * 128 + b"DICM" + dicom_element(2, 0, "UL", struct.pack("<I", len(meta))) + meta + data)


class Meta:
    """A MetaImage file: its header's fields and its values."""

    def __init__(self, path):
        with open(path, "rb") as file:
            content = file.read()
        end = content.index(b"\n", content.index(b"ElementDataFile")) + 1
        self.fields = dict(line.split(" = ", 1) for line in content[:end].decode().splitlines())
        data = content[end:]
        if self.fields["ElementDataFile"] != "LOCAL":
            with open(path.rsplit("/", 1)[0] + "/" + self.fields["ElementDataFile"], "rb") as file:
                data = file.read()
        if self.fields.get("CompressedData") == "True":
            data = zlib.decompress(data)
        names = {f"MET_{name}": pixel for pixel, name in META_TYPES.items()}
        names.update(MET_LONG="q", MET_ULONG="Q")
        self.pixel = names[self.fields["ElementType"]]
        self.data = data
        self.values = array.array(self.pixel, data)
        self.size = [int(word) for word in self.fields["DimSize"].split()]

    def numbers(self, field):
        return [float(word) for word in self.fields[field].split()]


def read_nrrd(path):
    """Header lines and data of a raw or gzip NRRD."""
    with open(path, "rb") as file:
        content = file.read()
    end = content.index(b"\n\n")
    header = content[:end].decode().splitlines()
    data = content[end + 2:]
    return header, gzip.decompress(data) if "encoding: gzip" in header else data
