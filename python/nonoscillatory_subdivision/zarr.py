# SPDX-License-Identifier: Apache-2.0
"""Subdivision of Zarr and OME-Zarr images of any size, on one machine or a cluster. Needs the extra ``zarr``.

python -m nonoscillatory_subdivision.zarr IN OUT
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from itertools import islice
from math import prod
from pathlib import Path
from typing import Any

import distributed
import numpy as np
import tqdm
import zarr

from . import _arguments, _zarr_image, schemes
from ._arguments import Boundary
from ._run import Run
from ._zarr_blocks import Job, Progress, block_size, compute_block

__all__ = ["main", "subdivide"]

PROGRAM = "python -m nonoscillatory_subdivision.zarr"


def subdivide(
    source: str,
    target: str | None,
    client: distributed.Client,
    *,
    scheme: str | None = None,
    tension: float | None = None,
    boundary: Boundary = "nearest",
    axes: Sequence[str] | None = None,
    levels: int = 1,
    chunks: Sequence[int] | None = None,
    labels: bool = False,
    report: Callable[[int, int], None] = lambda done, all_blocks: None,
) -> None:
    """Double the resolution of an image in a Zarr store.

    The scale of an OME-Zarr image is halved for each level, its translation moves by a quarter of the old voxel down
    for one level. A run that was ended before it was complete is taken up by the same call, if its input's files are
    as they were.

    Parameters
    ----------
    source : str
        A Zarr array, or the group of an OME-Zarr image (0.4 on Zarr 2, 0.5 on Zarr 3), of which the finest level is
        read. Whatever Zarr opens, if all workers can.
    target : str or None
        The folder of the result, which does not exist. All workers and the caller see it. None: the result becomes the
        finest level of the source's own pyramid.
    client : distributed.Client
        Whose workers compute the blocks.
    scheme, tension, boundary, levels
        As for `nonoscillatory_subdivision.subdivide`, or `subdivide_labels`, with the same defaults.
    axes : sequence of str, optional
        The names of axes to subdivide, or positions in a plain array. Default: those of space; all or the last three of
        a plain array.
    chunks : sequence of int, optional
        The chunks of the result. Default: as large as the source's, and in shards as the source's.
    labels : bool, optional
        Whether the values are labels.
    report : callable, optional
        Called with the number of finished blocks and of all.

    Raises
    ------
    ValueError, TypeError
        If there is no image, an argument does not fit it, the target exists, or the input's files change meanwhile.
    """
    run = _Run.prepare(
        source,
        target,
        scheme=scheme,
        tension=tension,
        boundary=boundary,
        axes=axes,
        levels=levels,
        chunks=chunks,
        labels=labels,
    )
    run.compute(client, report)


@dataclass(frozen=True)
class _Wanted:
    """What is to be computed: part of a job."""

    scheme: str
    tension: float
    boundary: str | float
    axes: tuple[int, ...]
    levels: int
    is_labels: bool


class _Place:
    """Where the result goes: a new array, a new group with one array, or an array in the source's group."""

    def __init__(self, image: _zarr_image.Image, target: str | None) -> None:
        self._image = image
        self._is_level = target is None
        if target is None:
            if image.multiscale is None:
                raise ValueError(f"{image.path} is a plain array: it has no pyramid to put a level before")
            target = image.path
        if "://" in target:
            raise ValueError(f"{target} is no folder")
        self.folder = Path(target)
        if not self._is_level and Path(image.array_path).resolve() in self.folder.resolve().parents:
            raise ValueError(f"{target} is within the input")
        self._name = None
        if image.multiscale is not None:
            self._finest = image.multiscale["datasets"][0]["path"]
            self._name = f"{self._finest}-doubled" if self._is_level else "0"
        self.array = self.folder if self._name is None else self.folder / self._name
        # Beside the result, so that it is no part of it.
        self.progress = Progress(self.folder.with_name(self.folder.name + ".unfinished"))

    def remove_notes_of_a_complete_run(self) -> None:
        """A run may have ended after it described its level and before it removed its notes."""
        if self._is_level and self.progress.exists():
            if self.progress.output() == str((self.folder / self._finest).resolve()):
                self.progress.end()
                raise ValueError(f"{self.folder} has its doubled level: the run before was complete")

    def exists(self) -> bool:
        return (self.array if self._is_level else self.folder).exists()

    def create(self, wanted: _Wanted, chunks: Sequence[int] | None) -> Any:
        if self._name is not None and not self._is_level:
            zarr.create_group(str(self.folder), zarr_format=self._image.array.metadata.zarr_format)
        return _zarr_image.create_array(
            str(self.array), self._image, wanted.axes, wanted.levels, chunks, wanted.is_labels
        )

    def describe(self, wanted: _Wanted) -> None:
        """Comes last, so that nobody takes an unfinished image for a finished one."""
        if self._name is None:
            return
        if self._is_level:
            _zarr_image.prepend_level(self._image, wanted.axes, wanted.levels, self._name)
        else:
            _zarr_image.write_new_group(str(self.folder), self._image, wanted.axes, wanted.levels, self._name)


