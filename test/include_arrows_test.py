# SPDX-License-Identifier: Apache-2.0
"""Who may know whom: reads the #include lines of the sources and holds them to the rules of the three layers and of the
folders that the programs share; and where the system is called."""
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
# Headers of POSIX, which other systems lack, and what it adds to those of the standard library.
POSIX_HEADER = re.compile(r"(sys|arpa|netinet|linux)/|csignal$|(unistd|fcntl|dirent|dlfcn|poll|pthread|pwd|grp|sched|"
                          r"semaphore|signal|spawn|strings|termios|utime)\.h$")
POSIX_CALL = re.compile(r"(?<![\w.>:])(?:::)?(open|close|read|write|pread|pwrite|lseek|stat|lstat|fstat|link|unlink|"
                        r"symlink|rename|mkdir|rmdir|mkdtemp|mkstemp|chmod|umask|access|fsync|flock|fcntl|ftruncate|"
                        r"fallocate|posix_fallocate|statvfs|fstatvfs|[gs]etxattr|dup|dup2|pipe|fork|waitpid|kill|"
                        r"getpid|getppid|geteuid|sysconf|pathconf|getrlimit|mmap|munmap|madvise|fileno|fdopen|"
                        r"isatty|sigaction|strsignal|pthread_\w+)\(")
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
HUGE_PAGES = "src/memory/HugePages.cxx"
SYSTEM = "apps/common/system/"
# Huge pages are asked for where there are any; the benchmark measures the machine.
POSIX_PLACES = (SYSTEM, HUGE_PAGES, "benchmark/")
ENUM_PRINTING = "src/itkNonOscillatorySubdivisionImageFilterEnums.cxx"

