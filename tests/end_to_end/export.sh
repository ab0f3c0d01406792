#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# `export` writes LaTeX tables, CSV, tables and maps of a run as figures, of all trials or of some, and names mistakes of its options in one line.
# Where rsvg-convert is installed, it reads them; latex.sh compiles the tables.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

run=$scratch/run
cat >"$scratch/sweep.toml" <<EOF
$(sed -n '1,/^\[\[local_controller\]\]/{/^\[\[local_controller\]\]/!p}' "$here/crossing.toml")

[[local_controller]]
use = "dmrp.controller.dwa"
sweep = { sim_time = [1.0, 1.7] }
EOF
grep -q '^\[\[pedestrian_model\]\]' "$scratch/sweep.toml" || sed -n '/^\[\[pedestrian_model\]\]/,$p' "$here/crossing.toml" >>"$scratch/sweep.toml"
expect_status 0 "$host" "$scratch/sweep.toml" --quiet --trials 2 --out "$run"

expect_status 0 "$host" export "$run" --latex
cp "$scratch/stdout" "$scratch/tables.tex"
for part in '\\toprule' '\\caption{Plans' '\\caption{Driving' 'PFD (m)'; do
  grep -q "$part" "$scratch/tables.tex" || fail "no $part in the LaTeX tables"
done
expect_status 0 "$host" export "$run" --latex --rows controller --columns planner --metric success,pfd --out "$scratch/own.tex"
grep -q 'success & PFD (m)' "$scratch/own.tex" || fail "the table has other columns: $(cat "$scratch/own.tex")"
[[ $(grep -c 'sim\\_time' "$scratch/own.tex") == 2 ]] || fail "not a row for each controller"

expect_status 0 "$host" export "$run" --csv
head -1 "$scratch/stdout" | grep -Eq '(^|,)local_controller.sim_time(,|$)' || fail "no column for the swept parameter"
head -1 "$scratch/stdout" | grep -Eq ',completion_time \[s\](,|$)' || fail "no unit in the header"
[[ $(wc -l <"$scratch/stdout") == $(($(query "$run" "SELECT count(*) FROM trial") + 1)) ]] || fail "not one line a trial"
cp "$scratch/stdout" "$scratch/trials.csv"
found=$(sqlite3 :memory: ".import --csv $scratch/trials.csv t" 'SELECT DISTINCT "local_controller.sim_time" FROM t ORDER BY 1')
[[ $found == $'1.0\n1.7' || $found == $'1\n1.7' ]] || fail "the swept values are $found"

# the map of a trial: world, plans and ways, with coordinates
expect_status 0 "$host" export "$run" --map 1 --out "$scratch/map.svg"
robots=$(query "$run" "SELECT robots FROM trial WHERE id = 1")
# dashed plans and ways have lines of their own widths; the legend has one of each
for width in 1.5 2.25; do
  [[ $(grep -c "fill:none;stroke-width:$width;" "$scratch/map.svg") == $((robots + 1)) ]] ||
    fail "the map should show $robots lines of $width pixels"
done
expect_status 0 "$host" export "$run" --map 1 --out "$scratch/map.pdf"
if command -v pdftotext >/dev/null; then
  pdftotext "$scratch/map.pdf" - >"$scratch/map.txt"
  for text in 'trial 1' 'x and y in m' 'way driven' 'way of a person'; do
    grep -q "$text" "$scratch/map.txt" || fail "the map does not say '$text'"
  done
fi

# tables as figures: one of the report, and one of rows and columns
expect_status 0 "$host" export "$run" --table driving --out "$scratch/driving.svg"
grep -q 'class="[^"]*">PFD</text>' "$scratch/driving.svg" || fail "the table has no column PFD"
expect_status 0 "$host" export "$run" --table own --rows controller --columns planner --metric success,pfd
grep -q '>each alone</text>' "$scratch/stdout" || fail "the table has no column for each planner"
[[ $(grep -c 'sim_time' "$scratch/stdout") == 2 ]] || fail "not a row for each controller"

