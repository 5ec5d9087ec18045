#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Builds tests under the address and undefined-behaviour sanitizers and under the thread sanitizer, and runs them; a
# finding makes it fail.
#   test_sanitizers.sh                          the kernel and the array layer, without ITK and by the portable target
#   test_sanitizers.sh PRESET OF test/array ... the same by these presets; asan-vectors has all targets
#   test_sanitizers.sh whole [asan|tsan]        the whole suite, the programs' tests in Python too, with all targets and
#                                               clang: hours, fewer with a small SUBDIVISION_CASES
set -euo pipefail
cd "$(dirname "$0")/.."
if command -v ccache > /dev/null; then
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi

test_array()
{
  (cd test/array && cmake --preset "$1" && cmake --build --preset "$1" --parallel "$(nproc)")
  ctest --test-dir "build/array-$1" --output-on-failure
}

# The programs work in a child process and keep what libraries print to themselves, so that findings go to files.
test_whole()
{
  scripts/install_packages.sh build test clang
  local findings="build/$1/findings"
  cmake --preset "$1"
  cmake --build --preset "$1" --parallel "$(nproc)"
  rm -rf "$findings"
  mkdir "$findings"
  local code=0
  ctest --preset "$1" --parallel "$(nproc)" || code=$?
  if [[ -n $(ls "$findings") ]]; then
    tail -n +1 "$findings"/*
    return 1
  fi
  return "$code"
}

whole=false
if [[ ${1:-} == whole ]]; then
  whole=true
  shift
fi
if [[ $# == 0 ]]; then
  set -- asan tsan
fi
for preset in "$@"; do
  if "$whole"; then
    test_whole "$preset"
  else
    test_array "$preset"
  fi
done
