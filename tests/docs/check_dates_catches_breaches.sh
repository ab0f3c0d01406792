#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_dates_catches_breaches.sh: writes a small tree with pages that may have dates and pages that may not, and asks that
# check_dates.sh names exactly the latter.
set -euo pipefail
check=$(dirname "$(realpath "${BASH_SOURCE[0]}")")/check_dates.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree"/{docs/measured,build}
dated='Measured at commit d90cc75, 2026-11-22.'
for page in CHANGELOG.md docs/measured/run.md build/copy.md docs/figure.svg; do echo "$dated" >"$tree/$page"; done
cat >"$tree/README.md" <<'PAGE'
Hu et al., ICRA 2026; Moussaid et al., 2010. Five of 1234567 trials, 0x00ffee1 bytes, a defaced effaced wall, 2026-11.
The robots may 2 times turn; `--seed 2026`; pages 12-13-14; July is warm.
PAGE
expect() {
  local output status=0
  output=$("$check" "$tree") || status=$?
  if [[ $status != "$1" || $(grep -c '^[^ ]*:[0-9]*: ' <<<"$output") != "$2" ]]; then
    echo "expected status $1 and $2 breaches, got status $status and:"
    echo "$output"
    exit 1
  fi
}
expect 0 0

dates=(
  'on 2026-11-22'
  'in November 2026'
  'on 23 November'
  'on May 3, 2025'
  'by e7aacf7'
  "commit \`7b494d2\` has it"
  'commit 1234567'
  'by 7dc71bad958cf3a1e7aacf71f8174822a3b4c5d6'
)
for line in "${dates[@]}"; do
  echo "$line" >"$tree/docs/dated.md"
  expect 1 1
done
printf '%s\n' "${dates[@]}" >"$tree/docs/dated.md"
expect 1 "${#dates[@]}"
echo "${#dates[@]} breaches caught"
