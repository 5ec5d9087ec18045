# SPDX-License-Identifier: Apache-2.0
"""A run from Zarr array to Zarr array, block by block, by any number of processes. Finished blocks are remembered."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from math import ceil, prod
from pathlib import Path
from typing import Any

import numpy as np
import zarr
from numpy.typing import NDArray

from . import _arguments, _core
from ._run import Indices, Run

# The voxels of a block, at most, unless a chunk has more: large enough to keep the halo small.
BLOCK_VOXELS = 2**24


@dataclass(frozen=True)
class Job:
    """All that a process needs to know to compute a block."""

    input: str
    state_of_input: str
    output: str
    shape: tuple[int, ...]
    dtype: str
    scheme: str
    tension: float
    boundary: str | float
    axes: tuple[int, ...]
    levels: int
    is_labels: bool
    # The size of a block of the output: whole chunks, or whole shards, so that no two blocks write to the same one.
    block: tuple[int, ...]

    def grid(self) -> tuple[int, ...]:
        """The number of blocks along each axis."""
        sizes = [size << self.levels if axis in self.axes else size for axis, size in enumerate(self.shape)]
        return tuple(ceil(size / block) for size, block in zip(sizes, self.block))


def block_size(unit: Sequence[int], shape: Sequence[int], axes: Sequence[int]) -> tuple[int, ...]:
    """Whole units, as many along the subdivided axes as make a block near BLOCK_VOXELS and near a cube."""
    block = list(unit)
    while True:
        growing = [axis for axis in axes if block[axis] < shape[axis]]
        if not growing or 2 * prod(block) > BLOCK_VOXELS:
            return tuple(block)
        block[min(growing, key=lambda axis: block[axis])] *= 2


class Progress:
    """The folder beside the output that exists until the run is complete: the job, a file for each finished block."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def begin(self, job: Job) -> None:
        self.folder.mkdir(parents=True)
        (self.folder / "job.json").write_text(self._text(job))

    def exists(self) -> bool:
        return (self.folder / "job.json").exists()

    def differences(self, job: Job) -> list[str]:
        """The names of what the job that was begun has other than this one."""
        begun, asked = self._read(), json.loads(self._text(job))
        return [name.replace("_", " ") for name in asked if begun.get(name) != asked[name]]

    def mark(self, block: int) -> None:
        (self.folder / str(block)).touch()

    def finished(self) -> set[int]:
        return {int(path.name) for path in self.folder.iterdir() if path.name.isdigit()}

    def output(self) -> str:
        return str(self._read()["output"])

    def end(self) -> None:
        # The job last: as long as it is there, a run that was ended here goes on.
        for path in self.folder.iterdir():
            if path.name.isdigit():
                path.unlink()
        (self.folder / "job.json").unlink()
        self.folder.rmdir()

    def _read(self) -> dict[str, Any]:
        begun: dict[str, Any] = json.loads((self.folder / "job.json").read_text())
        return begun

    @staticmethod
    def _text(job: Job) -> str:
        return json.dumps(asdict(job), indent=2)


def compute_block(job: Job, number: int, progress_folder: str) -> None:
    """Reads a block's halo from the store, computes and writes the block. Done twice, it does no harm."""
    output = zarr.open_array(job.output, mode="r+")
    position = np.unravel_index(number, job.grid())
    first = [int(index) * block for index, block in zip(position, job.block)]
    size = [min(block, whole - start) for block, whole, start in zip(job.block, output.shape, first)]
    result = np.empty(size, output.dtype)
    _compute(job, first, result)
    output[tuple(slice(start, start + length) for start, length in zip(first, size))] = result
    Progress(Path(progress_folder)).mark(number)


def _compute(job: Job, first: Sequence[int], result: NDArray[Any]) -> None:
    array = zarr.open_array(job.input, mode="r")
    # A periodic volume is one of several in a row, and a block of the middle one sees no boundary.
    repeats = [1] * array.ndim
    if job.boundary == "periodic":
        halo = 2 * _core.radius(job.scheme)
        repeats = [ceil(halo / size) if axis in job.axes else 0 for axis, size in enumerate(array.shape)]
        repeats = [2 * repeat + 1 for repeat in repeats]
    boundary = "nearest" if job.boundary == "periodic" else job.boundary
    run = Run(
        options=_arguments.make_options(job.scheme, job.tension, boundary, job.axes, array.ndim, job.is_labels),
        shape=tuple(size * repeat for size, repeat in zip(array.shape, repeats)),
        axes=job.axes,
        levels=job.levels,
        input_type=array.dtype,
        is_labels=job.is_labels,
    )
    middle = [size * (repeat // 2) for size, repeat in zip(array.shape, repeats)]
    shifted = [start + (offset << job.levels) for start, offset in zip(first, middle)]

    def read(part_first: Indices, part_size: Indices) -> NDArray[Any]:
        return _read_repeated(array, part_first, part_size)

    run.compute(read, shifted, result)


def _read_repeated(array: Any, first: Indices, size: Indices) -> NDArray[Any]:
    """A part of an array that is repeated along each axis."""
    ranges = []
    for start, length, whole in zip(first, size, array.shape):
        begin = start % whole
        inside = begin + length <= whole
        ranges.append(slice(begin, begin + length) if inside else np.arange(start, start + length) % whole)
    if all(isinstance(part, slice) for part in ranges):
        return np.asarray(array[tuple(ranges)])
    return np.asarray(array.oindex[tuple(ranges)])
