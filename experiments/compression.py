# SPDX-License-Identifier: Apache-2.0
"""The paper's Table 2: does subdivision take the artefacts of lossy compression away?

A region is compressed with the CDF 9/7 wavelet in 3-D. Each scheme's result on the compressed region is compared
with its own result on the original region, and the compressed region with the original.
"""
import numpy as np
import pywt

import common
from report import Finding, Picture, Result, Table, Text
from volumes import central_region, sample_volumes

WAVELET = "bior4.4"  # PyWavelets' name of the CDF 9/7 pair
FACTORS = (5, 12, 30)
SHOWN_FACTOR = 12  # nearest to the paper's
REGION = {"small": 64, "full": 192}
COMPRESSED = "compressed"
TRIO = (COMPRESSED, common.SCHEMES["linear"], common.SCHEMES["nonoscillatory"])

PAPER_FACTOR = 12.2
ERRORS = ("relative_l2_error", "median_relative_error", "q99_relative_error")
PAPER_METRICS = ("psnr_db", *ERRORS, "relative_total_variation")
PAPER = {
    TRIO[0]: (43.1, 0.235, 0.0133, 0.0551, 0.921),
    TRIO[1]: (44.3, 0.204, 0.0115, 0.0475, 0.917),
    TRIO[2]: (48.5, 0.129, 0.0074, 0.0295, 0.823),
}


def compress(volume, factor):
    """The volume from its 1/factor largest wavelet coefficients (the rest set to zero), float.

    The transform is close to orthonormal, so the magnitudes of all levels are compared as they are; the mean is
    taken out first. As many coefficients as voxels: the region is continued periodically.
    """
    data = volume.astype(np.float64)
    mean = data.mean()
    coefficients, layout = pywt.coeffs_to_array(pywt.wavedecn(data - mean, WAVELET, mode="periodization"))
    kept = max(1, round(data.size / factor))
    threshold = np.partition(np.abs(coefficients).ravel(), -kept)[-kept]
    coefficients[np.abs(coefficients) < threshold] = 0.0
    layers = pywt.array_to_coeffs(coefficients, layout, output_format="wavedecn")
    restored = pywt.waverecn(layers, WAVELET, mode="periodization")
    return (restored[tuple(slice(n) for n in data.shape)] + mean).astype(np.float32)


