#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes a Debian 12 or 13 machine ready and builds the release preset: the host and the plugins, and with --tests, on
# Debian 12, the tests too. Run it as often as you like: what is there stays, and a run without --tests leaves built tests alone.
# Other arguments go to CMake's configuration, as in ./setup.sh -DDMRP_WARNINGS_AS_ERRORS=ON
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

libraries=(libboost-dev libeigen3-dev libfcl-dev libccd-dev libtomlplusplus-dev libfmt-dev libcli11-dev libsqlite3-dev
  nlohmann-json3-dev libzstd-dev zlib1g-dev libssl-dev libseccomp-dev libyaml-cpp-dev libpng-dev libcairo2-dev node-d3
  libjs-three)
test_libraries=(catch2 coinor-libipopt-dev python3-numpy python3-pandas python3-matplotlib python3-pytest python3-venv
  python3-setuptools python3-wheel python3-pip python3-zstandard mypy)
# tool:package; a tool that is on the path is kept, wherever it came from
tools=(g++:build-essential make:build-essential cmake:cmake ninja:ninja-build pkg-config:pkg-config sqlite3:sqlite3
  esbuild:esbuild file:file) # cpack asks `file`

tests=false
arguments=()
for argument in "$@"; do
  if [[ $argument == --tests ]]; then tests=true; else arguments+=("$argument"); fi
done
target=(--target dmrp)
if $tests; then
  libraries+=("${test_libraries[@]}")
  arguments+=(-DDMRP_TESTS=ON)
  target=()
fi

missing=()
for tool in "${tools[@]}"; do
  command -v "${tool%%:*}" >/dev/null || missing+=("${tool##*:}")
done
for library in "${libraries[@]}"; do
  [[ $(dpkg-query --show --showformat='${db:Status-Status}' "$library" 2>/dev/null) == installed ]] ||
    missing+=("$library")
done
# shellcheck source=cmake/apt_install.sh
source cmake/apt_install.sh
apt_install "${missing[@]}"
package_seconds=$SECONDS

cmake --preset release "${arguments[@]}"
cmake --build --preset release "${target[@]}"
echo "setup: packages took $package_seconds s, the build took $((SECONDS - package_seconds)) s"
