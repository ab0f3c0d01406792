#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A host of the next minor version: every struct of the headers has grown, and no line of the host was touched. It is
# built, and libraries that were built with today's headers run on it as on today's host: the shipped ones, the
# templates, and plugins in C. WORK_DIR is emptied, and holds the build: in a build tree, so that ccache knows it again.
# Called as: grown_host.sh DMRP_HOST SOURCE_DIR WORK_DIR
source "$(dirname "${BASH_SOURCE[0]}")/../../end_to_end/checks.sh"
set -e
grown_scripts=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source_dir=$(realpath "$2") work=$3
installed=$(dirname "$(dirname "$host")")
rm -rf "$work"
mkdir -p "$work/tree/sdk"
work=$(realpath "$work")

# The tree of today, but for the headers.
for entry in "$source_dir"/* "$source_dir"/sdk/*; do
  to=$work/tree/${entry#"$source_dir/"}
  [[ $entry == */sdk || $entry == */include || $entry == */build ]] || ln -s "$entry" "$to"
done
"$grown_scripts/grow.sh" "$source_dir/sdk/include" "$work/tree/sdk/include"
cmake -S "$work/tree" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release >"$work/configured.txt"
cmake --build "$work/build" --target dmrp-host >"$work/built.txt" || { tail -40 "$work/built.txt" && exit 1; }
later=$work/build/bin/dmrp-host
mkdir -p "$work/build/lib/dmrp"
rm -rf "$work/build/lib/dmrp/plugins" "$work/build/share"
cp -r "$installed/lib/dmrp/plugins" "$work/build/lib/dmrp/plugins"  # built-in only there
ln -s "$installed/share" "$work/build/share"

# Libraries of today.
mkdir "$work/plugins"
cd "$work/plugins"
flags=(-O2 -ffp-contract=off -fPIC -shared -fvisibility=hidden -I "$source_dir" -I "$source_dir/sdk/include")
for kind in planner controller pedestrian-model metric; do
  sed "s/org.example.my_plugin/org.example.$kind/" "$source_dir/examples/templates/$kind/my_plugin.cpp" >"$kind.cpp"
  g++ -std=c++17 "${flags[@]}" "$kind.cpp" -o "lib$kind.so"
done
gcc -std=c99 "${flags[@]}" "$source_dir/examples/other_languages/planner.c" -lm -o libplanner_in_c.so
python3 "$source_dir/tests/abi/old_plugins/mix.py" "$source_dir/tests/abi/v1.txt" >mixed_fields.h
gcc -std=c99 "${flags[@]}" -I . "$source_dir/tests/abi/old_plugins/controller.c" -lm -o libcontroller_in_c.so

# both NAME COMMAND...: the output of each host, with HOST in its place, is the same
both() {
  local name=$1
  shift
  expect_status 0 "${@/HOST/$host}"
  sed "s,^.*/lib/,lib/," "$scratch/stdout" >"$name.today"
  expect_status 0 "${@/HOST/$later}"
  sed "s,^.*/lib/,lib/," "$scratch/stdout" | diff "$name.today" - || fail "$name differs"
}
for library in libdmrp_{planners,controllers,pedestrians,metrics}.so ./*.so; do
  both "$(basename "$library").plugins" HOST plugins "$library"
done
for library in planner controller pedestrian-model metric planner_in_c; do
  expect_status 0 "$later" check "./lib$library.so"
done
for planner in org.example.planner org.example.planner_in_c dmrp.planner.cbs; do
  plugin=()
  case $planner in
    *.planner) plugin=(--plugin ./libplanner.so) ;;
    *_in_c) plugin=(--plugin ./libplanner_in_c.so) ;;
  esac
  expect_status 0 "$host" plan --scenario tours "${plugin[@]}" --planner "$planner" --paths today.paths
  expect_status 0 "$later" plan --scenario tours "${plugin[@]}" --planner "$planner" --paths later.paths
  cmp today.paths later.paths || fail "$planner plans otherwise"
done

cat >experiment.toml <<'END'
[experiment]
seed = 1
trials = 1
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so",
           "./libplanner.so", "./libcontroller.so", "./libpedestrian-model.so", "./libmetric.so",
           "./libcontroller_in_c.so"]
[simulation]
time_limit_s = 60.0
[[scenario]]
use = "library"
[[global_planner]]
use = "org.example.planner"
[[global_planner]]
use = "dmrp.planner.eecbs"
[[local_controller]]
use = "org.example.controller"
[[local_controller]]
use = "org.example.mixing_in_c"
[[local_controller]]
use = "dmrp.controller.teb"
[[pedestrian_model]]
use = "org.example.pedestrian-model"
[[pedestrian_model]]
use = "dmrp.pedestrian.social_force"
END
expect_status 0 "$host" experiment.toml --quiet --jobs 2 --out run.today
expect_status 0 "$later" experiment.toml --quiet --jobs 2 --out run.later
diff <(values_of run.today) <(values_of run.later) || fail "trials have other values"
trials=$(query run.today "SELECT count(*) FROM trial WHERE outcome <> 'fault';")
((trials == 12)) || fail "$trials trials of 12 without a fault"
libraries=(./*.so "$installed"/lib/dmrp/plugins/*.so)
echo "${#libraries[@]} libraries, 3 planners, $trials trials: the same on the grown host"
