# SPDX-License-Identifier: Apache-2.0
import pytest


@pytest.fixture(scope="session")
def client():
    """Two worker processes on this machine."""
    distributed = pytest.importorskip("distributed")
    with distributed.Client(n_workers=2, threads_per_worker=1, dashboard_address=":0") as client:
        yield client


@pytest.fixture
def small_blocks(monkeypatch):
    """One chunk is a block, so that there are many blocks."""
    monkeypatch.setattr("nonoscillatory_subdivision._zarr_blocks.BLOCK_VOXELS", 1)
