#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A plugin of draft 1 gets one line that says so. Called as: refused.sh DMRP_HOST C_COMPILER
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
host=$1 compiler=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"$compiler" -std=c99 -shared -fPIC "$here/draft_1.c" -o "$scratch/libold.so" || exit 1
said=$("$host" plugins "$scratch/libold.so" 2>&1)
status=$?
expected='built for draft 1 of the v1 contract, this host has draft 5: build it again'
if ((status != 2)) || [[ $said != *libold.so*"$expected" || $said == *$'\n'* ]]; then
  echo "FAILED: status $status, should be 2 and one line that ends with '$expected':"
  echo "$said"
  exit 1
fi
