#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs a test in node: run.sh PACKAGES SCRIPT [argument...]. The script finds the packages in the folder PACKAGES by
# require(); PACKAGES is empty for a script that needs none. Status 77 where node or the packages are missing.
set -uo pipefail
packages=$1
shift
if ! command -v node >/dev/null; then
  echo "skipped: there is no node on this machine"
  exit 77
fi
if [[ -n $packages && ! -e $packages/done ]]; then
  echo "skipped: the packages of tests/node are not installed"
  exit 77
fi
NODE_PATH=$packages${packages:+/node_modules} exec node "$@"
