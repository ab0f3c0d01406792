#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Workers and supervisors that are killed at random moments lose nothing: all values equal those of an undisturbed run.
# Called as: killed.sh DMRP_HOST [MOMENTS [TRIALS]]
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
moments=${2:-6}
trials=${3:-12} # of each of four combinations
experiment=$here/crossing.toml
RANDOM=18

expect_status 0 "$host" "$experiment" --quiet --jobs 2 --trials "$trials" --out "$scratch/whole"

run=$scratch/killed
start() {
  "$host" "$experiment" --quiet --jobs 2 --trials "$trials" --out "$run" "$@" 2>"$scratch/stderr" >"$scratch/stdout" &
  host_process=$!
}
wait_for_workers() {
  for ((tries = 0; tries < 100; ++tries)); do
    workers=$(pgrep -P "$host_process" -f " worker ") && return
    kill -0 "$host_process" 2>/dev/null || return
    sleep 0.02
  done
}
start
for ((moment = 0; moment < moments; ++moment)); do
  wait_for_workers
  sleep "0.$((RANDOM % 30 + 10))"
  workers=$(pgrep -P "$host_process" -f " worker ") || break
  case $((moment % 3)) in
    0) xargs kill -KILL <<<"$workers" 2>/dev/null ;;
    1) kill -KILL "${workers%%$'\n'*}" 2>/dev/null ;;
    2) # the supervisor; its workers end with it
      kill -KILL "$host_process" 2>/dev/null || break
      wait "$host_process" 2>/dev/null
      while read -r id; do # a row of the table says that the trace is there
        [[ -s $(printf '%s/traces/trial_%06d.mcap' "$run" "$id") ]] || fail "trial $id lacks its trace"
      done < <(query "$run" "SELECT id FROM trial")
      start --resume
      ;;
  esac
done
status=0
wait "$host_process" || status=$?
((status == 0)) || fail "exit status $status: $(cat "$scratch/stderr")"
((moment > moments / 2)) || fail "the run was over after $moment of $moments moments"
[[ $(query "$run" "SELECT count(*) FROM fault") == 0 ]] || fail "to be killed is no fault: $(query "$run" "SELECT * FROM fault")"
cmp -s <(values_of "$run") <(values_of "$scratch/whole") || fail "values differ from an undisturbed run"
! compgen -G "$run/results.sqlite-*" >/dev/null || fail "files are left beside the database: $(ls "$run")"
# each trial has its trace, whole
expect_status 0 "$host" evaluate "$run" --metric dmrp.metric.path_length --csv "$scratch/measured.csv"
! compgen -G "$run/*scratch*" >/dev/null || fail "scratch files are left: $(ls "$run")"

# a run that is killed before it has a database is begun again
mkdir "$scratch/early" "$scratch/early/traces"
cp "$run/experiment.toml" "$scratch/early/"
head -c 5000 "$run/results.sqlite" >"$scratch/early/results.new"
expect_status 0 "$host" "$experiment" --quiet --resume --trials 1 --out "$scratch/early"
[[ $(query "$scratch/early" "SELECT count(*) FROM trial") == 4 ]] || fail "the run should have begun again"
expect_status 2 "$host" "$experiment" --quiet --resume --trials 1 --out "$scratch"

# a database that vanishes ends the run, and it says so
"$host" "$experiment" --quiet --jobs 2 --trials 100 --out "$scratch/vanished" 2>"$scratch/stderr" >"$scratch/stdout" &
host_process=$!
for ((i = 0; i < 600; ++i)); do
  ls "$scratch"/vanished/traces/*3.mcap >/dev/null 2>&1 && break
  sleep 0.05
done
rm "$scratch/vanished/results.sqlite"
status=0
wait "$host_process" || status=$?
((status == 3)) || fail "exit status $status, not 3"
grep -q "results.sqlite: was deleted or replaced" "$scratch/stderr" || fail "$(cat "$scratch/stderr")"
