#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A signal ends a run with status 130, keeps finished trials, and leaves no worker behind; --resume completes the run.
# (SIGTERM, because a shell starts background processes with SIGINT ignored.)
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

run="$scratch/a run"
"$host" "$here/crossing.toml" --quiet --jobs 2 --trials 100 --out "$run" >"$scratch/stdout" 2>"$scratch/stderr" &
host_process=$!

# the run alone reads its database until it is over; a trial has its trace before it is in the database
finished() { ls "$run/traces" 2>/dev/null | wc -l; }
for ((i = 0; i < 600; ++i)); do
  (($(finished) > 3)) && break
  sleep 0.05
done
(($(finished) > 3)) || fail "no trial finished within 30 s"
workers=$(pgrep -P "$host_process")
[[ -n $workers ]] || fail "there should be worker processes"
kill -TERM "$host_process"
status=0
wait "$host_process" || status=$?
((status == 130)) || fail "exit status $status after SIGTERM, not 130: $(cat "$scratch/stderr")"
for worker in $workers; do
  ! kill -0 "$worker" 2>/dev/null || fail "worker $worker outlives the run"
done

kept=$(query "$run" "SELECT count(*) FROM trial")
((kept >= 3 && kept < 400)) || fail "$kept trials were kept of 400"
[[ $(query "$run" "SELECT count(*) FROM fault") == 0 ]] || fail "an interruption is no fault"
[[ $(messages) == 1 ]] || fail "one line should say how to go on: $(cat "$scratch/stderr")"
grep -qF "continue with dmrp-host run $here/crossing.toml --trials 100 --resume --out '$run'" "$scratch/stderr" ||
  fail "the command cannot be pasted: $(cat "$scratch/stderr")"
[[ -s $run/trials.csv && -s $run/summary.csv ]] || fail "the tables of what was finished are missing"

expect_status 2 "$host" "$here/crossing.toml" --quiet --resume --trials 99 --out "$run"
