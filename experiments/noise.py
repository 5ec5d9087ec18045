# SPDX-License-Identifier: Apache-2.0
"""Noise, blur and labels: which surface comes closest, beside smoothing the mesh or the volume; and what it costs.

A capsule and a rounded box with exactly known surfaces, 64^3 voxels of which each is the fraction of 8^3 samples that
are inside. The same schemes' PSNR on CT volumes, averaged 2x2x2 and brought back, and their gain of white noise.
"""
import numpy as np
from scipy import ndimage

import common
import meshes
import rendering
import shapes
from report import Finding, Picture, Result, Table, Text
from volumes import sample_volumes

SIZE = 64
LEVEL = 0.5
SEED = 977
# Heading: (standard deviation of a Gaussian blur in voxels, of white noise as a part of the contrast, binary labels).
CASES = {
    "clean": (0.0, 0.0, False),
    "2 % noise": (0.0, 0.02, False),
    "blur 0.6, 2 % noise": (0.6, 0.02, False),
    "blur 1, 3 % noise": (1.0, 0.03, False),
    "binary labels": (0.0, 0.0, True),
}
SMALL_CASES = ("clean", "2 % noise")
RESTORED_TENSIONS = (2.0, 0.5, 0.0)
SURFACES_BEST = "restored, tension 0"
SMOOTH_MESHES = {pass_band: f"the same, windowed sinc, pass band {pass_band:g}" for pass_band in (0.1, 0.02)}
GAUSSIAN = "a Gaussian of 0.7 voxel before"
SURFACE_NETS = "surface nets on the labels"
DETAIL_REGIONS = {
    "trabecular_uct_LHDL": (slice(52, 148),) * 3,
    "cranium": (slice(6, 102), slice(80, 176), slice(60, 156)),
}
STATISTICS = {
    "angle": ("mean angle between the mesh's normals and the true ones, degrees", ".2f"),
    "bias": ("mean signed distance from the true surface, input voxels (negative: too small)", ".4f"),
    "rms": ("root mean square distance from the true surface, input voxels", ".4f"),
}
FOUR_WAYS = ("marching cubes on the voxels", "linear interpolation", "non-oscillatory", SURFACES_BEST)
ANGLE_SCALE = (0.0, 15.0)


def exact_shapes():
    """The two shapes; the box is turned by a fixed orthogonal matrix."""
    turned = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))[0]
    return {
        "capsule": shapes.Capsule((18.3, 20.1, 22.7), (43.9, 41.2, 38.4), 9.3),
        "rounded box": shapes.RoundedBox((31.4, 31.8, 31.1), turned, (13.0, 9.0, 11.0), 4.0),
    }


def voxelisations(chosen):
    """{(shape name, case): voxels}; a shape has the same noise in all cases."""
    generator, found = np.random.default_rng(SEED), {}
    for name, shape in exact_shapes().items():
        exact, white = shapes.sampled_volume(shape, SIZE), generator.normal(size=(SIZE,) * 3)
        for case in chosen:
            blur, noise, binary = CASES[case]
            voxels = shapes.labels(shape, SIZE) if binary else exact
            voxels = ndimage.gaussian_filter(voxels, blur, mode="nearest") if blur else voxels
            found[name, case] = (voxels + noise * white).astype(np.float32)
    return found


def schemes():
    """{name: function from voxels to twice the resolution} of the subdivision schemes."""

    def scheme(name, tension):
        return lambda voxels: common.subdivide(voxels, scheme=name, tension=tension)

    named = {common.SCHEMES[name]: scheme(name, common.DEFAULT_TENSION) for name in ("linear", "nonoscillatory")}
    return {**named, **{f"restored, tension {t:g}": scheme("restored", t) for t in RESTORED_TENSIONS}}


