# SPDX-License-Identifier: Apache-2.0
"""Who may know whom: reads the #include lines of the sources and holds them to the rules of the three layers."""
import re
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SUFFIXES = {".h", ".hxx", ".cxx"}
MOST_LINES = 400
ITK_HEADER = re.compile(r"(itk|vnl|vcl|vnl_)[A-Z_]\w*\.(h|hxx)$|vnl/")
INCLUDE = re.compile(r'^[ \t]*#[ \t]*(?:include|define[ \t]+HWY_TARGET_INCLUDE)[ \t]+["<]([^">]+)[">]', re.MULTILINE)

API = "include/NonOscillatorySubdivision/"
KERNEL = "src/kernel/"
STAGES = KERNEL + "stages/"
VECTORS = KERNEL + "vectors/"
# What every stage builds on; all other files of the folder are stages.
STAGE_TOOLS = [STAGES + name for name in ("Ring.h", "Masks-inl.h", "Rows-inl.h")]
# Headers of POSIX, which other systems lack. Huge pages are asked for where there are any.
POSIX_HEADER = re.compile(r"(sys|arpa|netinet)/|(unistd|fcntl|dirent|dlfcn|poll|pthread|pwd|spawn|strings|termios)\.h$")
HUGE_PAGES = "src/memory/HugePages.cxx"
ENUM_PRINTING = "src/itkNonOscillatorySubdivisionImageFilterEnums.cxx"

# For the files that a prefix names: prefixes of what they may include of the project, besides files of their own name.
# The first prefix that fits holds.
RULES = [
    (API, [API]),
    ("include/", ["include/"]),
    (ENUM_PRINTING, ["include/"]),
    ("src/memory/", ["src/memory/"]),
    *((tool, [*STAGE_TOOLS, VECTORS, "src/memory/", API + "Scheme.h", API + "ElementType.h"]) for tool in STAGE_TOOLS),
    (STAGES, [*STAGE_TOOLS, VECTORS, "src/memory/", API + "Scheme.h", API + "ElementType.h"]),
    (VECTORS, [VECTORS, API + "ElementType.h"]),
    (KERNEL, [KERNEL, "src/memory/"] + [API + name for name in ("Scheme.h", "ElementType.h", "Target.h", "Kernel.h")]),
    ("src/array/", ["src/array/", "src/memory/", API]),
    ("src/", []),
    ("apps/common/", ["apps/common/", "include/"]),
    ("python/", ["python/", "include/"]),
    ("benchmark/", ["benchmark/", "include/"]),
    ("examples/", ["include/"]),
]
FOLDERS = ("include", "src", "apps", "python", "benchmark", "examples")


def allowed_of(path):
    """Prefixes of the project's files that a file may include."""
    for prefix, allowed in RULES:
        if path.startswith(prefix):
            return allowed
    program = path.split("/")[1]
    return [f"apps/{program}/", "apps/common/", "include/"]


