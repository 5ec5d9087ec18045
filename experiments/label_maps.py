# SPDX-License-Identifier: Apache-2.0
"""Label maps: bodies sampled at voxel centres, doubled, against the body sampled at the children's centres."""
import numpy as np
import SimpleITK as sitk
from scipy import ndimage

import common
import noise
import shapes
from report import Finding, Result, Table, Text

SIZE = noise.SIZE
BALL_CENTRE = (31.4, 31.8, 31.1)
BALL_RADII = {"small": (6.3,), "full": (22.4, 6.3, 2.7)}
RESTORED = "restored, tension 0"
BLURRED = "a Gaussian of 1 voxel, then linear"
# SimpleITK's names for NearestNeighbor-, LabelImageGeneric- (of linear) and LabelImageGaussianInterpolateImageFunction.
ITK_INTERPOLATORS = {
    "ITK, nearest neighbour": sitk.sitkNearestNeighbor,
    "ITK, label linear": sitk.sitkLabelLinear,
    "ITK, label Gaussian": sitk.sitkLabelGaussian,
}


def bodies(setting):
    balls = {f"ball {radius:g}": shapes.Sphere(BALL_CENTRE, radius) for radius in BALL_RADII[setting]}
    return {**noise.exact_shapes(), **balls}


def sample(shape, parts):
    """1 where the centre of one of `parts` children of a voxel along each axis is inside, else 0."""
    axis = (np.arange(parts * SIZE) + 0.5) / parts - 0.5
    centres = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1)
    return (shape.distance(centres) < 0).astype(np.uint8)


def resample(interpolator):
    """A function from labels to labels on twice the grid, by ITK's ResampleImageFilter."""

    def double(labels):
        image = sitk.GetImageFromArray(labels)
        size = [2 * n for n in image.GetSize()]
        # Output m lies at input index m/2 - 1/4.
        grid = ([-0.25] * 3, [0.5] * 3, image.GetDirection())
        return sitk.GetArrayFromImage(sitk.Resample(image, size, sitk.Transform(), interpolator, *grid))

    return double


def _votes_of(double, sigma=0.0):
    """A function from labels to labels: those with more than half of the indicator, first smoothed by a Gaussian."""

    def vote(labels):
        indicator = labels.astype(np.float32)
        return (double(ndimage.gaussian_filter(indicator, sigma) if sigma else indicator) > 0.5).astype(np.uint8)

    return vote


def methods():
    """{name: function from labels to labels on twice the grid}."""

    def scheme(name, tension=common.DEFAULT_TENSION):
        return lambda labels: common.subdivide_labels(labels, name, tension)

    def grey(name):
        return lambda indicator: common.subdivide(indicator, scheme=name)

    return {
        "nearest voxel": lambda labels: common.interpolate(labels, 0).astype(np.uint8),
        "linear": scheme("linear"),
        "B-spline": scheme("bspline"),
        "non-oscillatory (its indicator above one half)": _votes_of(grey("nonoscillatory")),
        RESTORED: scheme("restored", 0.0),
        BLURRED: _votes_of(grey("linear"), sigma=1.0),
        **{name: resample(interpolator) for name, interpolator in ITK_INTERPOLATORS.items()},
    }


def measure(doubled, true):
    """Wrong children by the true body's boundary voxels (with a neighbour outside), and the error of the volume."""
    inside = true.astype(bool)
    boundary = inside & ~ndimage.binary_erosion(inside)
    return np.count_nonzero(doubled != true) / np.count_nonzero(boundary), doubled.sum() / true.sum() - 1.0


def measure_all(setting):
    """{(method, body): (share of wrong children, relative error of the volume)}."""
    found = {}
    for body, shape in bodies(setting).items():
        labels, true = sample(shape, 1), sample(shape, 2)
        for method, double in methods().items():
            found[method, body] = measure(double(labels), true)
    return found


def table(measured, setting):
    names = list(bodies(setting))
    heads = [(f"{name}: wrong / %", ".1f") for name in names] + [(f"{name}: volume / %", "+.2f") for name in names]
    rows = [
        [
            method,
            *[100.0 * measured[method, name][0] for name in names],
            *[100.0 * measured[method, name][1] for name in names],
        ]
        for method in methods()
    ]
    caption = (
        "**Children with the wrong label**, by the true boundary's voxels (those of the body with a face neighbour"
        " outside), and the error of the body's volume."
    )
    return Table("label_maps", caption, [("doubled by", ""), *heads], rows)


def findings(measured, setting):
    names = list(bodies(setting))
    smallest = min((name for name in names if name.startswith("ball")), key=lambda name: float(name.split()[1]))
    nearest = [measured[RESTORED, name][0] / measured["nearest voxel", name][0] for name in names]
    yield Finding(
        "Restored with tension 0 leaves less than half as many children with a wrong label as doubling voxels does.",
        max(nearest) < 0.5,
        f"At most {max(nearest):.2f} times as many.",
    )
    lost = {method: measured[method, smallest][1] for method in ("B-spline", RESTORED)}
    yield Finding(
        "Small bodies keep their volume, which the B-spline takes from them.",
        abs(lost[RESTORED]) < 0.05 and lost["B-spline"] < lost[RESTORED],
        f"The volume of {smallest} changes by {100 * lost[RESTORED]:+.1f} %, with the B-spline by"
        f" {100 * lost['B-spline']:+.1f} %.",
    )
    peers = {
        peer: [measured[peer, name][0] / measured[RESTORED, name][0] for name in names] for peer in ITK_INTERPOLATORS
    }
    yield Finding(
        "ITK's label interpolators leave more children with a wrong label on every body.",
        all(min(ratios) > 1 for ratios in peers.values()),
        " ".join(f"{peer}: {min(ratios):.1f} to {max(ratios):.1f} times as many." for peer, ratios in peers.items()),
    )


def winners(measured, setting):
    """In words: which methods are better than restored with tension 0, and on which bodies."""
    sentences = []
    for place, what in enumerate(("Fewer wrong children", "The volume closer to the body's")):
        better = {}
        for method in methods():
            for name in bodies(setting):
                if abs(measured[method, name][place]) < abs(measured[RESTORED, name][place]):
                    better.setdefault(method, []).append(name)
        listed = "; ".join(f"{method} ({', '.join(names)})" for method, names in better.items()) or "none"
        sentences.append(f"{what} than with restored, tension 0: {listed}.")
    return " ".join(sentences)


def run(setting, output_folder):
    del output_folder
    measured = measure_all(setting)
    result = Result("Label maps")
    result.add(
        Text(
            f"Bodies in {SIZE}³ voxels, labelled 1 where the voxel's centre is inside, else 0. Each label's indicator"
            " votes under a scheme; the largest vote wins (docs/scheme.md, section 6). ITK's interpolators are used"
            " through its ResampleImageFilter, the Gaussian with SimpleITK's parameters."
        ),
        table(measured, setting),
        Text("**Where others win.** " + winners(measured, setting)),
        *findings(measured, setting),
    )
    return result
