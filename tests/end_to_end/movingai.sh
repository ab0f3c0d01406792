#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Maps of the MovingAI benchmark as worlds: called as movingai.sh DMRP_HOST SOURCE_DIR [TEST_DATA].
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
source_dir=$2
data=${DMRP_TEST_DATA:-${3:-}}

# expect_success RUN_DIR: all trials are over, without a fault and without a contact with a wall
expect_success() {
  [[ $(query "$1" "SELECT count(*) FROM trial WHERE outcome NOT IN ('succeeded', 'failed')") == 0 ]] || fail "faults"
  [[ $(query "$1" "SELECT sum(value) FROM value WHERE metric = 'collisions_static' AND subject_kind = 'system'") == 0.0 ]] ||
    fail "a robot touched a wall"
  [[ $(query "$1" "SELECT sum(value) FROM value WHERE metric = 'success' AND subject_kind = 'robot'") != 0.0 ]] ||
    fail "no robot arrived"
}

# a map of this project
sed 's/"crossing"/"rooms"/; s/^trials .*/trials = 1/' "$here/crossing.toml" >"$scratch/rooms.toml"
expect_status 0 "$host" validate "$scratch/rooms.toml"
expect_status 0 "$host" "$scratch/rooms.toml" --out "$scratch/rooms" --quiet
expect_success "$scratch/rooms"
for name in rooms/scenario.toml rooms.map rooms.scen; do
  grep -q "/$name\"" "$scratch/rooms/manifest.json" || fail "the manifest does not list $name"
done
expect_status 0 "$host" draw rooms --planner dmrp.planner.cbs --svg "$scratch/rooms.svg"
(($(grep -c "fill:rgb(29.0" "$scratch/rooms.svg") >= 2)) || fail "the map's cells are not in the picture" # the legend is one wall
expect_status 0 "$host" plan --scenario rooms --planner dmrp.planner.cbs --paths "$scratch/rooms.csv"
# the first task, in the file's own coordinates
grep -qx "0,0,0,0" "$scratch/rooms.csv" || fail "robot 0 should begin at (0, 0): $(head -3 "$scratch/rooms.csv")"
[[ $(grep "^0," "$scratch/rooms.csv" | tail -1) == *,9,8 ]] || fail "robot 0 should end at (9, 8)"

# the example, with its files
if [[ ! -d $data/movingai ]]; then
  echo "skipped: DMRP_TEST_DATA is not set"
  exit 77
fi
cp -r "$source_dir/examples/movingai.toml" "$source_dir/examples/movingai" "$scratch"
cp "$data/movingai/maps/random-32-32-20.map" "$data/movingai/scens/random-32-32-20-random-1.scen" "$scratch/movingai" ||
  fail "the files of the example"
expect_status 0 "$host" validate "$scratch/movingai.toml"
sed -i 's/^robots = .*/robots = 4/' "$scratch/movingai.toml"
expect_status 0 "$host" "$scratch/movingai.toml" --trials 1 --out "$scratch/example" --quiet
expect_success "$scratch/example"
