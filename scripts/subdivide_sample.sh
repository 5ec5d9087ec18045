#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds the programs, subdivides a volume and draws a slice of it before and after:
#   subdivide_sample.sh [VOLUME]
# VOLUME: an image file, or a folder with a DICOM series; without it, the CT of a cranium from Debian's package
# invesalius-examples.
set -euo pipefail
volume=${1:+$(realpath "$1")}
cd "$(dirname "$0")/.."
output=$PWD/build/sample
programs=$PWD/build/release/bin

# Unpacks the cranium, 256 x 256 x 108 voxels of 16 bit as plain bytes, and describes it by an NRRD header.
unpack_cranium()
{
  local archive=usr/share/doc/invesalius-examples/examples/Cranium.inv3
  if [[ -e /$archive ]]; then
    tar --extract --gzip --to-stdout --wildcards --file "/$archive" '*/matrix.dat' > "$output/cranium.raw"
  else # systems that leave out /usr/share/doc, such as slim container images
    (cd "$output" && apt-get download --quiet --quiet invesalius-examples)
    dpkg-deb --fsys-tarfile "$output"/invesalius-examples_*.deb |
      tar --extract --to-stdout "./$archive" |
      tar --extract --gzip --to-stdout --wildcards '*/matrix.dat' > "$output/cranium.raw"
  fi
  printf '%s\n' NRRD0004 'type: short' 'dimension: 3' 'space: left-posterior-superior' 'sizes: 256 256 108' \
    'space directions: (0.95703,0,0) (0,0.95703,0) (0,0,1.5)' 'kinds: domain domain domain' \
    'endian: little' 'encoding: raw' 'data file: cranium.raw' > "$output/cranium.nhdr"
}

scripts/install_packages.sh build sample
cmake --preset release -DBUILD_TESTING=OFF
cmake --build --preset release --parallel "$(nproc)" --target SubdivideVolume ExtractSlice

mkdir -p "$output"
if [[ -z $volume ]]; then
  unpack_cranium
  volume=$output/cranium.nhdr
fi
name=$(basename "$volume")
name=${name%%.*}
result=$output/$name-subdivided.mha
picture=$output/$name.png

"$programs/SubdivideVolume" "$volume" "$result"
"$programs/ExtractSlice" "$volume" "$output/$name-slice.mha"
"$programs/ExtractSlice" "$result" "$output/$name-subdivided-slice.mha"
PYTHONPATH=$PWD/experiments /usr/bin/python3 scripts/draw_slices.py \
  "$output/$name-slice.mha" "$output/$name-subdivided-slice.mha" "$picture"
printf 'wrote   %s\npicture %s\n' "$result" "$picture"
