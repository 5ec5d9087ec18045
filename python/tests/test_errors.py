# SPDX-License-Identifier: Apache-2.0
"""Every error is a ValueError or TypeError that names the value."""

import numpy as np
import pytest
from nonoscillatory_subdivision import subdivide, subdivided_grid

VOLUME = np.zeros((4, 5, 6), np.float32)


@pytest.mark.parametrize(
    ("volume", "error", "message"),
    [
        (np.zeros((2, 2), complex), TypeError, "complex128"),
        (np.array([None, 1]), TypeError, "object"),
        (np.array(["a"]), TypeError, "<U1"),
        (np.zeros(3, "M8[s]"), TypeError, "datetime64"),
        (np.zeros((2,) * 5), ValueError, "5 dimensions"),
        (np.float64(1), ValueError, "0 dimensions"),
        (np.zeros((3, 0, 2)), ValueError, r"\(3, 0, 2\)"),
        ([], ValueError, r"\(0,\)"),
        (np.ma.masked_array([1.0, 2.0], [True, False]), TypeError, "masked"),
    ],
)
def test_volumes(volume, error, message):
    with pytest.raises(error, match=message):
        subdivide(volume)


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"scheme": "cubic"}, ValueError, "cubic"),
        ({"scheme": 3}, TypeError, "3"),
        ({"tension": 1.0}, ValueError, "1"),
        ({"tension": np.nan}, ValueError, "nan"),
        ({"tension": np.inf}, ValueError, "inf"),
        ({"tension": "2"}, TypeError, "'2'"),
        ({"tension": 2j}, TypeError, "2j"),
        ({"tension": -0.5, "scheme": "restored"}, ValueError, "-0.5"),
        ({"boundary": "wrap"}, ValueError, "wrap"),
        ({"boundary": None}, TypeError, "None"),
        ({"boundary": True}, TypeError, "True"),
        ({"boundary": 10**400}, ValueError, "boundary 10000"),
        ({"tension": 10**400}, ValueError, "tension 10000"),
        ({"axes": 3}, ValueError, "3"),
        ({"axes": -4}, ValueError, "-4"),
        ({"axes": (0, -3)}, ValueError, r"\(0, -3\)"),
        ({"axes": (0.5,)}, TypeError, "0.5"),
        ({"axes": "zy"}, TypeError, "'z'"),
        ({"axes": np.array([0, 3])}, ValueError, "3"),
        ({"levels": 0}, ValueError, "0"),
        ({"levels": 4}, ValueError, "4"),
        ({"levels": 1.0}, TypeError, "1.0"),
        ({"threads": 0}, ValueError, "0"),
        ({"threads": 1.5}, TypeError, "1.5"),
        ({"progress": 3}, TypeError, "3"),
        ({"region": (1, 2)}, TypeError, r"\(1, 2\)"),
        ({"region": np.s_[:, :, :, :]}, TypeError, "3 slices"),
        ({"region": 3}, TypeError, "region 3"),
        ({"region": ...}, TypeError, "region Ellipsis"),
        ({"region": np.s_[None, 1:2]}, TypeError, "None"),
        ({"region": np.s_[0.5:2]}, TypeError, "0.5"),
        ({"region": np.s_[::-1]}, ValueError, "step"),
        ({"region": np.s_[::2]}, ValueError, "step"),
        ({"region": np.s_[5:5]}, ValueError, "empty"),
        ({"region": np.s_[8:]}, ValueError, r"\(8, 10, 12\)"),
        ({"dtype": complex}, TypeError, "complex128"),
        ({"dtype": bool}, TypeError, "bool"),
        ({"dtype": object}, TypeError, "object"),
        ({"dtype": "uint9"}, TypeError, "uint9"),
        ({"dtype": "M8[s]"}, TypeError, "datetime64"),
        ({"dtype": np.dtype([("a", "u1")])}, TypeError, "'a'"),
        ({"channel_axis": 3}, ValueError, "3"),
        ({"channel_axis": -4}, ValueError, "-4"),
        ({"channel_axis": "c"}, TypeError, "'c'"),
        ({"channel_axis": 1, "axes": (0, 1)}, ValueError, "channel axis 1"),
        ({"out": np.zeros((4, 5, 6), np.float32)}, ValueError, r"\(4, 5, 6\).*\(8, 10, 12\)"),
        ({"out": np.zeros((8, 10, 12), complex)}, TypeError, "complex128"),
        ({"out": [0]}, TypeError, "list"),
        ({"out": np.ma.zeros((8, 10, 12), np.float32)}, TypeError, "MaskedArray"),
        ({"out": np.zeros((8, 10, 12)), "dtype": np.float32}, ValueError, "float32.*float64"),
    ],
    ids=str,
)
def test_options(options, error, message):
    with pytest.raises(error, match=message):
        subdivide(VOLUME, **options)


def test_four_axes_at_once():
    with pytest.raises(ValueError, match=r"\(0, 1, 2, 3\)"):
        subdivide(np.zeros((2, 2, 2, 2)), axes=(0, 1, 2, 3))


def test_read_only_out():
    out = np.zeros((8, 10, 12), np.float32)
    out.flags.writeable = False
    with pytest.raises(ValueError, match="read-only"):
        subdivide(VOLUME, out=out)


def test_a_failed_call_leaves_out_alone():
    out = np.ones((8, 10, 12), np.float32)
    with pytest.raises(ValueError, match="tension"):
        subdivide(VOLUME, out=out, tension=0.5)
    assert (out == 1).all()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((1.0, 0.0), "spacing 1.0"),
        (((1, 1), (0, 0, 0)), r"origin has shape \(3,\)"),
        (((1, 1), (0, 0), np.eye(3)), r"direction has shape \(3, 3\)"),
        (((1,) * 5, (0,) * 5), "spacing"),
        (((1, np.nan), (0, 0)), "nan"),
    ],
)
def test_grids(arguments, message):
    with pytest.raises(ValueError, match=message):
        subdivided_grid(*arguments)