# a run over people and a setting: columns, and the same when its effective.toml is run
cat >"$scratch/crowd.toml" <<EOF
$(sed '/^use = "crossing"/a people = [1, 4]' "$here/crossing.toml")
[simulation]
sweep = { tracking = ["none", "visible"] }
EOF
expect_status 0 "$host" "$scratch/crowd.toml" --quiet --trials 1 --out "$scratch/crowd"
found=$(sqlite3 :memory: ".import --csv $scratch/crowd/trials.csv t" \
  'SELECT DISTINCT people, "simulation.tracking", scenario FROM t ORDER BY 1, 2')
[[ $found == $'1|none|crossing (people 1, tracking none)\n1|visible|crossing (people 1, tracking visible)
4|none|crossing (people 4, tracking none)\n4|visible|crossing (people 4, tracking visible)' ]] ||
  fail "trials.csv has the columns $found"
expect_status 0 "$host" export "$scratch/crowd" --latex --rows controller --columns people --metric pfd
grep -q '{1 person}' "$scratch/stdout" && grep -q '{4 people}' "$scratch/stdout" || fail "people are not their number across"
expect_status 0 "$host" "$scratch/crowd/effective.toml" --quiet --out "$scratch/again"
swept="SELECT trial_id, key, value FROM swept ORDER BY 1, 2"
[[ $(query "$scratch/again" "$swept") == "$(query "$scratch/crowd" "$swept")" ]] || fail "effective.toml has another sweep"

# --where: some trials, in each format
expect_status 0 "$host" export "$run" --csv --where local_controller.sim_time=1.70 --where repetition=1 --metric success
[[ $(sed 1d "$scratch/stdout" | cut -d, -f7 | sort -u) == 1 ]] || fail "--where repetition=1 has other repetitions"
[[ $(sed 1d "$scratch/stdout" | wc -l) == $(query "$run" "SELECT count(*) FROM trial JOIN swept ON trial_id = id
  WHERE repetition = 1 AND key = 'sim_time' AND value + 0 = 1.7") ]] || fail "--where has other trials: $(cat "$scratch/stdout")"
expect_status 0 "$host" export "$run" --csv --where repetition=0 --where repetition=1 --metric success
[[ $(sed 1d "$scratch/stdout" | wc -l) == $(query "$run" "SELECT count(*) FROM trial") ]] || fail "two values are no alternatives"
for format in --latex "--table own"; do
  # shellcheck disable=SC2086
  expect_status 0 "$host" export "$run" $format --rows controller --metric success --where local_controller.sim_time=1
  [[ $(grep -c 'sim' "$scratch/stdout") == 1 ]] || fail "$format has rows of other trials"
done

refused() {
  expect_status 2 "$host" export "$run" "${@:2}"
  [[ $(messages) == 1 ]] || fail "not one line: $(cat "$scratch/stderr")"
  grep -Eq "$1" "$scratch/stderr" || fail "'$(cat "$scratch/stderr")' does not match '$1'"
}
refused "did you mean 'driving'" --table drivin
refused "did you mean 'success'" --latex --metric sucess
refused "none of scenario, robots, people, planner" --latex --rows planet
refused "no scenario of this run has levels" --thresholds
refused "there is no option .--over." --csv --over people
refused "^--map 99: .* has [0-9]+ finished trials, from 0 to" --map 99
refused "'sim_time' is none of the [0-9]+ columns of this run .did you mean 'local_controller.sim_time'" --csv --where sim_time=1
refused "'crosing' is none of crossing .did you mean 'crossing'" --csv --where scenario=crosing
refused "'2' is none of 1, 1.7" --latex --where local_controller.sim_time=2
refused "^--where: 'crossing' is not KEY=VALUE" --csv --where crossing
refused "where excludes --map" --map 1 --where scenario=crossing
refused "xactly 1 option from \[--latex,--csv,--thresholds,--map,--table\]" --latex --csv

if command -v rsvg-convert >/dev/null; then
  expect_status 0 "$host" export "$run" --table driving --out "$scratch/driving.pdf"
  [[ $(head -c 5 "$scratch/driving.pdf") == %PDF- ]] || fail "no PDF file of the table"
  if command -v pdftotext >/dev/null; then
    pdftotext "$scratch/driving.pdf" - | grep -qx 'PFD' || fail "the PDF of the table does not say PFD"
  fi
  [[ $(head -c 5 "$scratch/map.pdf") == %PDF- ]] || fail "no PDF file of the map"
fi
