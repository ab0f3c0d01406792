#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The help of every command: it fits a terminal of 80 columns, `help COMMAND` prints it too, and its example works.
# Called as: help.sh DMRP_HOST SOURCE_DIR
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
cd "$scratch" || exit 1
mkdir examples
sed 's/^trials .*/trials = 1/' "$2/examples/quickstart.toml" >examples/quickstart.toml

mapfile -t commands < <("$host" --help | sed -n '/^Subcommands/,/^$/s/^  \([a-z][a-z]*\) .*/\1/p')
((${#commands[@]} >= 16)) || fail "the help should list the commands: ${commands[*]}"
for command in "" "${commands[@]}"; do
  # shellcheck disable=SC2086  # no argument where there is no command
  "$host" $command --help >help
  # shellcheck disable=SC2086
  expect_status 0 "$host" help $command
  cmp -s help stdout || fail "'help $command' should print what --help does: $(cat stdout)"
  ! grep -E '^.{81}' help || fail "'$command --help' has lines of more than 80 columns"
  grep -q 'Exit status: .* 4 compare' <(tr '\n' ' ' <help) || fail "'$command --help' lacks the exit statuses"
done
expect_status 2 "$host" help plam
grep -q "there is no command 'plam' (did you mean 'plan'?)" stderr || fail "help should name the nearest: $(cat stderr)"
expect_status 2 "$host" export runs/none --latx
grep -q "there is no option '--latx' (did you mean '--latex'?)" stderr || fail "an option's nearest name: $(cat stderr)"

# plugins: a line each, one with its parameters by its short name, the nearest name
expect_status 0 "$host" plugins
cp stdout list
expect_status 0 "$host" plugins --json
[[ $(grep -c '^  dmrp\.' list) == "$(grep -c '"id": ' stdout)" ]] || fail "not each plugin has its line: $(cat list)"
expect_status 0 "$host" plugins dwa
[[ $(grep -c '^  dmrp\.' stdout) == 1 ]] && grep -q '^      sim_time .*how far ahead' stdout || fail "dwa: $(cat stdout)"
expect_status 0 "$host" plugins --kind planner
! grep '^  dmrp' stdout | grep -v planner || fail "--kind planner lists others: $(cat stdout)"
expect_status 2 "$host" plugins dwaa
grep -q "^no plugin 'dwaa' (did you mean 'dwa'?)" stderr || fail "the nearest name is missing: $(cat stderr)"
expect_status 2 "$host" plugins teb --kind planner
grep -q "^--kind: teb is no planner" stderr || fail "teb is listed as a planner: $(cat stdout stderr)"

words=()
# example COMMAND: sets its words, without the program's name
example() {
  local text
  text=$("$host" "$1" --help | sed -n '/^Example:/,/^$/s/^  //p' | sed -e ':a' -e '/\\$/{N;s/\\\n//;ta' -e '}')
  [[ $text == "dmrp-host "* ]] || fail "'$1 --help' has no example: $text"
  eval "words=(${text#dmrp-host })"
}

# Examples that need a plugin of the reader's, ffmpeg or more runs are only parsed: what they miss is no mistake of the
# command line.
export DMRP_PLUGIN_PATH=
for command in "${commands[@]}"; do
  [[ $command == help ]] && continue
  example "$command"
  [[ ${words[0]} == "$command" ]] || fail "the example of $command is one of ${words[0]}"
  case $command in
    check | merge | plan) expect_status 2 "$host" "${words[@]}" ;;
    video) "$host" "${words[@]}" >stdout 2>stderr || true ;;
    compare)
      cp -r runs/quickstart runs/before && cp -r runs/quickstart runs/after
      expect_status 4 "$host" "${words[@]}"  # one trial cannot decide
      ;;
    *) expect_status 0 "$host" "${words[@]}" ;;
  esac
  ! grep -q 'see --help' stderr || fail "the example of $command cannot be parsed: $(cat stderr)"
done
for file in mall.svg values.csv tables.tex quickstart-bundle/manifest.json mine/CMakeLists.txt runs/quickstart/report.html; do
  [[ -s $file ]] || fail "an example should have written $file"
done
