#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# `dmrp-host keys`: every key that the readers take, with the defaults that a run has and the ranges that are refused beyond. Called as: keys.sh DMRP_HOST
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
cd "$scratch" || exit 1

# normal FILE: "[table] key = value", a line each
normal() {
  awk '/^ *\[/ { table = $1; next } / = / { sub(/ +# .*/, ""); gsub(/ +/, " "); sub(/^ /, ""); print table, $0 }' "$1" | sort
}
expect_status 0 "$host" keys experiment
normal "$scratch/stdout" >listed
expect_status 0 "$host" "$here/crossing.toml" --quiet --trials 1 --out run
for table in simulation record limits robot; do
  comm -13 listed <(normal run/effective.toml | grep -F "[$table]") >missing
  [[ ! -s missing ]] || fail "keys experiment should have the defaults of a run: $(cat missing)"
  grep -qF "[$table]" listed || fail "keys experiment lacks [$table]"
done

expect_status 0 "$host" keys experiment
while IFS='|' read -r key range; do
  grep -F "  $key " "$scratch/stdout" | grep -qF " ($range)" || fail "keys experiment should say of $key: $range"
done <<'RANGES'
step_s = 0.02|0.001 to 1000000
tracking = "visible"|"none", "visible", "all"
goal_tolerance_m = 0.2|above 0, to 10000
scans = false|true, false
memory_mb = 4096|0 to 1073741824
beams = 360|1 to 100000
RANGES

expect_status 0 "$host" keys scenario
for key in start via group_size vertices_m scen; do
  grep -qE "^  $key( |$)" "$scratch/stdout" || fail "keys scenario lacks $key"
done
expect_status 2 "$host" keys experimant
grep -q "did you mean 'experiment'" stderr || fail "a mistyped format should have a suggestion: $(cat stderr)"
expect_status 2 "$host" draw "$here/crossing.toml"
grep -q "crossing.toml:[0-9:]* this is an experiment, not a scenario" stderr || fail "draw of an experiment says: $(cat stderr)"
expect_status 2 "$host" validate "$here/../../scenarios/library/scenario.toml"
grep -q "this is a scenario, not an experiment" stderr || fail "validate of a scenario says: $(cat stderr)"
for format in experiment scenario; do
  expect_status 0 "$host" keys "$format"
  ! grep '^  ' stdout | grep -v '# [^( ]' || fail "these keys have no meaning (host/layouts/keys.json)"
done

# --- what lies beyond a range is refused at its key ---
# beyond RANGE: values that the range leaves out, a line each; none for a range that is more than one
beyond() {
  local range=${1#each }
  case $range in
    "at least 1") echo 0 ;;
    "true, false") echo '"yes"' ;;
    *:* | *,\ or\ *) ;;
    \"*) echo '"none of these"' ;;
    "above 0, to "*) printf '0\n%s\n' "${range##* }1" ;;
    *" to 9223372036854775807") echo -1 ;;
    *" to "*) awk '{ print $1 - 1; print $3 + 1 }' <<<"$range" ;;
  esac
}
# written KEY RANGE VALUE: the value in the form that the key takes
written() {
  case $1 in
    noise) echo "[$3, 0, 0, 0]" ;;
    vertices_m) echo "[[$3, 0], [1, 0], [0, 1]]" ;;
    parts_m) echo "[[[$3, 0], [1, 0], [0, 1]]]" ;;
    goals) echo "[[$3, 0]]" ;;
    types) echo "{ default = $3 }" ;;
    *) if [[ $2 == each* ]]; then echo "[$3, 1]"; else echo "$3"; fi ;;
  esac
}
header='name = "world"
title = "a"
description = "a"'
tried=0
for format in experiment scenario; do
  while IFS='|' read -r table key range; do
    # read with the map or the robots that they belong to alone, or as [robot]
    [[ $table != "[map]" && $table != "[robots]" && $table != "[grade]" && $key != types ]] || continue
    [[ $table != "[robot_type"* ]] || continue
    while read -r value; do
      {
        [[ $format == experiment || $table == "[scenario]" ]] || printf '[scenario]\n%s\n' "$header"
        [[ $format == experiment || $table == "[scenario]" || $table == "[tiles]" ]] || echo "size_m = [10, 10]"
        echo "$table"
        [[ $table != "[[scenario]]" ]] || echo 'use = "mall"'
        [[ $table != "[scenario]" ]] || echo "$header"
        [[ $key != group_size ]] || echo "people = 1"
        echo "$key = $(written "$key" "$range" "$value")"
      } >world.toml
      place="world.toml:$(wc -l <world.toml):"
      file=world.toml
      if [[ $format == scenario ]]; then
        printf '[experiment]\nname = "a"\n[[scenario]]\nuse = "./world.toml"\n' >uses_it.toml
        file=uses_it.toml
      fi
      expect_status 2 "$host" validate "$file"
      grep -qF "$place" "$scratch/stderr" || fail "$table $key = $value should be refused: $(cat "$scratch/stderr")"
      tried=$((tried + 1))
    done < <(beyond "$range")
  done < <("$host" keys "$format" | awk '
    /^\[/ { table = $1; next }
    match($0, / \(.*\)$/) { print table "|" $1 "|" substr($0, RSTART + 2, RLENGTH - 3) }')
done
((tried > 100)) || fail "only $tried values beyond ranges were tried"
