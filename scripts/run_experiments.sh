#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Installs what the experiments need and is missing, and runs them:
#   run_experiments.sh [OPTION OF experiments/run.py ...]
set -euo pipefail
repository=$(cd "$(dirname "$0")/.." && pwd)
"$repository/scripts/install_packages.sh" experiments
exec "$repository/scripts/experiments_python.sh" "$repository/build/experiments" "$repository/experiments/run.py" "$@"
