# SPDX-License-Identifier: MIT
# shellcheck shell=bash disable=SC2034  # its variables are for the scripts that source it
# Sourced by faulty_*.sh, which are called as: TEST.sh DMRP_HOST LIBRARY_OF_FAULTS [SANITIZERS]. Gives them
#   run_with_faults NAME STATUS [OPTION...]   runs $scratch/NAME.toml
#   expect_fault ...              looks for a row of the table `fault`
#   limited                       whether workers live under a memory limit (not under sanitizers)
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
library=$2
limited=true
[[ -z ${3:-} ]] || limited=false

# begin_experiment NAME TABLE...: writes $scratch/NAME.toml: the crossing with one trial, without its [[TABLE]]s, with the
# library of faults
begin_experiment() {
  local file=$scratch/$1.toml table
  sed "s|^plugins = \[|&\"$library\", |; s/^trials .*/trials = 1/" "$here/crossing.toml" >"$file"
  for table in "${@:2}"; do sed -i "/^\[\[$table\]\]/,/^\$/d" "$file"; done
  printf '\n[limits]\nmemory_mb = 400\n' >>"$file"
}

# use NAME TABLE ID [FAULT [MORE_PARAMETERS]]: labelled with the fault
use() {
  printf '\n[[%s]]\nuse = "%s"\n' "$2" "$3" >>"$scratch/$1.toml"
  [[ -z ${4:-} ]] || printf 'label = "%s"\nparams = { fault = "%s"%s }\n' "${6:-$4}" "$4" "${5:-}" >>"$scratch/$1.toml"
}

run_with_faults() {
  expect_status "$2" "$host" "$scratch/$1.toml" --quiet --jobs 2 --out "$scratch/$1" "${@:3}"
  # why, in one line
  local faults='^dmrp-host: [0-9]+ of [0-9]+ trials? with a fault; trial [0-9]+: '
  [[ $2 == 0 ]] && faults='^$'
  [[ $(cat "$scratch/stderr") =~ $faults && $(wc -l <"$scratch/stderr") == "$2" ]] || fail "$1: $(cat "$scratch/stderr")"
}

# expect_fault NAME CONDITION_ON_TRIAL "KIND|PLUGIN|FUNCTION|STEP|ROBOT|SIGNAL" DETAIL_PATTERN
expect_fault() {
  local found
  found=$(query "$scratch/$1" "SELECT kind, plugin, function, step, robot, signal FROM fault
    JOIN trial ON trial.id = trial_id WHERE $2")
  [[ $found == "$3" ]] || fail "$1, $2: '$found', not '$3'"
  found=$(query "$scratch/$1" "SELECT detail FROM fault JOIN trial ON trial.id = trial_id WHERE $2")
  grep -Eq -- "$4" <<<"$found" || fail "$1, $2: the detail '$found' does not match '$4'"
}
