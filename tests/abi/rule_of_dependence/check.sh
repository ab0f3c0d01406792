#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check.sh SOURCE_DIR: the one rule of dependence, sdk <- core <- host and sdk <- plugins, and the rooms of core, host
# and plugins: their order (rooms.txt) and how full they are. Reads the include lines, the link lines and the plugin ids
# in the sources. Prints each breach as file:line: text; exit status 1 if there is one.
set -euo pipefail
shopt -s inherit_errexit
rooms=$(dirname "$(realpath "${BASH_SOURCE[0]}")")/rooms.txt
cd "$1"

# what the files of a part may include, beside themselves and what lies outside these folders
declare -A may_include=([sdk]="" [core]="sdk" [host]="core sdk" [plugins]="sdk" [examples]="sdk")
parts=(sdk core host plugins examples)
sources=(--include=*.h --include=*.hpp --include=*.c --include=*.cpp --include=*.inc)
breaches=0

breach() {
  echo "$1: $2"
  breaches=$((breaches + 1))
}

# owners[x/y.hpp] = the parts that have a file whose path ends so: whatever the include directories are,
# `#include "x/y.hpp"` can mean only these
declare -A owners
index_files() {
  local file suffix part
  while IFS= read -r file; do
    part=${file%%/*}
    suffix=$file
    while :; do
      [[ " ${owners[$suffix]:-} " == *" $part "* ]] || owners[$suffix]+=" $part"
      [[ $suffix == */* ]] || break
      suffix=${suffix#*/}
    done
  done < <(find "${parts[@]}" -type f)
}

# a path without its `.` and `..`
normalised() {
  local piece result=()
  local IFS=/
  for piece in $1; do
    case $piece in
      . | "") ;;
      ..) ((${#result[@]} == 0)) || unset 'result[-1]' ;;
      *) result+=("$piece") ;;
    esac
  done
  normal="${result[*]}"
}

check_include() {
  local file=$1 line=$2 header=$3 part=${1%%/*} found owner normal
  normalised "${file%/*}/$header"
  if [[ -e $normal ]]; then
    found=${normal%%/*}
  else
    normalised "$header"
    found=${owners[$normal]:-}
  fi
  # a header of the standard library or of a dependency
  [[ -n $found ]] || return 0
  for owner in $found; do
    if [[ " $part ${may_include[$part]} " == *" $owner "* ]]; then
      check_room "$file" "$line" "$header"
      return 0
    fi
  done
  breach "$file:$line" "$part includes $header of ${found# }"
}

# order[room] = its line in rooms.txt; a room further down may include those further up
declare -A order=()
read_rooms() {
  local room
  while IFS= read -r room; do
    [[ -z $room || $room == \#* ]] || order[$room]=${#order[@]}
  done <"$rooms"
}

check_room() {
  local room=${1%/*} header=$3 other
  [[ -e $header ]] || header=plugins/$header
  [[ -e $header ]] || return 0
  other=${header%/*}
  [[ -n ${order[$room]:-} && -n ${order[$other]:-} ]] || return 0
  ((${order[$other]} <= ${order[$room]})) || breach "$1:$2" "$room includes $3 of $other, a room above it"
}

# A fuller room is two rooms: nobody finds a thing among forty.
most_sources=32

check_each_room() {
  local room sources
  while read -r sources room; do
    [[ -n ${order[$room]:-} ]] || breach "$room:1" "this room is not in ${rooms##*/}"
    ((sources <= most_sources)) || breach "$room:1" "this room holds $sources sources, more than $most_sources"
  done < <(find core host plugins -name '*.[ch]pp' -printf '%h\n' | sort | uniq -c)
}

check_includes() {
  local file line text
  local directive='#[[:space:]]*include[[:space:]]*[<"]([^>"]+)[>"]'
  while IFS=: read -r file line text; do
    if [[ $text =~ $directive ]]; then check_include "$file" "$line" "${BASH_REMATCH[1]}"; fi
  done < <(grep -rnE '^[[:space:]]*#[[:space:]]*include' "${sources[@]}" "${parts[@]}")
}

# reports every line of `where...` that matches the pattern
forbid() {
  local why=$1 pattern=$2 file line text
  shift 2
  while IFS=: read -r file line text; do
    breach "$file:$line" "$why: $text"
  done < <(grep -rnE "$pattern" "$@" || true)
}

index_files
read_rooms
check_each_room
check_includes
forbid "links more than the SDK" '\bdmrp(_|::)(core|host)\b' --include=CMakeLists.txt plugins sdk examples
forbid "core sees the host or the plugins" '\bdmrp(_|::)(host|planners|controllers|pedestrians|metrics)\b' \
  "${sources[@]}" --include=CMakeLists.txt core
forbid "names a concrete plugin" 'dmrp\.(planner|controller|pedestrian|metric)\.[a-z0-9_]' "${sources[@]}" core host
forbid "core prints or loads" '#[[:space:]]*include[[:space:]]*<(iostream|print|dlfcn\.h|boost/dll.*)>' \
  "${sources[@]}" core

((breaches == 0)) || { echo "rule of dependence: $breaches breaches" && exit 1; }
echo "rule of dependence: kept"