def _check(image: _zarr_image.Image, wanted: _Wanted, chunks: Sequence[int] | None) -> None:
    """Finds what is wrong with what is wanted before anything is created."""
    array = image.array
    if array.ndim == 0 or 0 in array.shape:
        raise ValueError(f"{image.array_path} has shape {array.shape}: there is nothing to subdivide")
    kind = _arguments.checked_type(array.dtype, image.array_path)
    result_type = (_arguments.label_type if wanted.is_labels else _arguments.result_type)(kind, None)
    options = _arguments.make_options(
        wanted.scheme, wanted.tension, wanted.boundary, wanted.axes, array.ndim, wanted.is_labels
    )
    if wanted.is_labels:
        _arguments.check_boundary_label(wanted.boundary, kind)
    # One voxel is enough to find what else is wrong with the options.
    levels = _arguments.checked_levels(wanted.levels)
    voxel = Run(options, (1,) * array.ndim, wanted.axes, levels, kind, wanted.is_labels)
    voxel.compute(lambda first, size: np.zeros(size, kind), (0,) * array.ndim, np.empty((1,) * array.ndim, result_type))
    if chunks is not None and (len(chunks) != array.ndim or min(chunks) < 1):
        raise ValueError(f"chunks {tuple(chunks)} are not {array.ndim} positive numbers")
    if image.multiscale is not None:
        _zarr_image.dataset(image, wanted.axes, levels, "")


