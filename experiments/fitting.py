# SPDX-License-Identifier: Apache-2.0
"""Least-squares planes and cylinders through points, as in dimensional metrology.

Points are (n, 3); lengths are in the points' unit.
"""
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from shapes import split_along_axis, unit


@dataclass
class FittedPlane:
    """A point of the plane (the points' mean) and its unit normal."""

    centre: np.ndarray
    normal: np.ndarray

    def distance_to(self, point):
        return float(abs((point - self.centre) @ self.normal))


@dataclass
class FittedCylinder:
    """A point of the axis beside the points' mean, the axis' unit direction, the radius, and the roundness.

    The roundness is the largest minus the smallest distance of the points from the axis; 0 for a perfect cylinder.
    """

    centre: np.ndarray
    axis: np.ndarray
    radius: float
    roundness: float

    @property
    def diameter(self):
        return 2 * self.radius


def fit_plane(points):
    """The plane with the smallest sum of squared distances."""
    centre = points.mean(axis=0)
    _, vectors = np.linalg.eigh(np.cov((points - centre).T))
    return FittedPlane(centre, vectors[:, 0])


def _across(axis):
    """Two unit vectors perpendicular to an axis and to each other."""
    first = unit(np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))]))
    return first, np.cross(axis, first)


def fit_cylinder(points, axis):
    """The cylinder with the smallest sum of squared distances; `axis` is a first guess of its direction."""
    mean, guess = points.mean(axis=0), unit(axis)
    first, second = _across(guess)

    def cylinder_axis(parameters):
        shift, tilt = parameters[:2], parameters[2:4]
        centre = mean + shift[0] * first + shift[1] * second
        return centre, unit(guess + tilt[0] * first + tilt[1] * second)

    def radii(parameters):
        _, outwards = split_along_axis(points, *cylinder_axis(parameters))
        return np.linalg.norm(outwards, axis=-1)

    start = np.array([0.0, 0.0, 0.0, 0.0, radii(np.zeros(4)).mean()])
    scales = np.array([start[4], start[4], 1.0, 1.0, start[4]])
    best = least_squares(lambda p: radii(p) - p[4], start, x_scale=scales, xtol=1e-12, ftol=1e-12, gtol=1e-12).x
    centre, direction = cylinder_axis(best)
    return FittedCylinder(centre, direction, float(best[4]), float(np.ptp(radii(best))))


def perpendicularity(plane, axis, diameter):
    """How far a plane face of that diameter leans, from rim to rim, against the axis it should meet squarely."""
    sine = np.linalg.norm(np.cross(plane.normal, axis))
    return float(sine * diameter)


def concentricity(cylinder, datum, length):
    """Twice the largest distance of a cylinder's axis, over its length, from the axis of the datum cylinder."""
    ends = cylinder.centre + np.outer([-0.5, 0.5], cylinder.axis) * length
    _, outwards = split_along_axis(ends, datum.centre, datum.axis)
    return float(2 * np.linalg.norm(outwards, axis=-1).max())
