#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A library that cannot be loaded is refused before the run, or left out if the experiment says so.
# Called as: unloadable.sh DMRP_HOST LIBRARY_OF_ATTACKS
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
# broken/libhostile.so ends whatever loads it; text.so is none
mkdir "$scratch/broken"
cp "$2" "$scratch/broken/libhostile.so"
echo "no library" >"$scratch/broken/text.so"
export DMRP_TEST_AT_LOAD=crash

experiment=$scratch/experiment.toml
{
  sed 's|^plugins = \[|&"broken/libhostile.so", "broken/text.so", |; s/^trials .*/trials = 2/' "$here/crossing.toml"
  printf '\n[[local_controller]]\nuse = "test.controller.hostile"\n'
} >"$experiment"

expect_status 2 "$host" "$experiment" --quiet --out "$scratch/refused"
grep -q "broken/libhostile.so: crashes while it is loaded" "$scratch/stderr" ||
  fail "the library should be named: $(cat "$scratch/stderr")"
[[ ! -e $scratch/refused ]] || fail "a refused run should leave nothing"

# expect_left_out FILE: two libraries, and the controller that one of them may have
expect_left_out() {
  local text
  for text in "broken/libhostile.so: crashes" "broken/text.so: " "no local_controller 'test.controller.hostile'"; do
    grep -q "$text" "$1" || fail "'$text' should be in: $(cat "$1")"
  done
}
sed -i 's/^\[experiment\]/&\nskip_unloadable = true/' "$experiment"
expect_status 0 "$host" validate "$experiment"
expect_left_out "$scratch/stderr"
[[ $(grep -c "^warning: .*experiment.toml:[0-9:]* left out: " "$scratch/stderr") == 3 ]] || fail "$(cat "$scratch/stderr")"
expect_status 0 "$host" "$experiment" --quiet --jobs 2 --out "$scratch/run"
expect_left_out "$scratch/run/manifest.json"
expect_status 0 "$host" "$here/crossing.toml" --quiet --trials 2 --out "$scratch/without"
cmp -s <(values_of "$scratch/run") <(values_of "$scratch/without") || fail "the values should be those of the others alone"
expect_status 0 "$host" verify "$scratch/run" --trials 1
expect_status 0 "$host" "$experiment" --trials 1 --debug 0

# once it can be loaded, the run is another one
DMRP_TEST_AT_LOAD=none expect_status 2 "$host" "$experiment" --quiet --resume --out "$scratch/run"
grep -Eq "was run with another experiment: environment was .* \(and [0-9]+ more keys\)" "$scratch/stderr" || fail "$(cat "$scratch/stderr")"

# nothing is left
sed -i 's/^plugins = .*/plugins = ["broken\/text.so"]/' "$experiment"
expect_status 2 "$host" validate "$experiment"
grep -q "none of 'plugins' can be loaded" "$scratch/stderr" || fail "$(cat "$scratch/stderr")"
