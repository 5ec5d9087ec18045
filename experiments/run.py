#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Run the paper's experiments and write RESULTS.md, its tables (CSV) and its pictures (PNG)."""
import argparse
import importlib
import pathlib
import sys
import time

from common import REPOSITORY, ProgramError
from report import Finding
from volumes import VolumeError

EXPERIMENTS = ("phantom", "subsampling", "compression", "metrology", "surfaces", "smoothness", "noise", "label_maps")
# Their run() also takes the volumes named on the command line.
USING_VOLUMES = ("subsampling", "compression", "surfaces", "noise")
ASSETS = "results"

INTRODUCTION = """# The paper's experiments, measured with this module

Written by `experiments/run.py{flag}`: every number and every order stated below is computed by it, nothing is entered
by hand but the paper's own numbers, which are named as such.
The paper: M. Stock, S. López-Ureña, "Towards smoother surfaces by applying subdivision to voxel data".
Other volumes stand in for its scans: orders can be compared, digits cannot.
"""


def _arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("volumes", nargs="*", help="more volumes (MHA, MHD, NRRD) for the CT experiments")
    parser.add_argument("--full", action="store_true", help="whole volumes and all scans (about half an hour)")
    parser.add_argument("--only", nargs="+", choices=EXPERIMENTS, default=EXPERIMENTS, help="run just these")
    parser.add_argument(
        "--output",
        type=pathlib.Path,
        default=REPOSITORY / "build-experiments",
        help="folder of RESULTS.md and results/ (default: %(default)s)",
    )
    return parser.parse_args()


def summary(results):
    """A table of how many findings agree, and the ones that do not."""
    lines = ["## In short", "", "| experiment | agree | do not agree |", "|---|---:|---:|"]
    for result in results:
        holds = [finding.holds for finding in result.of_type(Finding)]
        lines.append(f"| {result.title} | {sum(holds)} | {len(holds) - sum(holds)} |")
    differing = [finding for result in results for finding in result.of_type(Finding) if not finding.holds]
    lines += ["", "Not as expected:" if differing else "Everything is as expected.", ""]
    return "\n".join(lines + [f"- {finding.claim}" for finding in differing]) + "\n"


def page(results, setting):
    """The whole of RESULTS.md."""
    introduction = INTRODUCTION.format(flag=" --full" if setting == "full" else "")
    return "\n".join([introduction, summary(results), *[result.markdown(ASSETS) for result in results]])


def run_experiments(names, setting, output, volumes=()):
    """Run the named experiments and write OUTPUT/RESULTS.md and OUTPUT/results/. Returns the results."""
    assets = output / ASSETS
    assets.mkdir(parents=True, exist_ok=True)
    results = []
    for name in names:
        start = time.monotonic()
        extra = (volumes,) if name in USING_VOLUMES else ()
        results.append(importlib.import_module(name).run(setting, assets, *extra))
        results[-1].write_tables(assets)
        print(f"{name}: {time.monotonic() - start:.0f} s", flush=True)
    (output / "RESULTS.md").write_text(page(results, setting), encoding="utf-8")
    return results


def main():
    arguments = _arguments()
    names = [name for name in EXPERIMENTS if name in arguments.only]
    try:
        run_experiments(names, "full" if arguments.full else "small", arguments.output, arguments.volumes)
    except (ProgramError, VolumeError, OSError) as error:
        sys.exit(f"run.py: {error}")
    print(f"Wrote {arguments.output / 'RESULTS.md'}")


if __name__ == "__main__":
    main()
