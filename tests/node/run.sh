#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs a test in node: run.sh PACKAGES SCRIPT [argument...]. The script finds the packages by require(). Status 77 where
# they are not installed.
set -uo pipefail
packages=$1
shift
if [[ ! -e $packages/done ]]; then
  echo "skipped: the packages of tests/node are not installed"
  exit 77
fi
NODE_PATH=$packages/node_modules exec node "$@"
