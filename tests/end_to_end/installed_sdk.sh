#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The steps of a third party: the installation, moved to another folder; plugins from its templates, built against it in
# separate folders; their experiments. Called as: installed_sdk.sh DMRP_HOST SOURCE_DIR CMAKE C_COMPILER
# CXX_COMPILER
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
source_dir=$2 cmake=$3 cc=$4 cxx=$5
build_dir=$(dirname "$(dirname "$host")")

expect_status 0 "$cmake" --install "$build_dir" --prefix "$scratch/installed"

# a run of an installation that is gone is verified by another, and by the build tree; and the reverse
expect_status 0 "$scratch/installed/bin/dmrp-host" "$source_dir/examples/quickstart.toml" --quiet --trials 1 --out "$scratch/run"
mv "$scratch/installed" "$scratch/moved"
expect_status 0 "$host" "$here/crossing.toml" --quiet --trials 1 --out "$scratch/run_of_build"
for name in libdmrp_planners.so libdmrp_controllers.so libdmrp_pedestrians.so libdmrp_metrics.so; do
  grep -q "\"$name\"" "$scratch/run_of_build/effective.toml" || fail "$name should be named alone: $(head "$scratch/run_of_build/effective.toml")"
done
for program in "$host" "$scratch/moved/bin/dmrp-host"; do
  for run in run run_of_build; do
    expect_status 0 "$program" verify "$scratch/$run" --trials 1
    [[ ! -s $scratch/stderr ]] || fail "$program on $run: nothing has changed: $(cat "$scratch/stderr")"
  done
done
prefix=$scratch/moved
for file in include/dmrp/dmrp.h include/dmrp/plugin.hpp include/dmrp/toolkit/angle.hpp \
  lib/cmake/dmrp/{dmrpConfig,dmrpConfigVersion,dmrpTargets,dmrp_add_plugin}.cmake lib/cmake/dmrp/plugin_exports.map \
  bin/dmrp-host lib/dmrp/plugins/libdmrp_{planners,controllers,pedestrians,metrics}.so \
  share/dmrp/layouts/summary.json share/dmrp/scenarios/mall/scenario.toml \
  share/dmrp/parameter_sets/controllers/tuned/dwa.toml share/pkgconfig/dmrp.pc; do
  [[ -f $prefix/$file ]] || fail "$file is not installed"
done
# whole folders of theirs: a source tree at /dmrp is no prefix of ${CMAKE_CURRENT_LIST_DIR}/dmrpTargets
made_here=(-e "$source_dir/sdk" -e "$build_dir/" -e "$scratch/installed")
! grep -rqF "${made_here[@]}" "$prefix/include" "$prefix/lib/cmake" ||
  fail "the package knows where it was made: $(grep -rF "${made_here[@]}" "$prefix/include" "$prefix/lib/cmake")"

# build FOLDER: as its README says, with the prefix only
build() {
  expect_status 0 env -u CFLAGS -u CXXFLAGS CC="$cc" CXX="$cxx" \
    "$cmake" -S "$1" -B "$1/build" -DCMAKE_PREFIX_PATH="$prefix"
  expect_status 0 "$cmake" --build "$1/build"
}

# run_printed PROGRAM KIND ID FOLDER: writes the folder, and runs the command that this prints
run_printed() {
  expect_status 0 "$1" new "$2" --id "$3" "$4"
  sed -n '$s/^ *//p' "$scratch/stdout" >"$scratch/printed"
  expect_status 0 env -u CFLAGS -u CXXFLAGS CC="$cc" CXX="$cxx" PATH="$(dirname "$cmake"):$PATH" bash -e "$scratch/printed"
  grep -qxF "DMRP_HOST:FILEPATH=$(realpath "$1")" "$4/build/CMakeCache.txt" || fail "$4 should be tested by $1"
}

# the folder finds the dmrp that wrote it, be it a build tree, and builds against another where one is named
cd "$scratch" || exit 1
run_printed "$host" metric org.example.of_build of_build
rm -r of_build/build
build of_build
grep -qxF "DMRP_HOST:FILEPATH=$prefix/bin/dmrp-host" of_build/build/CMakeCache.txt || fail "another dmrp was named"
rm -r of_build/build
sed -i "s|HINTS \".*\"|HINTS \"$scratch/gone\"|" of_build/CMakeLists.txt # as on another machine
expect_status 0 env CC="$cc" CXX="$cxx" "$cmake" -S of_build -B of_build/build -Ddmrp_DIR="$build_dir/lib/cmake/dmrp"

