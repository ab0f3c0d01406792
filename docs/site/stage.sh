#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Gathers the pages of the site: the tree's Markdown in its own folders, with functions of the templates put into the
# guides; what the pages link to; and the reference, which the program writes. Nothing is fetched.
# Called as: stage.sh SOURCE_DIR DMRP_HOST PAGES_DIR
set -euo pipefail
export LC_ALL=C
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source_dir=$(realpath "$1") host=$(realpath "$2") pages=$3
mkdir -p "$pages"
pages=$(realpath "$pages")

cd "$source_dir"
mapfile -t files < <(find . \( -name build -o -name .git -o -name .github -o -name node_modules -o -path "$pages" \) -prune -o -name '*.md' -printf '%P\n' | sort)
for file in "${files[@]}"; do
  mkdir -p "$pages/$(dirname "$file")"
  awk -v root="$source_dir" -f "$here/expand.awk" "$file" >"$pages/$file"
done

# files that pages link to come along; a link to a folder leads to its README, or to a list of its files
list_files() {
  echo "# \`$1/\`"
  echo
  (cd "$1" && find . -maxdepth 2 -type f ! -path '*/.*' ! -name '*.md' -printf '%P\n' | sort | sed 's/.*/- [`&`](&)/')
}
while IFS=$'\t' read -r kind file _ target; do
  path=${target%%#*}
  [[ $kind == link && -n $path && ! $target =~ ^[a-z]+: ]] || continue
  found=$(realpath --canonicalize-missing --relative-to=. "$(dirname "$file")/$path")
  if [[ -d $found ]]; then
    if [[ ! -e $pages/$found/README.md ]]; then
      mkdir -p "$pages/$found"
      list_files "$found" >"$pages/$found/README.md"
      (cd "$found" && find . -maxdepth 2 -type f ! -path './.*' -exec cp --parents -t "$pages/$found" {} +)
    fi
    sed -i "s|](${target})|](${target%/}/README.md)|g" "$pages/$file"
  elif [[ -f $found && ! -e $pages/$found ]]; then
    mkdir -p "$pages/$(dirname "$found")"
    cp "$found" "$pages/$found"
  fi
done < <(awk -f tests/docs/links.awk "${files[@]}")

# the reference
mkdir -p "$pages/reference"
used=$(mktemp)
trap 'rm -f "$used"' EXIT
for format in experiment scenario; do
  {
    echo "# The keys of $format files"
    echo
    echo "Written from the tables of the reader: \`dmrp-host keys $format\`."
    "$host" keys "$format" | awk -v used="$used" -f "$here/keys_page.awk" "$here/keys.txt" -
  } >"$pages/reference/$format.md"
done
unused=$(comm -13 <(sort -u "$used") <(awk '/^[^#]/ { print $1, $2 }' "$here/keys.txt" | sort -u))
[[ -z $unused ]] || { echo "docs/site/keys.txt: no reader knows $unused" >&2 && exit 1; }
for family in planners controllers pedestrians metrics; do
  {
    echo "# The built-in $family and their parameters"
    echo
    echo "Written from the descriptors: \`dmrp-host plugins --json libdmrp_$family.so\`."
    echo
    "$here/plugins_page.py" "$host" "libdmrp_$family.so"
  } >"$pages/reference/$family.md"
done
{
  echo "# The constants of the contract"
  echo
  echo "Written from \`share/dmrp/abi/dmrp-abi.json\`."
  sqlite3 -batch -separator $'\t' :memory: "SELECT json_extract(value, '\$.header'),
      replace(json_extract(value, '\$.group'), char(10), ' '), key, json_extract(value, '\$.value'),
      json_extract(value, '\$.since'), replace(json_extract(value, '\$.comment'), char(10), ' ')
    FROM json_each(readfile('$(dirname "$host")/../share/dmrp/abi/dmrp-abi.json'), '\$.constants');" |
    awk -F '\t' '{ gsub(/\|/, "\\|") }
      $1 != header { print "\n## `" $1 "`"; header = $1; group = "" }
      $2 != group || FNR == 1 { print "\n" $2 "\n\n| constant | value | since | |\n| --- | --- | --- | --- |"; group = $2 }
      { print "| `" $3 "` | `" $4 "` | 1." $5 " | " ($6 == $2 ? "" : $6) " |" }'
} >"$pages/reference/contract.md"
{
  echo "# Commands"
  echo
  echo "What \`dmrp-host COMMAND --help\` prints."
  for command in $("$host" --help | sed -n '/^Subcommands/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
    printf '\n## `%s`\n\n```\n%s\n```\n' "$command" "$("$host" "$command" --help | sed '/^Exit status/,$d')"
  done
} >"$pages/reference/commands.md"
