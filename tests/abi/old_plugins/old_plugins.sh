#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Plugins answer on this host as recorded, and their sources compile without a warning: with the frozen headers, once there
# are some, and with today's. Each plugin mixes every field that it is handed, by the list of
# fields, into what it answers. The stage is that of
# `dmrp-host check`; answers.txt changes only with the stage or, in a draft, with the headers.
# Called as: old_plugins.sh ANSWERS INCLUDE_DIR C_COMPILER CXX_COMPILER [--record]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
answers=$1 include=$(realpath "$2") c=$3 cxx=$4
recorded=$here/answers.txt
frozen=$here/../frozen/1.0
[[ -d $frozen ]] || frozen=$include
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# answers_with INCLUDE_DIR FLAG...: of the libraries built with these headers
answers_with() {
  local flags=(-pedantic -Wall -Wextra -Werror -O2 -ffp-contract=off -fPIC -shared -fvisibility=hidden)
  flags+=(-I "$here/../../.." -I "$scratch" -I "$@")
  "$c" -std=c99 "${flags[@]}" "$here/controller.c" -lm -o "$scratch/libcontroller.so"
  "$cxx" -std=c++17 "${flags[@]}" "$here/plugins.cpp" -o "$scratch/libplugins.so"
  "$answers" "$scratch/libcontroller.so" && "$answers" "$scratch/libplugins.so"
}
# expect WHAT: that the answers on standard input are the recorded ones
expect() {
  diff "$recorded" - >"$scratch/difference" || {
    echo "FAILED: $1 answer otherwise than recorded (<):"
    head -20 "$scratch/difference"
    exit 1
  }
}
layout=$here/../v1.txt
[[ ! -d $here/../frozen/1.0 ]] || layout=$here/../frozen/1.0.txt
python3 "$here/mix.py" "$layout" >"$scratch/mixed_fields.h"
if [[ ${5:-} == --record ]]; then
  answers_with "$frozen" >"$recorded"
  exit
fi

# a field at another place does not go unnoticed
mkdir "$scratch/moved"
cp -r "$frozen/dmrp" "$scratch/moved"
sed -i 's/double v_min;/double swapped;/; s/double v_max;/double v_min;/; s/double swapped;/double v_max;/' \
  "$scratch/moved/dmrp/robot.h"
answers_with "$scratch/moved" >"$scratch/moved.txt"
! cmp -s "$recorded" "$scratch/moved.txt" || { echo "FAILED: a plugin does not notice where a field is" && exit 1; }

[[ $frozen == "$include" ]] || answers_with "$frozen" | expect "plugins built from the frozen headers"
answers_with "$include" | expect "plugins built from today's headers"
echo "$(grep -c '^[a-z]' "$recorded") plugins answer as recorded"
