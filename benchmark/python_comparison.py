# SPDX-License-Identifier: Apache-2.0
"""Doubling a volume in Python: nonoscillatory_subdivision beside what people use, in time and in quality.

    pip install '.[zarr]' scipy scikit-image SimpleITK     # and torch, opencv-python-headless if wanted
    python benchmark/python_comparison.py --ct build/sample/cranium.nhdr

All get the same array and as many threads; SciPy and scikit-image have one only. Quality: the PSNR of a CT volume
that was averaged 2 x 2 x 2 and brought back, and the mean angle between the normals of a ball's isosurface and the true ones.
What is not installed is left out.
"""

import argparse
import os
import time
from importlib import import_module, metadata

import numpy as np
from nonoscillatory_subdivision import schemes, subdivide


def load(name):
    try:
        return import_module(name)
    except ImportError:
        return None


def own_methods(threads):
    for scheme in schemes():
        yield f"subdivide, {scheme}", lambda volume, scheme=scheme: subdivide(volume, scheme=scheme, threads=threads)
    yield (
        "subdivide, restored, tension 0",
        lambda volume: subdivide(volume, scheme="restored", tension=0, threads=threads),
    )


def scipy_methods(threads):
    if (ndimage := load("scipy.ndimage")) is None:
        return
    for order in (1, 3, 5):
        for grid_mode in (True, False):
            yield (
                f"scipy.ndimage.zoom, order {order}{', grid_mode' if grid_mode else ''} (one thread)",
                lambda volume, order=order, grid_mode=grid_mode: ndimage.zoom(
                    volume, 2, order=order, mode="nearest", grid_mode=grid_mode
                ),
            )


def skimage_methods(threads):
    if (transform := load("skimage.transform")) is None:
        return
    for order in (1, 3):
        yield (
            f"skimage.transform.rescale, order {order} (one thread)",
            lambda volume, order=order: transform.rescale(volume, 2, order=order, mode="edge", preserve_range=True),
        )


def simpleitk_methods(threads):
    if (sitk := load("SimpleITK")) is None:
        return
    sitk.ProcessObject.SetGlobalDefaultNumberOfThreads(threads)

    def expand(volume, interpolator):
        image = sitk.Expand(sitk.GetImageFromArray(volume), [2, 2, 2], interpolator)
        return sitk.GetArrayViewFromImage(image).copy()

    def resample(volume, interpolator):
        image = sitk.GetImageFromArray(volume)
        size = [2 * length for length in image.GetSize()]
        result = sitk.Resample(image, size, sitk.Transform(), interpolator, (-0.25,) * 3, (0.5,) * 3)
        return sitk.GetArrayViewFromImage(result).copy()

    yield "SimpleITK.Expand, linear", lambda volume: expand(volume, sitk.sitkLinear)
    yield "SimpleITK.Resample, linear", lambda volume: resample(volume, sitk.sitkLinear)
    yield "SimpleITK.Resample, B-spline of order 3", lambda volume: resample(volume, sitk.sitkBSpline)


def torch_methods(threads):
    if (torch := load("torch")) is None:
        return
    torch.set_num_threads(threads)

    def trilinear(volume):
        tensor = torch.from_numpy(volume.astype(np.float32))[None, None]
        return torch.nn.functional.interpolate(tensor, scale_factor=2, mode="trilinear")[0, 0].numpy()

    yield "torch interpolate, trilinear", trilinear


def opencv_methods(threads):
    if (cv2 := load("cv2")) is None:
        return
    cv2.setNumThreads(threads)

    def resize(volume, interpolation):
        planes = np.stack([cv2.resize(plane, None, fx=2, fy=2, interpolation=interpolation) for plane in volume])
        # Along z, each row of a plane at once: rows of all planes side by side are an image of their own.
        rows = [cv2.resize(planes[:, y], None, fx=1, fy=2, interpolation=interpolation) for y in range(planes.shape[1])]
        return np.stack(rows, axis=1)

    yield "cv2.resize, linear, plane by plane", lambda volume: resize(volume, cv2.INTER_LINEAR)
    yield "cv2.resize, cubic, plane by plane", lambda volume: resize(volume, cv2.INTER_CUBIC)


