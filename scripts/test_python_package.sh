#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Builds the Python package as a wheel, installs it into a virtual environment and runs its tests there:
#   test_python_package.sh FOLDER [OPTION of pytest ...]
# FOLDER keeps the environment and the build for the next run. The packages come from PyPI; without it, ends with
# status 77 and says so.
set -euo pipefail
repository=$(cd "$(dirname "$0")/.." && pwd)
folder=$(mkdir -p "$1" && cd "$1" && pwd)
shift
environment=$folder/environment
python=$environment/bin/python

# What pyproject.toml asks for to build and to test, but the package itself.
list_requirements()
{
  /usr/bin/python3 - "$repository/pyproject.toml" << 'END'
import sys, tomllib
with open(sys.argv[1], "rb") as file:
    settings = tomllib.load(file)
project = settings["project"]
extras = project["optional-dependencies"]
names = settings["build-system"]["requires"] + project["dependencies"] + extras["zarr"] + extras["test"]
print("\n".join(name for name in names if not name.startswith(project["name"])))
END
}

if ! /usr/bin/python3 -c 'import tomllib' 2> /dev/null; then
  echo "skipped, for want of: Python 3.11 or later"
  exit 77
fi
list_requirements > "$folder/requirements.txt"
"$repository/scripts/make_environment.sh" "$environment" "$folder/requirements.txt"

export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
if command -v ccache > /dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi
rm -rf "$folder/wheel"
"$python" -m pip wheel --quiet --disable-pip-version-check --no-deps --no-build-isolation \
  --config-settings=build-dir="$folder/build" --wheel-dir "$folder/wheel" "$repository"
"$python" -m pip install --quiet --disable-pip-version-check --no-deps --force-reinstall "$folder"/wheel/*.whl

# Away from the sources, so that it is the installed package that is tested.
cd "$folder"
exec "$python" -m pytest --quiet --config-file "$repository/pyproject.toml" --rootdir "$repository" \
  -p no:cacheprovider "$@" "$repository/python/tests"
