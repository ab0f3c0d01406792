#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# machine_fails.sh DMRP_HOST [SANITIZERS]
# When the machine fails, the exit status is 3 and one line says why. Files beyond `ulimit -f` stand for a full disk.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

# expect_failure PATTERN COMMAND...: status 3, and one line on standard error
expect_failure() {
  expect_status 3 "${@:2}"
  [[ $(messages) == 1 ]] || fail "not one line but: $(cat "$scratch/stderr")"
  grep -Eq -- "$1" "$scratch/stderr" || fail "'$(cat "$scratch/stderr")' does not match '$1'"
  echo "$(cat "$scratch/stderr")"
}
# with_files_up_to KILOBYTES COMMAND...
with_files_up_to() { (ulimit -f "$1" && exec "${@:2}"); }
run() { with_files_up_to "$1" "$host" "$scratch/$2.toml" --quiet --jobs 2 --trials 25 --out "$scratch/$2"; }

# a trace, in a worker; then the database, in the host
# (a guest's memory counts as a file, so that some room must be left)
sed '$a [record]\nscans = true\n[robot]\nlidar = { beams = 7200, noise_sd_m = 0.01 }' "$here/crossing.toml" >"$scratch/traces.toml"
sed '$a [record]\ntraces = "none"' "$here/crossing.toml" >"$scratch/database.toml"
expect_failure "^dmrp-host: .*/(trial_00000[0-9].mcap|samples): File too large$" run 1536 traces
expect_failure "^dmrp-host: .*database/results.sqlite: .*: disk I/O error$" run 1536 database
[[ $(query "$scratch/traces" "SELECT count(*) FROM fault") == 0 ]] || fail "the machine's failure is no fault of a plugin"

# a folder that vanishes during the run
expect_vanished() {
  "$host" "$here/crossing.toml" --quiet --jobs 1 --trials 100 --out "$scratch/vanished" >"$scratch/stdout" &
  local host_process=$! i
  for ((i = 0; i < 600; ++i)); do
    ls "$scratch"/vanished/traces/*1.mcap >/dev/null 2>&1 && break
    sleep 0.05
  done
  mv "$scratch/vanished" "$scratch/gone"
  wait "$host_process"
}
expect_failure "^dmrp-host: .*(No such file or directory|was deleted or replaced)" expect_vanished

# results on a full standard output
expect_status 0 "$host" "$here/crossing.toml" --quiet --trials 1 --out "$scratch/run"
full() { "$@" >/dev/full; }
expect_failure "^dmrp-host: .*No space left on device$" full "$host" evaluate "$scratch/run"
expect_failure "^dmrp-host: .*No space left on device$" full "$host" plan --scenario crossing --planner dmrp.planner.cbs
expect_failure "^dmrp-host: .*No space left on device$" full "$host" plugins --json
expect_failure "^dmrp-host: --svg $scratch/mall.svg: File too large$" \
  with_files_up_to 1 "$host" draw mall --svg "$scratch/mall.svg"
[[ ! -e $scratch/mall.svg ]] || fail "half a file was left"

# a terminal that cannot overwrite lines
if command -v script >/dev/null; then
  TERM=dumb script -qec "'$host' '$here/crossing.toml' --trials 1 --out '$scratch/dumb'" /dev/null >"$scratch/dumb.txt"
  grep -q "4/4" "$scratch/dumb.txt" || fail "the run should be shown: $(cat "$scratch/dumb.txt")"
  ! grep -q $'\x1b' "$scratch/dumb.txt" || fail "escape sequences on a dumb terminal"
fi

# no descriptors for child processes: one beyond the standard three, without those that this shell inherited
few_files() { (exec 3>&- 4>&- 5>&- 6>&- 7>&- 8>&- 9>&- && ulimit -n 4 && exec "$@"); }
# The undefined-behaviour sanitizer needs descriptors itself.
sanitizers=${2:-}
[[ -n $sanitizers ]] || expect_failure "^dmrp-host: .*Too many open files$" few_files "$host" plugins

# a path that the user can correct is bad input
expect_status 2 "$host" "$here/crossing.toml" --quiet --out /dev/null/run
expect_status 2 "$host" draw crossing --svg "$scratch/none/crossing.svg"
