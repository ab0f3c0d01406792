#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The planner of the template in C99 and in Rust: the same plans as in C++. What bindings are made from: dmrp-abi.json
# and dmrp.rs agree with v1.txt. Called as: other_languages.sh DMRP_HOST SOURCE_DIR
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
source_dir=$2
abi=$source_dir/tests/abi sources=$source_dir/examples/other_languages
shared=$(dirname "$(dirname "$host")")/share/dmrp/abi
cd "$scratch" || exit 1

# plans NAME ID: by libNAME.so, which keeps the contract; of tours in a lane, and of 40 robots
plans() {
  expect_status 0 "$host" check "./lib$1.so"
  expect_status 0 "$host" plan --scenario tours --plugin "./lib$1.so" --planner "$2" --paths "$1.tours"
  expect_status 0 "$host" plan --scenario mall --agents 40 --plugin "./lib$1.so" --planner "$2" --paths "$1.mall"
}
flags=(-O1 -ffp-contract=off -fPIC -shared -I "$source_dir/sdk/include")
expect_status 0 g++ -std=c++17 "${flags[@]}" "$source_dir/examples/templates/planner/my_plugin.cpp" -o libtemplate.so
plans template org.example.my_plugin
expect_status 0 gcc -std=c99 -Wall -Wextra -Wpedantic -Wshadow -Werror "${flags[@]}" "$sources/planner.c" -lm -o libc99.so
plans c99 org.example.planner_in_c
cmp template.tours c99.tours && cmp template.mall c99.mall || fail "C and C++ should plan alike"
(($(wc -l <c99.mall) > 40)) || fail "40 robots should have paths"

# the JSON says what v1.txt says
rows() {
  sqlite3 -batch -separator ' ' :memory: "WITH document AS (SELECT readfile('$shared/dmrp-abi.json') AS text) $1"
}
fields="SELECT json_extract(s.value, '\$.name'), json_extract(f.value, '\$.offset'), json_extract(f.value, '\$.size')
  FROM document, json_each(text, '\$.structs') s, json_each(s.value, '\$.fields') f"
recorded=$(awk '/^dmrp/ { type = $1 } /^ / { print type, $1, $2 }' "$abi/v1.txt")
[[ $(rows "$fields;" | sort) == "$(sort <<<"$recorded")" ]] ||
  fail "dmrp-abi.json has other fields than v1.txt"
[[ $(rows "SELECT key FROM document, json_each(text, '\$.constants');") == "$(awk '/ = / { print $1 }' "$abi/v1.txt")" ]] ||
  fail "dmrp-abi.json has other constants than v1.txt"
[[ $(rows "SELECT json_extract(text, '\$.constants.DMRP_EDGE_SE.value'), json_extract(text, '\$.constants.DMRP_NO_ROBOT.value'),
  json_extract(text, '\$.constants.DMRP_EXT_LIDAR.value') FROM document;") == "128 -1 dmrp.lidar/1" ]] ||
  fail "dmrp-abi.json has other values than the headers"
# What a field points to, or is, stands before its struct: a generator reads once.
late=$(rows "SELECT s.key, json_extract(s.value, '\$.name'), json_extract(f.value, '\$.type') ||
    coalesce(json_extract(f.value, '\$.returns') || json_extract(f.value, '\$.arguments'), '')
  FROM document, json_each(text, '\$.structs') s, json_each(s.value, '\$.fields') f;" |
  awk '{ place[$2] = $1; rest = $0; sub(/^[^ ]+ [^ ]+ /, "", rest)
         while (match(rest, /dmrp_[a-z0-9_]+/)) {
           name = substr(rest, RSTART, RLENGTH); rest = substr(rest, RSTART + RLENGTH)
           if (name != "dmrp_instance" && !(name in place)) print name, "after", $2
         } }')
[[ -z $late ]] || fail "dmrp-abi.json has a struct after one that needs it: $late"
[[ $(rows "SELECT json_extract(s.value, '\$.kind'), json_extract(f.value, '\$.thread'),
    json_extract(f.value, '\$.since'), json_extract(f.value, '\$.comment')
  FROM document, json_each(text, '\$.structs') s, json_each(s.value, '\$.fields') f
  WHERE json_extract(s.value, '\$.name') = 'dmrp_entry' AND json_extract(f.value, '\$.name') = 'deinit';") == \
  "growable main 0 Called once, when no instance is left." ]] || fail "dmrp-abi.json does not say what deinit() is"

command -v rustc >/dev/null || { echo "skipped: no rustc" && exit 77; }
cp "$shared/dmrp.rs" "$sources/planner.rs" .
awk -v check=1 -f "$abi/rust.awk" "$shared/dmrp-abi.json" >layout.rs
expect_status 0 rustc --edition 2021 -D warnings layout.rs
expect_status 0 ./layout
expect_status 0 rustc --edition 2021 -O -D warnings --crate-type cdylib planner.rs -o librust.so
[[ $(nm -D --defined-only librust.so | awk '{print $3}') == dmrp_entry_v1 ]] || fail "librust.so should export one symbol"
plans rust org.example.planner_in_rust
cmp template.tours rust.tours && cmp template.mall rust.mall || fail "Rust and C++ should plan alike"
