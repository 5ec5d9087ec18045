# SPDX-License-Identifier: Apache-2.0
"""Isosurfaces of volumes before and after losing half the resolution (the paper's Figure 6).

A volume gets a small pit in its surface, is averaged down 2x2x2 and brought back by each method. Its isosurface is
compared with the original's, everywhere and at the pit. Of each isosurface the largest connected piece is taken: noise
and the scanner's headrest make others, which come and go with the resolution. Lengths are in voxels of the original;
where its voxels are not cubes, their shortest side is 1.
"""
from dataclasses import dataclass

import numpy as np
from scipy import ndimage
from skimage.filters import threshold_multiotsu

import common
import meshes
import metrology
import rendering
import shapes
import specimen
from doubling import doubling_methods
from report import Finding, Picture, Result, Table, Text
from volumes import Volume, sample_volumes

REGION = {"small": 72, "full": 256}
# The pit that the volumes carry, and all that are tried: radii in voxels along each axis.
PIT_RADIUS, PIT_RADII = 2.0, (1.0, 2.0, 3.0)
# Half the edge of the box around the pit that is looked at closely.
NEIGHBOURHOOD = 16
PICTURED = ("linear interpolation", "linear subdivision", "non-oscillatory", "restored")
WHOLE_VIEW = (0.25, -0.6, 1.0)
SCALE = rendering.Scale("distance from the original's surface, voxels", 0.0, 1.0)


@dataclass
class Case:
    """A volume, the grey value of its surface, a voxel's sides; where a pit goes and which way it opens."""

    name: str
    voxels: np.ndarray
    level: float
    sides: np.ndarray
    place: np.ndarray
    opening: np.ndarray

    def surface(self, voxels):
        return meshes.isosurface(voxels, self.level, spacing=self.sides)

    def near_pit(self, voxels):
        """The voxels of the box around the pit; it starts on an even index, as averaging down needs it."""
        start = (self.place - NEIGHBOURHOOD) // 2 * 2
        return voxels[tuple(slice(s, s + 2 * NEIGHBOURHOOD) for s in start)]


@dataclass
class Measured:
    """A method's surface against the original's."""

    mesh: meshes.Mesh
    point_distances: np.ndarray
    distance: meshes.MeshDistance


def pit_place(voxels, level, sides):
    """A place on the surface of the thickest part, and the unit vector out of the material there ([z, y, x]).

    Only the part of the volume with a whole neighbourhood around it is considered.
    """
    depths, nearest_outside = ndimage.distance_transform_edt(voxels > level, sampling=sides, return_indices=True)
    margin = NEIGHBOURHOOD + 2
    core = tuple(slice(margin, n - margin) for n in voxels.shape)
    outside = np.all([(i >= margin) & (i < n - margin) for i, n in zip(nearest_outside, voxels.shape)], axis=0)
    candidates = np.where(outside, depths, 0)[core]
    deepest = np.array(np.unravel_index(np.argmax(candidates), candidates.shape)) + margin
    place = nearest_outside[(slice(None), *deepest)]
    return place, shapes.unit((place - deepest) * sides)


def with_pit(voxels, place, radius):
    """The volume with a ball of its least dense material at a place; the ball's surface has partial voxels."""
    half = int(radius) + 1
    ball = shapes.partial_volume(shapes.Sphere((half,) * 3, radius), 2 * half + 1)
    box = tuple(slice(p - half, p + half + 1) for p in place)
    pitted = voxels.copy()
    pitted[box] += (np.quantile(voxels, 0.05) - pitted[box]) * ball
    return pitted


