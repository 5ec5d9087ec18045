# SPDX-License-Identifier: Apache-2.0
"""Shapes with exactly known surfaces and normals, and their voxels.

Points are arrays (..., 3) in index coordinates [z, y, x]: voxel j covers j - 1/2 ... j + 1/2 along each axis.
A shape has `distance(points)`, signed and negative inside, and `normals(points)`, unit vectors pointing out; one that
leaves every volume is `endless`.
"""
import itertools
from dataclasses import dataclass

import numpy as np

# A voxel whose centre is farther from the surface than half its diagonal lies on one side of it.
HALF_DIAGONAL = np.sqrt(3.0) / 2.0


def unit(vectors):
    """Vectors (..., 3) scaled to length one."""
    vectors = np.asarray(vectors, dtype=float)
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def split_along_axis(points, centre, axis):
    """Positions along an axis (...), and the vectors (..., 3) from the axis to the points."""
    offsets = np.asarray(points, dtype=float) - np.asarray(centre)
    along = offsets @ np.asarray(axis)
    return along, offsets - along[..., None] * np.asarray(axis)


@dataclass(frozen=True)
class Sphere:
    centre: tuple
    radius: float
    endless = False

    def distance(self, points):
        return np.linalg.norm(points - np.asarray(self.centre), axis=-1) - self.radius

    def normals(self, points):
        return unit(points - np.asarray(self.centre))


@dataclass(frozen=True)
class Cylinder:
    """Endless along its axis, a unit vector."""

    centre: tuple
    axis: tuple
    radius: float
    endless = True

    def distance(self, points):
        _, outwards = split_along_axis(points, self.centre, self.axis)
        return np.linalg.norm(outwards, axis=-1) - self.radius

    def normals(self, points):
        return unit(split_along_axis(points, self.centre, self.axis)[1])


@dataclass(frozen=True)
class Torus:
    """A tube of radius `tube_radius` around a circle of radius `radius`, about an axis (a unit vector)."""

    centre: tuple
    axis: tuple
    radius: float
    tube_radius: float
    endless = False

    def _from_tube_centre(self, points):
        _, outwards = split_along_axis(points, self.centre, self.axis)
        return points - (np.asarray(self.centre) + self.radius * unit(outwards))

    def distance(self, points):
        return np.linalg.norm(self._from_tube_centre(points), axis=-1) - self.tube_radius

    def normals(self, points):
        return unit(self._from_tube_centre(points))


@dataclass(frozen=True)
class Plane:
    """The half-space below a plane; the normal is a unit vector."""

    centre: tuple
    normal: tuple
    endless = True

    def distance(self, points):
        return (points - np.asarray(self.centre)) @ np.asarray(self.normal)

    def normals(self, points):
        return np.broadcast_to(np.asarray(self.normal), np.shape(points))


@dataclass(frozen=True)
class Capsule:
    """All that is no farther than `radius` from the line between two points."""

    start: tuple
    end: tuple
    radius: float
    endless = False

    def _from_core(self, points):
        start, end = np.asarray(self.start), np.asarray(self.end)
        core = end - start
        along = np.clip((points - start) @ core / (core @ core), 0.0, 1.0)
        return points - start - along[..., None] * core

    def distance(self, points):
        return np.linalg.norm(self._from_core(points), axis=-1) - self.radius

    def normals(self, points):
        return unit(self._from_core(points))


@dataclass(frozen=True)
class RoundedBox:
    """A box of half sizes `half`, turned and then rounded: all that is no farther than `rounding` from it.

    turned: an orthogonal matrix; (p - centre) @ turned are coordinates along the box's edges.
    """

    centre: tuple
    turned: tuple
    half: tuple
    rounding: float
    endless = False

    def _outwards(self, points):
        local = (points - np.asarray(self.centre)) @ np.asarray(self.turned)
        return np.abs(local) - np.asarray(self.half), np.sign(local)

    def distance(self, points):
        beyond, _ = self._outwards(points)
        return np.linalg.norm(np.maximum(beyond, 0.0), axis=-1) + np.minimum(beyond.max(axis=-1), 0.0) - self.rounding

    def normals(self, points):
        beyond, signs = self._outwards(points)
        inside = np.all(beyond < 0.0, axis=-1)
        nearest_face = beyond == beyond.max(axis=-1, keepdims=True)
        local = np.where(inside[..., None], nearest_face, np.maximum(beyond, 0.0)) * signs
        return unit(local @ np.asarray(self.turned).T)


def voxel_centres(size):
    """Index coordinates (size, size, size, 3) of the voxels of a cube."""
    return np.stack(np.meshgrid(*[np.arange(size, dtype=float)] * 3, indexing="ij"), axis=-1)


def labels(shape, size):
    """Binary voxels: 1 where the voxel's centre is inside."""
    return (shape.distance(voxel_centres(size)) < 0).astype(np.float32)


def partial_volume(shape, size, parts=5):
    """The fraction of each voxel that is inside.

    A voxel at the surface is cut into parts^3 equal boxes; a box is filled by its centre's distance,
    from full half an edge inside the surface to empty half an edge outside.
    """
    centres = voxel_centres(size)
    distances = shape.distance(centres)
    fractions = (distances < 0).astype(np.float32)
    at_surface = np.abs(distances) < HALF_DIAGONAL
    steps = (np.arange(parts) + 0.5) / parts - 0.5
    filled = np.zeros(np.count_nonzero(at_surface))
    for offset in itertools.product(steps, repeat=3):
        box_distances = shape.distance(centres[at_surface] + np.asarray(offset))
        filled += np.clip(0.5 - box_distances * parts, 0.0, 1.0)
    fractions[at_surface] = filled / parts**3
    return fractions


def sampled_volume(shape, size, parts=8):
    """The fraction of each voxel that is inside, counted at the centres of parts^3 boxes."""
    centres = voxel_centres(size)
    distances = shape.distance(centres)
    fractions = (distances < 0).astype(float)
    at_surface = np.abs(distances) < HALF_DIAGONAL
    steps = (np.arange(parts) + 0.5) / parts - 0.5
    offsets = [np.asarray(offset) for offset in itertools.product(steps, repeat=3)]
    inside = sum((shape.distance(centres[at_surface] + offset) < 0).astype(int) for offset in offsets)
    fractions[at_surface] = inside / parts**3
    return fractions
