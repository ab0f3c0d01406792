#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The sources and the commands of docs/plugins.md, exactly as they are on the page: they build without CMake, without a
# warning, and load. Called as: documented_commands.sh SOURCE_DIR [DMRP_HOST]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source_dir=$(realpath "$1")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# what an installation to ~/dmrp would have
export HOME=$scratch/home
mkdir -p "$HOME/dmrp/bin"
ln -s "$source_dir/sdk/include" "$HOME/dmrp/include"
[[ -z ${2:-} ]] || ln -s "$(realpath "$2")" "$HOME/dmrp/bin/dmrp-host"

# ```LANGUAGE FILE begins the text of a file, ```sh begins commands
cd "$scratch"
awk '/^```/ { to = "" ; if ($1 == "```sh") to = "commands"; else if (NF == 2) to = $2; next }
     to != "" { print >to }' "$source_dir/docs/plugins.md"
mapfile -t commands <commands
((${#commands[@]} == 4)) || { echo "FAILED: the page should have four commands: ${commands[*]}" && exit 1; }

for command in "${commands[@]}"; do
  [[ $command != *dmrp-host* || -n ${2:-} ]] || continue
  said=$(bash -c "$command" 2>&1) || { echo "FAILED: $command"$'\n'"$said" && exit 1; }
  case $command in
    g++* | gcc*) [[ -z $said ]] || { echo "FAILED: $command warns:"$'\n'"$said" && exit 1; } ;;
    *check*)
      [[ $said == *" 0 fail, 0 crash"* ]] || { echo "FAILED: $command:"$'\n'"$said" && exit 1; }
      ;;
    *)
      [[ $said == *org.example.hold* && $said == *org.example.hold_in_c* ]] ||
        { echo "FAILED: $command does not list the plugins:"$'\n'"$said" && exit 1; }
      ;;
  esac
done

gcc -std=c99 -I "$HOME/dmrp/include" "$here/describe.c" -ldl -o describe
for library in libhold:org.example.hold libhold_in_c:org.example.hold_in_c; do
  [[ $(./describe "./${library%%:*}.so") == "${library#*:}" ]] || { echo "FAILED: ${library%%:*}.so" && exit 1; }
done