def surfaces():
    """{name: function from voxels to a mesh}: what users do today, then the schemes."""

    def on_voxels(voxels):
        return meshes.isosurface(voxels, LEVEL)

    def smooth(pass_band):
        return lambda voxels: meshes.smoothed(on_voxels(voxels), pass_band)

    def doubled(double):
        return lambda voxels: meshes.isosurface(double(voxels), LEVEL, parts=2)

    return {
        "marching cubes on the voxels": on_voxels,
        **{name: smooth(pass_band) for pass_band, name in SMOOTH_MESHES.items()},
        GAUSSIAN: lambda voxels: on_voxels(ndimage.gaussian_filter(voxels, 0.7)),
        "linear interpolation": doubled(lambda voxels: common.interpolate(voxels, 1)),
        **{name: doubled(double) for name, double in schemes().items()},
    }


def label_surfaces():
    """The same of binary labels alone."""
    return {SURFACE_NETS: meshes.surface_nets}


def measure(mesh, shape):
    """STATISTICS of a mesh, each triangle at its centroid and weighted by its area."""
    angles, areas = meshes.normal_angles(mesh, shape.normals(mesh.centroids()))
    distances = shape.distance(mesh.centroids())
    return {
        "angle": float(np.average(angles, weights=areas)),
        "bias": float(np.average(distances, weights=mesh.areas())),
        "rms": float(np.sqrt(np.average(distances**2, weights=mesh.areas()))),
    }


def measure_all(chosen):
    """{(method, shape name, case): (STATISTICS, mesh)}."""
    exact = exact_shapes()
    found = {}
    for (name, case), voxels in voxelisations(chosen).items():
        binary = CASES[case][2]
        for method, surface in {**surfaces(), **(label_surfaces() if binary else {})}.items():
            mesh = surface(voxels)
            found[method, name, case] = (measure(mesh, exact[name]), mesh)
    return found


def table(statistic, measured, chosen):
    caption, form = STATISTICS[statistic]
    cases = [(name, case) for name in exact_shapes() for case in chosen]
    columns = [("surface of", ""), *[(f"{name}, {case}", form) for name, case in cases]]
    methods = dict.fromkeys(method for method, _, _ in measured)
    rows = [
        [method, *[measured[(method, *key)][0][statistic] if (method, *key) in measured else None for key in cases]]
        for method in methods
    ]
    return Table(f"noise_{statistic}", f"**{caption[0].upper()}{caption[1:]}.**", columns, rows)


def psnr(reference, result):
    """In dB; the peak is the reference's range."""
    error = np.mean((result.astype(float) - reference) ** 2)
    return float(10.0 * np.log10(np.ptp(reference.astype(float)) ** 2 / error))


def white_noise_gain(double):
    """Standard deviation of the result on white noise, by that of the noise."""
    white = np.random.default_rng(SEED).normal(size=(SIZE,) * 3).astype(np.float32)
    return float(double(white).std() / white.std())


def detail_table(paths):
    """What the schemes keep of detail and of white noise, and notes on volumes that are absent."""
    volumes, notes = sample_volumes(paths)
    volumes = [volume for volume in volumes if volume.name in DETAIL_REGIONS]
    originals = {volume.name: volume.data[DETAIL_REGIONS[volume.name]] for volume in volumes}
    columns = [("scheme", ""), *[(f"PSNR / dB, {name}", ".2f") for name in originals], ("gain of white noise", ".2f")]
    rows = [
        [
            method,
            *[psnr(original, double(common.average_down(original))) for original in originals.values()],
            white_noise_gain(double),
        ]
        for method, double in schemes().items()
    ]
    caption = "**The other side**: crops of CT volumes averaged 2×2×2 and brought back, and white noise alone."
    return Table("noise_detail", caption, columns, rows), notes


def draw(measured, case, output_folder):
    """The rounded box four ways, coloured by the angle to the true normal."""
    shape = exact_shapes()["rounded box"]
    panels = []
    for method in FOUR_WAYS:
        mesh = measured[method, "rounded box", case][1]
        angles, _ = meshes.normal_angles(mesh, shape.normals(mesh.centroids()))
        panels.append(rendering.Panel(method.replace(" on the voxels", "\non the voxels"), mesh, angles))
    view = rendering.View(focus=shape.centre, towards=(0.45, -1.0, 0.35), half_height=22.0)
    scale = rendering.Scale("angle to the true normal, degrees", *ANGLE_SCALE)
    return rendering.draw(panels, view, scale, len(panels), output_folder, "noise.png")


