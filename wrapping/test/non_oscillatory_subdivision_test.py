# SPDX-License-Identifier: Apache-2.0
"""The filter from Python, held to numbers of docs/scheme.md, section 5."""
import itk
import numpy as np

STEP = [0, 0, 0, 0, 0, 1, 1, 1, 1, 1]
LINEAR = [0, 0, 0, 0, 0, 10, 14, -64, -112, 212, 812, 1136, 1088, 1010, 1014, 1024, 1024, 1024, 1024, 1024]
NON_OSCILLATORY = [0, 0, 0, 0, 0, 1, 11, 56, 176, 386, 638, 848, 968, 1013, 1023, 1024, 1024, 1024, 1024, 1024]
SCHEMES = itk.NonOscillatorySubdivisionImageFilterEnums


def step_image():
    """A step along x, the same on each of three lines."""
    image = itk.image_from_array(np.array([STEP] * 3, dtype=np.float32))
    image.SetSpacing([2.0, 3.0])
    image.SetOrigin([10.0, 20.0])
    return image


def test_after_a_filter_of_itk_itself():
    """Must be the first: the first filter of a process says what kind of threads all others have, so that an ITK within
    the module that knows fewer kinds than the ITK beside it fails only then."""
    image = itk.cast_image_filter(step_image(), ttype=(type(step_image()), itk.Image[itk.F, 2]))
    result = itk.non_oscillatory_subdivision_image_filter(image)
    np.testing.assert_allclose(1024.0 * itk.array_from_image(result), [NON_OSCILLATORY] * 6, rtol=0, atol=1e-3)


def test_values_of_each_scheme():
    for scheme, expected in ((SCHEMES.Scheme_NonOscillatory, NON_OSCILLATORY), (SCHEMES.Scheme_Linear, LINEAR)):
        result = itk.non_oscillatory_subdivision_image_filter(step_image(), scheme=scheme)
        lines = itk.array_from_image(result)
        assert lines.shape == (6, 20)
        np.testing.assert_allclose(1024.0 * lines, [expected] * 6, rtol=0, atol=1e-3)


def test_geometry():
    result = itk.non_oscillatory_subdivision_image_filter(step_image())
    np.testing.assert_allclose(result.GetSpacing(), [1.0, 1.5])
    np.testing.assert_allclose(result.GetOrigin(), [10.0 - 0.25 * 2.0, 20.0 - 0.25 * 3.0])


def test_one_axis_alone():
    image = step_image()
    subdivision = itk.NonOscillatorySubdivisionImageFilter.New(image)
    subdivision.SetSubdividedAxes([True, False])
    subdivision.Update()
    lines = itk.array_from_image(subdivision.GetOutput())
    assert lines.shape == (3, 20)
    np.testing.assert_allclose(1024.0 * lines, [NON_OSCILLATORY] * 3, rtol=0, atol=1e-3)


def test_mirror_boundary():
    image = step_image()
    mirror = itk.MirrorBoundaryCondition[type(image)]()
    subdivision = itk.NonOscillatorySubdivisionImageFilter.New(image)
    subdivision.SetBoundaryCondition(mirror)
    subdivision.Update()
    # The step is flat at both ends, where a mirror and the nearest voxel are the same.
    lines = itk.array_from_image(subdivision.GetOutput())
    np.testing.assert_allclose(1024.0 * lines, [NON_OSCILLATORY] * 6, rtol=0, atol=1e-3)


def test_a_scheme_by_name():
    step = [0] * 9 + [9679 / 32768, 23089 / 32768] + [1] * 9
    subdivision = itk.NonOscillatorySubdivisionImageFilter.New(step_image())
    subdivision.SetSchemeByName("restored")
    subdivision.SetSubdividedAxis(1, False)
    subdivision.Update()
    np.testing.assert_allclose(itk.array_from_image(subdivision.GetOutput()), [step] * 3, rtol=0, atol=1e-6)
    try:
        subdivision.SetSchemeByName("cubic")
    except RuntimeError as error:
        assert "bspline" in str(error)
    else:
        raise AssertionError("an unknown scheme was accepted")


def test_labels_stay_labels():
    labels = np.zeros((12, 14), dtype=np.uint8)
    labels[2:6, 3:9] = 3
    labels[7:11, 5:12] = 7
    doubled = itk.array_from_image(itk.label_subdivision_image_filter(itk.image_from_array(labels)))
    assert doubled.shape == (24, 28)
    assert set(np.unique(doubled)) == {0, 3, 7}
    assert (doubled[6:10, 8:16] == 3).all()


def test_fidelity():
    image = step_image()
    calculator = itk.ImageFidelityCalculator.New(image)
    calculator.SetTestImage(image)
    calculator.Update()
    assert calculator.GetRelativeL2Error() == 0


def test_wrong_tension_is_an_error():
    try:
        itk.non_oscillatory_subdivision_image_filter(step_image(), tension=0.5)
    except RuntimeError as error:
        assert "0.5" in str(error)
    else:
        raise AssertionError("a tension of 0.5 was accepted")


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
