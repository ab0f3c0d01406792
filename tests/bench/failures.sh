#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What the referee said of the robots of a run in shipped worlds that did not arrive: the table of docs/measured/referee.md.
#
#     tests/bench/failures.sh RUN_DIR [ROWS]
#
# Lists up to ROWS (20) robots that failed by themselves, not held behind another, with their first causes. Exit status 1
# if a robot that arrived was failed, or if a trial ended before its time limit while one of its robots made progress.
set -euo pipefail
results=$1/results.sqlite
rows=${2:-20}
scenarios=$(dirname "$0")/../../scenarios

ask() { sqlite3 -readonly -separator ' | ' "$results" "$1"; }

wrong=$(ask "SELECT count(*) FROM robot_values WHERE success = 0 AND \"completion_time [s]\" IS NOT NULL")
while IFS= read -r world; do
  limit_s=$(awk '$1 == "time_limit_s" { print $3; exit }' "$scenarios/$world/scenario.toml")
  early=$(ask "SELECT count(*) FROM robot_values JOIN trial ON trial.id = trial_id
    WHERE (scenario = '$world' OR scenario LIKE '$world (%') AND sim_time_s < $limit_s - 0.001 AND first_cause = 1")
  wrong=$((wrong + early))
done < <(ask "SELECT DISTINCT substr(scenario, 1, instr(scenario || ' ', ' ') - 1) FROM trial ORDER BY 1")
ask "SELECT count(*) || ' robots, ' || sum(success) || ' home, ' || coalesce(sum(held_behind), 0) || ' held behind others'
  FROM robot_values"
echo "$wrong failed though they had arrived, or ended before the limit while they made progress"

printf '| trial | world | controller | robot | cause | blocked by | blocked s | circling s | held s |\n'
printf '| --- | --- | --- | --- | --- | --- | --: | --: | --: |\n'
ask "SELECT '| ' || trial.id, scenario, local_controller, robot,
    CASE first_cause WHEN 1 THEN 'time limit' WHEN 4 THEN 'no command' WHEN 7 THEN 'circling'
      WHEN 8 THEN 'blocked by a person' WHEN 9 THEN 'blocked by a robot' WHEN 10 THEN 'stuck' WHEN 100 THEN 'collision' ELSE first_cause END,
    coalesce(CAST(culprit AS INTEGER), ''), round(\"blocked_time [s]\", 1), round(\"circling_time [s]\", 1),
    round(\"held_time [s]\", 1) || ' |'
  FROM robot_values JOIN trial ON trial.id = trial_id
  WHERE success = 0 AND held_behind = 0 ORDER BY first_cause = 1, trial.id, robot LIMIT $rows"
[[ $wrong == 0 ]]
