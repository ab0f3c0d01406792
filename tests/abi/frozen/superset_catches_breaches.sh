#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# superset.sh, with today's headers as if they were frozen: it notices each kind of breaking change, lets through
# what a minor version may do, and freezes once. Called as: superset_catches_breaches.sh INCLUDE_DIR C_COMPILER
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
today=$(realpath "$1") compiler=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# A tree of its own, in which today's headers are v1.
abi=$scratch/tests/abi include=$scratch/include
mkdir -p "$abi/frozen"
cp "$here"/../*.awk "$abi"
cp "$here"/superset.* "$abi/frozen"
begin() {
  rm -rf "$include"
  mkdir "$include"
  cp -r "$today/dmrp" "$include"
  cp "$here/../../../VERSIONING.md" "$scratch"
  # the headers' own assertions of sizes would notice some of this
  sed -i 's/^#define DMRP_ASSERT_SIZE.*/#define DMRP_ASSERT_SIZE(type, bytes) typedef type type##_of_any_size/
    s/^#define DMRP_ABI_DRAFT .*/#define DMRP_ABI_DRAFT 0/' "$include/dmrp/abi.h"
}
superset() { "$abi/frozen/superset.sh" "$include" "$compiler" "$@" 2>&1; }
# change HEADER SED...: must change it
change() {
  sed -i "$2" "$include/dmrp/$1"
  ! cmp -s "$abi/frozen/1.0/dmrp/$1" "$include/dmrp/$1" || { echo "FAILED: '$2' changes nothing in $1" && exit 1; }
}
# catches TEXT HEADER SED
catches() {
  local said
  begin
  change "$2" "$3"
  if said=$(superset) || [[ $said != *"$1"* ]]; then
    echo "FAILED: '$3' in $2 should be a breach, '$1', not:"$'\n'"$said"
    exit 1
  fi
}
passes() {
  local said
  said=$(superset) || { echo "FAILED: $1 should be let through:"$'\n'"$said" && exit 1; }
}

begin
said=$(superset || true)
[[ $said == *"nothing is frozen: "*" --freeze" ]] || { echo "FAILED: draft 0 without a frozen copy: $said" && exit 1; }
superset --freeze
passes "what is frozen"

catches "dmrp_person.reaction is gone" person.h "/  uint32_t reaction;/d;/  uint32_t reserved;/d"
catches "dmrp_person: '0 8 uint64_t id' has become" person.h '/  uint64_t id; /d;s/  double radius_m;/  uint64_t id;\n&/'
catches "has become '56 4 float desired_speed'" person.h "s/  double desired_speed;.*/  float desired_speed;\n  float more;/"
catches "has become '8 4 int32_t group'" person.h 's/  uint32_t group; /  int32_t group; /'
catches "has become '8 4 uint32_t party'" person.h 's/  uint32_t group; /  uint32_t party; /'
catches "DMRP_TIMEOUT was" status.h 's/DMRP_TIMEOUT 3/DMRP_TIMEOUT 23/'
catches "DMRP_REACTION_SCARED is gone" person.h '/DMRP_REACTION_SCARED/d'
catches "DMRP_HAS is gone" abi.h 's/^#define DMRP_HAS(/#define DMRP_HOLDS(/'
catches "dmrp_note is gone" ext/annotate.h 's/dmrp_note\b/dmrp_remark/g'
catches "uint32_t robot)' has become" ext/lidar.h 's/const dmrp_lidar\* lidar, uint32_t robot/const dmrp_lidar* lidar, int32_t robot/'
catches "has become" plugin.h 's/dmrp_instance\* self, const dmrp_start\* start/const dmrp_start* start, dmrp_instance* self/'
catches "dmrp_vec2 is a value, and has grown" values.h 's/^} dmrp_vec2;/  double z;\n&/'
catches "dmrp_person.mass is new, and not in" person.h "s/^} dmrp_person;/  double mass;\n&/"
catches "DMRP_REACTION_AMUSED is new, and not in" person.h 's/^#define DMRP_REACTION_SCARED.*/&\n#define DMRP_REACTION_AMUSED 7u/'
catches "what the headers say of dmrp_person.radius_m has changed" person.h 's/  double radius_m;/  double radius_m;  \/\/ of the head/'
catches "what the headers say of dmrp_person.group has changed" person.h 's/0: alone;/0: not known;/'
catches "what the headers say of list of DMRP_REACTION_UNSPECIFIED" person.h 's/Open list: a model/Closed list: a model/'
catches "what the headers say of abi.h has changed" abi.h 's/64-bit, little-endian/64-bit, any endian/'

# What a minor version may do.
grown='s/^} dmrp_person;/#if DMRP_TARGET_MINOR >= 1\n  double mass;  \/\/ kg\n#endif\n&/'
begin
change person.h "$grown"
[[ $(superset) == *"dmrp_person.mass is newer than DMRP_ABI_MINOR"* ]] || { echo "FAILED: a field of the next minor" && exit 1; }
change abi.h 's/DMRP_ABI_MINOR [0-9]*$/DMRP_ABI_MINOR 1/'
passes "an appended field of a new minor version"
change status.h 's/^#define DMRP_OK .*/&\n#if DMRP_TARGET_MINOR >= 1\n#define DMRP_SLOW 32\n#endif/'
passes "a new constant of it"
change robot.h '0,/uint32_t reserved;/s//uint32_t meaning;/'
passes "a reserved field that gets a meaning"
change person.h 's/0: alone;/0: none;/'
line=$( (superset || true) | sed -n "s/.*VERSIONING.md needs a line '\(.*\) WHY'/\1/p")
echo "$line the word was wrong" >>"$scratch/VERSIONING.md"
passes "a changed sentence with a line in VERSIONING.md"
change person.h 's/0: none;/0: no group;/'
[[ $(superset) == *"dmrp_person.group has changed"* ]] || { echo "FAILED: the line is for one sentence" && exit 1; }

# Nothing is frozen twice.
begin
change person.h '/DMRP_REACTION_SCARED/d'
! superset --freeze >/dev/null || { echo "FAILED: v1 is frozen twice" && exit 1; }
change abi.h 's/DMRP_ABI_DRAFT .*/DMRP_ABI_DRAFT 9/'
[[ $(superset) == *"DMRP_ABI_DRAFT stays 0"* ]] || { echo "FAILED: a draft after v1" && exit 1; }
rm -r "$abi/frozen/1.0"
status=0
superset >/dev/null || status=$?
((status == 77)) || { echo "FAILED: a draft of which nothing is frozen ends with $status, not 77" && exit 1; }
