#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The job that submit.sh submits after the array: joins the shards on a disk of the node, and copies the run to OUT/run.
#SBATCH --job-name=dmrp_merge
#SBATCH --open-mode=append
set -euo pipefail
out=$1
[[ ! -e $out/run ]] || exit 0
on_node=$(mktemp -d "${TMPDIR:-/tmp}/dmrp_merge.XXXXXX")
trap 'rm -rf "$on_node"' EXIT
"${DMRP_HOST:-dmrp-host}" merge "$on_node/run" "$out"/shard_*
rm -rf "$out/run.part"
cp -r "$on_node/run" "$out/run.part"
mv "$out/run.part" "$out/run"
