#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Fuzzes the kernel and array layers, and the programs' readers of headers, files and short texts, under the address and
# undefined-behaviour sanitizers, with clang's libFuzzer:
#   fuzz.sh [RUNS [FUZZER ...]]    RUNS executions (a million) of SubdividerFuzz, HeaderFuzz, FileFuzz and TextFuzz
# What is found stands in build/fuzz/found-FUZZER. What is worth keeping of a corpus goes to test/fuzz/corpus:
#   build/fuzz/HeaderFuzz -merge=1 test/fuzz/corpus/header build/fuzz/corpus-HeaderFuzz
set -euo pipefail
cd "$(dirname "$0")/.."

runs=${1:-1000000}
fuzzers=("${@:2}")
if [[ ${#fuzzers[@]} -eq 0 ]]; then
  fuzzers=(SubdividerFuzz HeaderFuzz FileFuzz TextFuzz)
fi
declare -A folders=([SubdividerFuzz]=subdivider [HeaderFuzz]=header [FileFuzz]=file [TextFuzz]=text)

scripts/install_packages.sh build fuzz
if command -v ccache > /dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi
# The vector targets, which take clang minutes under sanitizers, run under them in test/array.
CC=clang CXX=clang++ cmake -S test/fuzz -B build/fuzz -G Ninja -DNonOscillatorySubdivision_USE_HIGHWAY=OFF
cmake --build build/fuzz --parallel "$(nproc)" --target "${fuzzers[@]}" "${fuzzers[@]/%/Replay}"
# Short runs allocate much: a report tells where memory was allocated when the file is run again by itself.
export ASAN_OPTIONS=malloc_context_size=0:quarantine_size_mb=1:thread_local_quarantine_size_kb=64
# Each processor runs a part; what one process finds, the others take up.
processes=$(nproc)
for fuzzer in "${fuzzers[@]}"; do
  kept=$PWD/test/fuzz/corpus/${folders[$fuzzer]}
  mkdir -p "build/fuzz/corpus-$fuzzer" "build/fuzz/found-$fuzzer"
  options=(-max_len=2048 -dict="$PWD/test/fuzz/headers.dict")
  if [[ $fuzzer == SubdividerFuzz ]]; then
    # Some forty choices, and the values of the elements, which are repeated. How often a loop runs is one of the choices.
    options=(-max_len=128 -use_counters=0)
  fi
  # Files of a run lie in memory.
  (cd "build/fuzz/found-$fuzzer" && TMPDIR=/dev/shm "../$fuzzer" -jobs="$processes" -workers="$processes" \
    -runs=$(((runs + processes - 1) / processes)) -timeout=60 -reload=60 -entropic=0 -print_final_stats=1 "${options[@]}" \
    "../corpus-$fuzzer" "$kept")
  # libFuzzer soon gives up looking for leaks; at the end of a replay, all are found.
  "build/fuzz/${fuzzer}Replay" "build/fuzz/corpus-$fuzzer"
done
