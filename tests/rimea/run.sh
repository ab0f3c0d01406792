#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs RiMEA tests and judges them: run.sh DMRP_HOST PLUGINS [--out DIR] TEST...
#
# PLUGINS is the folder of libdmrp_rimea_metrics.so in the build tree, which has the rings of tests 4 and 16 too. TEST is a folder here, like 01_corridor, or an experiment file in
# one, like 04_fundamental_diagram/quick.toml. Runs are written to DIR/TEST, without --out to a temporary folder. Example:
#
#     tests/rimea/run.sh build/release/bin/dmrp-host build/release/tests/plugins --out runs/rimea 01_corridor
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
host=$1
built=$2/../rimea
export DMRP_PLUGIN_PATH=$2${DMRP_PLUGIN_PATH:+:$DMRP_PLUGIN_PATH}
shift 2
if [[ ${1-} == --out ]]; then
  out=$2
  shift 2
else
  out=$(mktemp -d)
  trap 'rm -rf "$out"' EXIT
fi

failed=0
for test in "$@"; do
  experiment=$here/$test
  [[ -e $built/$test ]] && experiment=$built/$test
  [[ -d $experiment ]] && experiment=$experiment/experiment.toml
  run=$out/${test%.toml}
  mkdir -p "$(dirname "$run")"
  if "$host" "$experiment" --out "$run" --quiet; then
    printf '\n### %s\n\n' "$test"
    "$here/judge.sh" "$run" "$(dirname "$experiment")" || failed=1
  else
    echo "$test did not run" >&2
    failed=1
  fi
done
exit $failed
