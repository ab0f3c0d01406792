#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_plot.sh: what plot.sh draws of rows written by hand.
set -euo pipefail
plot=$(dirname "$(realpath "${BASH_SOURCE[0]}")")/plot.sh
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "$1" && cat "$scratch/figure.svg" && exit 1; }

cat >"$scratch/a.csv" <<'ROWS'
commit,date,cpu,name,value,unit
bbb,2026-02-01T00:00Z,Plain CPU,one/figure,30,ms
bbb,2026-02-01T00:01Z,Plain CPU,one/figure,10,ms
bbb,2026-02-01T00:02Z,Plain CPU,one/figure,20,ms
bbb,2026-02-01T00:00Z,Plain CPU,one/figure/longer,99,ms
ROWS
cat >"$scratch/b.csv" <<'ROWS'
commit,date,cpu,name,value,unit
aaa,2026-01-01T00:00Z,Plain CPU,one/figure,40,ms
aaa,2026-01-01T00:00Z,"CPU, with & comma",one/figure,15,ms
ROWS
"$plot" one/figure "$scratch/a.csv" "$scratch/b.csv" >"$scratch/figure.svg"
figure=$(<"$scratch/figure.svg")
# from 0 at y = 310 to 40 at y = 50: the older commit comes first, three rows of the other have their median 20
[[ $(grep -c '<circle' <<<"$figure") == 3 ]] || fail "three points"
[[ $figure == *'d="M80.0 50.0L720.0 180.0"'* ]] || fail "the line of the plain CPU"
[[ $figure == *'<circle cx="80.0" cy="212.5"'* ]] || fail "the point of the other CPU"
[[ $figure == *'one/figure [ms]'* && $figure == *'CPU, with &amp; comma'* ]] || fail "title and names"

status=0
"$plot" none "$scratch/a.csv" >"$scratch/figure.svg" 2>&1 || status=$?
[[ $status == 1 && $(<"$scratch/figure.svg") == *one/figure/longer* ]] || fail "a name that is not there"
echo "drawn"
