#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Headers of a next minor version, in which everything has grown. They and the templates compile in every standard that
# is promised. Plugins built with them for 1.0 answer on this host as recorded, without a warning of the compiler; for a
# later host they are refused with both versions.
# Called as: grown_plugins.sh ANSWERS DMRP_HOST INCLUDE_DIR EXAMPLES_DIR C_COMPILER CXX_COMPILER
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
answers=$1 host=$2 include=$3 examples=$4 c=$5 cxx=$6
sources=$here/../old_plugins
recorded=$sources/answers.txt
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$here/grow.sh" "$include" "$scratch/grown"
python3 "$sources/mix.py" "$here/../v1.txt" >"$scratch/mixed_fields.h"

# build SUFFIX FLAG...
build() {
  local flags=(-pedantic -Wall -Wextra -O2 -ffp-contract=off -fPIC -shared -fvisibility=hidden)
  flags+=(-I "$here/../../.." -I "$scratch" -I "$scratch/grown")
  "$c" -std=c99 "${flags[@]}" "${@:2}" "$sources/controller.c" -lm -o "$scratch/libcontroller_$1.so"
  "$cxx" -std=c++17 "${flags[@]}" "${@:2}" "$sources/plugins.cpp" -o "$scratch/libplugins_$1.so"
}
build for_1.0 -Werror -DDMRP_TARGET_MINOR=0
{ "$answers" "$scratch/libcontroller_for_1.0.so" && "$answers" "$scratch/libplugins_for_1.0.so"; } >"$scratch/answers.txt"
diff "$recorded" "$scratch/answers.txt" || { echo "FAILED: they answer otherwise than recorded (<)" && exit 1; }

# Fields that a source does not name are zero, of which compilers warn.
build later -Wno-missing-field-initializers
minor=$(sed -n 's/^#define DMRP_ABI_MINOR //p' "$include/dmrp/abi.h")
for library in "$scratch"/*_later.so; do
  status=0
  said=$("$host" plugins "$library" 2>&1) || status=$?
  [[ $status == 2 && $said == *"needs a host of ABI 1.$((minor + 1)) or newer, this is 1.$minor" ]] ||
    { echo "FAILED: status $status, should be 2 and a line with both versions: $said" && exit 1; }
done
for flag in -DDMRP_TARGET_MINOR=0 -Wno-missing-field-initializers; do
  status=0
  "$here/../headers.sh" "$scratch/grown" "$examples" "$flag" || status=$?
  ((status == 0 || status == 77)) || exit "$status"
done
echo "plugins of the next minor version: taken when built for 1.0, refused otherwise"
