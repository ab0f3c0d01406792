#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Input without end or bottom is refused in one line, and a run survives its terminal.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
experiment=$here/crossing.toml

# expect_refusal PATTERN COMMAND...: status 2 and one line, no longer than a screen
expect_refusal() {
  expect_status 2 "${@:2}"
  [[ $(messages) == 1 ]] || fail "not one line but: $(head -c 2000 "$scratch/stderr")"
  (($(head -1 "$scratch/stderr" | wc -c) < 2200)) || fail "a line of $(head -1 "$scratch/stderr" | wc -c) bytes"
  grep -Eq -- "$1" "$scratch/stderr" || fail "'$(cat "$scratch/stderr")' does not match '$1'"
}
cd "$scratch" || fail "no folder"

# --- TOML that is 50,000 deep ---
repeat() { head -c "$1" /dev/zero | sed "s/\x00/$2/g"; }
echo "a = $(repeat 50000 '[')$(repeat 50000 ']')" >arrays.toml
echo "a = $(repeat 50000 '{b=')1$(repeat 50000 '}')" >tables.toml
echo "$(repeat 50000 'a.')a = 1" >key.toml
echo "[$(repeat 50000 'a.')a]" >header.toml
for file in arrays tables; do expect_refusal "^$file.toml:1:.*exceeded maximum nested" "$host" validate $file.toml; done
for file in key header; do expect_refusal "^$file.toml:1:.*more than 1000 parts" "$host" validate $file.toml; done

# --- texts of a megabyte ---
long=$(repeat 1048576 x)
long_in() { awk -v from="$1" 'NR == FNR {long = $0; next} {sub(from, long)} 1' <(echo "$long") "$experiment" >long.toml; }
long_in dmrp.planner.cbs
expect_refusal "^long.toml:13:9: no global_planner 'xxx" "$host" validate long.toml
long_in libdmrp_metrics
expect_refusal "^long.toml:7:87: no library 'xxx" "$host" validate long.toml
{ printf '[experiment]\nname = "%s"\n' "$long"; sed 1,5d "$experiment"; } >long.toml
expect_refusal "^long.toml:2:8: 'name' must have at most 1000 bytes" "$host" validate long.toml

# --- files without end ---
mkfifo pipe
expect_refusal "^/dev/zero: there is no such experiment file" "$host" validate /dev/zero
expect_refusal "^pipe: there is no such experiment file" "$host" validate pipe
expect_refusal "there is no such file" "$host" plan --map /dev/zero --planner dmrp.planner.cbs --draw 2
expect_refusal "there is no such file" "$host" plan --map pipe --planner dmrp.planner.cbs --draw 2
mkdir run_of_pipes && mkfifo run_of_pipes/results.sqlite
expect_refusal "is no run directory" "$host" report run_of_pipes

# --- a run directory that is no folder ---
touch file && ln -s /dev/null device
expect_refusal "^--out file: is no folder" "$host" "$experiment" --out file
expect_refusal "^--out device: is no folder" "$host" "$experiment" --out device

# --- a run whose output goes nowhere ---
count() { [[ $(query "$1" "SELECT count(*) FROM trial") == 4 && -s $1/report.html ]] || fail "$1 is not whole"; }
"$host" "$experiment" --trials 1 --out closed >&- 2>stderr || fail "closed output: status $?: $(cat stderr)"
count closed
status=0
"$host" "$experiment" --trials 1 --out full >/dev/full 2>stderr || status=$?
((status == 3)) || fail "full output: status $status"
grep -q "^dmrp-host: standard output: " stderr || fail "full output: $(cat stderr)"
count full
"$host" "$experiment" --trials 1 --out unread 2>stderr | true
grep -q "^dmrp-host: .*" stderr || fail "a pipe that nobody reads: $(cat stderr)"
count unread

# --- the terminal hangs up: finished trials are kept; not so under nohup ---
hang_up() { # RUN TRIALS COMMAND...
  "${@:3}" "$experiment" --quiet --jobs 2 --trials "$2" --out "$1" >stdout 2>stderr &
  local host_process=$! i
  for ((i = 0; i < 1200; ++i)); do
    compgen -G "$1/traces/*2.mcap" >/dev/null && break
    sleep 0.05
  done
  kill -HUP "$host_process"
  status=0
  wait "$host_process" || status=$?
}
hang_up hung 60 "$host"
((status == 130)) || fail "status $status after SIGHUP: $(cat stderr)"
[[ $(wc -l <stderr) == 1 ]] || fail "one line should say how to go on: $(cat stderr)"
(($(query hung "SELECT count(*) FROM trial") > 0)) || fail "finished trials were not kept"
hang_up kept 10 nohup "$host"
((status == 0)) || fail "status $status under nohup: $(cat stderr)"
[[ $(query kept "SELECT count(*) FROM trial") == 40 ]] || fail "nohup should have kept the run going"
