# SPDX-License-Identifier: Apache-2.0
"""The numbers of docs/scheme.md, section 5."""

from fractions import Fraction

import numpy as np
import pytest
from nonoscillatory_subdivision import subdivide

STEP = np.repeat([0.0, 1.0], 5)
BAR = np.repeat([0.0, 1.0, 0.0], [5, 2, 5])
SPIKE = np.repeat([0.0, 1.0, 0.0], [5, 1, 5])

LINEAR_STEP = [0] * 5 + [10, 14, -64, -112, 212, 812, 1136, 1088, 1010, 1014] + [1024] * 5
STEP_1024 = [0] * 5 + [1, 11, 56, 176, 386, 638, 848, 968, 1013, 1023] + [1024] * 5
LINEAR_BAR = [0] * 5 + [10, 14, -64, -112, 202, 798, 1200, 1200, 798, 202, -112, -64, 14, 10] + [0] * 5
BAR_1024 = [0] * 5 + [1, 11, 56, 176, 385, 627, 792, 792, 627, 385, 176, 56, 11, 1] + [0] * 5


@pytest.mark.parametrize(
    ("volume", "scheme", "expected"),
    [
        (STEP, "linear", LINEAR_STEP),
        (STEP, "nonoscillatory", STEP_1024),
        (BAR, "linear", LINEAR_BAR),
        (BAR, "nonoscillatory", BAR_1024),
    ],
)
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_step_and_bar(volume, scheme, expected, dtype):
    result = subdivide(volume.astype(dtype), scheme=scheme) * 1024
    np.testing.assert_array_equal(result, expected)


def fractions(text):
    return [float(Fraction(part)) for part in text.split(", ")]


@pytest.mark.parametrize(
    ("volume", "expected"),
    [
        (STEP, [0] * 9 + fractions("9679/32768, 23089/32768") + [1] * 9),
        (
            BAR,
            [0] * 8 + fractions("55/8192, 12023/32768, 27357/32768, 1, 1, 27357/32768, 12023/32768, 55/8192") + [0] * 8,
        ),
        (
            SPIKE,
            [0] * 8 + fractions("891/8192, 14499/32768, 23793/32768, 23793/32768, 14499/32768, 891/8192") + [0] * 8,
        ),
        (
            np.array([0, 0, 1, 3, 2, 5, 4, 4, 0, 7, 7, 6.0]),
            fractions(
                "0, 0, 0, 3191/65536, 46453/65536, 25441/16384, 1433/512, 717/256, 507/256, 163/64, 141/32, 2609/512, "
                "2227/512, 1067/256, 2856695/720896, 1785647/720896, 205133/720896, 938833/720896, 3744219/720896, "
                "5408343/720896, 7, 7, 221639/32768, 101087/16384"
            ),
        ),
    ],
)
def test_restored(volume, expected):
    result = subdivide(volume, scheme="restored")
    np.testing.assert_allclose(result, expected, rtol=1e-14, atol=1e-15)


def sine_averages(cells):
    edges = np.arange(cells + 1) * 2 * np.pi / cells
    return -np.diff(np.cos(edges)) / np.diff(edges)


@pytest.mark.parametrize("scheme", ["linear", "nonoscillatory", "restored"])
@pytest.mark.parametrize(("cells", "error"), [(16, 1.737e-5), (32, 2.777e-7), (64, 4.364e-9), (128, 6.828e-11)])
def test_order_six(scheme, cells, error):
    result = subdivide(sine_averages(cells), scheme=scheme, boundary="periodic")
    assert np.abs(result - sine_averages(2 * cells)).max() == pytest.approx(error, rel=1e-3)


@pytest.fixture(scope="module")
def phantom():
    volume = np.zeros((96, 96, 96))
    z, y, x = np.ogrid[:96, :96, :96]
    for box in (
        np.s_[8:28, 8:28, 8:28],
        np.s_[40:42, 8:10, 6:46],
        np.s_[8:40, 50:52, 50:86],
        np.s_[8:10, 50:80, 50:86],
    ):
        volume[box] = 1
    volume[(z - 66) ** 2 + (y - 26) ** 2 + (x - 26) ** 2 <= 16**2] = 1
    distance = np.sqrt((z - 66.0) ** 2 + (y - 66) ** 2 + (x - 66) ** 2)
    return np.maximum(volume, 1 - distance / 20)


def test_range_of_the_phantom_linear(phantom):
    result = subdivide(phantom, scheme="linear")
    assert result.min() == pytest.approx(-0.3127940520644188, abs=1e-13)
    assert result.max() == pytest.approx(1.5234947204589844, abs=1e-13)


@pytest.mark.parametrize(
    ("scheme", "tension"), [("nonoscillatory", 1.01), ("nonoscillatory", 2), ("nonoscillatory", 8), ("restored", 2)]
)
def test_range_of_the_phantom_is_kept(phantom, scheme, tension):
    result = subdivide(phantom, scheme=scheme, tension=tension)
    assert (result.min(), result.max()) == (0, 1)
