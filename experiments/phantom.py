#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The paper's kind of phantom (its Figure 3): sharp objects of value 1 on a background of 0.

As a program it writes the volume, or the README's picture:
    phantom.py --volume phantom.mha [--size 256] [--type float]
    phantom.py --picture docs/phantom.png
"""
import argparse
import pathlib
import sys

import numpy as np

import common
from report import Finding, Picture, Result, Table, Text
from volumes import write_volume

DESIGN_SIZE = 96  # the sizes below are in voxels of the 96^3 phantom
BOXES = {
    "cube": ((8, 28), (8, 28), (8, 28)),
    "stick": ((40, 42), (8, 10), (6, 46)),
    "plane": ((8, 40), (50, 52), (50, 86)),
    "attached plane": ((8, 10), (50, 80), (50, 86)),
}
SOLID_CENTRE, SOLID_RADIUS = (66, 26, 26), 16
RAMP_CENTRE, RAMP_RADIUS = (66, 66, 66), 20
LEFT_X, SEAM_Y, RIGHT_X = 20, 44, 66  # the picture: the slice at LEFT_X up to SEAM_Y, then the one at RIGHT_X

PAPER_LINEAR_RANGE = (-0.31, 1.5)
REFERENCE_LINEAR_RANGE = (-0.3127940520644188, 1.5234947204589844)
TENSIONS = (1.01, 1.5, 2.0, 4.0, 8.0)


def _distance(size, centre):
    axes = np.ogrid[:size, :size, :size]
    return np.sqrt(sum((axis - c) ** 2 for axis, c in zip(axes, centre)))


def phantom(size=DESIGN_SIZE, kind=np.float64):
    """A cube, a thin stick, two thin planes, a solid sphere and one that fades linearly, [z, y, x]."""
    scale = size / DESIGN_SIZE
    volume = np.zeros((size, size, size))
    for box in BOXES.values():
        volume[tuple(slice(round(start * scale), round(stop * scale)) for start, stop in box)] = 1.0
    volume[_distance(size, [c * scale for c in SOLID_CENTRE]) <= SOLID_RADIUS * scale] = 1.0
    ramp = np.maximum(0.0, 1.0 - _distance(size, [c * scale for c in RAMP_CENTRE]) / (RAMP_RADIUS * scale))
    return np.maximum(volume, ramp).astype(kind)


def every_object(volume):
    """One image [z, y] that cuts all six objects: two slices of constant x, side by side."""
    scale = volume.shape[0] / DESIGN_SIZE
    seam, left, right = (round(position * scale) for position in (SEAM_Y, LEFT_X, RIGHT_X))
    return np.concatenate([volume[:, :seam, left], volume[:, seam:, right]], axis=1)


def draw(volumes, output_folder, file):
    """The slices side by side: grey from 0 to 1, one colour for values below and one for values above."""
    grey = common.plt.get_cmap("gray").with_extremes(under=common.BELOW_COLOUR, over=common.ABOVE_COLOUR)
    figure, axes = common.new_figure(columns=len(volumes), width=4.0, height=4.3)
    for panel, (title, volume) in zip(axes[0], volumes.items()):
        title = f"{title}\n{volume.min():.4g} … {volume.max():.4g}"
        common.show_slice(panel, every_object(volume), title, cmap=grey, vmin=0.0, vmax=1.0)
    return common.save_figure(figure, output_folder, file)


def three_volumes(original):
    """The original, the linear and the non-oscillatory result, by title."""
    kind = "double" if original.dtype == np.float64 else "float"
    schemes = ("linear", "nonoscillatory")
    results = {common.SCHEMES[s]: common.subdivide(original, scheme=s, output_type=kind) for s in schemes}
    return {"original": original, **results}


def _row(original, label, tension, volume, paper="", reference=""):
    outside = np.mean((volume < original.min()) | (volume > original.max()))
    size = f"{original.shape[0]}³ {original.dtype}"
    measured = (float(volume.min()), float(volume.max()))
    return [size, label, tension, *measured, 100.0 * float(outside), paper, reference]


def ranges_table(originals_and_results):
    """One row for each (original, scheme label, tension, result, the paper's range, the reference's)."""
    columns = [
        ("phantom", ""), ("scheme", ""), ("tension", "g"), ("minimum", ".10g"), ("maximum", ".10g"),
        ("voxels out of range / %", ".3f"), ("the paper's range", ""), ("independent reference", ""),
    ]  # fmt: skip
    caption = "Ranges after subdivision; the original's is 0 … 1."
    return Table("phantom_ranges", caption, columns, [_row(*entry) for entry in originals_and_results])


def _range_text(bounds):
    return f"{bounds[0]:.10g} … {bounds[1]:.10g}"


def _findings(rows):
    linear = next(row for row in rows if row[1] == common.SCHEMES["linear"])
    kept = [row for row in rows if row[1] == common.SCHEMES["nonoscillatory"]]
    rounded = (round(linear[3], 2), round(linear[4], 1))
    deviation = max(abs(linear[3] - REFERENCE_LINEAR_RANGE[0]), abs(linear[4] - REFERENCE_LINEAR_RANGE[1]))
    return [
        Finding(
            "rounded as the paper prints it, the linear scheme's range is the paper's.",
            rounded == PAPER_LINEAR_RANGE,
            f"Here {rounded[0]} … {rounded[1]}, there {PAPER_LINEAR_RANGE[0]} … {PAPER_LINEAR_RANGE[1]}; "
            "the paper's phantom has the same kinds of objects, not the same sizes.",
        ),
        Finding(
            "the linear scheme's range is that of an independent double-precision computation.",
            deviation < 1e-12,
            f"Largest deviation {deviation:.1e}.",
        ),
        Finding(
            "the non-oscillatory scheme keeps the range 0 … 1 exactly, at every tension tried.",
            all(row[3] == 0.0 and row[4] == 1.0 for row in kept),
        ),
    ]


def run(setting, output_folder):
    """The phantom at 96^3 in double and, in the full setting, at 256^3 in float."""
    original = phantom()
    volumes = three_volumes(original)
    paper, reference = _range_text(PAPER_LINEAR_RANGE), _range_text(REFERENCE_LINEAR_RANGE)
    linear_label, label = common.SCHEMES["linear"], common.SCHEMES["nonoscillatory"]
    entries = [(original, linear_label, None, volumes[linear_label], paper, reference)]
    for tension in TENSIONS:
        result = common.subdivide(original, tension=tension, output_type="double")
        entries.append((original, label, tension, result, "", _range_text((0.0, 1.0))))
    for scheme in ("bounded", "bspline", "restored", "restored, tension 0"):
        result = common.subdivide(original, scheme=scheme, output_type="double")
        entries.append((original, common.SCHEMES[scheme], None, result))
    pictures = [draw(volumes, output_folder, "phantom_96.png")]
    if setting == "full":
        original = phantom(256, np.float32)
        volumes = three_volumes(original)
        entries.append((original, linear_label, None, volumes[linear_label], paper))
        entries.append((original, label, 2.0, volumes[label]))
        pictures.append(draw(volumes, output_folder, "phantom_256.png"))
    table = ranges_table(entries)
    result = Result("Phantom (the paper's Figure 3)")
    result.add(
        Text(
            "A cube, a stick and two planes two voxels thin, a solid sphere and one that fades linearly to zero. "
            "The linear scheme over- and undershoots at every jump; the non-oscillatory one must not."
        )
    )
    caption = "Original, linear and non-oscillatory; blue is below the original's range, red above it"
    result.add(*[Picture(file, f"{caption} ({file.split('_')[1].split('.')[0]}³ voxels).") for file in pictures])
    result.add(table, *_findings(table.rows))
    return result


def main():
    parser = argparse.ArgumentParser(description="Write the phantom as a volume, or the README's picture of it.")
    parser.add_argument("--volume", metavar="FILE.mha", help="write the phantom")
    parser.add_argument("--size", type=int, default=DESIGN_SIZE, help="voxels along each axis (default: %(default)s)")
    parser.add_argument("--type", choices=("float", "double"), default="double", help="of the voxels written")
    parser.add_argument("--picture", metavar="FILE.png", help="draw the original and both results")
    arguments = parser.parse_args()
    if not (arguments.volume or arguments.picture):
        parser.error("nothing to do: give --volume or --picture")
    try:
        original = phantom(arguments.size, {"float": np.float32, "double": np.float64}[arguments.type])
        if arguments.volume:
            write_volume(arguments.volume, original)
        if arguments.picture:
            picture = pathlib.Path(arguments.picture)
            draw(three_volumes(original), picture.parent, picture.name)
    except (common.ProgramError, OSError) as error:
        sys.exit(f"phantom.py: {error}")


if __name__ == "__main__":
    main()
