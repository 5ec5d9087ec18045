# SPDX-License-Identifier: Apache-2.0
"""Voxels as text are read as exactly the numbers that are there, or the file is refused."""

import array
import json
import struct
import unittest

from subdivide_volume_case import ProgramTest, noise
from subdivide_volume_files import META_TYPES, Meta, joined, meta_header, write_meta

NRRD_TYPES = {"B": "uchar", "b": "signed char", "H": "ushort", "h": "short", "I": "uint", "i": "int", "Q": "uint64",
              "q": "int64", "f": "float", "d": "double"}
VTK_TYPES = {"B": "unsigned_char", "b": "char", "H": "unsigned_short", "h": "short", "I": "unsigned_int", "i": "int",
             "Q": "vtktypeuint64", "q": "vtktypeint64", "f": "float", "d": "double"}


def meta(pixel, size, more=()):
    return meta_header(size, pixel, more=more).replace(b"BinaryData = True", b"BinaryData = False")


def nrrd(pixel, size):
    return (f"NRRD0004\ntype: {NRRD_TYPES[pixel]}\ndimension: {len(size)}\nsizes: {joined(size)}\n"
            "encoding: ascii\n\n").encode()


def vtk(pixel, size, attribute=None):
    points = size[0] * size[1] * size[2]
    attribute = attribute or f"SCALARS s {VTK_TYPES[pixel]}\nLOOKUP_TABLE default"
    return ("# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\n"
            f"DIMENSIONS {joined(size)}\nSPACING 1 1 1\nORIGIN 0 0 0\nPOINT_DATA {points}\n{attribute}\n").encode()


FORMATS = {"a.mha": meta, "a.nrrd": nrrd, "a.vtk": vtk}
SIZE = [3, 3, 3]


