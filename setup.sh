#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes a Debian 12 machine ready and builds the release preset. Run it as often as you like: what is there stays.
# Arguments go to CMake's configuration, as in ./setup.sh -DDMRP_WARNINGS_AS_ERRORS=ON
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

libraries=(libboost-dev libeigen3-dev libfcl-dev libccd-dev libtomlplusplus-dev libfmt-dev libcli11-dev libsqlite3-dev
  nlohmann-json3-dev libzstd-dev zlib1g-dev libssl-dev libyaml-cpp-dev libpng-dev catch2
  coinor-libipopt-dev node-d3 libjs-three)
# tool:package; a tool that is on the path is kept, wherever it came from
tools=(g++:build-essential make:build-essential cmake:cmake ninja:ninja-build pkg-config:pkg-config sqlite3:sqlite3
  esbuild:esbuild)

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

cmake --preset release "$@"
cmake --build --preset release