# The folders of what the programs share, from the lowest to the highest, with those that each may know besides itself.
COMMON = "apps/common/"
COMMON_FOLDERS = {
    "text": [],
    "system/files": [],
    "system/process": ["text", "system/files"],
    "volumes": ["text"],
    "deflate": ["system/files"],
    "headers": ["text", "system/files", "volumes"],
    "outputs": ["system/files", "system/process", "volumes", "headers"],
    "plain": ["text", "system/files", "volumes", "deflate", "headers", "outputs"],
    "nifti": ["text", "system/files", "volumes", "headers", "plain"],
    "tiff": ["text", "system/files", "volumes", "outputs"],
    "itk": ["text", "system/files", "system/process", "volumes", "deflate", "headers", "outputs", "nifti"],
    "dicom": ["system/files", "system/process", "volumes"],
    "slices": ["text", "system/files", "volumes", "outputs", "tiff", "itk"],
    "pieces": ["system/files", "system/process", "volumes", "headers", "outputs", "tiff", "slices"],
    "formats": ["text", "system/files", "volumes", "plain", "nifti", "tiff", "itk", "dicom", "slices"],
    "commandline": ["text", "system/process", "volumes", "plain"],
}

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
    *((f"{COMMON}{folder}/", ["include/", *(f"{COMMON}{other}/" for other in [folder, *known])])
      for folder, known in COMMON_FOLDERS.items()),
    (COMMON, []),
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
            if POSIX_HEADER.match(name) and not path.startswith(POSIX_PLACES):
                found.append(f"{path} includes {name}, which only POSIX has")
            known = resolve(path, name, texts)
            if below_itk and ITK_HEADER.match(name.rpartition("/")[2]) or (below_itk and ITK_HEADER.match(name)):
                found.append(f"{path} includes ITK's {name}")
            elif known and known != path and not known.startswith(tuple(allowed_of(path))):
                found.append(f"{path} may not know {known}")
        if not path.startswith(POSIX_PLACES):
            calls = POSIX_CALL.findall(COMMENT.sub("", text))
            found += [f"{path} calls {name}(), which only POSIX has" for name in calls]
        if path.startswith(COMMON) and not path.startswith(tuple(f"{COMMON}{folder}/" for folder in COMMON_FOLDERS)):
            found.append(f"{path} is in none of the folders of {COMMON}")
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
        folders = [f"{COMMON}{folder}/" for folder in COMMON_FOLDERS]
        for prefix in (API, KERNEL, STAGES, VECTORS, "src/array/", "src/memory/", *folders, "benchmark/"):
            self.assertTrue(any(path.startswith(prefix) for path in paths), prefix)

    def test_folders_of_the_programs_know_lower_ones_alone(self):
        lower = set()
        for folder, known in COMMON_FOLDERS.items():
            self.assertLessEqual(set(known), lower, folder)
            lower.add(folder)

    def test_faults_are_found(self):
        headers = {API + "Kernel.h": "", API + "Subdivider.h": "", API + "Scheme.h": "", "include/itkFilter.h": "",
                   KERNEL + "Sweep.h": "", STAGES + "Rows-inl.h": "", STAGES + "Ring.h": "",
                   STAGES + "LocalRange-inl.h": "", VECTORS + "Portable.h": "", "src/array/RowReader.h": "",
                   "src/memory/Layout.h": "", "apps/common/text/Messages.h": "", "apps/One/Options.h": "",
                   "apps/common/system/files/InputFile.h": "", "apps/common/tiff/TiffPage.h": ""}
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
            ("apps/common/text/Messages.cxx", "apps/One/Options.h"),
            ("apps/common/text/Messages.cxx", "system/files/InputFile.h"),
            ("apps/common/system/files/InputFile.cxx", "text/Messages.h"),
            ("apps/common/nifti/NiftiFiles.cxx", "tiff/TiffPage.h"),
            ("apps/common/nifti/NiftiFiles.cxx", "TiffPage.h"),
            ("apps/common/text/Messages.cxx", "array/RowReader.h"),
            ("benchmark/Rows.cxx", "kernel/Sweep.h"),
            ("python/module.cxx", "memory/Layout.h"),
            ("examples/Short.cxx", "apps/common/text/Messages.h"),
            ("src/array/Subdivider.cxx", "apps/common/text/Messages.h"),
        ):
            for line in (f'#include "{name}"\n', f'#  include "{name}" // for something\n', f"#include <{name}>\n"):
                with self.subTest(path=path, line=line):
                    found = self.violations_of({**headers, path: line})
                    self.assertEqual(1, len(found), found)
                    self.assertTrue(found[0].startswith(path + " "), found)

    def test_allowed_includes_are_no_faults(self):
        files = {API + "Kernel.h": '#include "NonOscillatorySubdivision/Scheme.h"\n',
                 API + "Scheme.h": "#include <array>\n",
                 "include/itkFilter.h": '#include "NonOscillatorySubdivision/Kernel.h"\n#include "itkImage.h"\n',
                 ENUM_PRINTING: '#include "itkFilter.h"\n',
                 STAGES + "Ring.h": "", STAGES + "Passes-inl.h": '#include "kernel/stages/Ring.h"\n',
                 KERNEL + "Sweep-inl.h": '#include "kernel/stages/Passes-inl.h"\n#include "memory/Layout.h"\n',
                 "src/memory/Layout.h": "", "src/array/Tiling.cxx": '#include "memory/Layout.h"\n',
                 "apps/One/One.cxx": '#include "text/Messages.h"\n#include "itkFilter.h"\n',
                 "apps/common/text/Messages.h": ""}
        self.assertEqual([], self.violations_of(files))

    def test_posix_headers_are_found(self):
        found = self.violations_of({"src/memory/Layout.cxx": "#  include <sys/mman.h>\n",
                                    HUGE_PAGES: "#include <sys/mman.h>\n",
                                    SYSTEM + "files/InputFile.cxx": "#include <fcntl.h>\n",
                                    "benchmark/Usage.cxx": "#include <sys/resource.h>\n",
                                    "include/itkFilter.h": "#include <unistd.h>\n",
                                    "apps/common/tiff/TiffPage.cxx": "#include <csignal>\n",
                                    "apps/One/One.cxx": "#include <poll.h>\n"})
        self.assertEqual(["apps/One/One.cxx includes poll.h, which only POSIX has",
                          "apps/common/tiff/TiffPage.cxx includes csignal, which only POSIX has",
                          "include/itkFilter.h includes unistd.h, which only POSIX has",
                          "src/memory/Layout.cxx includes sys/mman.h, which only POSIX has"], found)

    def test_posix_calls_are_found(self):
        allowed = ("/** open() waits. */ // as read() does\nfile.open(name); std::rename(a, b); fs::rename(a, b); "
                   "this->close(); Reopen(name);\n")
        found = self.violations_of({"apps/One/One.cxx": allowed + "const int file = open(name, 0);\n",
                                    "apps/common/tiff/TiffPage.cxx": allowed + "if (::mkdtemp(name) == nullptr)\n",
                                    SYSTEM + "files/InputFile.cxx": "open(name, 0);\n"})
        self.assertEqual(["apps/One/One.cxx calls open(), which only POSIX has",
                          "apps/common/tiff/TiffPage.cxx calls mkdtemp(), which only POSIX has"], found)

    def test_files_of_the_programs_are_in_a_folder(self):
        found = self.violations_of({"apps/common/Messages.h": "", "apps/common/things/Thing.h": ""})
        self.assertEqual(["apps/common/Messages.h is in none of the folders of apps/common/",
                          "apps/common/things/Thing.h is in none of the folders of apps/common/"], found)

    def test_long_files_are_found(self):
        found = self.violations_of({"src/array/Long.cxx": "\n" * 401, "include/itkShort.h": "\n" * 400})
        self.assertEqual(["src/array/Long.cxx has 401 lines, more than 400"], found)


if __name__ == "__main__":
    unittest.main()
