# SPDX-License-Identifier: Apache-2.0
"""A synthetic aluminium specimen with exactly known geometry, and CT scans of it.

A shaft with three steps outside and a bore with three steps through it, all on one axis. Lengths are in millimetres,
points are [z, y, x]; the specimen's own frame has its axis along z and its middle at 0.
"""
from dataclasses import dataclass

import numpy as np
from scipy import ndimage
from scipy.spatial.transform import Rotation

import shapes

BOTTOM, TOP = -3.0, 3.0
# (radius, lower end, upper end) from below; each solid step reaches down to the bottom, each bore out of it.
STEPS = ((3.1, -3.0, -1.0), (2.5, -1.0, 1.0), (1.9, 1.0, 3.0))
BORES = ((1.2, -3.0, -1.1), (0.9, -1.1, 0.9), (0.6, 0.9, 3.0))
# The faces: (height, inner radius, outer radius).
FACES = {
    "bottom": (-3.0, 1.2, 3.1),
    "lower step": (-1.0, 2.5, 3.1),
    "upper step": (1.0, 1.9, 2.5),
    "top": (3.0, 0.6, 1.9),
}

AIR, ALUMINIUM = 8000.0, 32000.0
BLUR_VOXELS = 0.8
# White noise of this part of the contrast gives the original's roundness the size that the paper measured.
NOISE = 0.03


def _upright_cylinder(along, radial, radius, lower, upper):
    return np.maximum(radial - radius, np.maximum(along - upper, lower - along))


@dataclass(frozen=True)
class Pose:
    """How the specimen lies in the scan: rotated about its middle, then shifted (millimetres)."""

    rotation: Rotation
    shift: np.ndarray

    def to_specimen(self, points):
        flat = (np.asarray(points) - self.shift).reshape(-1, 3)
        return self.rotation.inv().apply(flat).reshape(np.shape(points))

    def direction_in_scan(self, direction):
        return self.rotation.apply(direction)


@dataclass(frozen=True)
class Specimen:
    """The specimen in a pose, in index coordinates of a cube of `size` voxels around the origin."""

    pose: Pose
    size: int
    voxel: float

    def to_specimen(self, points):
        """Index coordinates to millimetres in the specimen's frame."""
        return self.pose.to_specimen((np.asarray(points) - (self.size - 1) / 2) * self.voxel)

    def distance(self, points):
        """In voxels, negative inside the metal: exact beside a face, at an edge no more than the distance."""
        local = self.to_specimen(points)
        along, radial = local[..., 0], np.hypot(local[..., 1], local[..., 2])
        solid = np.minimum.reduce([_upright_cylinder(along, radial, r, BOTTOM, upper) for r, _, upper in STEPS])
        # A bore is open downwards, so that no skin of metal is left where two of them meet.
        hollow = np.minimum.reduce([_upright_cylinder(along, radial, r, -np.inf, upper) for r, _, upper in BORES[:2]])
        hollow = np.minimum(hollow, radial - BORES[2][0])
        return np.maximum(solid, -hollow) / self.voxel


def random_pose(generator, voxel):
    """A small tilt (up to four degrees about each axis) and a shift of up to one voxel."""
    rotation = Rotation.from_euler("xyz", generator.uniform(-4, 4, size=3), degrees=True)
    return Pose(rotation, generator.uniform(-voxel, voxel, size=3))


def scan(seed, size, voxel):
    """The specimen in a random pose and its volume, unsigned 16 bit: partial volume, then blur, then noise."""
    generator = np.random.default_rng(seed)
    placed = Specimen(random_pose(generator, voxel), size, voxel)
    metal = ndimage.gaussian_filter(shapes.partial_volume(placed, size, parts=4), BLUR_VOXELS, mode="nearest")
    noise = generator.normal(0.0, NOISE, size=metal.shape)
    grey = AIR + (ALUMINIUM - AIR) * (metal + noise)
    return placed, np.clip(np.rint(grey), 0, 65535).astype(np.uint16)
