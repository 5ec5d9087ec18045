#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Builds the kernel and the array layer with their tests, without ITK and by the portable target, under the address and
# undefined-behaviour sanitizers and under the thread sanitizer, and runs the tests; a finding makes one fail:
#   test_sanitizers.sh [PRESET OF test/array ...]
set -euo pipefail
cd "$(dirname "$0")/../test/array"
if command -v ccache > /dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi
if [[ $# == 0 ]]; then
  set -- asan tsan
fi
for preset in "$@"; do
  cmake --preset "$preset"
  cmake --build --preset "$preset" --parallel "$(nproc)"
  ctest --test-dir "../../build/array-$preset" --output-on-failure
done
