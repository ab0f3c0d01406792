#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Writes the headers as the next minor version might have them. Called as: grow.sh INCLUDE_DIR GROWN_DIR, which is new.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
include=$1 grown=$2
minor=$(($(sed -n 's/^#define DMRP_ABI_MINOR //p' "$include/dmrp/abi.h") + 1))
cp -r "$include" "$grown"
for header in "$grown"/dmrp/*.h "$grown"/dmrp/ext/*.h; do
  awk -v minor=$minor -f "$here/grow.awk" "$include/${header#"$grown"}" >"$header"
done
# an extension that no host of today has
sed 's/distance_field/grown/g; s/DISTANCE_FIELD/GROWN/g; s/dmrp_field/dmrp_grown_field/g' \
  "$grown/dmrp/ext/distance_field.h" >"$grown/dmrp/ext/grown.h"
# what was to grow has
((minor > 0)) && grep -q "DMRP_ABI_MINOR $minor\$" "$grown/dmrp/abi.h"
for name in DMRP_AGENT_GROWN DMRP_PARAM_GROWN DMRP_GROWN_STATUS ext/grown.h 'double grown' '(\*grown)'; do
  grep -rq -- "$name" "$grown"/dmrp/*.h || { echo "FAILED: $name is not in the grown headers" && exit 1; }
done
