# SPDX-License-Identifier: Apache-2.0
"""The wrapping for ITK's Python as far as it can be tested without an ITK that is wrapped: what each file wrapping/*.wrap
names is instantiated and parsed by castxml, which is the first thing that ITK's wrapping does with it.

Reads the environment: CASTXML, CXX, CXXFLAGS, and INCLUDE_DIRECTORIES with colons between.
"""

import itertools
import os
import re
import shlex
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

WRAPPING = Path(__file__).resolve().parents[2] / "wrapping"

# What ITK wraps by default, but for double, which wheels leave out.
TYPES = {
    "WRAP_ITK_INT": ["unsigned char", "unsigned short", "signed short"],
    "WRAP_ITK_SCALAR": ["unsigned char", "unsigned short", "signed short", "float"],
}
DIMENSIONS = [2, 3]

# Methods that users of Python call, beside those that ITK itself adds.
METHODS = {
    "NonOscillatorySubdivisionImageFilter": {"SetScheme", "SetSchemeByName", "SetTension", "GetTension"},
    "SubdivisionImageFilterBase": {"SetSubdividedAxes", "SetSubdividedAxis", "SetBoundaryCondition"},
    "LabelSubdivisionImageFilter": {"SetScheme", "SetTension"},
    "ImageFidelityCalculator": {"SetTestImage", "GetRelativeL2Error", "Update"},
}


def instantiations(file):
    """The types that a .wrap file names, and their smart pointers."""
    text = file.read_text()
    simple = re.findall(r'itk_wrap_simple_class\("itk::(\w+)"', text)
    if simple:
        return [f"itk::{name}" for name in simple]
    (name, pointer), *_ = re.findall(r'itk_wrap_class\("itk::(\w+)"\s*(POINTER)?\)', text)
    result = []
    for variable, count in re.findall(r'itk_wrap_image_filter\("\$\{(\w+)\}" (\d)\)', text):
        for pixel, dimension in itertools.product(TYPES[variable], DIMENSIONS):
            images = ", ".join([f"itk::Image<{pixel}, {dimension}>"] * int(count))
            result.append(f"itk::{name}<{images}>")
    return result + [f"{kind}::Pointer" for kind in result if pointer]


def source(header, kinds):
    """As ITK's wrapping writes it: names in the namespace that castxml starts from, completed by their sizes."""
    names = "".join(f"using kind_{number} = {kind};\n" for number, kind in enumerate(kinds))
    sizes = "".join(f"static_cast<void>(sizeof(wrappers::kind_{number}));\n" for number in range(len(kinds)))
    return (
        f'#include "itkImage.h"\n#include "{header}"\n'
        f"namespace _wrapping_\n{{\nnamespace wrappers\n{{\n{names}}}\ninline void f()\n{{\n{sizes}}}\n}}\n"
    )


def parse(text):
    """The names of the types that castxml completed, and of all public methods."""
    with tempfile.TemporaryDirectory() as folder:
        program, parsed = Path(folder, "program.cxx"), Path(folder, "parsed.xml")
        program.write_text(text)
        includes = [f"-I{path}" for path in os.environ["INCLUDE_DIRECTORIES"].split(":") if path]
        # The standard library of GCC relies on sized deallocation, which the Clang within castxml has on demand only.
        command = [os.environ["CASTXML"], "--castxml-output=1", "--castxml-start", "_wrapping_", "--castxml-cc-gnu"]
        command += ["(", os.environ["CXX"], "-std=c++17", ")", "-std=c++17", "-fsized-deallocation"]
        command += shlex.split(os.environ.get("CXXFLAGS", ""))
        command += ["-DITK_WRAPPING_PARSER", "-DITK_MANUAL_INSTANTIATION", *includes, "-o", parsed, program]
        result = subprocess.run(command, capture_output=True, text=True)
        if result.returncode != 0:
            raise AssertionError(result.stderr)
        tree = ElementTree.parse(parsed).getroot()
    complete = [kind for kind in tree if kind.tag in ("Class", "Struct") and kind.get("incomplete") != "1"]
    methods = {item.get("name") for item in tree if item.tag == "Method" and item.get("access") == "public"}
    return {kind.get("name") for kind in complete}, methods


class Wrapping(unittest.TestCase):
    def test_each_file_is_parsed(self):
        files = sorted(WRAPPING.glob("*.wrap"))
        self.assertEqual(len(files), 6)
        for file in files:
            with self.subTest(file.name):
                kinds = instantiations(file)
                self.assertGreater(len(kinds), 0)
                header = file.with_suffix(".h").name
                complete, methods = parse(source(header, kinds))
                name = file.stem.removeprefix("itk")
                classes = {kind for kind in complete if kind and kind.split("<")[0] == name}
                self.assertEqual(len(classes), sum("::Pointer" not in kind for kind in kinds), classes)
                self.assertLessEqual(METHODS.get(name, set()), methods)

    def test_a_wrong_type_is_noticed(self):
        with self.assertRaises(AssertionError):
            parse(source("itkMirrorBoundaryCondition.h", ["itk::MirrorBoundaryCondition<itk::NoImage>"]))


if __name__ == "__main__":
    unittest.main()
