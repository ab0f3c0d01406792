#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs the fuzzers of the preset `fuzz`, each for so many seconds: run.sh BUILD_DIR SECONDS [NAME...]
# They begin with corpus/NAME and with files of the tree. What makes one fail is left in BUILD_DIR/fuzz/found.
set -uo pipefail
if (($# < 2)); then
  echo "usage: run.sh BUILD_DIR SECONDS [NAME...]" >&2
  exit 2
fi
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tree=$here/../..
programs=$(cd "$1/fuzz" && pwd) || exit 2
seconds=$2
shift 2
found=$programs/found
scratch=$(mktemp -d -p "$([[ -w /dev/shm ]] && echo /dev/shm || echo "${TMPDIR:-/tmp}")") # each input is a file
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$found" "$scratch/files"
export TMPDIR=$scratch/files

# seeds NAME: the files of the tree that this fuzzer may begin with
seeds() {
  case $1 in
    experiment) printf '%s\n' "$tree"/examples/*.toml "$tree"/tests/{end_to_end,same_bits}/*.toml ;;
    scenario) printf '%s\n' "$tree"/scenarios/*/scenario.toml "$tree"/tests/end_to_end/worlds/*/scenario.toml ;;
    mcap) printf '%s\n' "$tree"/tests/same_bits/small_trial/trial.mcap ;;
  esac
}

# in_hall EXPERIMENT...: with the scenario and the plugins of tests/unit/host/experiment/experiment_example.hpp
in_hall() {
  sed -i -E -e 's|^plugins .*|plugins = ["./libfake.so"]|' -e '/^params_file/d' \
    -e '/^\[\[scenario\]\]/,/^$/ s|^use .*|use = "./hall/scenario.toml"|' \
    -e 's/"dmrp\.planner\.[a-z0-9_]+"/"test.planner"/; s/"dmrp\.controller\.[a-z0-9_]+"/"test.controller"/' \
    -e 's/"dmrp\.pedestrian\.[a-z0-9_]+"/"test.model"/; s/"dmrp\.metric\.[a-z0-9_]+"/"test.length"/' "$@"
}

names=("$@")
if ((${#names[@]} == 0)); then
  for program in "$programs"/fuzz_*; do names+=("${program##*/fuzz_}"); done
fi
failed=()
for name in "${names[@]}"; do
  corpus=$scratch/$name
  mkdir "$corpus"
  number=0
  while read -r file; do cp "$file" "$corpus/$((++number))"; done < <(seeds "$name")
  [[ $name != experiment ]] || in_hall "$corpus"/*
  [[ ! -d $here/corpus/$name ]] || cp "$here/corpus/$name"/* "$corpus"
  log=$scratch/$name.log
  # with no share/dmrp beside it: to read one shipped scenario of many people takes a second under sanitizers
  cp "$programs/fuzz_$name" "$scratch/program"
  if "$scratch/program" "$corpus" -max_total_time="$seconds" -timeout=60 -rss_limit_mb=4096 -max_len=65536 \
    -artifact_prefix="$found/${name}_" >"$scratch/stdout" 2>"$log"; then
    echo "$name: $(grep -oE '^Done [0-9]+ runs in [0-9]+' "$log") s"
  else
    failed+=("$name")
    tail -n 60 "$log"
    echo "$name: FAILED"
  fi
done
if ((${#failed[@]} > 0)); then
  echo "failed: ${failed[*]}; inputs in $found"
  exit 1
fi
