#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every message of docs/messages.md, provoked.
# Called as: messages.sh DMRP_HOST FOLDER_OF_PLANTED_LIBRARIES PAGE [SANITIZERS]
set -uo pipefail
host=$1 planted=$2 page=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch" || exit 1

fail() {
  echo "FAILED: $*" >&2
  exit 1
}
check() { "$host" check "$@" 2>&1; }
with_fault() { DMRP_TEST_FAULT=$1 check "$planted/libdmrp_planted_faults.so" --only "${2:-}" 2>&1; }
without_part() { DMRP_TEST_FAULT=$1 check "$planted/libdmrp_planted_in_c.so" --only status 2>&1; }
experiment_with() {
  printf '[experiment]\nname = "x"\nplugins = ["%s"]\n[[scenario]]\nuse = "mall"\n' "$1" >experiment.toml
  "$host" validate experiment.toml 2>&1
}

# cases about what this host does not know do not apply to a plugin that may know it
check "$planted/libdmrp_planted_in_c.so" --only growth >newer.out || fail "$(cat newer.out)"
grep -q 'skip  growth/longer_structs, growth/unknown_constants, growth/longer_host: it is of version 1.1, and this host of 1.0' newer.out ||
  fail "$(cat newer.out)"

mkdir folder
ln -s nowhere.so link.so
echo text >text.so
# at byte 16 the type, at byte 18 the machine
with_bytes() {
  cp "$planted/libdmrp_planted_in_c.so" "$1"
  printf "$3" | dd of="$1" bs=1 seek="$2" conv=notrunc status=none
}
with_bytes arm.so 18 '\xb7\x00'
with_bytes object.so 16 '\x01\x00'

provoke() {
  case $1 in
    'there is no such file') check ./nothing.so ;;
    'it is a folder') check ./folder ;;
    'it is a link to nowhere') check ./link.so ;;
    'it is no shared object') check ./text.so ;;
    'it is for another machine') check ./arm.so ;;
    'it is an object file') check ./object.so ;;
    'a symbol is undefined') check "$planted/libdmrp_planted_undefined.so" ;;
    '`DMRP_PLUGINS` is missing') check "$(ldd "$host" | awk '/libz\.so/ {print $3; exit}')" ;;
    'it has another major version') check "$planted/libdmrp_planted_major.so" ;;
    'it crashes while it is loaded') with_fault 'crashes at load' ;;
    'it crashes in a descriptor') with_fault 'crashes in its descriptor' ;;
    'it ends the process') with_fault 'exits at load' ;;
    'its `init()` fails') with_fault 'init fails' ;;
    'an experiment names a folder') experiment_with ./folder ;;
    'an experiment names a link to nowhere') experiment_with ./link.so ;;
    '`create()` leaves out `self`') without_part 'no self' ;;
    '`create()` leaves out `start`') without_part 'no start' ;;
    '`create()` leaves out `destroy`') without_part 'no destroy' ;;
    '`create()` leaves out `table`') without_part 'no interface' ;;
    'a function table lacks `step`') without_part 'no step' ;;
    'a robot gets two paths') with_fault 'gives a path twice' 'planner status/ordinary' ;;
    'a path is for no robot') with_fault 'gives a path to nobody' 'planner status/ordinary' ;;
    'a value is not declared') with_fault 'gives the undeclared' 'metric status/ordinary' ;;
    'a value is infinite') with_fault 'gives infinity' 'metric status/ordinary' ;;
    'a status is none of the table') with_fault 'odd status' 'planner status/ordinary' ;;
    'there is no such command') "$host" plugin 2>&1 ;;
    'nothing is asked') "$host" 2>&1 ;;
    'the version is asked') "$host" --version 2>&1 ;;
    'a library of this folder is named without `./`') (cd "$planted" && "$host" plugins libdmrp_planted_faults.so 2>&1) ;;
    *) fail "no test for: $1" ;;
  esac
}

rows=0
while IFS='|' read -r _ situation message _; do
  situation=$(sed 's/^ *//; s/ *$//' <<<"$situation")
  message=$(sed 's/^ *`//; s/` *$//' <<<"$message")
  [[ $situation != if && $situation != --- ]] || continue
  # the text as a pattern: DMRP_PLUGINS(...) is text of the message, every other ... is any text
  pattern=$(sed 's/DMRP_PLUGINS(\.\.\.)/DMRP_PLUGINS(@)/; s/[][\\.*^$+?(){}|]/\\&/g; s/\\\.\\\.\\\./.*/g; s/@/\\.\\.\\./' <<<"$message")
  found=$(provoke "$situation") || true
  grep -Eq -- "^$pattern\$" <<<"$(sed 's/^  *//' <<<"$found")" || fail "$situation: should be '$message', is:"$'\n'"$found"
  rows=$((rows + 1))
done < <(grep '^|' "$page")
((rows >= 25)) || fail "only $rows rows in $page"
