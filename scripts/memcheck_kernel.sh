#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Runs the kernel and the array layer under Valgrind's memcheck, at odd sizes of tiles and in arrays with elements left
# free, with every target that Valgrind knows (AVX2, not AVX-512). Some minutes. A reading or writing beyond memory, or a
# value that was never set and decides something, makes it fail.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh build valgrind
(cd test/array && cmake --preset release && cmake --build --preset release --target ArrayGTestDriver)
tests='SubdivisionKernel/*.IsTheReferenceAlongAnyAxes:SubdivisionKernel/*.RoundsChildren'
tests+=':SubdivisionKernel/*.WidensElements:SubdivisionKernel/*.WorksAfterAnException'
tests+=':SubdivisionKernelConversion/*:Subdivider.WritesNothingBesideItsElements:Subdivider.BoxesAreTheBytesOfTheWhole'
valgrind --quiet --error-exitcode=1 --leak-check=full \
  build/array-release/ArrayGTestDriver --gtest_filter="${1:-$tests}"
