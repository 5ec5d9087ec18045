#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Makes a virtual environment with packages from PyPI, or brings it up to date:
#   make_environment.sh ENVIRONMENT REQUIREMENTS [OPTION OF venv ...]
# Ends with status 77 and says so where Python's venv or PyPI is missing. Processes that come second wait for the first.
set -euo pipefail
environment=$1
requirements=$2
shift 2

skip()
{
  echo "skipped, for want of: $1"
  exit 77
}

install_requirements()
{
  local log=$environment/pip.log
  if ! "$environment/bin/python" -m pip install --quiet --disable-pip-version-check --requirement "$requirements" \
    > "$log" 2>&1; then
    if grep --quiet -e 'from versions: none' -e 'Connection' -e 'Max retries' "$log"; then
      skip "a connection to PyPI"
    fi
    cat "$log" >&2
    exit 1
  fi
}

if ! /usr/bin/python3 -c 'import ensurepip, venv' 2> /dev/null; then
  skip "python3-venv"
fi
mkdir -p "$environment"
exec {lock}> "$environment/lock"
flock "$lock"
if [[ ! -x $environment/bin/pip ]]; then
  /usr/bin/python3 -m venv "$@" "$environment"
fi
if ! cmp --silent "$requirements" "$environment/installed.txt"; then
  install_requirements
  cp "$requirements" "$environment/installed.txt"
fi
