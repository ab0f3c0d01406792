#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# run.sh SOURCE_TREE: the tests of the Python package. Status 77, which CTest reports as skipped, without its packages.
set -euo pipefail
source_tree=$1
python=/usr/bin/python3
for module in numpy pandas pytest; do
  "$python" -c "import $module" 2>/dev/null || {
    echo "SKIPPED: python3-$module is not installed"
    exit 77
  }
done
cd "$source_tree"
export PYTHONPATH=$source_tree/sdk/python PYTHONDONTWRITEBYTECODE=1
if command -v mypy >/dev/null; then
  (cd sdk/python && /usr/bin/mypy --strict --ignore-missing-imports --cache-dir=/dev/null dmrp)
else
  echo "SKIPPED: mypy is not installed, types are not checked"
fi
"$python" -m pytest -q -p no:cacheprovider tests/python
