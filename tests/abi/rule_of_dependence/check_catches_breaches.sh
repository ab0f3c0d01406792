#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_catches_breaches.sh SOURCE_DIR: breaks a copy of the tree in every way that check.sh forbids, adds some things
# that it allows, and asks that it names the former files and none of the latter.
set -euo pipefail
check=$(dirname "$(realpath "${BASH_SOURCE[0]}")")/check.sh
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT

cp -r "$1"/{sdk,core,host,plugins,examples} "$copy"
mkdir -p "$copy"/{core,host}/deep "$copy"/plugins/planners/other
touch "$copy"/{core/deep/world_probe.hpp,host/deep/trial_probe.hpp,plugins/planners/other/search_probe.hpp}
"$check" "$copy" >/dev/null || { echo "the unbroken copy fails" && "$check" "$copy"; }

forbidden=() allowed=()
add() {
  mkdir -p "$(dirname "$copy/$1")"
  printf '%s\n' "$2" >"$copy/$1"
}
forbid() { add "$@" && forbidden+=("$1"); }
allow() { add "$@" && allowed+=("$1"); }

# each way of writing an include
forbid plugins/planners/broken/a.cpp '#include "core/deep/world_probe.hpp"'
forbid plugins/planners/broken/b.cpp '#include "../../../core/deep/world_probe.hpp"'
forbid plugins/planners/broken/c.cpp '#include <deep/world_probe.hpp>'
forbid plugins/planners/broken/d.hpp '  #  include "world_probe.hpp"  // indented'
# each pair of parts
forbid plugins/planners/broken/e.cpp '#include "host/deep/trial_probe.hpp"'
forbid sdk/include/dmrp/a.h '#include "core/deep/world_probe.hpp"'
forbid sdk/include/dmrp/b.h '#include "host/deep/trial_probe.hpp"'
forbid sdk/include/dmrp/c.h '#include "plugins/planners/other/search_probe.hpp"'
forbid core/broken/a.cpp '#include "host/deep/trial_probe.hpp"'
forbid core/broken/b.cpp '#include "plugins/planners/other/search_probe.hpp"'
forbid host/broken/a.cpp '#include "other/search_probe.hpp"'
forbid examples/broken/a.cpp '#include "plugins/planners/other/search_probe.hpp"'
# link lines, plugin ids, and what core leaves to the host
forbid plugins/planners/broken/CMakeLists.txt 'target_link_libraries(broken PRIVATE dmrp::core)'
forbid core/broken/CMakeLists.txt 'target_link_libraries(broken PRIVATE dmrp_host)'
forbid host/broken/b.cpp 'const char* fallback = "dmrp.planner.cbs";'
forbid core/broken/c.cpp 'const char* column = "dmrp.metric.sto";'
forbid core/broken/d.cpp '#include <iostream>'

allow core/fine/a.cpp '#include <dmrp/values.h>'
allow host/fine/a.cpp '#include "core/deep/world_probe.hpp"'
allow host/fine/b.cpp '// ids as in dmrp.planner.*'
allow plugins/planners/fine/a.cpp '#include "planners/other/search_probe.hpp"'
allow plugins/planners/fine/b.cpp '#include <vector>'

wrong=0
complain() { echo "$1" && wrong=1; }

status=0
output=$("$check" "$copy") || status=$?
((status == 1)) || complain "exit status $status instead of 1"
for file in "${forbidden[@]}"; do
  [[ $output == *"$file:"* ]] || complain "not caught: $file: $(<"$copy/$file")"
done
for file in "${allowed[@]}"; do
  [[ $output != *"$file:"* ]] || complain "refused: $file: $(<"$copy/$file")"
done
((wrong == 0)) || { echo "$output" && exit 1; }
echo "${#forbidden[@]} breaches caught, ${#allowed[@]} lawful files let pass"
