#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draw a slice before and after subdivision, whole and its middle enlarged: draw_slices.py BEFORE AFTER PICTURE.png"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402 (the backend has to be chosen first)
import numpy as np  # noqa: E402

from volumes import VolumeError, read_volume  # noqa: E402 (of experiments/)

ENLARGED_SHARE = 5  # the lower row shows the middle fifth of each axis


def middle(pixels):
    """The middle part along both axes."""
    box = [slice(n // 2 - n // ENLARGED_SHARE // 2, n // 2 + (n // ENLARGED_SHARE + 1) // 2) for n in pixels.shape]
    return pixels[box[0], box[1]] if all(s.stop > s.start for s in box) else pixels


def draw(slices, picture):
    """Both slices in one grey scale, side by side at the same physical size."""
    low, high = np.percentile(slices[0].data, [1, 99.5])
    figure, panels = plt.subplots(2, 2, figsize=(9, 9.6), constrained_layout=True)
    for column, (title, volume) in enumerate(zip(("before", "after subdivision"), slices)):
        pixels = volume.data[0]
        aspect = volume.spacing[1] / volume.spacing[2]
        style = {"cmap": "gray", "vmin": low, "vmax": high, "interpolation": "nearest", "aspect": aspect}
        panels[0][column].imshow(pixels, **style)
        panels[0][column].set_title(f"{title}: {pixels.shape[1]} x {pixels.shape[0]}")
        panels[1][column].imshow(middle(pixels), **style)
    for panel in panels.flat:
        panel.axis("off")
    figure.savefig(picture, dpi=120)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    try:
        draw([read_volume(path) for path in sys.argv[1:3]], sys.argv[3])
    except (VolumeError, OSError) as error:
        sys.exit(f"draw_slices.py: {error}")


if __name__ == "__main__":
    main()
