#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_catches_breaches.sh SOURCE_DIR: breaks a copy of the tree in every way that check.sh forbids and asks that it
# names the file each time.
set -euo pipefail
check=$(dirname "$(realpath "${BASH_SOURCE[0]}")")/check.sh
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT

cp -r "$1"/{sdk,core,host,plugins,examples} "$copy"
mkdir -p "$copy"/{core,host,plugins/planners/broken,plugins/planners/other}/deep
touch "$copy"/{core/deep/world_probe.hpp,host/deep/trial_probe.hpp,plugins/planners/other/search_probe.hpp}

"$check" "$copy" >/dev/null || { echo "the unbroken copy fails" && "$check" "$copy"; }

# expect PASS|FAIL FILE TEXT: the verdict on the copy with one more file
expect() {
  local verdict=PASS output
  mkdir -p "$(dirname "$copy/$2")"
  printf '%s\n' "$3" >"$copy/$2"
  output=$("$check" "$copy") || verdict=FAIL
  [[ $verdict == FAIL && $output != *"$2:"* ]] && verdict="FAIL elsewhere"
  rm "$copy/$2"
  [[ $verdict == "$1" ]] && return
  echo "expected $1, got $verdict: $2 with: $3"
  echo "$output"
  exit 1
}

# each way of writing an include
expect FAIL plugins/planners/broken/a.cpp '#include "core/deep/world_probe.hpp"'
expect FAIL plugins/planners/broken/a.cpp '#include "../../../core/deep/world_probe.hpp"'
expect FAIL plugins/planners/broken/a.cpp '#include <deep/world_probe.hpp>'
expect FAIL plugins/planners/broken/a.hpp '  #  include "world_probe.hpp"  // indented'
# each pair of parts
expect FAIL plugins/planners/broken/a.cpp '#include "host/deep/trial_probe.hpp"'
expect FAIL sdk/include/dmrp/a.h '#include "core/deep/world_probe.hpp"'
expect FAIL sdk/include/dmrp/a.h '#include "host/deep/trial_probe.hpp"'
expect FAIL sdk/include/dmrp/a.h '#include "plugins/planners/other/search_probe.hpp"'
expect FAIL core/a.cpp '#include "host/deep/trial_probe.hpp"'
expect FAIL core/a.cpp '#include "plugins/planners/other/search_probe.hpp"'
expect FAIL host/a.cpp '#include "other/search_probe.hpp"'
expect FAIL examples/plugin/a.cpp '#include "plugins/planners/other/search_probe.hpp"'
# link lines, plugin ids, and what core leaves to the host
expect FAIL plugins/planners/broken/CMakeLists.txt 'target_link_libraries(broken PRIVATE dmrp::core)'
expect FAIL core/a/CMakeLists.txt 'target_link_libraries(a PRIVATE dmrp_host)'
expect FAIL host/a.cpp 'const char* fallback = "dmrp.planner.cbs";'
expect FAIL core/a.cpp 'const char* column = "dmrp.metric.sto";'
expect FAIL core/a.cpp '#include <iostream>'
# what is allowed
expect PASS core/a.cpp '#include <dmrp/values.h>'
expect PASS host/a.cpp '#include "core/deep/world_probe.hpp"'
expect PASS plugins/planners/broken/a.cpp '#include "planners/other/search_probe.hpp"'
expect PASS plugins/planners/broken/a.cpp '#include <vector>'
expect PASS host/a.cpp '// ids as in dmrp.planner.*'

echo "every breach is caught"
