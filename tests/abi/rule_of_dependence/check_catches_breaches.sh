#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_catches_breaches.sh SOURCE_DIR: breaks a copy of the tree in every way that check.sh forbids, adds some things
# that it allows, and asks that it names the former files and none of the latter.
set -euo pipefail
check=$(dirname "$(realpath "${BASH_SOURCE[0]}")")/check.sh
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT

cp -r "$1"/{sdk,core,host,plugins,examples} "$copy"
mkdir -p "$copy"/core/world "$copy"/host/trial "$copy"/plugins/planners/mapf
touch "$copy"/{core/world/world_probe.hpp,host/trial/trial_probe.hpp,plugins/planners/mapf/search_probe.hpp}
"$check" "$copy" >/dev/null || { echo "the unbroken copy fails" && "$check" "$copy"; }

forbidden=() allowed=()
add() {
  mkdir -p "$(dirname "$copy/$1")"
  printf '%s\n' "$2" >"$copy/$1"
}
forbid() { add "$@" && forbidden+=("$1"); }
allow() { add "$@" && allowed+=("$1"); }

# each way of writing an include
forbid plugins/planners/cbs/broken_a.cpp '#include "core/world/world_probe.hpp"'
forbid plugins/planners/cbs/broken_b.cpp '#include "../../../core/world/world_probe.hpp"'
forbid plugins/planners/cbs/broken_c.cpp '#include <world/world_probe.hpp>'
forbid plugins/planners/cbs/broken_d.hpp '  #  include "world_probe.hpp"  // indented'
# each pair of parts
forbid plugins/planners/cbs/broken_e.cpp '#include "host/trial/trial_probe.hpp"'
forbid sdk/include/dmrp/a.h '#include "core/world/world_probe.hpp"'
forbid sdk/include/dmrp/b.h '#include "host/trial/trial_probe.hpp"'
forbid sdk/include/dmrp/c.h '#include "plugins/planners/mapf/search_probe.hpp"'
forbid core/statistics/broken_a.cpp '#include "host/trial/trial_probe.hpp"'
forbid core/statistics/broken_b.cpp '#include "plugins/planners/mapf/search_probe.hpp"'
forbid host/trial/broken_a.cpp '#include "mapf/search_probe.hpp"'
forbid examples/broken/a.cpp '#include "plugins/planners/mapf/search_probe.hpp"'
# rooms: an arrow up, in each part, and a folder that nobody has given a place
forbid core/scene/broken_f.cpp '#include "core/world/world_probe.hpp"'
forbid host/files/broken_f.cpp '#include "host/trial/trial_probe.hpp"'
forbid plugins/planners/mapf/broken_f.cpp '#include "planners/cbs/cbs.hpp"'
forbid core/cellar/f.cpp '#include <vector>'
# a room that is too full
for ((source = 1; source < 33; ++source)); do add "host/program/full_$source.cpp" ''; done
forbid host/program/full_33.cpp ''
# link lines, plugin ids, and what core leaves to the host
forbid plugins/planners/cbs/CMakeLists.txt 'target_link_libraries(broken PRIVATE dmrp::core)'
forbid core/statistics/CMakeLists.txt 'target_link_libraries(broken PRIVATE dmrp_host)'
forbid host/trial/broken_b.cpp 'const char* fallback = "dmrp.planner.cbs";'
forbid core/statistics/broken_c.cpp 'const char* column = "dmrp.metric.sto";'
forbid core/statistics/broken_d.cpp '#include <iostream>'

allow core/world/fine_a.cpp '#include <dmrp/values.h>'
allow host/trial/fine_a.cpp '#include "core/world/world_probe.hpp"'
allow host/trial/fine_b.cpp '// ids as in dmrp.planner.*'
allow core/sensors/fine_b.cpp '#include "core/world/world_probe.hpp"'
allow plugins/planners/cbs/fine_a.cpp '#include "planners/mapf/search_probe.hpp"'
allow plugins/planners/cbs/fine_b.cpp '#include <vector>'

wrong=0
complain() { echo "$1" && wrong=1; }

status=0
output=$("$check" "$copy") || status=$?
((status == 1)) || complain "exit status $status instead of 1"
for file in "${forbidden[@]}"; do
  [[ $output == *"$file:"* || $output == *"${file%/*}:1: this room"* ]] || complain "not caught: $file: $(<"$copy/$file")"
done
for file in "${allowed[@]}"; do
  [[ $output != *"$file:"* ]] || complain "refused: $file: $(<"$copy/$file")"
done
((wrong == 0)) || { echo "$output" && exit 1; }
echo "${#forbidden[@]} breaches caught, ${#allowed[@]} lawful files let pass"