def around(place, shape, size):
    """The box of at most `size` voxels along each axis around a place inside a volume; starts and sizes are even."""
    kept = [min(n, size) // 2 * 2 for n in shape]
    starts = [int(np.clip(p - k // 2, 0, n - k)) // 2 * 2 for p, k, n in zip(place, kept, shape)]
    return starts, tuple(slice(s, s + k) for s, k in zip(starts, kept))


def prepare(volume, level, size):
    """The Case of a volume, cut to `size` voxels along each axis around the pit's place."""
    sides = np.array(volume.spacing) / min(volume.spacing)
    place, opening = pit_place(volume.data, level, sides)
    starts, box = around(place, volume.data.shape, size)
    return Case(volume.name, volume.data[box].astype(np.float32), level, sides, place - starts, opening)


def bone_level(voxels):
    """The upper threshold of Otsu's method for three classes: bone against soft tissue or marrow, and air."""
    return float(threshold_multiotsu(voxels, 3)[-1])


def cases(setting, paths):
    """The Cases of the CT volumes and of a scan of the synthetic specimen, and notes on volumes that are absent."""
    volumes, notes = sample_volumes(paths)
    found = [prepare(volume, bone_level(volume.data), REGION[setting]) for volume in volumes]
    scanned = metrology.SETTINGS[setting]
    _, voxels = specimen.scan(0, scanned.size, scanned.voxel)
    metal = Volume("specimen", voxels, (scanned.voxel,) * 3)
    return [*found, prepare(metal, metrology.iso50(voxels), REGION[setting])], notes


def bring_back(method, voxels):
    return method(common.average_down(voxels))


def measure(case):
    """The original's surface, and {method: Measured}; both with the pit."""
    pitted = with_pit(case.voxels, case.place, PIT_RADIUS)
    original = case.surface(pitted).largest_piece()
    measured = {}
    for name, method in doubling_methods().items():
        mesh = case.surface(bring_back(method, pitted)).largest_piece()
        distances = meshes.point_distances(mesh, original)
        measured[name] = Measured(mesh, distances[0], meshes.mesh_distance(mesh, original, distances))
    return original, measured


def pit_depth(case, radius, method):
    """How far the surface with a pit lies from the one without, where they are farthest apart."""
    plain = case.near_pit(case.voxels)
    pitted = case.near_pit(with_pit(case.voxels, case.place, radius))
    distances = meshes.point_distances(*(case.surface(method(voxels)) for voxels in (pitted, plain)))
    return float(np.concatenate(distances).max())


def pit_depths(case):
    """{method: depths of the pits of PIT_RADII}; the first method is leaving the original as it is."""
    found = {"original": [pit_depth(case, radius, lambda voxels: voxels) for radius in PIT_RADII]}
    for name, method in doubling_methods().items():
        found[name] = [
            pit_depth(case, radius, lambda voxels, method=method: bring_back(method, voxels)) for radius in PIT_RADII
        ]
    return found


def close_up(case, mesh, values):
    """The part of a mesh, and of its points' values, in the box around the pit."""
    away = np.abs(mesh.points - case.place * case.sides)
    near = np.all(away < NEIGHBOURHOOD * 0.75, axis=1)
    kept = near[mesh.triangles].all(axis=1)
    return mesh.select(kept), values[np.unique(mesh.triangles[kept])]


def draw(case, original, measured, output_folder):
    """The whole surfaces and, below, what is around the pit, coloured by their distance from the original's."""
    shown = {"original": (original, np.zeros(len(original.points)))}
    shown.update({name: (measured[name].mesh, measured[name].point_distances) for name in PICTURED})
    lowest, highest = original.points.min(axis=0), original.points.max(axis=0)
    whole = rendering.View(tuple((lowest + highest) / 2), WHOLE_VIEW, float((highest - lowest).max()) * 0.65)
    close = rendering.View(tuple(case.place * case.sides), tuple(case.opening), NEIGHBOURHOOD * 0.7)
    panels = [rendering.Panel(name, *surface) for name, surface in shown.items()]
    panels += [rendering.Panel(f"{name}: the pit", *close_up(case, *surface)) for name, surface in shown.items()]
    views = [whole] * len(shown) + [close] * len(shown)
    return rendering.draw(panels, views, SCALE, len(shown), output_folder, f"surfaces_{case.name}.png")


def distance_table(measured):
    """The symmetric distances from the original's surface, by volume and method."""
    statistics = [("mean", ".3f"), ("95 %", ".3f"), ("maximum", ".2f")]
    rows = [
        [case_name, method, found.distance.mean, found.distance.q95, found.distance.maximum]
        for case_name, by_method in measured.items()
        for method, found in by_method.items()
    ]
    caption = (
        "**Distance between the surfaces of the original and of what was brought back**, both ways, weighted by area,"
        " in voxels of the original; of each surface the largest connected piece. The maximum is set by thin parts that"
        " break off or join."
    )
    return Table("surfaces_distance", caption, [("volume", ""), ("brought back by", ""), *statistics], rows)


def pit_table(depths):
    """The depths of all pits, by volume and method."""
    columns = [("volume", ""), ("surface of", ""), *[(f"pit of radius {radius:g}", ".2f") for radius in PIT_RADII]]
    rows = [[name, method, *values] for name, by_method in depths.items() for method, values in by_method.items()]
    caption = (
        "**What is left of a pit**: the largest distance between the surfaces with and without it, in voxels of the"
        " original (a radius is counted along each axis). A pit of radius 1 is one voxel of the averaged volume wide."
    )
    return Table("surfaces_pits", caption, columns, rows)


def findings(measured, depths):
    """Whether the defect stays visible, and which of the paper's schemes keeps closer to the original."""
    planted = PIT_RADII.index(PIT_RADIUS)
    schemes = [common.SCHEMES[name] for name in ("linear", "nonoscillatory", "bounded")]
    margins = [
        depths[name][scheme][planted] / measured[name][scheme].distance.q95 for name in measured for scheme in schemes
    ]
    left = [
        by_method[common.SCHEMES["nonoscillatory"]][planted] / by_method["original"][planted]
        for by_method in depths.values()
    ]
    yield Finding(
        "A pit as wide as two voxels of the averaged volume stays visible in the surfaces of the linear, the"
        " non-oscillatory and the bounded linear scheme: it stands out of 95 % of their distances from the original.",
        min(margins) > 1,
        f"It is at least {min(margins):.1f} times as deep. The non-oscillatory scheme leaves {min(left):.0%} to"
        f" {max(left):.0%} of its depth in the original.",
    )
    linear, ours = (
        np.array([by_method[common.SCHEMES[name]].distance.mean for by_method in measured.values()])
        for name in ("linear", "nonoscillatory")
    )
    ratios = ours / linear
    yield Finding(
        "The linear scheme's surface lies closer to the original's than the non-oscillatory scheme's, as Table 1's"
        " errors of the grey values let one expect.",
        bool(np.all(ratios > 1)),
        f"The non-oscillatory scheme's mean distance is {ratios.min():.1f} to {ratios.max():.1f} times as large: it"
        " rounds edges and thin walls, and its surface is the smoother one (see Smoothness).",
    )


def run(setting, output_folder, paths=()):
    result = Result("Surfaces: averaged 2×2×2 and brought back (Figure 6)")
    measured, depths, pictures = {}, {}, []
    chosen, notes = cases(setting, paths)
    for case in chosen:
        original, measured[case.name] = measure(case)
        depths[case.name] = pit_depths(case)
        caption = f"{case.name}: distance from the original's surface, whole and at the pit of radius {PIT_RADIUS:g}"
        pictures.append(Picture(draw(case, original, measured[case.name], output_folder), caption))
    result.add(*[Text(note) for note in notes])
    result.add(distance_table(measured), pit_table(depths), *pictures, *findings(measured, depths))
    return result
