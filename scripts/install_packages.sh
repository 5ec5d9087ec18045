#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Installs, on Debian 12, the packages that the given purposes need and this machine lacks:
#   install_packages.sh build|sample|test|benchmark|clang|coverage|fuzz|machines|valgrind|wrapping|experiments ...
# What each purpose needs stands here and nowhere else, but for the experiments, which bring their own list.
set -euo pipefail
repository=$(cd "$(dirname "$0")/.." && pwd)

# libgdcm-tools only keeps CMake quiet: Debian's GDCM names these programs among its targets, and CMake complains of each.
declare -A packages=(
  [build]="cmake g++ help2man libcli11-dev libgdcm-dev libgdcm-tools libhwy-dev libinsighttoolkit5-dev libisal-dev
    libjpeg-dev libpugixml-dev libtiff-dev ninja-build nlohmann-json3-dev zlib1g-dev"
  [sample]="invesalius-examples python3-matplotlib python3-numpy"
  [test]="castxml libgtest-dev openmpi-bin python3 python3-dev python3-venv strace"
  [benchmark]="libbenchmark-dev python3"
  [coverage]="gcovr"
  [wrapping]="castxml git libtbb-dev"
  [clang]="clang libclang-rt-14-dev"
  [fuzz]="clang libclang-rt-14-dev libcli11-dev libgtest-dev libisal-dev libjpeg-dev libpugixml-dev zlib1g-dev"
  [machines]="clang g++-aarch64-linux-gnu g++-arm-linux-gnueabihf g++-mingw-w64-x86-64-posix g++-powerpc64le-linux-gnu
    g++-riscv64-linux-gnu g++-s390x-linux-gnu libc++-dev libc++abi-dev qemu-user-static wine wine64"
  [valgrind]="libgtest-dev valgrind"
  [experiments]="$(tr '\n' ' ' < "$repository/experiments/debian-packages.txt")"
)

is_missing()
{
  [[ $(dpkg-query --show --showformat '${db:Status-Status}' "$1" 2> /dev/null) != installed ]]
}

as_root()
{
  if [[ $EUID -eq 0 ]]; then
    "$@"
  elif command -v sudo > /dev/null; then
    sudo "$@"
  else
    echo "install_packages.sh: neither root nor sudo; as root, run: $*" >&2
    return 1
  fi
}

missing=()
for purpose in "$@"; do
  if [[ ! -v packages[$purpose] ]]; then
    echo "install_packages.sh: '$purpose' is none of: ${!packages[*]}" >&2
    exit 2
  fi
  for package in ${packages[$purpose]}; do
    if is_missing "$package"; then
      missing+=("$package")
    fi
  done
done

if [[ ${#missing[@]} -gt 0 ]]; then
  echo "Installing ${missing[*]}"
  as_root apt-get update --quiet --quiet
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install --yes --quiet --quiet --no-install-recommends "${missing[@]}" < /dev/null
fi
