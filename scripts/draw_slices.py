#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draw a slice before and after subdivision, whole and a detail of it: draw_slices.py BEFORE AFTER PICTURE.png"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402 (the backend has to be chosen first)
import numpy as np  # noqa: E402

from volumes import VolumeError, read_volume  # noqa: E402 (of experiments/)

DETAILS = 6  # the slice is divided into so many parts along each axis, one of which is shown enlarged


def parts(size):
    """Bounds of the parts along an axis, as shares of it."""
    count = min(DETAILS, size)
    return [(i / count, (i + 1) / count) for i in range(count)]


def crop(pixels, detail):
    """The pixels of a detail, ((start, stop) along y, (start, stop) along x)."""
    rows, columns = [
        slice(round(start * n), round(stop * n)) for (start, stop), n in zip(detail, pixels.shape)
    ]  # fmt: skip
    return pixels[rows, columns]


def liveliest(pixels):
    """The detail whose pixels differ most."""
    details = [(y, x) for y in parts(pixels.shape[0]) for x in parts(pixels.shape[1])]
    return max(details, key=lambda detail: crop(pixels, detail).std())


def draw(slices, picture):
    """Both slices in one grey scale, side by side at the same physical size, above the same detail of both."""
    before = slices[0].data[0]
    low, high = np.percentile(before, [1, 99.5])
    (top, bottom), (left, right) = detail = liveliest(before)
    figure, panels = plt.subplots(2, 2, figsize=(9, 9.6), constrained_layout=True)
    for column, (title, volume) in enumerate(zip(("before", "after subdivision"), slices)):
        pixels = volume.data[0]
        aspect = volume.spacing[1] / volume.spacing[2]
        style = {"cmap": "gray", "vmin": low, "vmax": high, "interpolation": "nearest", "aspect": aspect}
        panels[0][column].imshow(pixels, **style)
        panels[0][column].set_title(f"{title}: {pixels.shape[1]} x {pixels.shape[0]}")
        height, width = pixels.shape
        corner = (left * width - 0.5, top * height - 0.5)
        frame = plt.Rectangle(corner, (right - left) * width, (bottom - top) * height, fill=False, color="tab:orange")
        panels[0][column].add_patch(frame)
        panels[1][column].imshow(crop(pixels, detail), **style)
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
