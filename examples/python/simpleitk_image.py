# SPDX-License-Identifier: Apache-2.0
"""An image file, or a folder with a DICOM series, twice as fine: simpleitk_image.py IN OUT"""

import sys
from pathlib import Path

import SimpleITK as sitk
from nonoscillatory_subdivision import subdivide


def read(path):
    if not path.is_dir():
        return sitk.ReadImage(path)
    series = sitk.ImageSeriesReader.GetGDCMSeriesIDs(str(path))
    if len(series) != 1:
        sys.exit(f"{path} has {len(series)} DICOM series, not one")
    return sitk.ReadImage(sitk.ImageSeriesReader.GetGDCMSeriesFileNames(str(path), series[0]))


image = read(Path(sys.argv[1]))
doubled = subdivide(image, progress=lambda done: print(f"\r{done:.0%}", end=""))
sitk.WriteImage(doubled, sys.argv[2])
print(f"\r{image.GetSize()}, spacing {image.GetSpacing()} -> {doubled.GetSize()}, spacing {doubled.GetSpacing()}")
