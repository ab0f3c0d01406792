#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Nothing that `dmrp-host check` is given makes it hang, or end otherwise than with 0, 1 or 2.
# Called as: hostile_input.sh DMRP_HOST LIBRARY [SANITIZERS]
set -uo pipefail
host=$1 library=$2 sanitizers=${3:-}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# check STATUS TEXT ARGUMENT...
check() {
  local expected=$1 text=$2 status=0
  shift 2
  timeout -k 5 100 "$host" check "$@" >"$scratch/out" 2>&1 || status=$?
  if ((status != expected)) || ! grep -Eq -- "$text" "$scratch/out"; then
    cat "$scratch/out"
    fail "check $*: status $status, not $expected with '$text'"
  fi
}

# no library
echo 'no ELF file' >"$scratch/text.so"
head -c 4000 "$library" >"$scratch/cut.so"
: >"$scratch/empty.so"
cp "$library" "$scratch/arm.so"
printf '\xb7\x00' | dd of="$scratch/arm.so" bs=1 seek=18 conv=notrunc status=none
ln -s nowhere.so "$scratch/link.so"
mkfifo "$scratch/pipe.so"
check 2 'no shared object' "$scratch/text.so"
check 2 'no shared object' "$scratch/empty.so"
check 2 'is a folder' "$scratch"
check 2 'is a link to nowhere.so' "$scratch/link.so"
check 2 'there is no such library' "$scratch/missing.so"
check 2 '' "$scratch/pipe.so"
check 2 'is for aarch64, this host is x86_64|is no 64-bit' "$scratch/arm.so"
check 1 'load/open' "$scratch/cut.so"
check 1 'no symbol dmrp_entry_v1' "$(ldd "$host" | awk '/libz\.so/ {print $3; exit}')"
check 2 'regular expression' "$library" --only '('
check 2 'no case' "$library" --only 'no such case'

# libraries that misbehave while they are loaded
export DMRP_TEST_FAULT
DMRP_TEST_FAULT='crashes at load' check 1 'crashes .*dlopen' "$library"
DMRP_TEST_FAULT='exits at load' check 1 'ends the process .*dlopen' "$library"
[[ -n $sanitizers ]] || DMRP_TEST_FAULT='forks at load' check 1 'system call' "$library"
[[ -n $sanitizers ]] || DMRP_TEST_FAULT='hangs at load' check 1 'hangs .*dlopen' "$library"
# and while they run
DMRP_TEST_FAULT='exits in a call' check 1 'crash .*ended the process' "$library" --only 'metric numbers'
DMRP_TEST_FAULT='prints garbage' check 0 'pass' "$library" --only 'metric numbers'
"$host" check "$library" --json --only 'metric numbers' | grep -q '^{' || fail "what plugins print is in the JSON"
