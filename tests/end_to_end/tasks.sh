#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Five tasks under five crowds each are five observations: terminal, report, summary.csv, compare and export print the
# same n, and the same interval of a share.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

drawn() { # FILE TRIALS
  sed -e 's/^use = "crossing"$/&\nrobots = 2\ntasks = { drawn = 5 }/' -e "s/^trials .*/trials = $2/" "$here/crossing.toml" >"$1"
}
drawn "$scratch/tasks.toml" 25
run=$scratch/run
expect_status 0 "$host" "$scratch/tasks.toml" --quiet --out "$run"
[[ $(query "$run" "SELECT count(DISTINCT task) FROM trial") == 5 ]] || fail "not five tasks"
# two tasks fail under one crowd each
forge "$run" "UPDATE value SET value = (SELECT CASE WHEN repetition < 2 THEN 0.5 ELSE 1 END FROM trial
  WHERE id = trial_id) WHERE metric = 'success' AND subject_kind = 'system'"

# summary.csv and the terminal's table, written again from these results
expect_status 0 "$host" "$scratch/tasks.toml" --resume --out "$run"
cp "$scratch/stdout" "$scratch/terminal"
row=$(sqlite3 :memory: ".import --csv $run/summary.csv t" "SELECT n, n_defined, trials, ci_low, ci_high FROM t WHERE
  metric = 'success' AND local_controller = 'DWA' AND global_planner = 'together'")
IFS='|' read -r n defined trials low high <<<"$row"
[[ $n == 5 && $defined == 25 && $trials == 25 ]] || fail "summary.csv has n = $n of $trials trials"
interval=$(LC_ALL=C printf '[%.2f, %.2f]' "$low" "$high")
grep -F "together + DWA" "$scratch/terminal" | grep -qF "0.96 $interval" ||
  fail "the terminal has another interval than $interval: $(cat "$scratch/terminal")"
grep -q "over 5 drawn tasks x 5 crowds" "$scratch/terminal" || fail "the terminal does not say that there are five tasks"

# the report's data
expect_status 0 "$host" report "$run"
sed -n 's|.*<script type="application/json" id="dmrp-data">\(.*\)</script>$|\1|p' "$run/report.html" >"$scratch/data.json"
found=$(sqlite3 :memory: "WITH data AS (SELECT CAST(readfile('$scratch/data.json') AS TEXT) AS j),
    metric AS (SELECT key FROM data, json_each(j, '\$.metrics') WHERE json_extract(value, '\$.name') = 'success'),
    combination AS (SELECT key FROM data, json_each(j, '\$.combinations') WHERE
      json_extract(value, '\$.local_controller') = 'DWA' AND json_extract(value, '\$.global_planner') = 'together')
  SELECT json_extract(s, '\$.n'), printf('[%.2f, %.2f]', json_extract(s, '\$.low'), json_extract(s, '\$.high'))
    FROM (SELECT json_extract(j, '\$.summaries[' || combination.key || '][' || metric.key || ']') AS s
      FROM data, combination, metric)")
[[ $found == "5|$interval" ]] || fail "the report has $found, not $interval"

# export
expect_status 0 "$host" export "$run" --latex --metric success --rows controller,planner
grep -F "together + DWA" "$scratch/stdout" | grep -qF "0.96 $interval" || fail "export has no $interval: $(cat "$scratch/stdout")"
grep -q "means over 5 drawn tasks x 5 crowds" "$scratch/stdout" || fail "the caption does not say n"

# compare: n, and the interval of a share's difference is that of the page
cp -r "$run" "$scratch/other"
forge "$scratch/other" "UPDATE value SET value = 0 WHERE metric = 'success' AND subject_kind = 'system'"
expect_status 0 "$host" compare "$run" "$scratch/other" --metric success --report "$scratch/compare.html"
read -r _ pairs tasks _ _ difference <<<"$(grep -E '^  success ' "$scratch/stdout")"
[[ $pairs == 100 && $tasks == 5 ]] || fail "compare has $pairs pairs of $tasks tasks"
sed -n 's|.*<script type="application/json" id="dmrp-data">\(.*\)</script>$|\1|p' "$scratch/compare.html" >"$scratch/data.json"
found=$(sqlite3 :memory: "SELECT printf('%+.3f [%+.3f, %+.3f]', json_extract(j, '\$.runs[0].differences[0].difference'),
  json_extract(j, '\$.runs[0].differences[0].low'), json_extract(j, '\$.runs[0].differences[0].high'))
  FROM (SELECT CAST(readfile('$scratch/data.json') AS TEXT) AS j)")
[[ $difference == "$found "* ]] || fail "compare prints '$difference', its page has $found"

# the two lines that a run of few offers are valid, and draw what they say
cp "$here/crossing.toml" "$scratch/few.toml"
expect_status 0 "$host" "$scratch/few.toml" --trials 2 --out "$scratch/few"
line=$(tr '\n' ' ' <"$scratch/stdout" | grep -o 'For a comparison: .*trials = [0-9]*') || fail "no lines to paste: $(cat "$scratch/stdout")"
[[ $line =~ \[\[scenario\]\]\ (.*)\ and\ +\[experiment\]\ (.*) ]] || fail "two tables should be named: $line"
for pair in "scenario|${BASH_REMATCH[1]}" "experiment|${BASH_REMATCH[2]}"; do
  keys=$(sed 's/, \(tasks\)/\n\1/' <<<"${pair#*|}")
  for key in $(sed 's/ =.*//' <<<"$keys"); do sed -i "/^$key /d" "$scratch/few.toml"; done
  awk -v table="${pair%%|*}" -v keys="$keys" '{ print } $0 == "[" table "]" || $0 == "[[" table "]]" { print keys }' \
    "$scratch/few.toml" >"$scratch/pasted.toml" && mv "$scratch/pasted.toml" "$scratch/few.toml"
done
expect_status 0 "$host" validate "$scratch/few.toml"
grep -q "good. 4 combinations of 40 repetitions: 160 trials" "$scratch/stdout" || fail "the pasted lines give: $(cat "$scratch/stdout")"

# more tasks than were declared: the manifest tells
sed 's/drawn = 5/drawn = 40/' "$scratch/tasks.toml" >"$scratch/many.toml"
expect_status 0 "$host" "$scratch/many.toml" --quiet --trials 2 --out "$scratch/grown"
expect_status 0 "$host" "$scratch/many.toml" --quiet --trials 12 --resume --out "$scratch/grown"
sed -n '/"grown_from"/,/\]/p' "$scratch/grown/manifest.json" | tr -d ' \n' | grep -qF '"grown_from":[2]' ||
  fail "the manifest does not say that the run grew"
expect_status 0 "$host" "$scratch/many.toml" --trials 12 --resume --out "$scratch/grown"
grep -qF "You added trials after seeing results (2, then 12): treat p values as exploratory." "$scratch/stdout" ||
  fail "the terminal does not say that the run grew"

# validate says how many tasks would show the smallest effect of interest, by how those of the last run differ
cd "$scratch" || exit 1
expect_status 0 "$host" validate many.toml
! grep -q "would show with about" "$scratch/stdout" || fail "validate knows of a run that is not there: $(cat "$scratch/stdout")"
mkdir runs && mv grown runs/crossing
forge runs/crossing "UPDATE value SET value = (SELECT CASE WHEN local_controller = 'DWA' AND repetition = 3 THEN 0.5 ELSE 1 END
  FROM trial WHERE id = trial_id) WHERE metric = 'safe_sct' AND subject_kind = 'system'"
needed() { # SMALLEST_EFFECT
  { cat many.toml && printf '[benchmark]\nsmallest_effect = %s\n' "$1"; } >effect.toml
  expect_status 0 "$host" validate effect.toml
  sed -n "s/^A difference of $1 in safe success by time would show with about \([0-9]*\) tasks (from .* runs\/crossing)$/\1/p" "$scratch/stdout"
}
small=$(needed 0.05)
large=$(needed 0.2)
[[ $small -gt $large && $large -gt 0 ]] || fail "0.05 needs '$small' tasks, 0.2 '$large': $(cat "$scratch/stdout")"
