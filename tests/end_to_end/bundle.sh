#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A bundle runs elsewhere with the same bits, and is a run directory.
# Called as: bundle.sh DMRP_HOST LIBRARY_WITH_PLANTED_FAULTS
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
unshare --user --mount true 2>/dev/null || { echo "skipped: the kernel refuses namespaces" && exit 77; }
planted=$2

# expect_refusal PATTERN COMMAND...: one line, and status 2
expect_refusal() {
  expect_status 2 "${@:2}"
  [[ $(messages) == 1 ]] || fail "not one line but: $(cat "$scratch/stderr")"
  grep -Eq -- "$1" "$scratch/stderr" || fail "'$(cat "$scratch/stderr")' does not match '$1'"
}

# a folder that is gone when the bundle is used: a scenario, a library, a file of parameters
mkdir "$scratch/author"
cd "$scratch/author" || exit 1
cp -r "$here/worlds" .
cp "$planted" libmine.so
echo 'lookahead_dist = 0.7' >slow.toml
sed -e 's|^use = "crossing"$|use = "./worlds/crossing"|; s/^trials .*/trials = 2/; s|"libdmrp_metrics.so"|&, "./libmine.so"|' \
  -e 's|^use = "dmrp.controller.pure_pursuit"|&\nparams_file = "slow.toml"|' "$here/crossing.toml" >mine.toml
unset DMRP_SCENARIO_PATH
expect_status 0 "$host" mine.toml --quiet --jobs 1 --out "$scratch/run" --bundle "$scratch/bundle"
expect_status 0 "$host" bundle mine.toml --out "$scratch/unrun"
expected=$(values_of "$scratch/run")
digests=$(cut -d ' ' -f 1 "$scratch/bundle/trace_digests.txt")
[[ $(wc -w <<<"$digests") == 8 ]] || fail "8 trials should have digests"

cd "$scratch" || exit 1
rm -r author
for name in bundle unrun; do
  mkdir "elsewhere_$name"
  mv "$name" "elsewhere_$name/moved"
  bundle=$scratch/elsewhere_$name/moved
  for file in experiment.toml original.toml README.md manifest.json plugins/libmine.so parameters/slow.toml \
    scenarios/crossing/scenario.toml; do
    [[ -f $bundle/$file ]] || fail "$name has no $file"
  done
  # but for the command line
  ! grep -rqI --exclude=manifest.json "$scratch" "$bundle" || fail "$name knows where it was made: $(grep -rI "$scratch" "$bundle")"
  ! grep -q '"path": "/' "$bundle/manifest.json" || fail "the manifest of $name has paths of this machine"
  grep -q '"commit": "..*"' "$bundle/manifest.json" || fail "$name does not name the commit"
  expect_status 0 "$host" "$bundle/experiment.toml" --quiet --out "$scratch/again_$name"
  [[ $(values_of "$scratch/again_$name") == "$expected" ]] || fail "$name gives other values"
done
expect_status 0 "$host" bundle again_unrun
[[ $(cut -d ' ' -f 1 again_unrun-bundle/trace_digests.txt) == "$digests" ]] || fail "the bundle gives other traces"
expect_refusal "again_unrun-bundle: exists already" "$host" bundle again_unrun

bundle=$scratch/elsewhere_bundle/moved
expect_status 0 "$host" verify "$bundle" --trials 3
grep -q "3 trials run again, equal to the bit" "$scratch/stdout" || fail "$(cat "$scratch/stdout")"
[[ ! -s $scratch/stderr ]] || fail "nothing is to be said: $(cat "$scratch/stderr")"
[[ $(echo "$bundle"/results*) == "$bundle/results.sqlite" ]] || fail "reading left $(echo "$bundle"/results*)"
# its plugins are somebody else's
without_namespaces=(env "DMRP_VIEW=namespaces: none in this test" "$host")
if DMRP_VIEW="namespaces: none in this test" "$host" "$bundle/experiment.toml" --trials 1 --quiet --out "$scratch/boxless" >/dev/null 2>&1; then
  echo "not tested: sanitizers exclude the box"
else
  for command in verify run; do
    [[ $command == run ]] && target=$bundle/experiment.toml || target=$bundle
    expect_refusal "its plugins would see your files, as this kernel gives them no namespaces .*: --trust runs them" \
      "${without_namespaces[@]}" $command "$target" --trials 1
  done
  expect_status 0 "${without_namespaces[@]}" verify "$bundle" --trials 1 --trust
fi
expect_refusal "results.sqlite" "$host" verify "$scratch/elsewhere_unrun/moved"

# a bundle of results is a run directory
expect_status 0 "$host" report "$bundle"
expect_status 0 "$host" "$bundle/experiment.toml" --quiet --resume --trials 3 --out "$bundle"
[[ $(query "$bundle" "SELECT count(*) FROM trial") == 12 ]] || fail "the bundle's run should grow"

# what a folder cannot hold is refused, and leaves nothing
cp -r "$here/maps" .
mkdir world
sed -e 's/^name = "rooms"/name = "world"/' -e "s|../../maps/rooms.map|$scratch/maps/rooms.map|; s|../../maps|../maps|" \
  "$here/worlds/rooms/scenario.toml" >world/scenario.toml
sed -e 's|^use = "crossing"$|use = "./world"|' "$here/crossing.toml" >absolute.toml
expect_refusal "scenario 'world' names .*rooms.map by an absolute path" "$host" bundle absolute.toml --out none
[[ ! -e none ]] || fail "a refused bundle should leave nothing"
sed -i "s|$scratch|..|" world/scenario.toml
expect_status 0 "$host" bundle absolute.toml --out held
for file in world/scenario.toml maps/rooms.map maps/rooms.scen; do
  [[ -f $(echo held/scenarios/*/"$file") ]] || fail "the bundle lacks $file"
done
