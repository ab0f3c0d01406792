#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_catches_breaches.sh: writes a small tree in the dialect, breaks it in each way that check.sh refuses, and asks that
# check.sh names the broken file and nothing else.
set -euo pipefail
check=$(dirname "$(realpath "${BASH_SOURCE[0]}")")/check.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
licence='// SPDX-License-Identifier: MIT'

add() {
  mkdir -p "$(dirname "$tree/$1")"
  printf '%s\n' "${@:2}" >"$tree/$1"
}
add core/world/world.hpp "$licence" '// The world.' '' '#pragma once'
add core/world/world.cpp "$licence" '#include "core/world/world.hpp"' '#include <vector>' '// not setlocale()'
add host/trial/trial.cpp "$licence" '  #  include "core/world/world.hpp"'
add plugins/planners/mapf/problem.hpp "$licence" '#pragma once'
add plugins/planners/mapf/problem.cpp "$licence" '#include "planners/mapf/problem.hpp"'
add sdk/include/dmrp/plugin.hpp "$licence" '#pragma once' '#include "cpp/span.hpp"' '#include "../dmrp/cpp/span.hpp"'
add sdk/include/dmrp/cpp/span.hpp "$licence" '#pragma once'
add examples/CMakeLists.txt '# SPDX-License-Identifier: MIT'
add .ci/run '#!/usr/bin/env bash' '# SPDX-License-Identifier: MIT'
add tests/unit/core/world/world_test.cpp "$licence" '#include "tests/unit/core/sample.hpp"' 'TEST_CASE("x") {}' 'setlocale(LC_ALL, "");'
add tests/unit/core/sample.hpp "$licence" '#pragma once'
add tests/unit/planners/mapf/problem_test.cpp "$licence"
add core/build/generated.hpp 'anything'
"$check" "$tree" >/dev/null || { echo "the unbroken tree fails:" && "$check" "$tree"; }

caught=0
# refuse FILE LINE...: with this file alone added, check.sh names it or its folder, once
refuse() {
  local output status=0
  add "$@"
  output=$("$check" "$tree") || status=$?
  if [[ $status != 1 || $output != *"${1%/*}"* || $(wc -l <<<"$output") != 2 ]]; then
    printf 'not caught alone: %s: %s\n%s\n' "$1" "${*:2}" "$output"
    exit 1
  fi
  rm "$tree/$1"
  caught=$((caught + 1))
}
refuse core/world/a.cpp '#include <vector>'
refuse core/world/a.cpp '' "$licence"
refuse tests/a.sh '#!/usr/bin/env bash' 'true' '# SPDX-License-Identifier: MIT'
refuse .ci/quick '#!/usr/bin/env bash' 'true'
refuse core/world/a.hpp "$licence" '#ifndef A_HPP' '#pragma once'
refuse sdk/include/dmrp/a.hpp "$licence" '#include <vector>'
refuse core/world/a.cpp "$licence" '#include "world.hpp"'
refuse core/world/a.cpp "$licence" '#include "world/world.hpp"'
refuse core/world/a.cpp "$licence" '#include "../world/world.hpp"'
refuse plugins/planners/a.cpp "$licence" '#include "mapf/problem.hpp"'
refuse tests/unit/core/world/a.cpp "$licence" 'TEST_CASE("x") {}'
refuse core/world/a.cpp "$licence" 'using namespace std;'
refuse core/world/a.cpp "$licence" 'request.enable_signed_distance = true;'
refuse tests/bench/a.cpp "$licence" 'fcl::Cylinderd(0.3, 1.0)'
refuse host/trial/a.cpp "$licence" '  setlocale(LC_ALL, "C");'
refuse tests/unit/core/nowhere/a_test.cpp "$licence"
echo "$caught breaches caught"
