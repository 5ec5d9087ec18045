# SPDX-License-Identifier: Apache-2.0
"""Coloured meshes side by side in one picture: VTK draws them through EGL, without a screen, Matplotlib lays them out."""
import os
from dataclasses import dataclass

import matplotlib as mpl
import numpy as np

# VTK would look for a screen first, and warn where there is none.
os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (registers VTK's renderer)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkWindowToImageFilter,
)

import common
from meshes import Mesh

PIXELS = 420


@dataclass
class Panel:
    """A mesh under a title, with a value for each of its points or each of its triangles."""

    title: str
    mesh: Mesh
    values: np.ndarray


@dataclass
class View:
    """A parallel projection: what is in the middle, from which side it is seen ([z, y, x]), and how much shows."""

    focus: tuple
    towards: tuple
    half_height: float


@dataclass
class Scale:
    """One colour scale for all panels."""

    label: str
    lowest: float
    highest: float
    colours: str = "YlOrRd"

    def mappable(self):
        return mpl.cm.ScalarMappable(mpl.colors.Normalize(self.lowest, self.highest), mpl.colormaps[self.colours])


def _actor(panel, scale):
    """The mesh in its colours, lit flatly, so that every facet shows."""
    data = panel.mesh.polydata()
    colours = numpy_to_vtk(np.ascontiguousarray(scale.mappable().to_rgba(panel.values, bytes=True)[:, :3]), deep=True)
    per_point = len(panel.values) == len(panel.mesh.points)
    (data.GetPointData() if per_point else data.GetCellData()).SetScalars(colours)
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetInterpolationToFlat()
    return actor


def _aim(renderer, view):
    focus, towards = np.asarray(view.focus, dtype=float)[::-1], np.asarray(view.towards, dtype=float)[::-1]
    position = focus + towards / np.linalg.norm(towards) * view.half_height * 10
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*focus)
    camera.SetPosition(*position)
    upright = np.abs(towards[2]) < 0.9 * np.linalg.norm(towards)
    camera.SetViewUp(*((0, 0, 1) if upright else (0, 1, 0)))
    camera.SetParallelScale(view.half_height)
    renderer.ResetCameraClippingRange()


def render(panel, view, scale):
    """The panel's mesh as an RGB image."""
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(_actor(panel, scale))
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(4)
    window.SetSize(PIXELS, PIXELS)
    window.AddRenderer(renderer)
    _aim(renderer, view)
    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    pixels = vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(PIXELS, PIXELS, 3)[::-1]


def draw(panels, view, scale, columns, output_folder, file):
    """All panels from one view (or each from its own, given a list), with one colour bar; the file's name."""
    views = view if isinstance(view, list) else [view] * len(panels)
    rows = -(-len(panels) // columns)
    figure, grid = common.new_figure(columns, rows, width=2.6, height=2.8)
    figure.set_layout_engine("constrained")
    for axes in grid.ravel():
        axes.set_axis_off()
    for axes, panel, its_view in zip(grid.ravel(), panels, views):
        axes.imshow(render(panel, its_view, scale))
        axes.set_title(panel.title)
    figure.colorbar(scale.mappable(), ax=grid, label=scale.label, shrink=0.8)
    return common.save_figure(figure, output_folder, file, dither=True)
