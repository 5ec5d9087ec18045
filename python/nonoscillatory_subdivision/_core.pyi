# SPDX-License-Identifier: Apache-2.0
from collections.abc import Callable, Sequence
from typing import Any

from numpy.typing import NDArray

__version__: str

def schemes() -> list[str]:
    """The names of the schemes, the default first."""

def targets() -> list[str]:
    """The instruction sets that this processor can use, the one in use first."""

def radius(scheme: str) -> int:
    """How many voxels to either side of its own a child depends on."""

class Options:
    """What to compute: axes are flags in NumPy's order; boundary is nearest, mirror, periodic or constant."""

    def __init__(self, scheme: str, tension: float, axes: Sequence[bool], boundary: str, constant: float) -> None: ...
    def input_request(
        self, first: Sequence[int], size: Sequence[int], whole: Sequence[int]
    ) -> tuple[list[int], list[int]]:
        """First indices and size of the part of an input, of the given whole size, that a part of the output needs."""

def subdivide(
    options: Options,
    input: NDArray[Any],
    input_first: Sequence[int],
    whole: Sequence[int],
    output: NDArray[Any],
    output_first: Sequence[int],
    threads: int,
    progress: Callable[[float], object] | None,
    begin: float,
    end: float,
) -> None:
    """One level: fills the output, part of the doubled whole, from a part of the input."""

def subdivide_labels(
    options: Options,
    input: NDArray[Any],
    input_first: Sequence[int],
    whole: Sequence[int],
    output: NDArray[Any],
    output_first: Sequence[int],
    threads: int,
    progress: Callable[[float], object] | None,
    begin: float,
    end: float,
) -> None:
    """One level of labels: fills the output, part of the doubled whole, from a part of the input."""