def grey_findings(value, names, chosen):
    """With partial volume: restored beside smoothing the mesh or the volume. value(method, statistic, name, case)."""
    smoothing = [SMOOTH_MESHES[0.1], SMOOTH_MESHES[0.02], GAUSSIAN]
    keys = [(name, case) for name in names for case in chosen if not CASES[case][2]]
    angles = [(value(SURFACES_BEST, "angle", *key), min(value(m, "angle", *key) for m in smoothing)) for key in keys]
    yield Finding(
        "Restored with tension 0 has better normals than smoothing the mesh, at either pass band, and than a Gaussian"
        " before, in every case but binary labels.",
        all(mine < theirs for mine, theirs in angles),
        f"It and the best of them: {', '.join(f'{mine:.2f} and {theirs:.2f}' for mine, theirs in angles)} degrees.",
    )
    shares = [
        abs(value(SURFACES_BEST, "bias", *key)) / min(abs(value(m, "bias", *key)) for m in smoothing) for key in keys
    ]
    yield Finding(
        "There its bias is less than theirs, too.", max(shares) < 1, f"At most {max(shares):.2f} times as large."
    )


def label_findings(value, names):
    """On binary labels others have the better normals; what that costs."""
    case = "binary labels"
    order = (SURFACE_NETS, SMOOTH_MESHES[0.02], common.SCHEMES["nonoscillatory"], SURFACES_BEST)
    angles = {name: [value(method, "angle", name, case) for method in order] for name in names}
    yield Finding(
        "On binary labels, which have no partial volume, surface nets have the best normals, then the smoothed mesh"
        " (pass band 0.02), then the non-oscillatory scheme, then restored.",
        all(found == sorted(found) for found in angles.values()),
        "In this order, degrees: "
        + "; ".join(f"{name} {', '.join(f'{a:.2f}' for a in found)}" for name, found in angles.items())
        + ".",
    )
    sizes = {name: [value(method, "bias", name, case) for method in order] for name in names}
    yield Finding(
        "The price of surface nets is size; neither they nor a smoothed mesh are a volume.",
        all(max(abs(bias) for bias in found[1:]) < abs(found[0]) / 2 for found in sizes.values()),
        "In the same order, voxels too small: "
        + "; ".join(f"{name} {', '.join(f'{-bias:.3f}' for bias in found)}" for name, found in sizes.items())
        + ".",
    )


def findings(measured, chosen):
    """Where the restored scheme wins, and where others do."""
    names = list(exact_shapes())

    def value(method, statistic, name, case):
        return measured[method, name, case][0][statistic]

    yield from grey_findings(value, names, chosen)
    if "binary labels" in chosen:
        yield from label_findings(value, names)


def run(setting, output_folder, paths=()):
    chosen = list(CASES) if setting == "full" else list(SMALL_CASES)
    measured = measure_all(chosen)
    details, notes = detail_table(paths)
    pictured = chosen[-1] if setting == "small" else "2 % noise"
    result = Result("Noise and blur: surfaces beside what users do today")
    result.add(
        Text(
            f"A capsule and a rounded box in {SIZE}³ voxels with partial volume, blurred (in voxels) and with white"
            " noise (of the contrast); the isosurface at one half against the exact surface, each triangle at its"
            " centroid, weighted by area. Mesh smoothing is VTK's windowed sinc with 20 iterations; surface nets are"
            " VTK's, smoothed as they are by default, and need labels. VTK is that of experiments/requirements.txt:"
            " other versions of its filters find other figures."
        ),
        *[table(statistic, measured, chosen) for statistic in STATISTICS],
        details,
        *map(Text, notes),
        Picture(draw(measured, pictured, output_folder), f"The rounded box four ways ({pictured})"),
        *findings(measured, chosen),
    )
    return result
