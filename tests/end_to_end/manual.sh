#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The manual page and the completions have every command and every option of the help.
# Called as: manual.sh DMRP_HOST SOURCE_DIR
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
expect_status 0 "$2/packaging/manual.sh" "$host" "$scratch/manual"
cd "$scratch/manual" || exit 1

mapfile -t commands < <("$host" --help | sed -n '/^Subcommands/,/^$/s/^  \([a-z]*\) .*/\1/p')
((${#commands[@]} >= 11)) || fail "the help should list the commands: ${commands[*]}"
for command in "" "${commands[@]}"; do
  # shellcheck disable=SC2086  # no argument where there is no command
  mapfile -t options < <("$host" $command --help | grep -Eo '^ +(-h,)?--[a-z-]+' | grep -Eo '\--[a-z-]+')
  for option in "${options[@]}"; do
    grep -qF -- "${option//-/\\-}" dmrp-host.1 || fail "the manual lacks $option of '$command'"
    grep -qF -- "'$option:" _dmrp-host || fail "zsh's completion lacks $option of '$command'"
    # shellcheck disable=SC1091
    found=$(bash -c 'source ./dmrp-host.bash; COMP_WORDS=(dmrp-host $0 "$1"); COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
      _dmrp_host; echo "${COMPREPLY[@]}"' "$command" "$option")
    [[ " $found " == *" $option "* ]] || fail "bash completes '$command $option' with '$found'"
  done
  line=$("$host" ${command:+"$command"} --help | sed -n '/^Example:/{n;s/^  //p}')
  grep -qF -- "${line//-/\\-}" dmrp-host.1 || fail "the manual lacks the example of '$command': $line"
  [[ -z $command ]] || grep -q "^.SS dmrp\\\\-host $command " dmrp-host.1 || fail "the manual lacks $command"
done
grep -q "4 compare" dmrp-host.1 || fail "the manual lacks exit status 4"
! grep -qE "^options.*:'\)" _dmrp-host || fail "options without a text: $(grep -E "^options.*:'\)" _dmrp-host)"
command -v zsh >/dev/null || { echo "skipped: no zsh to read its completion" && exit 77; }
expect_status 0 zsh -n _dmrp-host
