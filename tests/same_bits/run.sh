#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Whether two builds give the same bits: run.sh BIN_DIR OUT_DIR [SOURCE_DIR]
#
# Runs the experiments of this folder and some of examples/ with BIN_DIR/dmrp-host, leaves the runs in OUT_DIR, which is
# new or empty, and prints a line for each: its name, its trials, the SHA-256 of its rows (trials, values but for those
# of wall clocks, events, faults; doubles bit by bit) and that of the digests of its traces, in the order of the trials.
# Where the tables of two builds differ, so do OUT_DIR/NAME/rows.txt and digests.txt, and `trace_digest --records` on a
# trace tells where it begins.
#
#   SOURCE_DIR       the source tree whose tests/same_bits/ and examples/ are run; default: this one
#   TRACE_DIGEST     the program of that name; default: BIN_DIR/trace_digest
#   JOBS             worker processes; default: 2
#
#     diff <(run.sh old/bin /tmp/old) <(run.sh new/bin /tmp/new) && echo "the same bits"
set -uo pipefail
if (($# < 2 || $# > 3)); then
  echo "usage: run.sh BIN_DIR OUT_DIR [SOURCE_DIR]" >&2
  exit 2
fi
source_dir=$(cd "${3:-$(dirname "${BASH_SOURCE[0]}")/../..}" && pwd) || exit 2
host=$(cd "$1" && pwd)/dmrp-host
trace_digest=${TRACE_DIGEST:-$1/trace_digest}
out=$2
jobs=${JOBS:-2}
for program in "$host" "$trace_digest"; do
  [[ -x $program ]] || { echo "run.sh: $program is no program" >&2; exit 2; }
done
mkdir -p "$out" || exit 2
[[ -z $(ls -A "$out") ]] || { echo "run.sh: $out is not empty" >&2; exit 2; }
failed=0

# Whatever must not change, of a run directory; doubles as the 16 digits of their bits.
rows_of() {
  sqlite3 -batch -bail "$1/results.sqlite" "
    SELECT 'trial', id, scenario, robots, global_planner, local_controller, pedestrian_model, repetition, seed, outcome,
      repeatable, hex(ieee754_to_blob(sim_time_s)) FROM trial ORDER BY id;
    SELECT 'value', trial_id, scenario, global_planner, local_controller, pedestrian_model, repetition, metric, unit,
      direction, subject_kind, subject, hex(ieee754_to_blob(coordinate)) AS coordinate_bits, typeof(value.value),
      hex(ieee754_to_blob(value.value)) AS value_bits, printf('%!.17g', value.value)
      FROM value JOIN trial ON trial.id = trial_id JOIN metric ON metric.name = metric
      WHERE wall_clock = 0 ORDER BY trial_id, metric, subject_kind, subject, coordinate, value_bits;
    SELECT 'event', trial_id, metric, hex(ieee754_to_blob(from_s)) AS from_bits, hex(ieee754_to_blob(to_s)) AS to_bits,
      subjects, text FROM event ORDER BY trial_id, metric, from_s, to_s, subjects, text;
    SELECT 'fault', trial_id, kind, plugin, function, step, robot, signal FROM fault ORDER BY 2, 3, 4, 5, 6, 7, 8;"
}

sha256_of() { sha256sum "$1" | cut -d ' ' -f 1; }

# same_bits NAME EXPERIMENT [option of dmrp-host...]: runs it into $out/NAME and prints its line
same_bits() {
  local name=$1 experiment=$2 run=$out/$1 trials
  shift 2
  if ! "$host" "$experiment" --quiet --jobs "$jobs" --out "$run" "$@" >"$out/$name.log" 2>&1; then
    echo "run.sh: $name did not run well:" >&2
    cat "$out/$name.log" >&2
    failed=1
  fi
  if ! rows_of "$run" >"$run/rows.txt" ||
    ! "$trace_digest" "$run"/traces/*.mcap | sed "s|  $run/|  |" >"$run/digests.txt"; then
    echo "run.sh: $name left nothing whole to look at" >&2
    failed=1
    return
  fi
  trials=$(grep -c '^trial|' "$run/rows.txt")
  [[ $(wc -l <"$run/digests.txt") == "$trials" ]] || { echo "run.sh: $name lacks traces" >&2; failed=1; }
  cut -d ' ' -f 1 "$run/digests.txt" >"$run/digests_alone.txt"
  printf '%-18s %3d  %s  %s\n' "$name" "$trials" "$(sha256_of "$run/rows.txt")" "$(sha256_of "$run/digests_alone.txt")"
  rm "$run/digests_alone.txt"
}

printf '%-18s %3s  %-64s  %s\n' experiment n 'SHA-256 of the rows' 'SHA-256 of the traces'
same_bits quickstart "$source_dir/examples/quickstart.toml"
# with a trace of every trial
sed 's/^traces = "failed"/traces = "all"/' "$source_dir/examples/paper_table_3.toml" >"$out/paper_table_3.toml"
same_bits paper_table_3 "$out/paper_table_3.toml" --trials 2
same_bits recorded_crowd "$source_dir/examples/recorded_crowd.toml"
same_bits ros_map "$source_dir/examples/ros_map.toml"
for experiment in "$source_dir"/tests/same_bits/*.toml; do
  same_bits "$(basename "$experiment" .toml)" "$experiment"
done
exit $failed
