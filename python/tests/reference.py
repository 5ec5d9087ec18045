# SPDX-License-Identifier: Apache-2.0
"""The schemes of docs/scheme.md as they stand there, in double precision, on whole arrays."""

from itertools import combinations, product

import numpy as np

B = np.array([11, 165, 462, 330, 55, 1]) / 1024
C = np.array([3, -285, -111, 9]) / 1024
A = np.array([14, -126, 924, 276, -74, 10]) / 1024
PAD = 10
PAD_MODES = {"nearest": "edge", "mirror": "symmetric", "periodic": "wrap"}


def shifted(x, offset, axis):
    """The value `offset` voxels further along an axis. What comes round the end lies in the padding."""
    return np.roll(x, -offset, axis)


def filtered(x, mask, upper, axis):
    """The mask for one child: as it stands for the upper one, reversed for the lower one."""
    size = len(mask)
    first = 1 - size // 2 if upper else -(size // 2)
    weights = mask if upper else mask[::-1]
    return sum(weight * shifted(x, first + i, axis) for i, weight in enumerate(weights))


def second_difference(x, axis):
    return shifted(x, -1, axis) - 2 * x + shifted(x, 1, axis)


def windowed(x, radius, axes, reduce):
    for axis in axes:
        x = reduce([shifted(x, offset, axis) for offset in range(-radius, radius + 1)])
    return x


def minimum(arrays):
    return np.min(arrays, axis=0)


def maximum(arrays):
    return np.max(arrays, axis=0)


def non_oscillatory(f, upper, axes, tension):
    total = np.zeros_like(f)
    for count in range(len(axes) + 1):
        for chosen in combinations(axes, count):
            g, differences = f, f
            for axis in chosen:
                g = second_difference(g, axis)
                differences = differences - shifted(differences, -1, axis)
            h = np.abs(differences)
            for axis in chosen:
                h = h + shifted(h, 1, axis)
            if chosen:
                k = tension * windowed(h, 2, chosen, minimum)
                g = np.clip(g, -k, k)
            for axis in axes:
                g = filtered(g, C if axis in chosen else B, upper[axis], axis)
            total = total + g
    return total


def tensor_product(f, mask, upper, axes):
    for axis in axes:
        f = filtered(f, mask, upper[axis], axis)
    return f


def bounded(values, f, axes):
    return np.clip(values, windowed(f, 1, axes, minimum), windowed(f, 1, axes, maximum))


def restored(f, upper, axes, tension):
    def laplacian(x):
        return sum(second_difference(x, axis) for axis in axes)

    sharpened = f - 15 / 16 * laplacian(f) - 9 / 64 * laplacian(laplacian(f))
    e = bounded(tensor_product(sharpened, B, upper, axes), f, axes)
    h = sum(np.abs(f - shifted(f, -1, axis)) + np.abs(shifted(f, 1, axis) - f) for axis in axes)
    least, greatest = windowed(h, 2, axes, minimum), windowed(h, 2, axes, maximum)
    t = np.divide(4 * tension * least**2, greatest, out=np.zeros_like(f), where=greatest > 0)
    return e + np.clip(tensor_product(f, A, upper, axes) - e, -t, t)


def child(f, scheme, upper, axes, tension):
    if scheme == "nonoscillatory":
        return non_oscillatory(f, upper, axes, tension)
    if scheme == "restored":
        return restored(f, upper, axes, tension)
    values = tensor_product(f, B if scheme == "bspline" else A, upper, axes)
    return bounded(values, f, axes) if scheme == "bounded" else values


def subdivided(f, scheme="nonoscillatory", tension=2.0, boundary="nearest", axes=None, levels=1):
    """Real values, not rounded. `axes`: default all."""
    f = np.asarray(f, dtype=np.float64)
    axes = tuple(range(f.ndim)) if axes is None else axes
    for _ in range(levels):
        width = [(PAD, PAD) if axis in axes else (0, 0) for axis in range(f.ndim)]
        how = {"mode": "constant", "constant_values": boundary}
        padded = np.pad(f, width, **({"mode": PAD_MODES[boundary]} if boundary in PAD_MODES else how))
        result = np.empty([2 * size if axis in axes else size for axis, size in enumerate(f.shape)])
        inside = tuple(slice(PAD, -PAD) if axis in axes else slice(None) for axis in range(f.ndim))
        for bits in product((0, 1), repeat=len(axes)):
            upper = dict(zip(axes, bits))
            place = tuple(slice(upper[axis], None, 2) if axis in axes else slice(None) for axis in range(f.ndim))
            result[place] = child(padded, scheme, upper, axes, tension)[inside]
        f = result
    return f
