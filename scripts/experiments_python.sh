#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Runs a script with all that the experiments need: the system's Python with Debian's packages, and beside them those of
# experiments/requirements.txt from PyPI in a virtual environment, which FOLDER keeps for the next run:
#   experiments_python.sh FOLDER SCRIPT [ARGUMENT ...]
# Ends with status 77 and says so where PyPI is missing.
set -euo pipefail
repository=$(cd "$(dirname "$0")/.." && pwd)
environment=$1/environment
shift
"$repository/scripts/make_environment.sh" "$environment" "$repository/experiments/requirements.txt" \
  --system-site-packages
exec "$environment/bin/python" "$@"
