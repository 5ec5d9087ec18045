#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds the library, the programs and the tests so that they count lines, runs the tests, and
# prints the share of the lines that they reach, in C++ and in Python; fails where one of the two is below LEAST percent:
#   measure_coverage.sh [LEAST]
set -euo pipefail
cd "$(dirname "$0")/.."
least=${1:-75}
build=$PWD/build/coverage

scripts/install_packages.sh build test coverage
if command -v ccache > /dev/null; then
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi
cmake --preset coverage
cmake --build --preset coverage --parallel "$(nproc)"
find "$build" -name '*.gcda' -delete
# The tests of the Python package count by themselves, below; an installed copy of the library has no counters here.
ctest --preset coverage --parallel "$(nproc)" --exclude-regex 'python_package|Package\.|experiments'
gcovr --root . --object-directory "$build" --filter 'src/' --filter 'include/' --filter 'apps/' \
  --exclude-throw-branches --exclude-unreachable-branches --fail-under-line "$least" --sort-uncovered

scripts/test_python_package.sh "$build/python" --cov=nonoscillatory_subdivision --cov-report=term \
  --cov-fail-under="$least"
