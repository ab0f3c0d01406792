#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The steps of a third party: the installation, moved to another folder; a plugin built against it in a separate folder; an
# experiment that names the .so by its path. Called as: installed_sdk.sh DMRP_HOST SOURCE_DIR CMAKE C_COMPILER
# CXX_COMPILER
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
source_dir=$2 cmake=$3 cc=$4 cxx=$5
build_dir=$(dirname "$(dirname "$host")")

expect_status 0 "$cmake" --install "$build_dir" --prefix "$scratch/installed"
mv "$scratch/installed" "$scratch/moved"
prefix=$scratch/moved
for file in include/dmrp/dmrp.h include/dmrp/plugin.hpp include/dmrp/toolkit/angle.hpp \
  lib/cmake/dmrp/{dmrpConfig,dmrpConfigVersion,dmrpTargets,dmrp_add_plugin}.cmake lib/cmake/dmrp/plugin_exports.map \
  bin/dmrp-host lib/dmrp/plugins/libdmrp_{planners,controllers,pedestrians,metrics}.so \
  share/dmrp/layouts/summary.json share/dmrp/scenarios/mall/scenario.toml \
  share/dmrp/parameter_sets/controllers/tuned/dwa.toml; do
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

cp -r "$source_dir/examples/plugin_template" "$scratch/mine"
build "$scratch/mine"
[[ $(nm -D --defined-only "$scratch/mine/build/libcarrot.so" | awk '{print $3}') == dmrp_entry_v1 ]] ||
  fail "libcarrot.so should export dmrp_entry_v1 alone"
cp -r "$here/plugin_in_c" "$scratch/in_c"
build "$scratch/in_c"

cd "$scratch" || exit 1
expect_status 0 "$prefix/bin/dmrp-host" plugins mine/build/libcarrot.so
grep -q org.example.carrot "$scratch/stdout" || fail "dmrp-host plugins does not show org.example.carrot"

# the template's own experiment: the shipped mall, the library by its path
expect_status 0 "$prefix/bin/dmrp-host" mine/carrot.toml --quiet --trials 1 --out run
[[ $(query run "SELECT outcome, (SELECT count(*) FROM fault) FROM trial") == @(succeeded|failed)"|0" ]] ||
  fail "the template should drive: $(query run "SELECT * FROM trial; SELECT * FROM fault")"
[[ $(query run "SELECT value > 0.5 FROM value WHERE metric = 'success' AND subject_kind = 'system'") == 1 ]] ||
  fail "the template should bring most robots to their goals"

sed 's|libdmrp_controllers|./in_c/build/libturner|; /^\[\[local_controller/,/^$/d' "$here/crossing.toml" >turner.toml
printf '\n[[local_controller]]\nuse = "org.example.turner"\nparams = { rate = 0.8 }\n' >>turner.toml
expect_status 0 "$prefix/bin/dmrp-host" turner.toml --quiet --trials 1 --out turned
[[ $(query turned "SELECT count(*), min(outcome), (SELECT count(*) FROM fault) FROM trial") == "2|failed|0" ]] ||
  fail "a controller that turns on the spot should arrive nowhere, without a fault"
