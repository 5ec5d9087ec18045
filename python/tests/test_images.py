# SPDX-License-Identifier: Apache-2.0
"""Images of other libraries come back as their own kind, on the doubled grid."""

import numpy as np
import pytest
from nonoscillatory_subdivision import subdivide

SPACING, ORIGIN = (0.5, 2.0, 3.0), (10.0, -20.0, 30.0)
ANGLE = np.deg2rad(30)
DIRECTION = np.array([[np.cos(ANGLE), -np.sin(ANGLE), 0], [np.sin(ANGLE), np.cos(ANGLE), 0], [0, 0, 1]])


@pytest.fixture(scope="module")
def volume():
    return np.random.default_rng(6).integers(-1000, 3000, (5, 6, 7), dtype=np.int16)


def physical_point(image, index):
    """The point at a continuous index, in ITK's order."""
    direction = np.asarray(image.GetDirection()).reshape(3, 3)
    return np.asarray(image.GetOrigin()) + direction @ (np.asarray(image.GetSpacing()) * index)


def assert_same_box(result, image, lower, upper, result_lower, result_upper):
    """At opposite corners."""
    for index, result_index in ((lower, result_lower), (upper, result_upper)):
        np.testing.assert_allclose(physical_point(result, result_index), physical_point(image, index), atol=1e-9)


def test_simpleitk(volume):
    sitk = pytest.importorskip("SimpleITK")
    image = sitk.GetImageFromArray(volume)
    image.SetSpacing(SPACING)
    image.SetOrigin(ORIGIN)
    image.SetDirection(DIRECTION.ravel())
    result = subdivide(image, scheme="linear")
    assert isinstance(result, sitk.Image)
    assert result.GetPixelID() == image.GetPixelID()
    assert result.GetSize() == (14, 12, 10)
    np.testing.assert_array_equal(sitk.GetArrayViewFromImage(result), subdivide(volume, scheme="linear"))
    assert_same_box(result, image, (-0.5,) * 3, (6.5, 5.5, 4.5), (-0.5,) * 3, (13.5, 11.5, 9.5))

    in_plane = subdivide(image, axes=(1, 2), levels=2, dtype=np.float32)
    assert in_plane.GetSize() == (28, 24, 5)
    assert in_plane.GetPixelID() == sitk.sitkFloat32
    assert_same_box(in_plane, image, (-0.5,) * 3, (6.5, 5.5, 4.5), (-0.5,) * 3, (27.5, 23.5, 4.5))


def test_simpleitk_vectors(volume):
    sitk = pytest.importorskip("SimpleITK")
    channels = np.stack([volume, volume[::-1]], axis=-1)
    result = subdivide(sitk.GetImageFromArray(channels, isVector=True))
    assert result.GetNumberOfComponentsPerPixel() == 2
    np.testing.assert_array_equal(sitk.GetArrayViewFromImage(result), subdivide(channels, channel_axis=-1))


def test_simpleitk_vectors_of_one_component(volume):
    sitk = pytest.importorskip("SimpleITK")
    image = sitk.GetImageFromArray(volume[..., np.newaxis], isVector=True)
    result = subdivide(image)
    assert (result.GetSize(), result.GetPixelID()) == ((14, 12, 10), image.GetPixelID())
    np.testing.assert_array_equal(sitk.GetArrayViewFromImage(result), subdivide(volume))


def test_options_for_arrays_alone_are_refused(volume):
    sitk = pytest.importorskip("SimpleITK")
    image = sitk.GetImageFromArray(volume)
    for name, value in (("region", np.s_[:2]), ("out", np.zeros(3))):
        with pytest.raises(TypeError, match=name):
            subdivide(image, **{name: value})
    with pytest.raises(TypeError, match="complex"):
        subdivide(sitk.Image((3, 3), sitk.sitkComplexFloat32))
    with pytest.raises(TypeError, match="LabelMapToLabel"):
        subdivide(sitk.Image((3, 3), sitk.sitkLabelUInt8))


def test_itk(volume):
    itk = pytest.importorskip("itk")
    image = itk.image_from_array(volume)
    image.SetSpacing(SPACING)
    image.SetOrigin(ORIGIN)
    image.SetDirection(DIRECTION)
    region = image.GetLargestPossibleRegion()
    region.SetIndex([2, -3, 1])
    image.SetRegions(region)
    result = subdivide(image)
    assert type(result) is type(image)
    assert list(result.GetLargestPossibleRegion().GetIndex()) == [4, -6, 2]
    np.testing.assert_array_equal(itk.array_view_from_image(result), subdivide(volume))
    assert_same_box(result, image, (1.5, -3.5, 0.5), (8.5, 2.5, 5.5), (3.5, -6.5, 1.5), (17.5, 5.5, 11.5))


def test_itk_vectors_of_one_component(volume):
    itk = pytest.importorskip("itk")
    image = itk.image_from_array(volume[..., np.newaxis].astype(np.float32), is_vector=True)
    result = subdivide(image)
    assert type(result) is type(image)
    assert result.GetNumberOfComponentsPerPixel() == 1
    expected = subdivide(volume.astype(np.float32))
    np.testing.assert_array_equal(np.reshape(itk.array_view_from_image(result), expected.shape), expected)