# the template of a controller: built and tested by CMake
run_printed "$prefix/bin/dmrp-host" controller org.example.carrot mine
[[ $(nm -D --defined-only mine/build/libcarrot.so | awk '{print $3}') == dmrp_entry_v1 ]] ||
  fail "libcarrot.so should export dmrp_entry_v1 alone"
[[ $(query mine/build/runs/carrot "SELECT count(*), min(outcome), (SELECT count(*) FROM fault) FROM trial") == 2*"|0" ]] ||
  fail "the template should drive: $(query mine/build/runs/carrot "SELECT * FROM trial; SELECT * FROM fault")"
[[ $(query mine/build/runs/carrot "SELECT min(value) > 0.5 FROM value WHERE metric = 'success' AND subject_kind = 'system'") == 1 ]] ||
  fail "the template should bring most robots to their goals"

# the other templates: built by the README's command without CMake
for kind in planner pedestrian-model metric; do
  expect_status 0 "$prefix/bin/dmrp-host" new "$kind" --id "org.example.${kind}_1" "$kind"
  awk '/^```/ { fenced = !fenced; if (fenced) ++block; next } fenced && block == 2' "$kind/README.md" >"$kind/commands"
  (cd "$kind" && PKG_CONFIG_PATH=$prefix/share/pkgconfig expect_status 0 bash -e commands) || exit 1
  [[ ! -s $scratch/stderr ]] || fail "$kind: the command warns: $(cat "$scratch/stderr")"
  name=${kind//-/_}_1
  expect_status 0 "$prefix/bin/dmrp-host" check "$kind/build/lib$name.so"
  expect_status 0 "$prefix/bin/dmrp-host" "$kind/$name.toml" --quiet --trials 1 --out "run_$kind"
  [[ $(query "run_$kind" "SELECT count(*), (SELECT count(*) FROM fault) FROM trial") == "2|0" ]] ||
    fail "$kind: $(query "run_$kind" "SELECT * FROM trial; SELECT * FROM fault")"
  [[ $(query "run_$kind" "SELECT min(value) > 0.5 FROM value WHERE metric = 'success' AND subject_kind = 'system'") == 1 ]] ||
    fail "$kind: most robots should arrive"
done
[[ $(query run_metric "SELECT count(*) FROM value WHERE metric = 'time_near_people' AND subject_kind = 'system' AND value > 0") == 2 ]] ||
  fail "the template of a metric should measure something"

# tours that meet in a lane; the host checks the plan
expect_status 0 "$prefix/bin/dmrp-host" plan --scenario tours --plugin planner/build/libplanner_1.so --planner org.example.planner_1
grep -q "cost  *56$" "$scratch/stdout" || fail "the template should plan the tours: $(cat "$scratch/stdout")"

# versions: before 1.0 a minor version may change the contract
for wish in "" 0 0.1 0.1.0; do
  printf 'cmake_minimum_required(VERSION 3.16)\nproject(p LANGUAGES NONE)\nfind_package(dmrp %s REQUIRED)\n' "$wish" >CMakeLists.txt
  expect_status 0 "$cmake" -S . -B "version_$wish" -DCMAKE_PREFIX_PATH="$prefix"
done
for wish in 0.0 0.2 0.1.7 1; do
  sed -i "s/find_package.*/find_package(dmrp $wish REQUIRED)/" CMakeLists.txt
  expect_status 1 "$cmake" -S . -B "version_$wish" -DCMAKE_PREFIX_PATH="$prefix"
done

cp -r "$here/plugin_in_c" "$scratch/in_c"
build "$scratch/in_c"
sed 's|libdmrp_controllers|./in_c/build/libturner|; /^\[\[local_controller/,/^$/d' "$here/crossing.toml" >turner.toml
printf '\n[[local_controller]]\nuse = "org.example.turner"\nparams = { rate = 0.8 }\n' >>turner.toml
expect_status 0 "$prefix/bin/dmrp-host" turner.toml --quiet --trials 1 --out turned
[[ $(query turned "SELECT count(*), min(outcome), (SELECT count(*) FROM fault) FROM trial") == "2|failed|0" ]] ||
  fail "a controller that turns on the spot should arrive nowhere, without a fault"
