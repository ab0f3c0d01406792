#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs on a network file system are refused in one line; finished ones are read from there.
# Called as: network_file_system.sh DMRP_HOST LIBRARY, which makes a folder seem to be on NFS.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
library=$2
scratch=$(realpath "$scratch")
nfs=$scratch/nfs
mkdir "$nfs"
on_nfs() { PRETENDED_FOLDER=$nfs LD_PRELOAD=$library "$@"; }
expect_refusal() {
  expect_status 2 on_nfs "${@:2}"
  [[ $(messages) == 1 ]] || fail "not one line but: $(cat "$scratch/stderr")"
  grep -Eq -- "$1" "$scratch/stderr" || fail "'$(cat "$scratch/stderr")' does not match '$1'"
}

refused="nfs/.*: is on a network file system \(NFS\), where results.sqlite is not safe: choose a folder on a disk"
expect_refusal "$refused" "$host" "$here/crossing.toml" --out "$nfs/a/run"
cd "$nfs" && expect_refusal "^runs/crossing: is on a network file system" "$host" "$here/crossing.toml"
[[ -z $(ls -A "$nfs") ]] || fail "something was made: $(find "$nfs")"

for shard in 0 1; do
  expect_status 0 on_nfs "$host" "$here/crossing.toml" --quiet --trials 1 --shard $shard/2 --out "$scratch/local_$shard"
  cp -r "$scratch/local_$shard" "$nfs/shard_#$shard?%"
done
expect_refusal "$refused" "$host" "$here/crossing.toml" --quiet --trials 1 --shard 0/2 --resume --out "$nfs/shard_#0?%"
expect_refusal "$refused" "$host" merge "$nfs/joined" "$nfs"/shard_*
rm -f "$nfs"/shard_*/results.sqlite-* # empty: a reader on the local disk leaves them
expect_status 0 on_nfs "$host" merge "$scratch/joined" "$nfs"/shard_*
expect_status 0 "$host" merge "$scratch/expected" "$scratch"/local_*
cmp -s <(values_of "$scratch/joined") <(values_of "$scratch/expected") || fail "other values when read from there"
! compgen -G "$nfs/shard_*/results.sqlite-*" >/dev/null || fail "files were made: $(find "$nfs" -name 'results*')"

# what a killed run left in its log is not overlooked
echo "a log" >"$nfs/shard_#0?%/results.sqlite-wal"
expect_refusal "results.sqlite: was not closed, and cannot be recovered on a network file system \(NFS\): copy its folder" \
  "$host" merge "$scratch/third" "$nfs"/shard_*
