#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_links.sh SOURCE_DIR: every relative link and anchor of the tree's Markdown leads somewhere, and every text in
# backticks that reads like a path of this tree names a file or folder. Prints each breach as file:line: text; exit
# status 1 if there is one. Nothing is fetched: links to the web are not checked.
set -euo pipefail
shopt -s inherit_errexit
export LC_ALL=C
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
cd "$1"
breaches=0

breach() {
  echo "$1: $2"
  breaches=$((breaches + 1))
}

# where a path in backticks may start: the tree, the folders that includes start from, and the page's own folder
roots=(. plugins sdk/include sdk/include/dmrp)
top_folders=" $(find . -mindepth 1 -maxdepth 1 -type d ! -name .git ! -name build -printf '%f ')"

# exists PATH FOLDER...: the path, which may be a glob or lack its file's extension, is in one of the folders
exists() {
  local path=$1 folder
  shift
  for folder in "$@"; do
    [[ ! -e $folder/$path ]] || return 0
    # compgen takes a name without a star as it is
    [[ $path != *[*]* ]] || ! compgen -G "$folder/$path" >/dev/null || return 0
    [[ $path == */ ]] || ! compgen -G "$folder/$path.*" >/dev/null || return 0
  done
  return 1
}

check_link() {
  local file=$1 line=$2 target=$3 path anchor
  [[ ! $target =~ ^[a-z]+: ]] || return 0
  path=${target%%#*} anchor=
  [[ $target != *#* ]] || anchor=${target#*#}
  if [[ -z $path ]]; then
    path=$file
  else
    path=$(realpath --canonicalize-missing --relative-to=. "$(dirname "$file")/$path")
  fi
  if [[ ! -e $path ]]; then
    breach "$file:$line" "no such file: $target"
  elif [[ -n $anchor && $path == *.md && -z ${anchors[$path#$anchor]:-} ]]; then
    breach "$file:$line" "no such heading: $target"
  fi
}

# A path of this tree: its first folder is one of ours, or it ends as our sources do. A name that begins with two capitals
# (FAMILY, NAME_test.cpp) stands for any name; a `:12` at the end is a line.
check_path() {
  local file=$1 line=$2 path=$3 first
  path=${path%%:[0-9]*} path=${path#./}
  [[ $path =~ ^[A-Za-z0-9_.*/-]+$ ]] || return 0
  [[ ! $path =~ (^|/)[A-Z][A-Z_] || $path == *.md ]] || return 0
  first=${path%%/*}
  [[ $top_folders == *" $first "* || $path =~ \.(h|hpp|cpp|md|sh|awk|cmake|cjs)$ ]] || return 0
  exists "$path" "${roots[@]}" "$(dirname "$file")" || breach "$file:$line" "no such file or folder: $path"
}

declare -A anchors=()
mapfile -t pages < <(find . \( -name build -o -name .git -o -name node_modules \) -prune -o -name '*.md' -printf '%P\n' | sort)
references=$(awk -f "$here/links.awk" "${pages[@]}")
while IFS=$'\t' read -r kind file line text; do
  [[ $kind != anchor ]] || anchors[$file#$text]=$line
done <<<"$references"
while IFS=$'\t' read -r kind file line text; do
  case $kind in
    link) check_link "$file" "$line" "$text" ;;
    path) check_path "$file" "$line" "$text" ;;
  esac
done <<<"$references"

((breaches == 0)) || { echo "$breaches breaches in ${#pages[@]} pages" && exit 1; }
echo "${#pages[@]} pages, $(wc -l <<<"$references") links, paths and headings: all lead somewhere"
