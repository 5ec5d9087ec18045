# SPDX-License-Identifier: Apache-2.0
"""The project's programs as functions on arrays, what users use today instead, and the pictures' style.

Arrays are [z, y, x] and spacings have the same order (see volumes.py). An experiment is a module with
`run(setting, output_folder) -> report.Result`, where setting is "small" (minutes for all of them) or "full";
it writes its PNG files into output_folder, and run.py writes its tables and the page.
"""
import io
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

import matplotlib
import numpy as np
from PIL import Image
from scipy import ndimage

from volumes import read_volume, write_volume

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402 (the backend has to be chosen first)

REPOSITORY = pathlib.Path(__file__).resolve().parents[1]

# The schemes of SubdivideVolume, one of them with two tensions, and what the tables call them.
SCHEMES = {
    "linear": "linear subdivision",
    "nonoscillatory": "non-oscillatory",
    "bounded": "bounded linear",
    "bspline": "B-spline subdivision",
    "restored": "restored",
    "restored, tension 0": "restored, tension 0",
}
DEFAULT_TENSION = 2.0
# Interpolation orders of what users use today and what the tables call them.
PEERS = {0: "nearest voxel", 1: "linear interpolation", 3: "B-spline 3 interpolation", 5: "B-spline 5 interpolation"}

LINEAR_COLOUR, NONOSCILLATORY_COLOUR, RESTORED_COLOUR = "tab:blue", "tab:red", "tab:green"
BELOW_COLOUR, ABOVE_COLOUR = "#2a7fff", "#ff3b30"


# The metrics of CompareVolumes as table columns: key, heading, factor, format.
_METRICS = (
    ("psnr_db", "PSNR / dB", 1.0, ".1f"),
    ("relative_l2_error", "relative L2 / %", 100.0, ".2f"),
    ("median_relative_error", "median error / %", 100.0, ".3f"),
    ("q99_relative_error", "99 % quantile / %", 100.0, ".2f"),
    ("relative_total_variation", "relative TV / %", 100.0, ".1f"),
    ("test_minimum", "minimum", 1.0, ".5g"),
    ("test_maximum", "maximum", 1.0, ".5g"),
)
METRIC_NAMES = {key: heading.split(" / ")[0] for key, heading, _, _ in _METRICS}
METRIC_COLUMNS = [(heading, form) for _, heading, _, form in _METRICS]
METRICS_TEXT = (
    "PSNR's peak is the reference's range; a voxel's error is relative to that peak; "
    "relative TV is the total variation as a share of the reference's."
)


class ProgramError(Exception):
    """A program that is missing or failed, in one line."""


def program(name, variable):
    """Path of one of the project's programs: the environment variable, the PATH, or a build folder here."""
    if os.environ.get(variable):
        return os.environ[variable]
    built = sorted(p for p in REPOSITORY.glob(f"build*/**/{name}") if p.is_file() and os.access(p, os.X_OK))
    found = shutil.which(name) or (built and str(built[-1]))
    if not found:
        raise ProgramError(f"{name} is not found: build the project first, or set {variable} to its path")
    return found


def _run(arguments):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        silent = f"{pathlib.Path(arguments[0]).name}: exit status {done.returncode}"
        raise ProgramError(done.stderr.strip() or silent)
    return done.stdout


def subdivide(
    array,
    spacing=(1.0, 1.0, 1.0),
    scheme="nonoscillatory",
    tension=DEFAULT_TENSION,
    boundary="nearest",
    output_type="float",
):
    """Twice the resolution on all axes, by SubdivideVolume.

    scheme: a key of SCHEMES; one that names a tension has that one, whatever `tension` says.
    boundary: "nearest", "mirror", "periodic" or a value. Children 2j and 2j + 1 cover voxel j's two halves.
    """
    tool = program("SubdivideVolume", "SUBDIVIDE_VOLUME")
    scheme, _, own_tension = scheme.partition(", tension ")
    tension = own_tension or tension
    with tempfile.TemporaryDirectory() as folder:
        source, target = pathlib.Path(folder) / "in.mha", pathlib.Path(folder) / "out.mha"
        write_volume(source, np.asarray(array), spacing)
        options = ["--scheme", scheme, "--tension", tension, "--boundary", boundary, "--output-type", output_type]
        _run([tool, source, target, *options, "--quiet"])
        return read_volume(target).data


