# SPDX-License-Identifier: Apache-2.0
"""The paper's Table 2: does subdivision take the artefacts of lossy compression away?

A region is compressed with the CDF 9/7 wavelet in 3-D. Each scheme's result on the compressed region is compared
with its own result on the original region, and the compressed region with the original.
"""
from dataclasses import dataclass

import numpy as np
import pywt

import common
from report import Finding, Picture, Result, Table, Text
from volumes import central_region, sample_volumes

WAVELET = "bior4.4"  # PyWavelets' name of the CDF 9/7 pair
FACTORS = (5, 12, 30)
SHOWN_FACTOR = 12  # nearest to the paper's
CENTRE = {"small": 64, "full": 96}  # the edge of the central region
STEEP_SHARE = 0.05  # the voxels with the largest gradients, looked at apart from the rest
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


@dataclass
class Closeness:
    """How close a scheme's results on the original and on the compressed region are."""

    metrics: dict
    steep: float  # root mean square difference in the original's steepest voxels, grey values
    elsewhere: float
    middle: np.ndarray  # the middle slice of the result on the compressed region


def _middle(volume):
    return volume[len(volume) // 2].copy()


def _steepest(volume):
    """Where the gradient is among the STEEP_SHARE largest."""
    slope = sum(difference**2 for difference in np.gradient(volume))
    return slope >= np.quantile(slope, 1.0 - STEEP_SHARE)


def _closeness(reference, result, steep):
    if result.shape != steep.shape:
        steep = steep.repeat(2, 0).repeat(2, 1).repeat(2, 2)
    squares = (result - reference) ** 2
    rms = [float(np.sqrt(squares[where].mean(dtype=np.float64))) for where in (steep, ~steep)]
    return Closeness(common.compare(reference, result), *rms, _middle(result))


def measure(original, spacing):
    """{(factor, label): Closeness}, and the middle slices of the results on the original."""
    compressed = {factor: compress(original, factor) for factor in FACTORS}
    steep = _steepest(original)
    measured = {(factor, COMPRESSED): _closeness(original, compressed[factor], steep) for factor in FACTORS}
    slices = {COMPRESSED: _middle(original)}
    for scheme, label in common.SCHEMES.items():
        reference = common.subdivide(original, spacing, scheme=scheme)
        slices[label] = _middle(reference)
        for factor, volume in compressed.items():
            result = common.subdivide(volume, spacing, scheme=scheme)
            measured[factor, label] = _closeness(reference, result, steep)
    return measured, slices


def variation_against_linear(original, spacing):
    """Total variation of the non-oscillatory result on the compressed by that of the linear one on the original."""
    reference = common.subdivide(original, spacing, scheme="linear")
    result = common.subdivide(compress(original, SHOWN_FACTOR), spacing, scheme="nonoscillatory")
    return common.compare(reference, result)["relative_total_variation"]


def _file_name(what, region_name):
    return f"compression_{what}_{region_name.replace(', ', '_')}.png"


def _table(rows):
    named = {label: dict(zip(PAPER_METRICS, values)) for label, values in PAPER.items()}
    paper = [
        ["the paper: battery scan", PAPER_FACTOR, label, *common.metric_cells(metrics)]
        for label, metrics in named.items()
    ]
    columns = [("region", ""), ("factor", "g"), ("compared", ""), *common.METRIC_COLUMNS]
    caption = "Each scheme's result on the compressed region against its own result on the original region."
    return Table("compression", caption, columns, paper + rows)


def _steep_table(rows):
    places = [f"{label}: {place}" for place in ("steep", "elsewhere") for label in TRIO]
    columns = [("region", ""), ("factor", "g"), *[(place, ".3g") for place in places]]
    caption = (
        f"Root mean square differences, in grey values, at the steepest {100.0 * STEEP_SHARE:g} % of the original's "
        "voxels and elsewhere."
    )
    return Table("compression_steep", caption, columns, rows)


def _steep_rows(name, measured):
    for factor in FACTORS:
        trio = [measured[factor, label] for label in TRIO]
        yield [name, factor, *[entry.steep for entry in trio], *[entry.elsewhere for entry in trio]]


def _steep_text(all_measured):
    """How often the non-oscillatory scheme is the closer one, and why not always."""
    pairs = [[measured[factor, label] for label in TRIO[1:]] for measured in all_measured for factor in FACTORS]
    steep = sum(ours.steep < linear.steep for linear, ours in pairs)
    elsewhere = sum(ours.elsewhere < linear.elsewhere for linear, ours in pairs)
    text = (
        f"The non-oscillatory scheme is closer than the linear one at the steepest voxels in {steep} of {len(pairs)} "
        f"cases, elsewhere in {elsewhere}."
    )
    if steep < len(pairs):
        text += (
            " Beside a sharp edge its thresholds are close to zero; what compression adds to the flat side raises "
            "them, and the edge comes out sharper than on the original."
        )
    return Text(text)


def _draw_slices(name, measured, slices, output_folder):
    """A window of the middle slice: on the original above, on the compressed region below."""
    figure, axes = common.new_figure(columns=len(TRIO), rows=2, width=3.0, height=3.1)
    darkest, brightest = np.quantile(slices[COMPRESSED], (0.005, 0.995))
    for column, label in enumerate(TRIO):
        above, below = slices[label], measured[SHOWN_FACTOR, label].middle
        box = tuple(slice(n // 4, n - n // 4) for n in above.shape)
        options = {"vmin": darkest, "vmax": brightest}
        plain = label == COMPRESSED
        common.show_slice(axes[0][column], above[box], "original" if plain else f"{label}\nof the original", **options)
        title = f"{COMPRESSED}, factor {SHOWN_FACTOR}" if plain else f"{label}\nof the compressed"
        common.show_slice(axes[1][column], below[box], title, **options)
    return common.save_figure(figure, output_folder, _file_name("slices", name))


def _draw_factors(name, measured, output_folder):
    """PSNR against the compression factor."""
    figure, axes = common.new_figure(width=4.6, height=3.2)
    for label in (COMPRESSED, *common.SCHEMES.values()):
        axes[0][0].plot(FACTORS, [measured[factor, label].metrics["psnr_db"] for factor in FACTORS], "o-", label=label)
    axes[0][0].set(xscale="log", xlabel="compression factor", ylabel="PSNR / dB", title=name)
    axes[0][0].set_xticks(FACTORS, [f"{factor:g}" for factor in FACTORS])
    axes[0][0].minorticks_off()
    axes[0][0].legend()
    return common.save_figure(figure, output_folder, _file_name("psnr", name))


def exchanged(compressed, linear, nonoscillatory):
    """The metrics out of the paper's order: non-oscillatory better than linear, linear better than compressed."""
    psnr_in_order = compressed["psnr_db"] < linear["psnr_db"] < nonoscillatory["psnr_db"]
    errors = [key for key in ERRORS if not compressed[key] > linear[key] > nonoscillatory[key]]
    return ([] if psnr_in_order else ["psnr_db"]) + errors


def _joined(values, form=".1f"):
    return ", ".join(f"{value:{form}}" for value in values)


def _order_finding(name, measured):
    trios = {factor: [measured[factor, label].metrics for label in TRIO] for factor in FACTORS}
    gains = [trio[2]["psnr_db"] - trio[0]["psnr_db"] for trio in trios.values()]
    paper_gain = PAPER[TRIO[2]][0] - PAPER[TRIO[0]][0]
    reason = (
        f"The non-oscillatory gain over the compressed volume is {_joined(gains)} dB at the factors "
        f"{_joined(FACTORS, 'g')}; {paper_gain:.1f} dB in the paper at {PAPER_FACTOR:g}."
    )
    exceptions = {factor: exchanged(*trio) for factor, trio in trios.items()}
    if any(exceptions.values()):
        listed = "; ".join(
            f"factor {factor}: {', '.join(common.METRIC_NAMES[key] for key in keys)}"
            for factor, keys in exceptions.items()
            if keys
        )
        reason += f" Out of order: {listed}. The table of steep places below shows where that comes from."
    return Finding(
        f"{name}: in PSNR, L2, median and 99 % quantile the non-oscillatory results lie closest together, then the "
        "linear ones, then the volumes themselves, at every factor.",
        not any(exceptions.values()),
        reason,
    )


def _variation_finding(name, measured, against_linear):
    shares = [100.0 * measured[SHOWN_FACTOR, label].metrics["relative_total_variation"] for label in TRIO]
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


def regions(volume, setting):
    """The central cube and, in the full setting, the whole volume, both by name."""
    yield f"{volume.name}, centre", central_region(volume, CENTRE[setting])
    if setting == "full":
        yield f"{volume.name}, whole", central_region(volume, max(volume.data.shape))


def introduction(setting):
    return Text(
        f"Wavelet: CDF 9/7 (`{WAVELET}`) in 3-D, on the whole of each volume (full setting only) and on its central "
        f"cube of {CENTRE[setting]}³ voxels. The factor is voxels by coefficients kept; a file's factor in bytes also "
        "depends on how the kept coefficients are coded. Each scheme is judged against itself: a method that smooths "
        "more has the easier task, so a high PSNR here says that artefacts are damped, not that detail has come back. "
        f"{common.METRICS_TEXT}"
    )


def run(setting, output_folder, paths=()):
    """Regions of the sample volumes and of those given, at all factors."""
    volumes, notes = sample_volumes(paths)
    rows, steep_rows, findings, pictures, all_measured = [], [], [], [], []
    for name, region in (entry for volume in volumes for entry in regions(volume, setting)):
        original = region.data.astype(np.float32)
        measured, slices = measure(original, region.spacing)
        rows += [
            [name, factor, label, *common.metric_cells(measured[factor, label].metrics)]
            for factor in FACTORS
            for label in (COMPRESSED, *common.SCHEMES.values())
        ]
        steep_rows += _steep_rows(name, measured)
        all_measured.append(measured)
        against_linear = variation_against_linear(original, region.spacing)
        findings += [_order_finding(name, measured), _variation_finding(name, measured, against_linear)]
        pictures += [
            Picture(
                _draw_slices(name, measured, slices, output_folder),
                f"{name}: the middle of a slice, before and after compression.",
            ),
            Picture(
                _draw_factors(name, measured, output_folder),
                f"{name}: how close each scheme's two results lie, against the factor.",
            ),
        ]
    result = Result("Compression (the paper's Table 2)")
    result.add(introduction(setting), *map(Text, notes), _table(rows), *findings)
    if all_measured:
        result.add(_steep_table(steep_rows), _steep_text(all_measured))
    result.add(*pictures)
    return result
