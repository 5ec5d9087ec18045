# SPDX-License-Identifier: Apache-2.0
"""Everything here that doubles the resolution, under the name that the tables use."""
import common


def doubling_methods():
    """{name: function from voxels to voxels on twice the grid}: interpolation first, then the project's schemes."""
    found = {
        name: lambda voxels, order=order: common.interpolate(voxels, order) for order, name in common.PEERS.items()
    }
    for scheme, name in common.SCHEMES.items():
        found[name] = lambda voxels, scheme=scheme: common.subdivide(voxels, scheme=scheme)
    return found
