#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The steps of examples/nav2/README.md with nav2's sources: they are built as they are, nav2's own tests of MPPI pass,
# and its controllers and one of somebody's own drive in trials that repeat to the bit. Called as: nav2.sh DMRP_HOST
# [NAV2_SOURCE_DIR]. The sources are DMRP_NAV2_SOURCE_DIR, or ../shared/third_party/nav2-* beside the source tree. Exit
# status 77: skipped, there are none. It builds for some minutes.
source "$(dirname "${BASH_SOURCE[0]}")/../end_to_end/checks.sh"
source_dir=$(cd "$here/../.." && pwd)
nav2=${2:-${DMRP_NAV2_SOURCE_DIR:-}}
[[ -n $nav2 ]] || nav2=$(find "$source_dir/../shared/third_party" -maxdepth 1 -name 'nav2-*' 2>/dev/null | sort | tail -1)
if [[ ! -e $nav2/nav2_core/include/nav2_core/controller.hpp ]]; then
  echo "skipped: DMRP_NAV2_SOURCE_DIR is not set"
  exit 77
fi
nav2=$(realpath "$nav2")

hashes() {
  (cd "$nav2" && find . -type f -print0 | sort -z | xargs -0 sha256sum)
}

# --- built outside of the source tree, with the installed SDK ---
hashes >"$scratch/before"
expect_status 0 cmake --install "$(dirname "$(dirname "$host")")" --prefix "$scratch/installed"
cp -r "$source_dir/examples/nav2" "$scratch/nav2" && rm -rf "$scratch/nav2/build"
cd "$scratch/nav2" || exit 1
expect_status 0 cmake -S . -B build -DCMAKE_PREFIX_PATH="$scratch/installed" -DNAV2_SOURCE_DIR="$nav2" -DNAV2_TESTS=ON \
  -DNAV2_MY_SOURCES="$PWD/my_controller/follow_the_line.cpp" \
  -DNAV2_MY_CONTROLLERS="org.example.follow_the_line=my_controller::FollowTheLine" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
expect_status 0 cmake --build build -j 2
host=$scratch/installed/bin/dmrp-host

# --- every file that was compiled is one of ours or lies in nav2's folder, and that folder is as it was ---
grep -oP '"file": "\K[^"]+' build/compile_commands.json | sort -u >"$scratch/compiled"
grep -F "$nav2/" "$scratch/compiled" >"$scratch/of_nav2"
(($(wc -l <"$scratch/of_nav2") >= 60)) || fail "only $(wc -l <"$scratch/of_nav2") files of nav2 were compiled"
! grep -vF -e "$nav2/" -e "$scratch/nav2/" "$scratch/compiled" || fail "compiled a file of neither nav2 nor ours"
while IFS= read -r file; do
  cmp "$file" "$nav2/${file#"$nav2/"}" || fail "$file is not nav2's"
done <"$scratch/of_nav2"
hashes | cmp - "$scratch/before" || fail "the build has changed nav2's folder"
shim_lines=$(find "$source_dir/examples/nav2/shim" -type f -exec cat {} + | wc -l)
echo "the shim has $shim_lines lines; $(wc -l <"$scratch/of_nav2") files of nav2 were compiled as they are"
((shim_lines < 1500)) || fail "the shim should stay below 1,500 lines"
while IFS= read -r file; do
  ! grep -qF "$(sha256sum <"$file" | cut -d' ' -f1)" "$scratch/before" || fail "$file is a copy of a file of nav2"
done < <(find "$source_dir/examples/nav2" -name build -prune -o -type f -size +0 -print)

# --- nav2's own tests ---
expect_status 0 ctest --test-dir build --output-on-failure

# --- the plugins ---
expect_status 0 "$host" plugins build/libdmrp_nav2.so
for id in nav2.{mppi,dwb,regulated_pure_pursuit,graceful} org.example.follow_the_line; do
  grep -q "$id" "$scratch/stdout" || fail "the library has no $id"
done
expect_status 0 "$host" check build/libdmrp_nav2.so
[[ $(nm -D --defined-only build/libdmrp_nav2.so | awk '{print $3}') == dmrp_entry_v1 ]] ||
  fail "libdmrp_nav2.so should export dmrp_entry_v1 alone"

# experiment NAME ID PARAMETER_FILE: one robot in the mall, called at 20 Hz
experiment() {
  cat <<TOML
[experiment]
name    = "$1"
seed    = 1
trials  = 2
plugins = ["libdmrp_planners.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so", "./build/libdmrp_nav2.so"]
[[scenario]]
use    = "mall"
robots = 2
[[global_planner]]
use = "dmrp.planner.cbs"
[[pedestrian_model]]
use = "dmrp.pedestrian.social_force"
[simulation]
step_s           = 0.025
control_period_s = 0.05
goal_tolerance_m = 0.25
[robot]
footprint = { radius_m = 0.22 }
v_max     = 0.5
v_min     = -0.35
omega_max = 1.9
a_max     = 3.0
alpha_max = 3.5
[[local_controller]]
use = "$2"
TOML
  [[ -z ${3:-} ]] || echo "params = { nav2_params = \"$3\" }"
}

