# SPDX-License-Identifier: Apache-2.0
"""The paper's title: are the surfaces smoother, and what does that cost?

Shapes whose surfaces and normals are known exactly are voxelised, brought to twice the resolution by each method, and
their isosurfaces at one half are held against the exact ones.
"""
import numpy as np

import meshes
import rendering
import shapes
from doubling import doubling_methods
from report import Finding, Picture, Result, Table, Text

SIZES = {"small": 32, "full": 64}
VOXELISATIONS = {"labels": shapes.labels, "partial volume": shapes.partial_volume}
LEVEL = 0.5
# Where an endless shape leaves the volume its mesh shows the boundary condition: this many voxels are left out.
MARGIN = 6.0
STATISTICS = {
    "angle_mean": ("angle between the mesh's normals and the true normals, mean, degrees", ".2f"),
    "angle_q95": ("the same angle, 95 % quantile, degrees", ".2f"),
    "distance_mean": ("signed distance from the true surface, mean, input voxels (negative: too small)", ".4f"),
    "distance_rms": ("distance from the true surface, root mean square, input voxels", ".4f"),
    "distance_max": ("distance from the true surface, maximum, input voxels", ".4f"),
}
PICTURED = ("original", "linear interpolation", "B-spline 5 interpolation", "non-oscillatory", "restored, tension 0")
PICTURED_SHAPE = "sphere"
ANGLE_SCALE = (0.0, 15.0)


def exact_shapes(size):
    """The four shapes in a cube of `size` voxels, centred off the grid and tilted against it."""
    centre = tuple(size / 2 + offset for offset in (-0.3, 0.1, -0.45))
    tilted = tuple(shapes.unit((1.0, 0.37, 0.21)))
    return {
        "sphere": shapes.Sphere(centre, 0.35 * size),
        "cylinder": shapes.Cylinder(centre, tilted, 0.25 * size),
        "torus": shapes.Torus(centre, tilted, 0.25 * size, 0.11 * size),
        "plane": shapes.Plane(centre, tilted),
    }


def methods():
    """Each method's name and function; all but the first double the resolution."""
    return {"original": lambda voxels: voxels, **doubling_methods()}


