# SPDX-License-Identifier: Apache-2.0
"""SubdivideVolume on NIfTI's own ways: what its numbers, placements and components mean, and what is not finite."""

import array
import gzip
import math
import os
import unittest

from subdivide_volume_case import ProgramTest, noise
from subdivide_volume_files import Meta, write_meta

SIZE = [7, 6, 5]


def read_nifti(path, kind):
    """The voxels of a NIfTI file, or of the two of a pair."""
    with (gzip.open if path.endswith(".gz") else open)(path.replace(".hdr", ".img"), "rb") as file:
        return array.array(kind, file.read()[0 if path.endswith(".hdr") else 352:])


class Nifti(ProgramTest):
    def test_what_is_not_finite_is_written(self):
        for kind in "fd":
            for place, value in ((0, math.nan), (209, math.inf), (100, -math.inf)):
                values = [float(number) for number in noise(210)]
                values[place] = value
                write_meta(self.path("in.mha"), SIZE, kind, values)
                self.subdivide("in.mha", "truth.mha")
                truth = Meta(self.path("truth.mha")).data
                for ending in (".nii", ".nii.gz", ".hdr"):
                    with self.subTest(kind=kind, value=value, ending=ending):
                        self.subdivide("in.mha", "written" + ending)
                        self.assertEqual(read_nifti(self.path("written" + ending), kind).tobytes(), truth)


if __name__ == "__main__":
    unittest.main()
