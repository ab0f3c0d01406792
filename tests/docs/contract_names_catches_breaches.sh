#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# contract_names.sh finds names that are gone, and toolkit.sh a header that the page lacks.
# Called as: contract_names_catches_breaches.sh SOURCE_DIR
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$scratch"/{core,host,cmake,packaging,plugins,examples,tests,docs}
cp -r "$1/sdk" "$scratch"
mkdir "$scratch/tests/abi"
cp "$1/tests/abi/describe.awk" "$scratch/tests/abi"
cp "$1/docs/toolkit.md" "$scratch/docs"
echo "add_library(dmrp_core)" >"$scratch/CMakeLists.txt"

good='`DMRP_FLAG_*` of `dmrp_world.robots`, `dmrp_core`'
bad='`DMRP_FLAG_NONE` of `dmrp_world.nothing`, `dmrp_gone`'
echo "$good" >"$scratch/docs/page.md"
"$here/contract_names.sh" "$scratch" >/dev/null || { echo "FAILED: a page without a breach" && exit 1; }
echo "$bad" >>"$scratch/docs/page.md"
said=$("$here/contract_names.sh" "$scratch") && { echo "FAILED: nothing is found" && exit 1; }
for name in DMRP_FLAG_NONE dmrp_world.nothing dmrp_gone; do
  [[ $said == *"docs/page.md:2: $name is"* ]] || { echo "FAILED: $name is not found: $said" && exit 1; }
done
[[ $said == *"3 names that are gone" ]] || { echo "FAILED: finds more: $said" && exit 1; }

"$here/toolkit.sh" "$scratch" || { echo "FAILED: the page of the toolkit" && exit 1; }
echo "// new.hpp: something new." >"$scratch/sdk/include/dmrp/toolkit/new.hpp"
! "$here/toolkit.sh" "$scratch" >/dev/null || { echo "FAILED: a header that the page lacks" && exit 1; }
