#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The files that the tutorials show are good: experiments are validated, scenarios drawn with a plan.
# Called as: tutorials.sh SOURCE_DIR DMRP_HOST
set -euo pipefail
source_dir=$(realpath "$1") host=$(realpath "$2")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# a block that begins with ```toml FILE is that file
awk '/^```toml [^ ]+$/ { file = $2; folder = file; if (sub(/\/[^\/]*$/, "", folder)) system("mkdir -p " folder); next }
  /^```/ { file = "" }
  file != "" { print > file }' "$source_dir"/docs/tutorials/*.md

count=0
for experiment in *.toml; do
  "$host" validate "$experiment" || { echo "FAILED: $experiment" && exit 1; }
  count=$((count + 1))
done
for scenario in */scenario.toml; do
  "$host" draw "$scenario" --planner dmrp.planner.cbs --svg drawn.svg || { echo "FAILED: $scenario" && exit 1; }
  count=$((count + 1))
done
((count == 4)) || { echo "FAILED: $count files, there should be 4" && exit 1; }
