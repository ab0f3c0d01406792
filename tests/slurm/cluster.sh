#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The array job of examples/slurm on a real Slurm of four nodes: tasks that are killed, requeued and submitted again end
# with the values and trace digests of a local run. Called as: cluster.sh DMRP_HOST TRACE_DIGEST. Exit status 77:
# skipped; it needs root and Debian's slurmctld, slurmd, slurm-client and munge. All of it runs in name spaces of its
# own, for processes and network, and ends with them.
for program in slurmctld slurmd sbatch munged unshare ip; do
  command -v "$program" >/dev/null || { echo "skipped: $program is not installed" && exit 77; }
done
if [[ ${1:-} != --inside ]]; then
  own=(unshare --pid --fork --kill-child --mount-proc --net --ipc)
  "${own[@]}" true 2>/dev/null || { echo "skipped: this user cannot make name spaces" && exit 77; }
  exec "${own[@]}" "${BASH_SOURCE[0]}" --inside "$@"
fi
shift
source "$(dirname "${BASH_SOURCE[0]}")/../end_to_end/checks.sh"
source "$(dirname "${BASH_SOURCE[0]}")/start_slurm.sh"
trace_digest=$2
slurm=$here/../../examples/slurm
experiment=$scratch/crossing.toml
sed 's/^trials .*/trials = 50/' "$here/crossing.toml" >"$experiment"
out=$scratch/out
export DMRP_HOST=$host TMPDIR=$scratch/node_disk
mkdir "$TMPDIR"

expect_status 0 "$host" "$experiment" --quiet --jobs 2 --out "$scratch/whole"
start_slurm

# until COMMAND...: waits for it to succeed
until_true() {
  local i
  for ((i = 0; i < 6000; ++i)); do
    "$@" && return
    sleep 0.05
  done
  squeue
  tail -n 20 "$out"/log/* "$scratch"/slurm/log/*
  fail "did not come true: $*"
}
# the process that runs a shard, once it has finished a trial
host_of_shard() {
  compgen -G "$TMPDIR/*_$1/traces/*.mcap" >/dev/null && found=$(pgrep -f -- "--shard $1/4")
}
submit() { expect_status 0 "$slurm/submit.sh" "$experiment" "$out" 4 --cpus-per-task=1; }
is_idle() { [[ -z $(squeue --noheader) ]]; }
job_of_shard() { squeue --noheader --array --format='%F_%K' | grep "_$1\$"; }

submit
until_true host_of_shard 1
kill -KILL "$found" # only the program: the task asks for another start itself
until_true host_of_shard 2
scontrol requeue "$(job_of_shard 2)" || fail "Slurm does not requeue a running task"
until_true host_of_shard 3
task=$(ps -o ppid= -p "$found")
kill -KILL "$task" "$found" # the task too, as when a node goes down
until_true is_idle

[[ -d $out/shard_0 && -d $out/shard_1 && -d $out/shard_2 ]] || fail "shards are missing: $(ls "$out")"
[[ ! -e $out/shard_3 ]] || fail "shard 3 was killed and has not been submitted again"
[[ ! -e $out/run ]] || fail "three shards of four are no run"
for shard in 1 2; do
  grep -q "^shard $shard of 4 on .*, start 2 --resume" "$out/log/shard_$shard.txt" ||
    fail "shard $shard should have gone on: $(cat "$out/log/shard_$shard.txt")"
done

submit
grep -q "^shards 3: job" "$scratch/stdout" || fail "shard 3 alone is missing: $(cat "$scratch/stdout")"
until_true is_idle
grep -q "^shard 3 of 4 on .*, start 1 --resume" "$out/log/shard_3.txt" || fail "$(cat "$out/log/shard_3.txt")"
[[ -d $out/run ]] || fail "the shards were not joined: $(tail -n 5 "$out"/log/*)"
[[ $(query "$out/run" "SELECT count(*) FROM trial") == 200 ]] || fail "trials are missing"
[[ $(query "$out/run" "SELECT count(*) FROM fault") == 0 ]] || fail "to be killed is no fault"
cmp -s <(values_of "$out/run") <(values_of "$scratch/whole") || fail "values differ from those of a local run"
digests_of() { (cd "$1/traces" && "$trace_digest" ./*.mcap); }
cmp -s <(digests_of "$out/run") <(digests_of "$scratch/whole") || fail "traces differ from those of a local run"
[[ $(digests_of "$out/run" | wc -l) == 200 ]] || fail "traces are missing"
! compgen -G "$TMPDIR/dmrp*" >/dev/null || fail "left on the node's disk: $(ls "$TMPDIR")"

expect_status 2 "$slurm/submit.sh" "$experiment" "$out" 5
grep -q "has 4 shards, not 5" "$scratch/stderr" || fail "$(cat "$scratch/stderr")"