@dataclass(frozen=True)
class _Run:
    image: _zarr_image.Image
    place: _Place
    wanted: _Wanted
    chunks: Sequence[int] | None

    @classmethod
    def prepare(
        cls,
        source: str,
        target: str | None,
        *,
        scheme: str | None,
        tension: float | None,
        boundary: Boundary,
        axes: Sequence[str] | None,
        levels: int,
        chunks: Sequence[int] | None,
        labels: bool,
    ) -> _Run:
        """Finds what is wrong. Nothing is created yet."""
        image = _zarr_image.open_image(source, labels)
        place = _Place(image, target)
        place.remove_notes_of_a_complete_run()
        wanted = _Wanted(
            scheme=scheme if scheme is not None else "restored" if labels else "nonoscillatory",
            tension=float(tension) if tension is not None else 0.0 if labels else 2.0,
            boundary=boundary if isinstance(boundary, str) else float(boundary),
            axes=image.axes_to_subdivide(axes),
            levels=levels,
            is_labels=labels,
        )
        _check(image, wanted, chunks)
        run = cls(image, place, wanted, chunks)
        if place.progress.exists():
            run._check_what_was_begun()
        elif place.exists():
            name = place.array if place.array.exists() else place.folder
            raise ValueError(f"{name} exists: remove it or choose another name")
        return run

    def _job(self, output: Any) -> Job:
        path = self.image.array_path
        return Job(
            input=str(Path(path).resolve()) if Path(path).exists() else path,
            state_of_input=_zarr_image.state_of(path),
            output=str(self.place.array.resolve()),
            shape=self.image.array.shape,
            dtype=str(self.image.array.dtype),
            block=block_size(output.shards or output.chunks, output.shape, self.wanted.axes),
            **asdict(self.wanted),
        )

    def _check_what_was_begun(self) -> None:
        output = zarr.open_array(str(self.place.array), mode="r")
        differences = self.place.progress.differences(self._job(output))
        if self.chunks is not None and tuple(self.chunks) != output.chunks:
            differences.append("chunks")
        if differences:
            raise ValueError(
                f"{self.place.folder} was begun with another {', '.join(differences)}: take it up as it was begun, or "
                f"remove it and {self.place.progress.folder}"
            )

    def _begin(self) -> Job:
        """The job; its output is created unless a run of this very job began before."""
        if self.place.progress.exists():
            return self._job(zarr.open_array(str(self.place.array), mode="r"))
        job = self._job(self.place.create(self.wanted, self.chunks))
        self.place.progress.begin(job)
        return job

    def compute(self, client: distributed.Client, report: Callable[[int, int], None]) -> None:
        job = self._begin()
        total = prod(job.grid())
        finished = self.place.progress.finished()
        report(len(finished), total)
        for done in self._compute_blocks(client, job, (block for block in range(total) if block not in finished)):
            report(len(finished) + done, total)
        if _zarr_image.state_of(job.input) != job.state_of_input:
            raise ValueError(
                f"{job.input} was changed while it was read: remove {self.place.folder} and {self.place.progress.folder}"
            )
        self.place.describe(self.wanted)
        self.place.progress.end()

    def _compute_blocks(self, client: distributed.Client, job: Job, blocks: Iterable[int]) -> Iterable[int]:
        """Yields how many blocks are done. Those of a worker that is lost are given to another one by the scheduler."""
        remaining = iter(blocks)

        def submit(block: int) -> distributed.Future:
            return client.submit(compute_block, job, block, str(self.place.progress.folder), pure=False, retries=2)

        # A few blocks for each thread are enough to keep it busy; a task for every block might be too many.
        window = 3 * max(1, sum(client.nthreads().values()))
        running = distributed.as_completed([submit(block) for block in islice(remaining, window)])
        for done, future in enumerate(running, start=1):
            future.result()
            for block in islice(remaining, 1):
                running.add(submit(block))
            yield done


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog=PROGRAM, description="Double the resolution of a Zarr or OME-Zarr image.")
    parser.add_argument("input", metavar="IN", help="Zarr array, or group of an OME-Zarr image (0.4 or 0.5)")
    parser.add_argument("output", metavar="OUT", nargs="?", help="the folder to write; must not exist")
    parser.add_argument("--append-level", action="store_true", help="no OUT: put the result before IN's finest level")
    parser.add_argument("--labels", action="store_true", help="IN is a label map; only labels that are there appear")
    parser.add_argument("--scheme", choices=schemes(), help="default: nonoscillatory, for labels restored")
    parser.add_argument("--tension", type=float, help="default: 2, for labels 0")
    parser.add_argument("--boundary", type=_boundary, default="nearest", help="nearest, mirror, periodic or a number")
    parser.add_argument("--axes", type=lambda text: text.split(","), help="such as y,x; default: those of space")
    parser.add_argument("--levels", type=int, default=1, help="1 to 3: 2, 4 or 8 times as fine")
    parser.add_argument("--chunks", type=_numbers, help="such as 64,64,64; default: as IN's")
    workers = parser.add_mutually_exclusive_group()
    workers.add_argument("--scheduler", metavar="ADDRESS", help="of a Dask cluster that is running")
    workers.add_argument("--workers", metavar="N", type=int, help="processes on this machine; default: one a processor")
    return parser


def _boundary(text: str) -> Boundary:
    try:
        return float(text)
    except ValueError:
        return _arguments.checked_boundary(text) and text


def _numbers(text: str) -> tuple[int, ...]:
    return tuple(int(part) for part in text.split(","))


def _connect(arguments: argparse.Namespace) -> distributed.Client:
    if arguments.scheduler is not None:
        return distributed.Client(arguments.scheduler, timeout=30)
    workers = _arguments.checked_threads(arguments.workers, "workers")
    return distributed.Client(n_workers=workers, threads_per_worker=1, processes=True, dashboard_address=":0")


def main(arguments: Sequence[str] | None = None) -> int:
    """The command line. Returns the exit code."""
    parser = _parser()
    options = parser.parse_args(arguments)
    if (options.output is None) != options.append_level:
        parser.error("either OUT or --append-level")
    try:
        run = _Run.prepare(
            options.input,
            options.output,
            scheme=options.scheme,
            tension=options.tension,
            boundary=options.boundary,
            axes=options.axes,
            levels=options.levels,
            chunks=options.chunks,
            labels=options.labels,
        )
        with _connect(options) as client, tqdm.tqdm(unit="block") as bar:

            def report(done: int, total: int) -> None:
                bar.total = total
                bar.update(done - bar.n)

            run.compute(client, report)
    except KeyboardInterrupt:
        print(f"{PROGRAM}: interrupted: the same command goes on from here", file=sys.stderr)
        return 130
    except (ValueError, TypeError, OSError, distributed.scheduler.KilledWorker) as error:
        print(f"{PROGRAM}: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
