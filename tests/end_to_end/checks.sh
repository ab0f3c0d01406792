# SPDX-License-Identifier: MIT
# shellcheck shell=bash disable=SC2034  # its variables are for the scripts that source it
# Sourced by the end-to-end tests, which are called as: TEST.sh DMRP_HOST. Gives them
#   host, here, scratch   the executable, this folder, a folder that is deleted when the test ends
#   fail, expect_status, messages, query, forge, values_of
set -uo pipefail

host=$1
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export DMRP_SCENARIO_PATH=$here/worlds

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# expect_status STATUS COMMAND...: standard output and error go to files of the scratch folder.
expect_status() {
  local expected=$1 status=0
  shift
  "$@" >"$scratch/stdout" 2>"$scratch/stderr" || status=$?
  # on a machine that refuses namespaces each run says so; hostile.sh tests that line
  sed -i '/(namespaces: none in this test)/!{/reach the network (namespaces: /d}' "$scratch/stderr"
  ((status == expected)) && return
  cat "$scratch/stdout" "$scratch/stderr"
  fail "exit status $status, not $expected: $*"
}

# The number of messages on standard error: its lines, without those that quote a line of a file for a mistake.
messages() {
  grep -cv '^ *[0-9]* | ' "$scratch/stderr"
}

# query RUN_DIR SQL
query() {
  sqlite3 -batch "$1/results.sqlite" "$2" || fail "sqlite3 on $1: $2"
}

# forge RUN_DIR SQL: changes results so that their digests do not tell
forge() {
  python3 "$here/forge.py" "$1/results.sqlite" "$2" || fail "forge.py on $1: $2"
}

# Everything that must have the same bits in every run of these trials: values with 17 digits, events, trials.
values_of() {
  query "$1" "SELECT id, scenario, robots, global_planner, local_controller, pedestrian_model, repetition, seed, outcome,
                repeatable, printf('%!.17g', sim_time_s) FROM trial ORDER BY id;
              SELECT trial_id, metric, subject_kind, subject, printf('%!.17g', coordinate),
                coalesce(printf('%!.17g', value.value), 'NULL'), value.value IS NULL
                FROM value JOIN metric ON metric.name = value.metric WHERE wall_clock = 0
                ORDER BY trial_id, metric, subject_kind, subject, coordinate;
              SELECT trial_id, metric, printf('%!.17g', from_s), printf('%!.17g', to_s), subjects, text,
                people, severity, printf('%!.17g', x_m), printf('%!.17g', y_m)
                FROM event ORDER BY trial_id, metric, from_s, subjects, text, people;"
}
