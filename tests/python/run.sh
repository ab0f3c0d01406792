#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# run.sh SOURCE_TREE [MARK]: the tests of the Python package, or those with this mark; with nightly, its types, too.
# Status 77, which CTest reports as skipped, without its packages.
set -euo pipefail
source_tree=$1 mark=${2:-not nightly}
python=/usr/bin/python3
missing=$("$python" -c 'import importlib.util as u; print(*(m for m in ("numpy", "pandas", "pytest") if not u.find_spec(m)))')
[[ -z $missing ]] || { echo "SKIPPED: not installed: $missing" && exit 77; }
cd "$source_tree"
export PYTHONPATH=$source_tree/sdk/python PYTHONDONTWRITEBYTECODE=1
if [[ $mark == nightly ]]; then
  if command -v mypy >/dev/null; then
    (cd sdk/python && /usr/bin/mypy --strict --ignore-missing-imports --cache-dir=/dev/null dmrp)
  else
    echo "SKIPPED: mypy is not installed, types are not checked"
  fi
fi
"$python" -m pytest -q -p no:cacheprovider -o markers="nightly: they run for long" -m "$mark" tests/python
