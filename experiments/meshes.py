# SPDX-License-Identifier: Apache-2.0
"""Isosurfaces as triangle meshes, and how far apart two of them are."""
from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from skimage.measure import marching_cubes
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkSurfaceNets3D, vtkWindowedSincPolyDataFilter
from vtkmodules.vtkFiltersModeling import vtkHausdorffDistancePointSetFilter


@dataclass
class Mesh:
    """Points (n, 3) as [z, y, x] and triangles (m, 3) of point numbers.

    Seen from outside (the side of low values) a triangle's cross product in [z, y, x] points to the viewer.
    """

    points: np.ndarray
    triangles: np.ndarray

    def corners(self):
        """The triangles' points (m, 3, 3)."""
        return self.points[self.triangles]

    def centroids(self):
        return self.corners().mean(axis=1)

    def cross_products(self):
        """Vectors (m, 3) along the triangles' normals, of twice their area."""
        first, second, third = np.moveaxis(self.corners(), 1, 0)
        return np.cross(second - first, third - first)

    def areas(self):
        return np.linalg.norm(self.cross_products(), axis=1) / 2

    def point_areas(self):
        """A third of the area of the triangles around each point."""
        shares = np.repeat(self.areas() / 3, 3)
        return np.bincount(self.triangles.ravel(), weights=shares, minlength=len(self.points))

    def select(self, triangles_kept):
        """The mesh of some of the triangles (a mask) and of the points that they use."""
        triangles = self.triangles[triangles_kept]
        used, renumbered = np.unique(triangles, return_inverse=True)
        return Mesh(self.points[used], renumbered.reshape(-1, 3))

    def largest_piece(self):
        """The connected piece with the most triangles."""
        first, second, third = self.triangles.T
        links = (np.concatenate([first, second]), np.concatenate([second, third]))
        count = len(self.points)
        _, pieces = connected_components(coo_matrix((np.ones(len(links[0]), dtype=bool), links), shape=(count, count)))
        return self.select(pieces[first] == np.argmax(np.bincount(pieces[first])))

    def polydata(self):
        """The same for VTK, whose points are (x, y, z); reversing the corners keeps the outside outside."""
        points, cells = vtkPoints(), vtkCellArray()
        points.SetData(numpy_to_vtk(np.ascontiguousarray(self.points[:, ::-1]), deep=True))
        triangles = np.ascontiguousarray(self.triangles[:, ::-1], dtype=np.int64)
        offsets = np.arange(0, triangles.size + 1, 3, dtype=np.int64)
        cells.SetData(
            numpy_to_vtkIdTypeArray(offsets, deep=True), numpy_to_vtkIdTypeArray(triangles.ravel(), deep=True)
        )
        data = vtkPolyData()
        data.SetPoints(points)
        data.SetPolys(cells)
        return data


def isosurface(volume, level, parts=1, spacing=(1.0, 1.0, 1.0)):
    """Marching cubes, the points interpolated between voxel centres, high values inside.

    `parts` is how many voxels along an axis each input voxel was divided into (2 after subdivision). Points are in
    index coordinates of the input (voxel m of a subdivided volume lies at m/2 - 1/4) times the input's spacing.
    """
    # scikit-image orders corners for (x, y, z); "ascent" is what makes [z, y, x] cross products point to low values.
    points, triangles, _, _ = marching_cubes(
        np.asarray(volume, dtype=np.float32), level, gradient_direction="ascent", allow_degenerate=False
    )
    return Mesh(((points.astype(float) + 0.5) / parts - 0.5) * spacing, triangles.astype(np.int64))


def smoothed(mesh, pass_band, iterations=20):
    """The mesh after VTK's windowed-sinc smoothing, with the same triangles: what users do to a stepped surface."""
    smoother = vtkWindowedSincPolyDataFilter()
    smoother.SetInputData(mesh.polydata())
    smoother.SetNumberOfIterations(iterations)
    smoother.SetPassBand(pass_band)
    smoother.NormalizeCoordinatesOn()
    smoother.Update()
    points = vtk_to_numpy(smoother.GetOutput().GetPoints().GetData()).astype(float)
    return Mesh(points[:, ::-1], mesh.triangles)


def surface_nets(labels):
    """VTK's surface nets around label 1, smoothed as they are by default."""
    image = vtkImageData()
    image.SetDimensions(*labels.shape[::-1])
    image.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(labels, dtype=np.uint8).ravel(), deep=True))
    nets = vtkSurfaceNets3D()
    nets.SetInputData(image)
    nets.SetValue(0, 1)
    nets.SetOutputMeshTypeToTriangles()
    nets.Update()
    surface = nets.GetOutput()
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    triangles = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3).astype(np.int64)
    # From (x, y, z) to [z, y, x]; reversing the corners keeps the outside outside.
    return Mesh(points[:, ::-1], triangles[:, ::-1])


def weighted_quantile(values, weights, fraction):
    """The smallest value below or at which at least that fraction of the weight lies."""
    order = np.argsort(values)
    cumulated = np.cumsum(weights[order])
    return values[order][np.searchsorted(cumulated, fraction * cumulated[-1])]


def normal_angles(mesh, true_normals):
    """Angles in degrees between the triangles' normals and true ones (m, 3), and the triangles' areas.

    Triangles too small to have a normal are left out; their area is nothing.
    """
    cross = mesh.cross_products()
    lengths = np.linalg.norm(cross, axis=1)
    kept = lengths > 1e-12
    cosines = np.einsum("ij,ij->i", cross[kept], true_normals[kept]) / lengths[kept]
    return np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0))), lengths[kept] / 2


def point_distances(first, second):
    """Distance of each point of one mesh to the other's nearest triangle: (of the first, of the second)."""
    compare = vtkHausdorffDistancePointSetFilter()
    compare.SetInputData(0, first.polydata())
    compare.SetInputData(1, second.polydata())
    compare.SetTargetDistanceMethodToPointToCell()
    compare.Update()
    return tuple(vtk_to_numpy(compare.GetOutput(k).GetPointData().GetArray("Distance")).astype(float) for k in (0, 1))


@dataclass
class MeshDistance:
    """The symmetric distance of two meshes: both meshes' points, each weighted by its area."""

    mean: float
    q95: float
    maximum: float


def mesh_distance(first, second, distances=None):
    """The MeshDistance of two meshes; `distances` is their point_distances where they are known already."""
    pooled = np.concatenate(distances or point_distances(first, second))
    areas = np.concatenate([first.point_areas(), second.point_areas()])
    return MeshDistance(
        float(np.average(pooled, weights=areas)),
        float(weighted_quantile(pooled, areas, 0.95)),
        float(pooled.max()),
    )
