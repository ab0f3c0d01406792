#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The planners' benchmark prints its rows, and reports planners that fail. Called as
# bench_planners.sh DMRP_HOST BENCH_PLANNERS LIBRARY_OF_FAULTS [TEST_DATA]. This does not test times.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
bench=$2
faults=$3
data=${DMRP_TEST_DATA:-${4:-}}

mkdir -p "$scratch/data/movingai/maps" "$scratch/data/movingai/scens"
cp "$here/maps/rooms.map" "$scratch/data/movingai/maps"
for k in 1 2; do cp "$here/maps/rooms.scen" "$scratch/data/movingai/scens/rooms-random-$k.scen"; done

run() { expect_status "$1" "$bench" --data "$scratch/data" --host "$host" --instances 2 --times 3 --json "${@:2}"; }
# value NAME: of a row of the list
value() {
  sqlite3 -batch :memory: "SELECT json_extract(value, '$.value') FROM json_each(CAST(readfile('$scratch/stdout') AS TEXT))
    WHERE json_extract(value, '$.name') = '$1'"
}

run 0 --planner cbs --planner dmrp.planner.individual --on rooms:2,8 --scenario mall
[[ $(value planner/dmrp.planner.cbs/rooms/8/solved) == 2 ]] || fail "$(cat "$scratch/stdout")"
[[ $(value planner/dmrp.planner.individual/rooms/2/solved) == 2 ]] || fail "$(cat "$scratch/stdout")"
[[ $(value planner/dmrp.planner.cbs/mall/4/solved) == 3 ]] || fail "$(cat "$scratch/stdout")"
for row in planner/dmrp.planner.cbs/rooms/2/median_ms planner/dmrp.planner.cbs/mall/4/median_ms; do
  [[ $(value "$row") =~ ^[0-9.e-]+$ ]] || fail "no $row: $(cat "$scratch/stdout")"
done
[[ -z $(sqlite3 -batch :memory: "SELECT json_extract(value, '$.name') AS name
  FROM json_each(CAST(readfile('$scratch/stdout') AS TEXT)) GROUP BY name HAVING count(*) > 1") ]] ||
  fail "a name occurs twice"

# two runs into one CSV file: one head, then rows of a commit, a date, a CPU and the values
for _ in 1 2; do run 0 --planner cbs --on rooms:2 --csv "$scratch/rows.csv"; done
[[ $(head -n 1 "$scratch/rows.csv") == commit,date,cpu,name,value,unit &&
  $(grep -c '^commit,' "$scratch/rows.csv") == 1 &&
  $(grep -cE '^[^,]+,20[0-9T:-]+Z,.+,planner/dmrp.planner.cbs/rooms/2/solved,2,1$' "$scratch/rows.csv") == 2 ]] ||
  fail "$(cat "$scratch/rows.csv")"

# variants of one planner have separate rows
run 0 --planner "cbs node_limit=100000" --planner cbs --on rooms:2
[[ $(value "planner/dmrp.planner.cbs node_limit=100000/rooms/2/solved") == 2 ]] || fail "$(cat "$scratch/stdout")"
[[ $(value planner/dmrp.planner.cbs/rooms/2/solved) == 2 ]] || fail "$(cat "$scratch/stdout")"

# a planner that crashes solves nothing, and is reported
run 1 --planner "test.planner.faulty fault=crash" --plugin "$faults" --on rooms:2
[[ $(value "planner/test.planner.faulty/rooms/2/solved") == 0 ]] || fail "$(cat "$scratch/stdout")"
[[ $(value "planner/test.planner.faulty/rooms/2/median_ms") == 10000 ]] || fail "unsolved counts as the time limit"
run 2 --planner "cbs node_limits=1" --on rooms:2
grep -q "did you mean 'node_limit'" "$scratch/stderr" || fail "$(cat "$scratch/stderr")"

# a peer takes turns with the planner; its paths are judged, too; known costs are compared with
printf 'map,scen,agents,planner,solved,sum_of_costs,cpu_s\nrooms,random-1,2,elsewhere,1,1000,1\n' >"$scratch/known.csv"
same="'$host' plan --map \"\$MAP\" --scen \"\$SCEN\" --agents \$AGENTS --planner dmrp.planner.cbs --paths \"\$PATHS\""
run 0 --planner cbs --on rooms:2 --peer "twin=$same" --peer "lazy=true" --known-costs "$scratch/known.csv"
[[ $(value "planner/dmrp.planner.cbs/rooms/2/cost_over/twin") == 1 ]] || fail "$(cat "$scratch/stdout")"
[[ -z $(value "planner/dmrp.planner.cbs/rooms/2/cost_over/lazy") ]] || fail "$(cat "$scratch/stdout")"
grep -q elsewhere "$scratch/stdout" || fail "$(cat "$scratch/stdout")"
run 1 --planner cbs --on rooms:2 --peer "liar=echo agent,t,x,y >\$PATHS; echo 0,0,0,0 >>\$PATHS"
run 2 --planner cbs --on rooms:2 --peer "nothing"

# every planner on public maps with few robots: solved, and the path files are valid
if [[ ! -d $data/movingai ]]; then
  echo "skipped: DMRP_TEST_DATA is not set"
  exit 77
fi
expect_status 0 "$bench" --data "$data" --host "$host" --instances 1 --time-limit 30 --json \
  --on random-32-32-20:15 --on warehouse-10-20-10-2-1:15 --on gen-rooms-40-40:10
rows="SELECT count(*) FROM json_each(CAST(readfile('$scratch/stdout') AS TEXT)) WHERE json_extract(value, '$.name') LIKE '%/solved'"
[[ $(sqlite3 -batch :memory: "$rows") -ge 6 &&
  $(sqlite3 -batch :memory: "$rows AND json_extract(value, '$.value') <> 1") == 0 ]] || fail "$(cat "$scratch/stdout")"