def sources(root):
    """The sources by their path within the project."""
    files = (path for folder in FOLDERS for path in (root / folder).rglob("*") if path.suffix in SUFFIXES)
    return {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8") for path in sorted(files)}


def resolve(includer, name, paths):
    """The project's file that an include means: one beside the includer, else one whose path ends so."""
    parts = []
    for part in (includer.rpartition("/")[0] + "/" + name).split("/"):
        if part == "..":
            parts.pop()
        else:
            parts.append(part)
    if "/".join(parts) in paths:
        return "/".join(parts)
    bare = name.replace("../", "")
    return next((path for path in paths if path == bare or path.endswith("/" + bare)), None)


def violations(root):
    """What breaks a rule, one line for each."""
    found = []
    texts = sources(root)
    for path, text in texts.items():
        lines = text.count("\n")
        if path.startswith(("include/", "src/")) and lines > MOST_LINES:
            found.append(f"{path} has {lines} lines, more than {MOST_LINES}")
        below_itk = path.startswith((API, "src/")) and path != ENUM_PRINTING
        for name in INCLUDE.findall(text):
            if path.startswith(("include/", "src/")) and path != HUGE_PAGES and POSIX_HEADER.match(name):
                found.append(f"{path} includes {name}, which only POSIX has")
            known = resolve(path, name, texts)
            if below_itk and ITK_HEADER.match(name.rpartition("/")[2]) or (below_itk and ITK_HEADER.match(name)):
                found.append(f"{path} includes ITK's {name}")
            elif known and known != path and not known.startswith(tuple(allowed_of(path))):
                found.append(f"{path} may not know {known}")
    return found


class IncludeArrows(unittest.TestCase):
    """The project as it is, and a project with each kind of fault."""

    def violations_of(self, files):
        with tempfile.TemporaryDirectory() as folder:
            for path, text in files.items():
                file = Path(folder, path)
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(text, encoding="utf-8")
            return violations(Path(folder))

    def test_every_include_is_allowed(self):
        self.assertEqual([], violations(ROOT))

    def test_every_layer_was_read(self):
        paths = sources(ROOT)
        for prefix in (API, KERNEL, STAGES, VECTORS, "src/array/", "src/memory/", "apps/common/", "benchmark/"):
            self.assertTrue(any(path.startswith(prefix) for path in paths), prefix)

    def test_faults_are_found(self):
        headers = {API + "Kernel.h": "", API + "Subdivider.h": "", API + "Scheme.h": "", "include/itkFilter.h": "",
                   KERNEL + "Sweep.h": "", STAGES + "Rows-inl.h": "", STAGES + "Ring.h": "",
                   STAGES + "LocalRange-inl.h": "", VECTORS + "Portable.h": "", "src/array/RowReader.h": "",
                   "src/memory/Layout.h": "", "apps/common/Messages.h": "", "apps/One/Options.h": ""}
        self.assertEqual([], self.violations_of(headers))
        for path, name in (
            (API + "Other.h", "itkImage.h"),
            (API + "Other.h", "array/RowReader.h"),
            ("include/itkOther.h", "memory/Layout.h"),
            (KERNEL + "Kernel.cxx", "NonOscillatorySubdivision/Subdivider.h"),
            (KERNEL + "Kernel.cxx", "array/RowReader.h"),
            (KERNEL + "Kernel.cxx", "itkMacro.h"),
            (STAGES + "Restoration-inl.h", "LocalRange-inl.h"),
            (STAGES + "Restoration-inl.h", "kernel/Sweep.h"),
            (STAGES + "Rows-inl.h", "LocalRange-inl.h"),
            (VECTORS + "Highway-inl.h", "kernel/stages/Rows-inl.h"),
            ("src/array/Subdivider.cxx", "kernel/Sweep.h"),
            ("src/array/Subdivider.cxx", "../kernel/Sweep.h"),
            ("src/memory/HugePages.cxx", "NonOscillatorySubdivision/Scheme.h"),
            ("src/other.cxx", "itkFilter.h"),
            ("src/array/Tiling.cxx", "itkFilter.h"),
            ("apps/Two/Two.cxx", "array/RowReader.h"),
            ("apps/Two/Two.cxx", "../One/Options.h"),
            ("apps/common/Messages.cxx", "apps/One/Options.h"),
            ("benchmark/Rows.cxx", "kernel/Sweep.h"),
            ("python/module.cxx", "memory/Layout.h"),
            ("examples/Short.cxx", "apps/common/Messages.h"),
            ("src/array/Subdivider.cxx", "apps/common/Messages.h"),
        ):
            for line in (f'#include "{name}"\n', f'#  include "{name}" // for something\n', f"#include <{name}>\n"):
                with self.subTest(path=path, line=line):
                    found = self.violations_of({**headers, path: line})
                    self.assertEqual(1, len(found), found)
                    self.assertTrue(found[0].startswith(path + " "), found)

    def test_allowed_includes_are_no_faults(self):
        files = {API + "Kernel.h": '#include "NonOscillatorySubdivision/Scheme.h"\n', API + "Scheme.h": "#include <array>\n",
                 "include/itkFilter.h": '#include "NonOscillatorySubdivision/Kernel.h"\n#include "itkImage.h"\n',
                 ENUM_PRINTING: '#include "itkFilter.h"\n',
                 STAGES + "Ring.h": "", STAGES + "Passes-inl.h": '#include "kernel/stages/Ring.h"\n',
                 KERNEL + "Sweep-inl.h": '#include "kernel/stages/Passes-inl.h"\n#include "memory/Layout.h"\n',
                 "src/memory/Layout.h": "", "src/array/Tiling.cxx": '#include "memory/Layout.h"\n',
                 "apps/One/One.cxx": '#include "Messages.h"\n#include "itkFilter.h"\n', "apps/common/Messages.h": ""}
        self.assertEqual([], self.violations_of(files))

    def test_posix_headers_are_found(self):
        found = self.violations_of({"src/memory/Layout.cxx": "#  include <sys/mman.h>\n",
                                    HUGE_PAGES: "#include <sys/mman.h>\n",
                                    "include/itkFilter.h": "#include <unistd.h>\n",
                                    "apps/One/One.cxx": "#include <poll.h>\n"})
        self.assertEqual(["include/itkFilter.h includes unistd.h, which only POSIX has",
                          "src/memory/Layout.cxx includes sys/mman.h, which only POSIX has"], found)

    def test_long_files_are_found(self):
        found = self.violations_of({"src/array/Long.cxx": "\n" * 401, "include/itkShort.h": "\n" * 400})
        self.assertEqual(["src/array/Long.cxx has 401 lines, more than 400"], found)


if __name__ == "__main__":
    unittest.main()
