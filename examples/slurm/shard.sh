#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A task of the array that submit.sh submits: runs one shard on a disk of the node, and copies it to OUT in the end.
# A task that is killed, preempted or out of time goes on where it was, on any node.
#SBATCH --job-name=dmrp_shard
#SBATCH --cpus-per-task=4
#SBATCH --mem=4G
#SBATCH --time=08:00:00
#SBATCH --signal=B:USR1@300
#SBATCH --requeue
#SBATCH --open-mode=append
set -uo pipefail
experiment=$1
out=$2
shards=$3
shard=$SLURM_ARRAY_TASK_ID
task=${SLURM_ARRAY_JOB_ID}_$shard
finished=$out/shard_$shard
unfinished=$out/unfinished_$shard
# a disk of the node: results.sqlite must not be on a network file system
on_node=${TMPDIR:-/tmp}/dmrp${out//\//_}_$shard

# copy FROM TO: TO is whole, or as it was
copy() {
  rm -rf "$2.part" && cp -r "$1" "$2.part" && rm -rf "$2" && mv "$2.part" "$2"
}
requeue_while_few() {
  if ((${SLURM_RESTART_COUNT:-0} < 3)); then scontrol requeue "$task"; fi
}

[[ ! -e $finished ]] || exit 0
if [[ ! -e $on_node && -e $unfinished ]]; then copy "$unfinished" "$on_node" || exit 3; fi
rmdir "$on_node" 2>/dev/null # empty: killed before it began
resume=()
[[ ! -e $on_node ]] || resume=(--resume)
echo "shard $shard of $shards on $(hostname), start $((${SLURM_RESTART_COUNT:-0} + 1)) ${resume[*]}"

time_is_up=false
signalled=false
"${DMRP_HOST:-dmrp-host}" "$experiment" --shard "$shard/$shards" --jobs "${SLURM_CPUS_PER_TASK:-1}" --out "$on_node" \
  "${resume[@]}" &
host_process=$!
trap 'time_is_up=true signalled=true; kill -TERM "$host_process"' USR1
trap 'signalled=true; kill -TERM "$host_process"' TERM
while true; do # a signal interrupts wait
  signalled=false
  wait "$host_process"
  status=$?
  $signalled || break
done
echo "shard $shard: dmrp-host ended with status $status"

case $status in
  0 | 1) # trials with faults are results
    copy "$on_node" "$finished" && rm -rf "$on_node" "$unfinished" && exit 0
    exit 3
    ;;
  2) exit 2 ;; # bad input stays bad
  130)         # ended by this script, because Slurm said so
    copy "$on_node" "$unfinished" && rm -rf "$on_node"
    ! $time_is_up || scontrol requeue "$task"
    ;;
  *) # killed, or the machine failed
    copy "$on_node" "$unfinished" && rm -rf "$on_node"
    requeue_while_few
    ;;
esac
exit "$status"
