# SPDX-License-Identifier: Apache-2.0
"""A NumPy array, twice as fine: numpy_array.py IN.npy OUT.npy"""

import sys

import numpy as np
from nonoscillatory_subdivision import subdivide

volume = np.load(sys.argv[1], mmap_mode="r")
# The result may be larger than memory: it is written slab by slab, each with the bytes of the whole.
shape = tuple(2 * size for size in volume.shape)
doubled = np.lib.format.open_memmap(sys.argv[2], mode="w+", dtype=volume.dtype, shape=shape)
thickness = 64
for start in range(0, len(doubled), thickness):
    slab = slice(start, min(start + thickness, len(doubled)))
    subdivide(volume, region=(slab,), out=doubled[slab])
doubled.flush()
print(f"{volume.shape} {volume.min()} ... {volume.max()} -> {doubled.shape} {doubled.min()} ... {doubled.max()}")
