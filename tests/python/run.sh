#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# run.sh SOURCE_TREE [MARK]: the tests of the Python package, or those with this mark. Status 77, which CTest reports as skipped, without its packages.
set -euo pipefail
source_tree=$1 mark=${2:-not nightly}
python=/usr/bin/python3
for module in numpy pandas pytest; do
  "$python" -c "import $module" 2>/dev/null || {
    echo "SKIPPED: python3-$module is not installed"
    exit 77
  }
done
cd "$source_tree"
export PYTHONPATH=$source_tree/sdk/python PYTHONDONTWRITEBYTECODE=1
if ! command -v mypy >/dev/null; then
  echo "SKIPPED: mypy is not installed, types are not checked"
elif [[ $mark != nightly ]]; then
  (cd sdk/python && /usr/bin/mypy --strict --ignore-missing-imports --cache-dir=/dev/null dmrp)
fi
"$python" -m pytest -q -p no:cacheprovider -o markers="nightly: they run for long" -m "$mark" tests/python