def surface(volume, shape, size):
    """The shape's isosurface at one half, in input voxels, an endless shape's away from the volume's faces."""
    mesh = meshes.isosurface(volume, LEVEL, parts=volume.shape[0] // size)
    if not shape.endless:
        return mesh
    to_face = np.minimum(mesh.corners(), size - 1 - mesh.corners()).min(axis=(1, 2))
    return mesh.select(to_face > MARGIN)


def measure(mesh, shape):
    """STATISTICS of a mesh against the exact shape; all but the maximum are weighted by area."""
    angles, areas = meshes.normal_angles(mesh, shape.normals(mesh.centroids()))
    distances, point_areas = shape.distance(mesh.points), mesh.point_areas()
    return {
        "angle_mean": float(np.average(angles, weights=areas)),
        "angle_q95": float(meshes.weighted_quantile(angles, areas, 0.95)),
        "distance_mean": float(np.average(distances, weights=point_areas)),
        "distance_rms": float(np.sqrt(np.average(distances**2, weights=point_areas))),
        "distance_max": float(np.abs(distances).max()),
    }


def measure_all(size):
    """{(shape, voxelisation, method): STATISTICS} and, for the pictures, {(voxelisation, method): mesh}."""
    measured, pictured = {}, {}
    for shape_name, shape in exact_shapes(size).items():
        for voxelisation, voxelise in VOXELISATIONS.items():
            voxels = voxelise(shape, size)
            for method, double in methods().items():
                mesh = surface(double(voxels), shape, size)
                measured[shape_name, voxelisation, method] = measure(mesh, shape)
                if shape_name == PICTURED_SHAPE and method in PICTURED:
                    pictured[voxelisation, method] = mesh
    return measured, pictured


def table(statistic, measured, size):
    """One statistic: a row for each method, a column for each shape and voxelisation."""
    caption, form = STATISTICS[statistic]
    cases = [(shape, voxelisation) for shape in exact_shapes(size) for voxelisation in VOXELISATIONS]
    columns = [("method", "")] + [(f"{shape}, {voxelisation}", form) for shape, voxelisation in cases]
    rows = [[method] + [measured[case + (method,)][statistic] for case in cases] for method in methods()]
    return Table(f"smoothness_{statistic}", f"**{caption[0].upper()}{caption[1:]}.**", columns, rows)


def draw(pictured, size, output_folder):
    """The sphere's surfaces side by side, coloured by the angle to the true normal."""
    shape = exact_shapes(size)[PICTURED_SHAPE]
    panels = []
    for voxelisation in VOXELISATIONS:
        for method in PICTURED:
            mesh = pictured[voxelisation, method]
            angles, _ = meshes.normal_angles(mesh, shape.normals(mesh.centroids()))
            panels.append(rendering.Panel(f"{method}\n({voxelisation})", mesh, angles))
    view = rendering.View(focus=shape.centre, towards=(0.45, -1.0, 0.35), half_height=shape.radius * 1.05)
    scale = rendering.Scale("angle to the true normal, degrees", *ANGLE_SCALE)
    return rendering.draw(panels, view, scale, len(PICTURED), output_folder, "smoothness.png")


def findings(measured, size):
    """What the paper's title promises, and its price, checked on every shape with partial volume."""
    every_shape = list(exact_shapes(size))

    def values(statistic, method):
        return np.array([measured[shape, "partial volume", method][statistic] for shape in every_shape])

    others = ("non-oscillatory", "B-spline subdivision", "restored", "restored, tension 0")
    rivals = [name for name in methods() if name not in others]
    ours, best_rival = values("angle_mean", "non-oscillatory"), np.min(
        [values("angle_mean", name) for name in rivals], axis=0
    )
    sphere_ours, sphere_linear = (
        measured["sphere", "partial volume", name] for name in ("non-oscillatory", "linear subdivision")
    )
    yield Finding(
        "The non-oscillatory scheme's surfaces are smoother than those of the original, of interpolation and of the"
        " linear schemes (partial volume, all four shapes).",
        bool(np.all(ours < best_rival)),
        f"On the sphere its normals are {sphere_ours['angle_mean']:.2f} degrees off on average; the linear scheme's"
        f" {sphere_linear['angle_mean']:.2f}.",
    )
    yield Finding(
        "The price is size: curved surfaces shrink towards their centre of curvature.",
        bool(sphere_ours["distance_mean"] < sphere_linear["distance_mean"] < 0.01),
        f"The sphere's radius is {-sphere_ours['distance_mean']:.4f} input voxels too small, with the linear scheme"
        f" {-sphere_linear['distance_mean']:.4f}. The B-spline masks smooth; the flatter the surface, the smaller the"
        " loss.",
    )
    restored = measured["sphere", "partial volume", "restored, tension 0"]
    restored_bias = values("distance_mean", "restored, tension 0")
    yield Finding(
        "The restored scheme's surfaces are smoother still, and hardly shrink (partial volume, all four shapes).",
        bool(np.all(values("angle_mean", "restored, tension 0") < ours))
        and bool(np.all(np.abs(restored_bias) <= np.abs(values("distance_mean", "non-oscillatory")))),
        f"On the sphere its normals are {restored['angle_mean']:.2f} degrees off, and the radius"
        f" {abs(restored['distance_mean']):.4f} input voxels.",
    )
    differences = [
        abs(
            measured[shape, "labels", "non-oscillatory"][name] - measured[shape, "labels", "B-spline subdivision"][name]
        )
        for shape in every_shape
        for name in STATISTICS
    ]
    yield Finding(
        "On binary labels, where every edge is a jump with flat voxels beside it, the non-oscillatory surface is the"
        " B-spline one.",
        max(differences) < 1e-3,
    )


def run(setting, output_folder):
    size = SIZES[setting]
    measured, pictured = measure_all(size)
    picture = draw(pictured, size, output_folder)
    result = Result("Smoothness: surfaces against the exact ones")
    result.add(
        Text(
            f"Four shapes in {size}³ voxels, once as binary labels and once with the fraction of each voxel that is"
            " inside (partial volume). The isosurface at one half is compared with the exact surface; means and"
            " quantiles are weighted by area."
        ),
        *[table(statistic, measured, size) for statistic in STATISTICS],
        Picture(picture, "The sphere's surfaces, coloured by the angle between mesh normal and true normal"),
        *findings(measured, size),
    )
    return result
