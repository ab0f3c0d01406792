#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The structs of a layout can grow (growth.awk); the same layout with a struct that cannot is noticed.
# Called as: growth.sh LAYOUT
set -euo pipefail
rules=$(dirname "${BASH_SOURCE[0]}")/growth.awk
layout=$1
broken=$(awk -f "$rules" "$layout")
[[ -z $broken ]] || { echo "FAILED: $broken" && exit 1; }

# expect_notice SED_SCRIPT WHAT
expect_notice() {
  broken=$(sed "$1" "$layout" | awk -f "$rules")
  [[ $broken == "$2" ]] || { echo "FAILED: after '$1' it says '$broken', should say '$2'" && exit 1; }
}
expect_notice '/ goal_stride$/d' 'dmrp_planning_robot points to 1 arrays of structs without struct_size, with 0 strides
dmrp_observation points to 2 arrays of structs without struct_size, with 1 strides
dmrp_robot points to 1 arrays of structs without struct_size, with 0 strides'
expect_notice '/^dmrp_route /,/^$/s/const dmrp_path[*] path/dmrp_path path/' \
  'dmrp_route.path embeds dmrp_path, which may grow'
echo "all structs can grow"
