#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_links_catches_breaches.sh: writes a small tree with links that lead somewhere and links that do not, and asks that
# check_links.sh names exactly the latter.
set -euo pipefail
check=$(dirname "$(realpath "${BASH_SOURCE[0]}")")/check_links.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree"/{core/world,docs,plugins/planners,build}
touch "$tree"/{core/world/world.cpp,core/world/world.hpp,plugins/planners/a.hpp,docs/figure.svg}
echo '[gone](nowhere.md)' >"$tree/build/copy.md"

cat >"$tree/docs/other.md" <<'PAGE'
# Other things: `a_b`, twice
## Part
## Part
```
# no heading
[no link](in/code.md)
```
PAGE
cat >"$tree/README.md" <<'PAGE'
# Fine
[page](docs/other.md) [with anchor](docs/other.md#other-things-a_b-twice) [second](docs/other.md#part-1)
[here](#fine) [web](https://example.org/none#none) ![figure](docs/figure.svg) <img src="docs/figure.svg">
`core/world/world.hpp`, `core/world/world.hpp:12`, `core/world/world`, `core/world/*.cpp`, `planners/a.hpp`, `core/FAMILY/`
`core/world/NAME_test.cpp`, `a/b`, `dmrp-host run core/none.hpp`, `[no link](docs/none.md)`, `runs/x/report.html`

[defined]: docs/other.md
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

broken=(
  '[gone](none.md)'
  '[gone](other.md#none)'
  '[in code](other.md#no-heading)'
  '[gone](#none)'
  '![gone](none.svg)'
  '<img src="none.svg">'
  '[defined]: none.md'
  '[third](other.md#part-2)'
  "see \`core/world/none.hpp\`"
  "see \`core/none/\`"
  "see \`planners/none.hpp\`"
  "see \`core/none/*.cpp\`"
)
for line in "${broken[@]}"; do
  echo "$line" >"$tree/docs/broken.md"
  expect 1 1
done
echo "${#broken[@]} breaches caught"