def subdivide_labels(labels, scheme="restored", tension=0.0):
    """Twice the resolution of a label map (an array of integers) on all axes, by SubdivideVolume --labels."""
    tool = program("SubdivideVolume", "SUBDIVIDE_VOLUME")
    with tempfile.TemporaryDirectory() as folder:
        source, target = pathlib.Path(folder) / "in.mha", pathlib.Path(folder) / "out.mha"
        write_volume(source, np.asarray(labels))
        _run([tool, source, target, "--labels", "--scheme", scheme, "--tension", tension, "--quiet"])
        return read_volume(target).data


def compare(reference, test):
    """The metrics of `test` against `reference` (arrays of one size), by CompareVolumes.

    Keys: psnr_db, relative_l2_error, median_relative_error, q99_relative_error, relative_total_variation,
    test_minimum, test_maximum. All but the first and the last two are fractions.
    """
    tool = program("CompareVolumes", "COMPARE_VOLUMES")
    with tempfile.TemporaryDirectory() as folder:
        paths = [pathlib.Path(folder) / name for name in ("reference.mha", "test.mha")]
        for path, array in zip(paths, (reference, test)):
            write_volume(path, np.asarray(array))
        return json.loads(_run([tool, *paths, "--json"]))


def metric_cells(metrics):
    """The metrics in the order of METRIC_COLUMNS; one that is not there is an empty cell."""
    return [None if metrics.get(key) is None else factor * metrics[key] for key, _, factor, _ in _METRICS]


def side_by_side(first, second, keys, first_name, second_name):
    """A sentence with both values of some metrics."""
    parts = [
        f"{heading.replace(' / ', ' in ')}: {factor * first[key]:{form}} and {factor * second[key]:{form}}"
        for key, heading, factor, form in _METRICS
        if key in keys
    ]
    return f"{first_name.capitalize()} and {second_name}: " + "; ".join(parts) + "."


def interpolate(array, order):
    """Twice the resolution by interpolation on the same grid: output m lies at input index m/2 - 1/4."""
    return ndimage.zoom(np.asarray(array, dtype=np.float32), 2, order=order, mode="nearest", grid_mode=True)


def average_down(array):
    """Means of 2x2x2 blocks, float; every size has to be even."""
    z, y, x = array.shape
    blocks = np.asarray(array, dtype=np.float64).reshape(z // 2, 2, y // 2, 2, x // 2, 2)
    return blocks.mean(axis=(1, 3, 5)).astype(np.float32)


def new_figure(columns=1, rows=1, width=3.4, height=3.4):
    """A figure and its axes (always a 2-D array), in the style of all pictures here."""
    plt.rcParams.update({"font.size": 9, "axes.titlesize": 9, "savefig.dpi": 100, "savefig.bbox": "tight"})
    return plt.subplots(rows, columns, figsize=(width * columns, height * rows), squeeze=False)


def save_figure(figure, output_folder, file, dither=False):
    """Write FILE (a PNG of 256 colours: a third of the bytes) into the output folder and return its name.

    dither: for pictures with more colours than that, such as shaded surfaces.
    """
    rendered = io.BytesIO()
    figure.savefig(rendered, format="png")
    plt.close(figure)
    picture = Image.open(rendered).convert("RGB")
    reduced = picture.quantize(256, dither=Image.Dither.NONE)
    if dither:
        reduced = picture.quantize(palette=reduced, dither=Image.Dither.FLOYDSTEINBERG)
    reduced.save(pathlib.Path(output_folder) / file, optimize=True)
    return file


def show_slice(axes, image, title="", **options):
    """One grey slice without ticks; options as for matplotlib's imshow."""
    axes.imshow(image, **{"cmap": "gray", "interpolation": "nearest", **options})
    axes.set_title(title)
    axes.set_axis_off()
