# SPDX-License-Identifier: Apache-2.0
"""The programs of examples/python, run as a user runs them."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from nonoscillatory_subdivision import subdivide

EXAMPLES = Path(__file__).parents[2] / "examples" / "python"


def run(name, *arguments):
    program = [sys.executable, str(EXAMPLES / name), *map(str, arguments)]
    result = subprocess.run(program, capture_output=True, text=True, timeout=120)
    assert result.returncode == 0, result.stderr
    return result.stdout


@pytest.fixture
def volume():
    return np.random.default_rng(0).integers(0, 60000, (45, 20, 30), dtype=np.uint16)


def test_numpy_array(tmp_path, volume):
    np.save(tmp_path / "in.npy", volume)
    assert "(90, 40, 60)" in run("numpy_array.py", tmp_path / "in.npy", tmp_path / "out.npy")
    np.testing.assert_array_equal(np.load(tmp_path / "out.npy"), subdivide(volume))


def test_simpleitk_image(tmp_path, volume):
    sitk = pytest.importorskip("SimpleITK")
    image = sitk.GetImageFromArray(volume)
    image.SetSpacing((0.5, 0.5, 2))
    sitk.WriteImage(image, tmp_path / "in.mha")
    run("simpleitk_image.py", tmp_path / "in.mha", tmp_path / "out.mha")
    result = sitk.ReadImage(tmp_path / "out.mha")
    assert result.GetSpacing() == (0.25, 0.25, 1)
    np.testing.assert_array_equal(sitk.GetArrayFromImage(result), subdivide(volume))


def test_tiffs_to_ome_zarr(tmp_path, volume):
    tifffile = pytest.importorskip("tifffile")
    zarr = pytest.importorskip("zarr")
    (tmp_path / "slices").mkdir()
    for number, values in enumerate(volume):
        tifffile.imwrite(tmp_path / "slices" / f"slice_{number + 1}.tif", values)
    run("tiffs_to_ome_zarr.py", tmp_path / "slices", tmp_path / "out.zarr", 0.012)
    group = zarr.open_group(tmp_path / "out.zarr", mode="r")
    np.testing.assert_array_equal(group["0"][...], subdivide(volume))
    scale, translation = group.attrs["ome"]["multiscales"][0]["datasets"][0]["coordinateTransformations"]
    assert scale["scale"] == [0.006] * 3
    assert translation["translation"] == [-0.003] * 3


def test_the_notebook_runs():
    nbclient = pytest.importorskip("nbclient")
    nbformat = pytest.importorskip("nbformat")
    pytest.importorskip("ipywidgets")
    notebook = nbformat.read(EXAMPLES / "before_and_after.ipynb", as_version=4)
    nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3").execute()
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    assert sum("image/png" in output.get("data", {}) for output in outputs) == 1
    assert any("application/vnd.jupyter.widget-view+json" in output.get("data", {}) for output in outputs)
    # What a cell prints may come in several pieces.
    printed = "".join(output.text for output in outputs if output.output_type == "stream")
    angles = dict(re.findall(r"^(.*?) +([0-9.]+)°", printed, re.MULTILINE))
    assert float(angles["restored, tension 0"]) < float(angles["non-oscillatory"]) < float(angles["the voxels"])
