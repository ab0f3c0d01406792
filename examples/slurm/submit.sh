#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs an experiment on a Slurm cluster: an array job with a task for each shard, and a job that joins them.
#
#   submit.sh EXPERIMENT.toml OUT SHARDS [OPTION_OF_SBATCH...]
#
# OUT is a folder that all nodes see; OUT/run is the run directory in the end. Called again, it submits the shards that
# have not finished. DMRP_HOST names the program where dmrp-host is not on the path of the nodes.
set -euo pipefail
if (($# < 3)) || [[ ! $3 =~ ^[1-9][0-9]*$ ]]; then
  echo "usage: submit.sh EXPERIMENT.toml OUT SHARDS [OPTION_OF_SBATCH...]" >&2
  exit 2
fi
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
experiment=$(realpath -e "$1")
out=$(realpath -m "$2")
shards=$3
shift 3

"${DMRP_HOST:-dmrp-host}" validate "$experiment"
mkdir -p "$out/log"
# shards of another number are other trials
[[ -e $out/shards ]] || echo "$shards" >"$out/shards"
if [[ $(<"$out/shards") != "$shards" ]]; then
  echo "submit.sh: $out has $(<"$out/shards") shards, not $shards" >&2
  exit 2
fi

missing=()
for ((shard = 0; shard < shards; ++shard)); do
  [[ -e $out/shard_$shard ]] || missing+=("$shard")
done
after=()
if ((${#missing[@]} > 0)); then
  list=$(IFS=,; echo "${missing[*]}")
  array=$(sbatch --parsable --array="$list" --output="$out/log/shard_%a.txt" "$@" \
    "$here/shard.sh" "$experiment" "$out" "$shards")
  after=(--dependency="afterok:${array%%;*}" --kill-on-invalid-dep=yes)
  echo "shards $list: job ${array%%;*}"
fi
join=$(sbatch --parsable --output="$out/log/merge.txt" "${after[@]}" "$@" "$here/merge.sh" "$out")
echo "join: job ${join%%;*}, to $out/run"
