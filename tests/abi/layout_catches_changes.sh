#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# layout.sh notices what it is there for: a field that is new, moved or of another type, and a constant.
# Called as: layout_catches_changes.sh INCLUDE_DIR C_COMPILER
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
include=$1 compiler=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

expect_notice() {
  rm -rf "$scratch/include"
  cp -r "$include" "$scratch/include"
  sed -i "$2" "$scratch/include/dmrp/$1"
  ! diff -rq "$include" "$scratch/include" >/dev/null || { echo "FAILED: '$2' changes nothing in $1"; exit 1; }
  if "$here/layout.sh" "$scratch/include" "$compiler" >/dev/null 2>&1; then
    echo "FAILED: '$2' in $1 goes unnoticed"
    exit 1
  fi
}
expect_notice abi.h 's/DMRP_ABI_DRAFT [0-9]*/DMRP_ABI_DRAFT 99/'
expect_notice status.h 's/DMRP_TIMEOUT 3/DMRP_TIMEOUT 7/'
expect_notice person.h 's/DMRP_REACTION_SCARED 5/DMRP_REACTION_SCARED 6/'
expect_notice local_controller.h 's/  double omega;.*/&\n  double jerk;/;s/DMRP_ASSERT_SIZE(dmrp_command.*//'
expect_notice local_controller.h 's/  double v_x; .*/  double omega;/;s/  double omega;  \/\/.*/  double v_x;/'
expect_notice entry.h 's/int32_t (\*init)/int32_t (*prepare)/'
expect_notice sample.h 's/  int64_t duration_ns;.*/  int32_t duration_ms;\n  int32_t more;/'
expect_notice sample.h 's/const dmrp_person\* people/const dmrp_agent* people/'
expect_notice plugin.h 's/  int32_t robot; .*/  uint32_t robot;/'
expect_notice plugin.h 's/dmrp_instance\* self, const dmrp_start\* start/const dmrp_start* start, dmrp_instance* self/'
expect_notice ext/lidar.h 's/const dmrp_lidar\* lidar, uint32_t robot/const dmrp_lidar* lidar, int32_t robot/'
expect_notice ext/annotate.h 's/dmrp.annotate.1/dmrp.annotate\/2/'

# --update writes what is gone only for a higher draft, and what is new at once
cp "$here/layout.sh" "$here/layout.awk" "$here/v1.txt" "$scratch"
update() { "$scratch/layout.sh" "$scratch/include" "$compiler" --update >/dev/null; }
expect_notice status.h '/DMRP_TIMEOUT 3/d'
! update || { echo "FAILED: a constant goes with the same draft" && exit 1; }
sed -i 's/DMRP_ABI_DRAFT [0-9]*/DMRP_ABI_DRAFT 99/' "$scratch/include/dmrp/abi.h"
update || { echo "FAILED: a constant cannot go with another draft" && exit 1; }
expect_notice status.h 's/.*DMRP_TIMEOUT 3.*/&\n#define DMRP_SLOW 32/'
cp "$here/v1.txt" "$scratch"
update || { echo "FAILED: a constant cannot be added" && exit 1; }