def best_time(method, volume, repetitions, clock):
    times = []
    for _ in range(repetitions):
        begin = clock()
        method(volume)
        times.append(clock() - begin)
        if sum(times) > 20:
            break
    return min(times)


def psnr_after_averaging(method, volume):
    """In dB; the peak is the range of the volume."""
    coarse = volume.reshape([length for size in volume.shape for length in (size // 2, 2)]).mean((1, 3, 5))
    error = method(coarse.astype(np.float32)).astype(np.float64) - volume
    return 20 * np.log10(np.ptp(volume) / np.sqrt(np.mean(error**2)))


def ball(size=64, radius=22.4, centre=(31.4, 31.8, 31.1), samples=8):
    """Partial volumes: the share of a voxel's samples that lie within."""
    fine = (np.arange(size * samples) + 0.5) / samples - 0.5
    squares = [(fine - position) ** 2 for position in centre]
    result = np.zeros((size,) * 3, np.float32)
    for z in range(size * samples):
        inside = squares[0][z] + squares[1][:, None] + squares[2] <= radius**2
        result[z // samples] += inside.reshape(size, samples, size, samples).sum((1, 3))
    return result / samples**3, np.array(centre)


def normal_angle(method, volume, centre):
    """The mean angle between a triangle's normal and the true one, in degrees, weighted by area."""
    measure = load("skimage.measure")
    if measure is None:
        return np.nan
    vertices, faces, _, _ = measure.marching_cubes(np.ascontiguousarray(method(volume), dtype=np.float32), 0.5)
    corners = vertices[faces] / 2 - 0.25
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1)
    outward = corners.mean(1) - centre
    cosines = np.abs((normals * outward).sum(1)) / np.maximum(areas * np.linalg.norm(outward, axis=1), 1e-30)
    return np.average(np.degrees(np.arccos(np.clip(cosines, 0, 1))), weights=areas)


def read_ct(path, size):
    """The middle of a volume, of even size."""
    sitk = import_module("SimpleITK")
    volume = sitk.GetArrayFromImage(sitk.ReadImage(path))
    sizes = [min(size, length // 2 * 2) for length in volume.shape]
    starts = [(length - part) // 2 for length, part in zip(volume.shape, sizes)]
    middle = tuple(slice(start, start + part) for start, part in zip(starts, sizes))
    return volume[middle].astype(np.float64)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=int, default=128, help="voxels along a side of the volume that is timed")
    parser.add_argument("--dtype", default="uint16")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--repetitions", type=int, default=5, help="the best counts")
    parser.add_argument("--ct", help="a volume that SimpleITK reads; its middle, 128 voxels a side, is used")
    parser.add_argument("--processor-time", action="store_true", help="of all threads: for a machine that is not idle")
    options = parser.parse_args()
    clock = time.process_time if options.processor_time else time.perf_counter

    volume = np.random.default_rng(0).integers(0, 1000, (options.size,) * 3).astype(options.dtype)
    ct = read_ct(options.ct, 128) if options.ct else None
    sphere, centre = ball()
    packages = ["nonoscillatory-subdivision", "numpy", "scipy", "scikit-image", "SimpleITK", "torch"]
    packages += ["opencv-python-headless"]
    names = {distribution.metadata["Name"]: distribution.version for distribution in metadata.distributions()}
    print(", ".join(f"{name} {names[name]}" for name in packages if name in names))
    print(
        f"{options.size}³ {options.dtype}, {options.threads} threads{', processor time' if options.processor_time else ''}\n"
    )
    print("| | times as long | seconds | PSNR, dB | normals, ° |\n|---|---:|---:|---:|---:|")
    unit = None
    for methods in (own_methods, scipy_methods, skimage_methods, simpleitk_methods, torch_methods, opencv_methods):
        for name, method in methods(options.threads):
            seconds = best_time(method, volume, options.repetitions, clock)
            unit = unit or seconds
            psnr = f"{psnr_after_averaging(method, ct):.2f}" if ct is not None else ""
            angle = f"{normal_angle(method, sphere, centre):.2f}"
            print(f"| {name} | {seconds / unit:.3g} | {seconds:.4f} | {psnr} | {angle} |", flush=True)


if __name__ == "__main__":
    main()
