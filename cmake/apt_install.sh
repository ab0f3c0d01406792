# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Sourced by setup.sh and .ci/run: apt_install PACKAGE... installs packages, as root or through sudo.
apt_install() {
  (($# > 0)) || return 0
  if ! command -v apt-get >/dev/null; then
    echo "setup: no apt-get here; install what these Debian packages hold: $*" >&2
    return 1
  fi
  local as_root=()
  if ((EUID != 0)); then
    command -v sudo >/dev/null || { echo "setup: run this as root or install sudo; missing: $*" >&2 && return 1; }
    as_root=(sudo)
  fi
  echo "setup: installing $*"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install --yes -qq --no-install-recommends "$@" >/dev/null
}
