#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The example with a map of ROS's map_server, and the errors of damaged ones: called as ros_map.sh DMRP_HOST SOURCE_DIR.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
source_dir=$2

work=$scratch/work
mkdir -p "$work"
cp -r "$source_dir/examples/ros_map.toml" "$source_dir/examples/ros_map" "$work"
cd "$work" || exit 1

expect_status 0 "$host" validate ros_map.toml
[[ ! -s $scratch/stderr ]] || fail "a warning: $(cat "$scratch/stderr")"
census="^flat.yaml: [0-9]* cells: [0-9]* % free, [0-9]* % walls, [0-9]* % unknown (count as walls)$"
grep -q "$census" "$scratch/stdout" || fail "no census: $(cat "$scratch/stdout")"
expect_status 0 "$host" ros_map.toml --out "$scratch/run" --quiet
[[ $(query "$scratch/run" "SELECT count(*) FROM trial WHERE outcome <> 'succeeded'") == 0 ]] ||
  fail "a controller does not arrive: $(query "$scratch/run" "SELECT local_controller, outcome FROM trial")"
[[ $(query "$scratch/run" "SELECT sum(value) FROM value WHERE metric = 'collisions' AND subject_kind = 'system'") == 0.0 ]] ||
  fail "a robot touched something"
for name in ros_map/flat.toml ros_map/flat.yaml ros_map/flat.pgm parameter_sets/controllers/tuned/dwa.toml; do
  grep -q "/$name\"" "$scratch/run/manifest.json" || fail "the manifest does not list $name"
done
# the values of the parameter set are in effective.toml
sed -n '/dmrp.controller.dwa/,/^$/p' "$scratch/run/effective.toml" >"$scratch/dwa.toml"
grep -q '^occdist_scale = ' "$scratch/dwa.toml" || fail "effective.toml lacks DWA's parameters"
expect_status 0 "$host" draw ros_map/flat.toml --svg "$scratch/flat.svg"
grep -q "$census" "$scratch/stderr" || fail "no census: $(cat "$scratch/stderr")"
(($(grep -c "fill:rgb(29.0" "$scratch/flat.svg") >= 2)) || fail "the map's cells are not in the picture" # the legend is one wall

# as nav2's map_saver writes thresholds: what `unknown` says holds, and without it there is a warning
sed -i 's/^free_thresh:.*/free_thresh: 0.25/' ros_map/flat.yaml
sed -i '3,$ {s/^9$/255/; s/\b7\b/205/g; s/\b9\b/254/g}' ros_map/flat.pgm
expect_status 0 "$host" draw ros_map/flat.toml --svg "$scratch/same.svg"
cmp -s "$scratch/flat.svg" "$scratch/same.svg" || fail "unknown cells are no walls"
sed -i.whole '/^unknown/d' ros_map/flat.toml
expect_status 0 "$host" validate ros_map.toml
grep -q "cells of grey 205, .* count as free by free_thresh = 0.25: unknown = \"occupied\"" "$scratch/stderr" ||
  fail "no warning: $(cat "$scratch/stderr")"
mv ros_map/flat.toml.whole ros_map/flat.toml
cp "$source_dir"/examples/ros_map/flat.* ros_map

contents() { find "$work" -type f -exec sha256sum {} + | sort; }
# expect_mistake FILE SED PATTERN: of the answer to FILE, changed by sed; then restores FILE
expect_mistake() {
  local file=$1 change=$2 pattern=$3 before call
  cp "$file" "$scratch/whole"
  sed -i "$change" "$file"
  ! cmp -s "$file" "$scratch/whole" || fail "nothing was changed by $change"
  before=$(contents)
  for call in "ros_map.toml --out out" "validate ros_map.toml" "ros_map.toml"; do
    # shellcheck disable=SC2086
    expect_status 2 "$host" $call
    [[ $(messages) == 1 ]] || fail "$change: not one line but: $(cat "$scratch/stderr")"
    grep -Eq "^$pattern" "$scratch/stderr" || fail "'$(cat "$scratch/stderr")' does not match '$pattern'"
    [[ $(contents) == "$before" && ! -e out && ! -e runs ]] || fail "$change: something was written"
  done
  cat "$scratch/stderr"
  cp "$scratch/whole" "$file"
}
map=ros_map/flat
expect_mistake $map.pgm '1s/P2/P7/' "$map.pgm:1:1: expected a PGM"
expect_mistake $map.pgm '30,$d' "$map.pgm:[0-9]+:[0-9]+: the file ends before a grey value"
expect_mistake $map.pgm '3s/.*/40000 25000/' "$map.pgm:1:3: the map is too large: 40000 x 25000 cells"
expect_mistake $map.yaml 's/^resolution: 0.1/resolution: 0.0/' "$map.yaml:3:13: 'resolution' must be from"
expect_mistake $map.yaml 's/^image: flat/image: flap/' "$map.yaml:2:8: no file 'flap.pgm'"
expect_mistake $map.yaml '/^image/d' "$map.yaml:[0-9]+:1: the map needs 'image'"
expect_mistake $map.yaml 's/\]//' "$map.yaml:[0-9]+:[0-9]+: "
expect_mistake $map.toml 's/"occupied"/"ocupied"/' "$map.toml:[0-9]+:[0-9]+: 'unknown' must be one of .*did you mean 'occupied'"
expect_mistake ros_map.toml 's/tuned.dwa/tuned\/dwo/' "ros_map.toml:[0-9]+:[0-9]+: no parameter file .*did you mean 'controllers/tuned/dwa.toml'"
cp "$(dirname "$host")/../share/dmrp/parameter_sets/controllers/tuned/dwa.toml" mine.toml
sed -i 's|"controllers/tuned/dwa.toml"|"mine.toml"|' ros_map.toml
expect_status 0 "$host" validate ros_map.toml
echo "sim_tme = 1.0" >>mine.toml
expect_mistake mine.toml '1d' "mine.toml:[0-9]+:1: unknown key 'sim_tme' for dmrp.controller.dwa \(did you mean 'sim_time'"