def test_itk_before_an_update(volume):
    itk = pytest.importorskip("itk")
    stream = itk.StreamingImageFilter.New(itk.image_from_array(volume))
    for image in (stream.GetOutput(), itk.Image[itk.F, 2].New()):
        with pytest.raises(ValueError, match="UpdateLargestPossibleRegion"):
            subdivide(image)
    with pytest.raises(TypeError, match="pass its output"):
        subdivide(stream)
    stream.Update()
    np.testing.assert_array_equal(subdivide(stream.GetOutput()), subdivide(volume))


def test_itk_has_no_such_images(volume):
    itk = pytest.importorskip("itk")
    with pytest.raises(TypeError, match="float16"):
        subdivide(itk.image_from_array(volume), dtype=np.float16)


def test_itk_colours():
    itk = pytest.importorskip("itk")
    colours = np.random.default_rng(1).integers(0, 255, (5, 6, 3), dtype=np.uint8)
    image = itk.image_from_array(colours, ttype=itk.Image[itk.RGBPixel[itk.UC], 2])
    result = subdivide(image)
    assert type(result) is type(image)
    np.testing.assert_array_equal(itk.array_view_from_image(result), subdivide(colours, channel_axis=2))


def test_xarray(volume):
    xarray = pytest.importorskip("xarray")
    coordinates = {
        "z": ("z", np.array([0.0, 1, 2, 4, 8]), {"units": "mm"}),
        "y": np.arange(6) * 10,
        "x": np.datetime64("2026-01-01T00:00:00") + np.arange(7) * np.timedelta64(4, "s"),
        "patient": "phantom",
    }
    image = xarray.DataArray(volume, coordinates, ("z", "y", "x"), "ct", {"units": "HU"})
    result = subdivide(image)
    assert (result.name, result.dims, result.attrs) == ("ct", ("z", "y", "x"), {"units": "HU"})
    np.testing.assert_array_equal(result.values, subdivide(volume))
    assert result["z"].attrs == {"units": "mm"}
    np.testing.assert_allclose(result["z"], [-0.25, 0.25, 0.75, 1.25, 1.75, 2.5, 3.5, 5, 7, 9])
    np.testing.assert_allclose(result["y"], np.arange(12) * 5 - 2.5)
    np.testing.assert_array_equal(np.diff(result["x"]), np.full(13, np.timedelta64(2, "s")))
    assert result["x"][0] == np.datetime64("2025-12-31T23:59:59")
    assert result["patient"] == "phantom"


@pytest.mark.parametrize("dtype", [np.uint8, np.int8, np.uint64, np.float32])
def test_xarray_coordinates_may_fall(dtype):
    xarray = pytest.importorskip("xarray")
    places = np.array([120, 60, 0] if np.dtype(dtype).kind != "i" else [120, 0, -120], dtype)
    result = subdivide(xarray.DataArray(np.zeros(3), {"x": places}, ("x",)))
    step = (float(places[1]) - float(places[0])) / 2
    np.testing.assert_allclose(result["x"], 120 - step / 2 + step * np.arange(6))


@pytest.mark.parametrize("kind", ["m", "M"])
def test_xarray_times_in_whole_seconds(kind):
    xarray = pytest.importorskip("xarray")
    image = xarray.DataArray(np.zeros(3), {"t": np.array([1, 2, 3], f"{kind}8[s]")}, ("t",))
    seconds = subdivide(image)["t"].values.astype(f"{kind}8[ns]").astype(np.int64) / 1e9
    np.testing.assert_array_equal(seconds, [0.75, 1.25, 1.75, 2.25, 2.75, 3.25])


def test_xarray_times_that_are_none():
    xarray = pytest.importorskip("xarray")
    image = xarray.DataArray(np.zeros(3), {"t": np.array(["2020", "NaT", "2021"], "M8[ns]")}, ("t",))
    with pytest.raises(ValueError, match="'t' has NaT"):
        subdivide(image)


@pytest.mark.parametrize("dimension", [2, 4])
def test_simpleitk_of_other_dimensions(dimension):
    sitk = pytest.importorskip("SimpleITK")
    volume = np.random.default_rng(2).integers(0, 255, (3, 4, 5, 6)[4 - dimension :], dtype=np.uint8)
    image = sitk.GetImageFromArray(volume, isVector=False)
    image.SetDirection(np.fliplr(np.eye(dimension)).ravel())
    result = subdivide(image)
    np.testing.assert_array_equal(sitk.GetArrayViewFromImage(result), subdivide(volume))
    # The direction turns the axes around, so the origin moves along the opposite ones: not along time, the last of four.
    moved = [-0.25] * dimension if dimension == 2 else [0.0, -0.25, -0.25, -0.25]
    assert result.GetOrigin() == tuple(moved)
    assert result.GetDirection() == image.GetDirection()


def test_xarray_coordinates_without_numbers(volume):
    xarray = pytest.importorskip("xarray")
    image = xarray.DataArray(volume[0], {"y": list("abcdef")}, ("y", "x"))
    with pytest.raises(ValueError, match="'y'"):
        subdivide(image)
    result = subdivide(image, axes=1)
    assert list(result["y"].values) == list("abcdef")


def test_xarray_over_dask_stays_lazy(volume):
    xarray = pytest.importorskip("xarray")
    dask_array = pytest.importorskip("dask.array")
    image = xarray.DataArray(dask_array.from_array(volume, chunks=3), dims=("z", "y", "x"))
    result = subdivide(image)
    assert isinstance(result.data, dask_array.Array)
    np.testing.assert_array_equal(result.values, subdivide(volume))