def measure(original, spacing):
    """{(factor, label): (metrics, middle slice)}, and the middle slices of the results on the original."""
    compressed = {factor: compress(original, factor) for factor in FACTORS}
    measured = {}
    slices = {COMPRESSED: original[len(original) // 2].copy()}
    for factor, volume in compressed.items():
        measured[factor, COMPRESSED] = (common.compare(original, volume), volume[len(volume) // 2].copy())
    for scheme, label in common.SCHEMES.items():
        reference = common.subdivide(original, spacing, scheme=scheme)
        slices[label] = reference[len(reference) // 2].copy()
        for factor, volume in compressed.items():
            result = common.subdivide(volume, spacing, scheme=scheme)
            measured[factor, label] = (common.compare(reference, result), result[len(result) // 2].copy())
    return measured, slices


def variation_against_linear(original, spacing):
    """Total variation of the non-oscillatory result on the compressed by that of the linear one on the original."""
    reference = common.subdivide(original, spacing, scheme="linear")
    result = common.subdivide(compress(original, SHOWN_FACTOR), spacing, scheme="nonoscillatory")
    return common.compare(reference, result)["relative_total_variation"]


def _table(rows):
    named = {label: dict(zip(PAPER_METRICS, values)) for label, values in PAPER.items()}
    paper = [
        ["the paper: battery scan", PAPER_FACTOR, label, *common.metric_cells(metrics)]
        for label, metrics in named.items()
    ]
    columns = [("volume", ""), ("factor", "g"), ("compared", ""), *common.METRIC_COLUMNS]
    caption = "Each scheme's result on the compressed region against its own result on the original region."
    return Table("compression", caption, columns, paper + rows)


def _draw_slices(name, measured, slices, output_folder):
    """A window of the middle slice: on the original above, on the compressed region below."""
    figure, axes = common.new_figure(columns=len(TRIO), rows=2, width=3.0, height=3.1)
    darkest, brightest = np.quantile(slices[COMPRESSED], (0.005, 0.995))
    for column, label in enumerate(TRIO):
        above, below = slices[label], measured[SHOWN_FACTOR, label][1]
        box = tuple(slice(n // 4, n - n // 4) for n in above.shape)
        options = {"vmin": darkest, "vmax": brightest}
        plain = label == COMPRESSED
        common.show_slice(axes[0][column], above[box], "original" if plain else f"{label}\nof the original", **options)
        title = f"{COMPRESSED}, factor {SHOWN_FACTOR}" if plain else f"{label}\nof the compressed"
        common.show_slice(axes[1][column], below[box], title, **options)
    return common.save_figure(figure, output_folder, f"compression_slices_{name}.png")


def _draw_factors(name, measured, output_folder):
    """PSNR against the compression factor."""
    figure, axes = common.new_figure(width=4.6, height=3.2)
    for label in (COMPRESSED, *common.SCHEMES.values()):
        axes[0][0].plot(FACTORS, [measured[factor, label][0]["psnr_db"] for factor in FACTORS], "o-", label=label)
    axes[0][0].set(xscale="log", xlabel="compression factor", ylabel="PSNR / dB", title=name)
    axes[0][0].set_xticks(FACTORS, [f"{factor:g}" for factor in FACTORS])
    axes[0][0].minorticks_off()
    axes[0][0].legend()
    return common.save_figure(figure, output_folder, f"compression_psnr_{name}.png")


def is_paper_order(compressed, linear, nonoscillatory):
    """Non-oscillatory better than linear better than the compressed volume in PSNR, L2, median and 99 % quantile."""
    return compressed["psnr_db"] < linear["psnr_db"] < nonoscillatory["psnr_db"] and all(
        compressed[key] > linear[key] > nonoscillatory[key] for key in ERRORS
    )


def _joined(values, form=".1f"):
    return ", ".join(f"{value:{form}}" for value in values)


def _order_finding(name, measured):
    trios = [[measured[factor, label][0] for label in TRIO] for factor in FACTORS]
    gains = [trio[2]["psnr_db"] - trio[0]["psnr_db"] for trio in trios]
    paper_gain = PAPER[TRIO[2]][0] - PAPER[TRIO[0]][0]
    return Finding(
        f"{name}: in PSNR, L2, median and 99 % quantile the non-oscillatory results lie closest together, then the "
        "linear ones, then the volumes themselves, at every factor.",
        all(is_paper_order(*trio) for trio in trios),
        f"The non-oscillatory gain over the compressed volume is {_joined(gains)} dB at the factors "
        f"{_joined(FACTORS, 'g')}; {paper_gain:.1f} dB in the paper at {PAPER_FACTOR:g}. An artefact at an edge or in "
        "noise is a jump to the scheme, which answers with its smoothing B-spline part.",
    )


def _variation_finding(name, measured, against_linear):
    shares = [100.0 * measured[SHOWN_FACTOR, label][0]["relative_total_variation"] for label in TRIO]
    paper = [100.0 * PAPER[label][-1] for label in TRIO]
    return Finding(
        f"{name}: the relative total variation falls from compressed over linear to non-oscillatory "
        f"(factor {SHOWN_FACTOR}).",
        shares[0] > shares[1] > shares[2],
        f"Here {_joined(shares)} %, in the paper {_joined(paper)} %. Each is a share of the same scheme's result on "
        "the original, where the non-oscillatory scheme has already removed fine detail that compression would remove. "
        "As a share of the linear result on the original, the non-oscillatory one has "
        f"{100.0 * against_linear:.1f} %.",
    )


def run(setting, output_folder, paths=()):
    """Central regions of the sample volumes and of those given, at all factors."""
    volumes, notes = sample_volumes(paths)
    result = Result("Compression (the paper's Table 2)")
    result.add(
        Text(
            f"Wavelet: CDF 9/7 (`{WAVELET}`) in 3-D. The factor is voxels by coefficients kept; a file's factor in "
            "bytes also depends on how the kept coefficients are coded. The schemes "
            "smooth what compression adds, and each one is judged against itself: a method that smooths more has the "
            "easier task, so a high PSNR here says that artefacts are damped, not that detail has come back. "
            f"{common.METRICS_TEXT}"
        ),
        *map(Text, notes),
    )
    rows, findings, pictures = [], [], []
    for volume in volumes:
        volume = central_region(volume, REGION[setting])
        original = volume.data.astype(np.float32)
        measured, slices = measure(original, volume.spacing)
        against_linear = variation_against_linear(original, volume.spacing)
        labels = (COMPRESSED, *common.SCHEMES.values())
        rows += [
            [volume.name, factor, label, *common.metric_cells(measured[factor, label][0])]
            for factor in FACTORS
            for label in labels
        ]
        findings += [_order_finding(volume.name, measured), _variation_finding(volume.name, measured, against_linear)]
        pictures += [
            Picture(
                _draw_slices(volume.name, measured, slices, output_folder),
                f"{volume.name}: the middle of a slice, before and after compression.",
            ),
            Picture(
                _draw_factors(volume.name, measured, output_folder),
                f"{volume.name}: how close each scheme's two results lie, against the factor.",
            ),
        ]
    result.add(_table(rows), *findings, *pictures)
    return result
