#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs RiMEA tests and judges them: run.sh DMRP_HOST PLUGINS [--out DIR] [--model FILE ID | --params LINE] TEST...
#
# PLUGINS is the folder of libdmrp_rimea_metrics.so in the build tree, which has the rings of tests 4 and 16 too. TEST is a
# folder here, like 01_corridor, or an experiment file in one, like 04_fundamental_diagram/quick.toml. Runs are written to DIR/TEST, without --out to a temporary folder. --model
# tests the plugin ID of a library in place of the built-in models; --params adds a line to each of these, like
# 'params.reactions = "off"'. Example:
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

if [[ ${1-} == --model ]]; then
  model=$(realpath "$2") id=$3
  shift 3
  change='
    /^plugins = / { sub(/\[/, "[\"" model "\", ") }
    /^\[/ { skip = $0 == "[[pedestrian_model]]"; if (skip && !count++) print $0 "\nuse = \"" id "\"\n" }
    !skip { print }'
  [[ $model != *.py ]] || /usr/bin/python3 -c 'import numpy' 2>/dev/null || { echo "SKIPPED: no python3-numpy" && exit 77; }
elif [[ ${1-} == --params ]]; then
  line=$2
  shift 2
  change='{ print } /^use = "dmrp.pedestrian/ { print line }'
fi

# The experiment FILE with this change, in a folder of its own beside its scenarios' links.
changed() {
  local folder
  mkdir -p "$out"
  folder=$(mktemp -d "$out/XXXXXX")
  ln -s "$(realpath "$(dirname "$1")")"/* "$folder"
  rm "$folder/$(basename "$1")"
  awk -v model="${model-}" -v id="${id-}" -v line="${line-}" "$change" "$1" >"$folder/$(basename "$1")"
  echo "$folder/$(basename "$1")"
}

failed=0
for test in "$@"; do
  experiment=$here/$test
  [[ -e $built/$test ]] && experiment=$built/$test
  [[ -d $experiment ]] && experiment=$experiment/experiment.toml
  bands=$(dirname "$experiment")
  [[ -z ${change-} ]] || experiment=$(changed "$experiment")
  run=$out/${test%.toml}
  mkdir -p "$(dirname "$run")"
  if "$host" "$experiment" --out "$run" --quiet; then
    printf '\n### %s\n\n' "$test"
    "$here/judge.sh" "$run" "$bands" || failed=1
  else
    echo "$test did not run" >&2
    failed=1
  fi
done
exit $failed
