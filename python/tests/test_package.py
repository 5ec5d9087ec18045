# SPDX-License-Identifier: Apache-2.0
"""The package as it is built and installed: examples, types, versions, contents."""

import doctest
import importlib
import importlib.metadata
import os
import re
import subprocess
import sys
import tarfile
from pathlib import Path

import nonoscillatory_subdivision
import pytest

REPOSITORY = Path(__file__).parents[2]
MODULES = ["", "._grid", "._labels", "._subdivide", ".dask", ".zarr"]


@pytest.mark.parametrize("name", MODULES)
def test_examples_in_docstrings(name):
    if name in (".dask", ".zarr"):
        pytest.importorskip("distributed")
    module = importlib.import_module("nonoscillatory_subdivision" + name)
    result = doctest.testmod(module)
    assert result.failed == 0
    assert result.attempted > 0 or name == ".zarr"


def test_examples_in_the_documentation(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    result = doctest.testfile(str(REPOSITORY / "docs/python.md"), module_relative=False)
    assert result.failed == 0 and result.attempted > 10


def test_the_installed_package_is_tested():
    assert REPOSITORY / "python" not in Path(nonoscillatory_subdivision.__file__).parents


def test_one_version():
    project_line = re.search(
        r"^project\(.* VERSION ([0-9.]+)", (REPOSITORY / "CMakeLists.txt").read_text(), re.MULTILINE
    )
    assert project_line is not None
    assert nonoscillatory_subdivision.__version__ == project_line[1]
    assert importlib.metadata.version("nonoscillatory-subdivision") == project_line[1]
    assert f"version: {project_line[1]}\n" in (REPOSITORY / "CITATION.cff").read_text()
    assert f"## {project_line[1]}" in (REPOSITORY / "CHANGELOG.md").read_text()
    minor = project_line[1].rpartition(".")[0]
    assert f"What was tried with version {minor}:" in (REPOSITORY / "README.md").read_text()


@pytest.mark.parametrize("project", [".", "wrapping"])
def test_wheels_take_the_version_from_the_project_line(project):
    """As scikit-build-core reads it: the first match of the expression."""
    tomllib = pytest.importorskip("tomllib")
    settings = tomllib.loads((REPOSITORY / project / "pyproject.toml").read_text())
    source = settings["tool"]["scikit-build"]["metadata"]["version"]
    lines = (REPOSITORY / project / source["input"]).read_text()
    match = re.search(source["regex"], lines, re.MULTILINE)
    assert match is not None and match["value"] == nonoscillatory_subdivision.__version__


def test_import_is_light():
    """Neither Dask nor an image library is loaded, nor needed."""
    heavy = ["dask", "zarr", "itk", "SimpleITK", "xarray", "scipy"]
    code = f"import sys, nonoscillatory_subdivision; print([name for name in {heavy} if name in sys.modules])"
    assert subprocess.check_output([sys.executable, "-c", code], text=True) == "[]\n"


def test_types(tmp_path):
    """The package and a user's program, as mypy sees them."""
    pytest.importorskip("mypy")
    program = tmp_path / "program.py"
    program.write_text(
        "import numpy as np\n"
        "from nonoscillatory_subdivision import schemes, subdivide, subdivide_labels, subdivided_grid\n"
        "volume = np.zeros((3, 4), np.int16)\n"
        "doubled: np.ndarray = subdivide(volume, scheme=schemes()[0], region=np.s_[:2], axes=(0, 1))\n"
        "subdivide(volume, axes=np.array([0, 1]), boundary=np.float32(2))\n"
        "subdivide(volume, axes=np.int64(1), boundary=3)\n"
        "class Image: ...\n"
        "image: Image = subdivide(Image(), levels=2)\n"
        "class Labelled:\n"
        "    coords = ()\n"
        "    def __array__(self) -> np.ndarray: return volume\n"
        "class Lazy(Labelled):\n"
        "    chunks = ()\n"
        "labelled: Labelled = subdivide_labels(Labelled())\n"
        "lazy: Lazy = subdivide(Lazy())\n"
        "spacing, origin = subdivided_grid((1.0, 2.0), (0.0, 0.0))\n"
        "spacing.tolist()\n"
    )
    config = ["--config-file", str(REPOSITORY / "pyproject.toml"), "--cache-dir", str(tmp_path)]
    for target in ([str(program)], ["--package", "nonoscillatory_subdivision"]):
        check = [sys.executable, "-m", "mypy", *config, *target]
        result = subprocess.run(check, capture_output=True, text=True, cwd=tmp_path)
        assert result.returncode == 0, result.stdout + result.stderr
    program.write_text("from nonoscillatory_subdivision import subdivide\nsubdivide([1.0], levels='2')\n")
    check = [sys.executable, "-m", "mypy", *config, str(program)]
    assert "levels" in subprocess.run(check, capture_output=True, text=True, cwd=tmp_path).stdout


def test_stub_names_what_the_module_has():
    stub = (Path(nonoscillatory_subdivision.__file__).parent / "_core.pyi").read_text()
    names = set(re.findall(r"^(?:def|class) (\w+)|^(\w+):", stub, re.MULTILINE))
    written = {name for pair in names for name in pair if name}
    core = importlib.import_module("nonoscillatory_subdivision._core")
    assert written == {name for name in vars(core) if not name.startswith("__") or name == "__version__"}


def test_source_distribution_has_all_sources(tmp_path):
    pytest.importorskip("scikit_build_core")
    code = f"from scikit_build_core.build import build_sdist; build_sdist({str(tmp_path)!r})"
    subprocess.run([sys.executable, "-c", code], cwd=REPOSITORY, check=True, capture_output=True)
    (archive,) = tmp_path.glob("*.tar.gz")
    with tarfile.open(archive) as file:
        names = {name.split("/", 1)[1] for name in file.getnames() if "/" in name}
    folders = ("src", "include/NonOscillatorySubdivision", "python/nonoscillatory_subdivision", "python/src")
    needed = {
        str(path.relative_to(REPOSITORY))
        for folder in folders
        for path in (REPOSITORY / folder).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    assert needed | {"pyproject.toml", "LICENSE", "python/CMakeLists.txt"} <= names
    assert not any(name.startswith(("experiments", "shared", "test/", "build")) for name in names)
    assert os.path.getsize(archive) < 1_000_000