class Text(ProgramTest):
    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content)

    def read(self, name, header, words):
        """What is read where all voxels are the same word; None: it was refused."""
        self.write(name, header + " ".join([words] * 27).encode())
        result = self.run_program(self.path(name), self.path("read.mha"), "--json", "--quiet")
        if result.returncode:
            self.assert_fails(result, 1, "cannot read", f"'{words[:40]}'", "voxels of the type")
            return None
        found = json.loads(result.stdout)["input"]
        if found["nan"] + found["infinite"] == 27:
            return "nan" if found["nan"] else "inf"
        self.assertEqual(found["minimum"], found["maximum"])
        return found["minimum"]

    def test_every_number_is_itself_or_refused(self):
        cases = {
            "B": {"255": 255, "256": None, "-1": None, "1.5": None, "1e2": 100, "5.0": 5, "0x10": None, "+7": 7, "7x": None},
            "b": {"-128": -128, "128": None, "-129": None, "127": 127},
            "H": {"65535": 65535, "70000": None, "-1": None, "1.5": None, "1e3": 1000, "1e5": None, "nan": None, "007": 7},
            "h": {"-32768": -32768, "32768": None, "-3.2768e4": -32768, "1-2": None, "--1": None, "+-1": None},
            "I": {"4294967295": 4294967295, "4294967296": None, "-1": None},
            "i": {"-2147483648": -2147483648, "2147483648": None, "1e9": 10 ** 9, "1e10": None},
            "Q": {"-1": None, "18446744073709551616": None, "4503599627370497": 4503599627370497, "1e30": None},
            "q": {"9223372036854775808": None, "-4503599627370497": -4503599627370497, "0.1": None,
                  "9007199254740993.0": None, "-9007199254740991.0": -9007199254740991},
            "f": {"1.5": 1.5, "-1e3": -1000, "nan": "nan", "-inf": "inf", "1e39": None, "1e-60": 0, "1e-400": 0, "1d3": None,
                  ".5": 0.5, "5.": 5, "+2.25e+1": 22.5, "1,5": None, "0.5f": None, "NaN": "nan", "Inf": "inf"},
            "d": {"1e-400": 0, "1e308": 1e308, "1e309": None, "16777217": 16777217, "0.1": 0.1, "-1e-5000": 0, "1e5000": None,
                  "1e-99999999999999999999": 0, "1e99999999999999999999": None, f"0.{'0' * 350}1": 0, f"1{'0' * 320}e-5": None,
                  f"0.{'0' * 350}1e360": 1e9, f"1{'0' * 320}e-320": 1},
        }
        for pixel, words in cases.items():
            for word, due in words.items():
                for name, header in FORMATS.items():
                    if name == "a.nrrd" and "," in word:
                        continue  # commas stand between numbers there
                    with self.subTest(pixel=pixel, word=word, name=name):
                        self.assertEqual(self.read(name, header(pixel, SIZE), word), due)

    def test_layouts_of_the_text(self):
        values = noise(27, low=-900)
        write_meta(self.path("in.mha"), SIZE, "h", values)
        due = self.meta("in.mha", "due.mha").data
        words = [str(value) for value in values]
        texts = {"lines": "\n".join(words), "CR LF": "\r\n".join(words), "tabs": "\t".join(words) + "\n\n\n",
                 "many blanks": "   ".join(words) + " " * 3000000}
        for name, header in FORMATS.items():
            for text in texts.values():
                self.write(name, header("h", SIZE) + text.encode())
                self.assertEqual(self.meta(name, "found.mha").data, due)
        for comma in (", ", ",", " ,", ",\n"):
            self.write("a.nrrd", nrrd("h", SIZE) + comma.join(words).encode())
            self.assertEqual(self.meta("a.nrrd", "found.mha").data, due)

    def test_a_byte_order_means_nothing_for_text(self):
        for pixel in "Hhifdq":
            values = noise(210, high=100)
            write_meta(self.path("in.mha"), [7, 6, 5], pixel, values)
            due = self.meta("in.mha", "due.mha").data
            for key in ("BinaryDataByteOrderMSB", "ElementByteOrderMSB"):
                header = meta(pixel, [7, 6, 5], [f"{key} = True"])
                if key == "BinaryDataByteOrderMSB":
                    header = header.replace(b"BinaryDataByteOrderMSB = False\n", b"")
                else:
                    header = header.replace(b"BinaryDataByteOrderMSB = False\n", b"BinaryDataByteOrderMSB = True\n")
                self.write("a.mha", header + joined(values).encode())
                self.assertEqual(self.meta("a.mha", "found.mha").data, due)
            self.write("a.nrrd", nrrd(pixel, [7, 6, 5])[:-1] + b"endian: big\n\n" + joined(values).encode())
            self.assertEqual(self.meta("a.nrrd", "found.mha").data, due)
            data = array.array(pixel, values)
            data.byteswap()
            header = nrrd(pixel, [7, 6, 5])[:-1].replace(b"ascii", b"hex") + b"endian: big\n\n"
            self.write("a.nrrd", header + data.tobytes().hex().upper().encode())
            self.assertEqual(self.meta("a.nrrd", "found.mha").data, due)

    def test_text_in_other_files(self):
        values = noise(210)
        write_meta(self.path("in.mha"), [7, 6, 5], "H", values)
        due = self.meta("in.mha", "due.mha").data
        for z in range(5):
            self.write(f"s{z}.txt", joined(values[42 * z:42 * z + 42]).encode())
        self.write("all.txt", joined(values).encode())
        names = "".join(f"s{z}.txt\n" for z in range(5)).encode()
        headers = {"a.mhd": meta("H", [7, 6, 5]).replace(b"LOCAL", b"all.txt"),
                   "b.mhd": meta("H", [7, 6, 5]).replace(b"LOCAL", b"LIST") + names,
                   "c.nhdr": nrrd("H", [7, 6, 5])[:-1] + b"data file: all.txt\n",
                   "d.nhdr": nrrd("H", [7, 6, 5])[:-1] + b"data file: LIST\n" + names}
        for name, header in headers.items():
            self.write(name, header)
            self.assertEqual(self.meta(name, "found.mha").data, due)
        self.write("s3.txt", joined(values[:43]).encode())
        for name in ("b.mhd", "d.nhdr"):
            self.assert_fails(self.run_program(self.path(name), self.path("out.mha"), "--quiet"), 1, "s3.txt", "more than")

    def test_vectors_and_tensors_of_vtk(self):
        values = [value / 4 for value in noise(27 * 9)]
        for count, attribute, chosen in ((3, "VECTORS v float", range(3)), (9, "TENSORS t float", (0, 1, 2, 4, 5, 8)),
                                         (3, "SCALARS s float 3\nLOOKUP_TABLE default", range(3)),
                                         (2, "SCALARS s float 2\nLOOKUP_TABLE default", range(2))):
            voxels = [[values[count * i + part] for part in chosen] for i in range(27)]
            write_meta(self.path("in.mha"), SIZE, "f", sum(voxels, []), channels=len(list(chosen)))
            due = self.meta("in.mha", "due.mha").data
            self.write("text.vtk", vtk("f", SIZE, attribute) + joined(values[:27 * count]).encode())
            self.assertEqual(self.meta("text.vtk", "found.mha").data, due, attribute)
            binary = vtk("f", SIZE, attribute).replace(b"ASCII", b"BINARY")
            self.write("binary.vtk", binary + struct.pack(f">{27 * count}f", *values[:27 * count]))
            self.assertEqual(self.meta("binary.vtk", "found.mha").data, due, attribute)
            self.write("text.vtk", vtk("f", SIZE, attribute) + joined(values[:27 * count - 1]).encode())
            self.assert_fails(self.run_program(self.path("text.vtk"), self.path("out.mha"), "--quiet"), 1, "truncated")

    def warnings(self, name):
        result = self.run_program(self.path(name), self.path("found.mha"))
        self.assertEqual(result.returncode, 0, result.stderr)
        return [line for line in result.stderr.splitlines() if "warning" in line]

    def test_other_arrays_of_vtk(self):
        values = noise(27)
        write_meta(self.path("in.mha"), SIZE, "h", values)
        due = self.meta("in.mha", "due.mha").data
        other = "SCALARS q short\nLOOKUP_TABLE default\n"
        notes = "METADATA\nINFORMATION 0\n\n"
        for encoding in ("ASCII", "BINARY"):
            def part(numbers, encoding=encoding):
                return joined(numbers).encode() if encoding == "ASCII" else struct.pack(f">{len(numbers)}h", *numbers)
            table = ("LOOKUP_TABLE t 2\n", joined([0.5] * 8).encode() if encoding == "ASCII" else bytes([10, 13] * 4))
            header = vtk("h", SIZE, "SCALARS Mean short 1\nLOOKUP_TABLE default").replace(b"ASCII", encoding.encode())
            start, first = header.split(b"SCALARS")
            first = b"SCALARS" + first + part(values)
            for rest, is_other in (("", False), (notes, False), (table, False), (other, True), (notes + other, True),
                                   ("VECTORS v short\n", True), ("FIELD FieldData 1\nf 1 27 short\n", True),
                                   ("CELL_DATA 8\nSCALARS c short\n", True), ("NORMALS n short\n", True)):
                rest, data = rest if isinstance(rest, tuple) else (rest, part(values[::-1]) if is_other else b"")
                for more in (b"", b"\n" + other.encode() + part(values)) if rest else (b"",):
                    for gap in (b"\n", b" " if encoding == "ASCII" else b""):
                        with self.subTest(encoding=encoding, rest=rest, more=more, gap=gap):
                            self.write("a.vtk", start + first + gap + rest.encode() + data + more)
                            found = self.warnings("a.vtk")
                            self.assertEqual(len(found), 1 if is_other or more else 0, found)
                            self.assertTrue(all("only 'Mean' is read" in line for line in found), found)
                            self.assertEqual(Meta(self.path("found.mha")).data, due)
            self.write("a.vtk", start + b"NORMALS n short\n" + part([1] * 81) + b"\n" + first)
            self.assertEqual(["only 'Mean' is read" in line for line in self.warnings("a.vtk")], [True])
            self.assertEqual(Meta(self.path("found.mha")).data, due)

    def test_one_slice_of_vtk(self):
        values = noise(9)
        for encoding in ("ASCII", "BINARY"):
            data = joined(values).encode() if encoding == "ASCII" else struct.pack(">9h", *values)
            for z, count in (("0", 0), ("30", 1), ("-1e-3", 1), ("0.0", 0)):
                header = vtk("h", [3, 3, 1]).replace(b"ASCII", encoding.encode())
                self.write("a.vtk", header.replace(b"ORIGIN 0 0 0", b"ORIGIN -10 20 " + z.encode()) + data)
                found = self.warnings("a.vtk")
                self.assertEqual(["position across those is left out" in line for line in found], [True] * count)
                self.assertEqual(Meta(self.path("found.mha")).numbers("Offset"), [-10.25, 19.75])
        self.write("a.vtk", vtk("h", SIZE).replace(b"ORIGIN 0 0 0", b"ORIGIN 0 0 7") + joined(noise(27)).encode())
        self.assertEqual(self.warnings("a.vtk"), [])

    def test_all_types(self):
        self.assertEqual(set(META_TYPES), set(NRRD_TYPES))
        for pixel in META_TYPES:
            values = noise(27, high=127)
            write_meta(self.path("in.mha"), SIZE, pixel, values)
            due = self.meta("in.mha", "due.mha")
            for name, header in FORMATS.items():
                self.write(name, header(pixel, SIZE) + joined(values).encode())
                found = self.meta(name, "found.mha")
                self.assertEqual((found.pixel, found.data), (due.pixel, due.data), name)


if __name__ == "__main__":
    unittest.main()