# --- all drive the mall, and repeat to the bit ---
printf 'a: {ros__parameters: {FollowPath: {plugin: "my_controller::FollowTheLine", speed: 0.6}}}\n' >mine.yaml
drive() {
  local name=$1
  experiment "$@" >"$name.toml"
  expect_status 0 "$host" "$name.toml" --quiet --jobs 1 --out "$name"
  expect_status 0 "$host" "$name.toml" --quiet --jobs 2 --out "$name-again"
  [[ $(values_of "$name") == "$(values_of "$name-again")" ]] || fail "$name does not repeat to the bit"
  [[ $(query "$name" "SELECT count(*) FROM fault") == 0 ]] || fail "$name: $(query "$name" "SELECT * FROM fault")"
  local arrived
  arrived=$(query "$name" "SELECT sum(value) FROM value WHERE metric = 'success' AND subject_kind = 'robot'")
  echo "$name: $arrived of 4 robots arrived"
  [[ ${arrived%.*} -ge 3 ]] || fail "$name: only $arrived of 4 robots arrived"
}
drive mppi nav2.mppi params/mppi.yaml
drive dwb nav2.dwb params/dwb.yaml
drive pure_pursuit nav2.regulated_pure_pursuit params/regulated_pure_pursuit.yaml
drive graceful nav2.graceful params/graceful.yaml
drive mine org.example.follow_the_line mine.yaml

# --- parameter files with mistakes: one line with the place ---
# refused TEXT: the only trial ends in a fault that says so
refused() {
  expect_status 1 "$host" mistake.toml --quiet --trials 1 --out mistake
  query mistake "SELECT detail FROM fault LIMIT 1" | grep -qF "$1" ||
    fail "expected '$1': $(query mistake "SELECT detail FROM fault")"
  rm -r mistake
}
experiment mistake nav2.mppi mistake.yaml >mistake.toml
printf 'a:\n  ros__parameters:\n    FollowPath: {vx_max: 1}\n' >mistake.yaml
refused "mistake.yaml:3:26: parameter 'FollowPath.vx_max' has invalid type: expected [double] got [integer]"
printf 'a:\n  ros__parameters:\n    FollowPath: {plugin: "dwb_core::DWBLocalPlanner"}\n' >mistake.yaml
refused "FollowPath.plugin is 'dwb_core::DWBLocalPlanner', but this controller is 'nav2_mppi_controller::MPPIController'"
printf 'a:\n  b: [1\n' >mistake.yaml
refused "mistake.yaml:3:1: expected YAML"
printf 'a: 1\n' >mistake.yaml
refused "mistake.yaml:1:1: expected a node with ros__parameters that has a section FollowPath"
# found when MPPI's thread draws noise already
printf 'a:\n  ros__parameters:\n    FollowPath: {regenerate_noises: true, prune_distance: 1}\n' >mistake.yaml
refused "mistake.yaml:3:59: parameter 'FollowPath.prune_distance' has invalid type"
printf 'a:\n  ros__parameters:\n    FollowPath: {model_dt: 0.02}\n' >mistake.yaml
refused "Controller period more then model dt"
printf 'a:\n  ros__parameters:\n    FollowPath: {critics: [NoCritic]}\n' >mistake.yaml
refused "no class 'mppi::critics::NoCritic'"

# --- keys that nobody reads are told of; so is noise from a thread, which ends with its trial ---
sed 's/regenerate_noises: false/regenerate_noises: true/; s/batch_size: 2000/batch_size: 200\n      vx_maxx: 1.0/' \
  params/mppi.yaml >warned.yaml
experiment warned nav2.mppi warned.yaml >warned.toml
expect_status 0 "$host" warned.toml --quiet --jobs 1 --out warned
grep -q "warned.yaml:.*nav2_mppi_controller::MPPIController does not read 'FollowPath.vx_maxx'" warned/log.txt ||
  fail "a key that nobody reads should be told of: $(cat warned/log.txt)"
grep -q "regenerate_noises is true" warned/log.txt || fail "noise from a thread should be told of"
[[ $(query warned "SELECT sum(repeatable) FROM trial") == 0 ]] || fail "noise from a thread does not repeat"
[[ $(query warned "SELECT DISTINCT plugin, reason FROM timing") == "nav2.mppi|FollowPath.regenerate_noises is true"* ]] ||
  fail "the results should say why"
[[ $(query mppi "SELECT sum(repeatable) FROM trial") == 2 ]] || fail "other trials repeat"

# --- what is published is in the traces, and no result depends on it ---
for name in mppi dwb pure_pursuit graceful; do
  { cat "$name.toml" && printf '[record]\nannotations = true\n'; } >"$name-shown.toml"
  expect_status 0 "$host" "$name-shown.toml" --quiet --jobs 2 --out "$name-shown"
  [[ $(values_of "$name") == "$(values_of "$name-shown")" ]] || fail "$name: annotations change the results"
  bytes=$(stat -c %s "$name"/traces/trial_000000.mcap) shown=$(stat -c %s "$name-shown"/traces/trial_000000.mcap)
  echo "$name: trace of $bytes bytes, $shown with annotations"
  ((shown * 100 > bytes * 104)) || fail "$name annotates nothing"
done
echo "nav2: passed after $SECONDS s"
