#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Builds the kernel and the array layer for other machines, compilers and libraries, without ITK, runs their tests under
# QEMU, Wine or here, and compares the bytes of their outputs with those of x86:
#   test_other_machines.sh [arm64 sve armhf ppc64el riscv64 s390x windows clang libcxx ...]
# Without arguments, all of these. arm64 has no SVE; sve is arm64 with it, at vectors of several widths. On Debian 12.
# Where QEMU or Wine runs them, the generated tests have 10 cases each and four long tests are left out. Vectors of SVE
# of other than 256 and 2048 bits run the bytes, the conversions, the random runs and the extremes alone.
# SUBDIVISION_CASES=300 GTEST_FILTER='*' runs all that the others run, in many times the time.
set -euo pipefail
cd "$(dirname "$0")/.."
repository=$PWD

if [[ $# -eq 0 ]]; then
  set -- arm64 sve armhf ppc64el riscv64 s390x windows clang libcxx
fi
scripts/install_packages.sh build test machines
if command -v ccache > /dev/null; then
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi

# Unpacks Debian's Highway for another machine beside the builds; the system's packages stay as they are.
unpack_highway()
{
  local architecture=$1 folder=$repository/build/sysroot-$1
  if [[ ! -d $folder/usr ]]; then
    mkdir -p "$folder/lists/partial"
    echo "deb [arch=$architecture signed-by=/usr/share/keyrings/debian-archive-keyring.gpg]" \
      "http://deb.debian.org/debian bookworm main" > "$folder/sources.list"
    local options=(-o "Dir::State::Lists=$folder/lists" -o "Dir::Etc::SourceList=$folder/sources.list"
      -o Dir::Etc::SourceParts=/dev/null -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache=
      -o "APT::Architectures::=$(dpkg --print-architecture)" -o "APT::Architectures::=$architecture")
    apt-get "${options[@]}" --quiet --quiet update
    (cd "$folder" && apt-get "${options[@]}" --quiet --quiet download "libhwy-dev:$architecture" "libhwy1:$architecture")
    for package in "$folder"/*.deb; do
      dpkg-deb --extract "$package" "$folder"
    done
  fi
  export SUBDIVISION_SYSROOT=$folder
}

build()
{
  (cd test/array && cmake --preset "$1" && cmake --build --preset "$1" --parallel "$(nproc)")
}

# The tests of a build, then the line of each target's bytes.
run_tests()
{
  ctest --test-dir "build/array-$1" --output-on-failure --parallel "$(nproc)" --timeout 3600
  grep --text ' runs with the bytes of ' "build/array-$1/Testing/Temporary/LastTest.log"
}

run_emulated_tests()
{
  local long_tests=LabelSubdivider.NoTarget*:LabelSubdivider.Parts*:Subdivider.OneWorkspace*:Subdivider.LargeOutputs*
  SUBDIVISION_CASES=${SUBDIVISION_CASES:-10} GTEST_FILTER=${GTEST_FILTER:-${2:-*}-$long_tests} run_tests "$1"
}

run_sve_tests()
{
  local bits=$1 tests='*'
  if [[ $bits != 256 && $bits != 2048 ]]; then
    tests='SubdivisionKernelConversion*:SubdividerRandom*:SubdividerExtremes*'
  fi
  QEMU_CPU="max,sve$bits=on,sve-default-vector-length=$((bits / 8))" run_emulated_tests arm64 "$tests"
}

test_machine()
{
  local machine=$1
  case $machine in
    arm64)
      unpack_highway arm64
      build arm64
      QEMU_CPU=cortex-a72 run_emulated_tests arm64
      ;;
    sve)
      unpack_highway arm64
      build arm64
      for bits in 128 256 384 512 1024 2048; do
        echo "== SVE with vectors of $bits bits"
        run_sve_tests "$bits"
      done
      ;;
    clang | libcxx)
      build "$machine"
      run_tests "$machine"
      ;;
    *)
      build "$machine"
      run_emulated_tests "$machine"
      ;;
  esac
}

failed=()
for machine in "$@"; do
  echo "== $machine"
  # Within a condition, errors would not end the function.
  set +e
  (
    set -e
    test_machine "$machine"
  )
  status=$?
  set -e
  if [[ $status -ne 0 ]]; then
    failed+=("$machine")
  fi
done
if [[ ${#failed[@]} -gt 0 ]]; then
  echo "test_other_machines.sh: failed: ${failed[*]}" >&2
  exit 1
fi
