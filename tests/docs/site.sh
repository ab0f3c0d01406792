#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The site: its pages can be gathered (every function that guides show is there, every key has a meaning and every
# meaning a key), and with `build` the site is built and its links lead somewhere. SKIPPED from there without the tools.
# Called as: site.sh SOURCE_DIR DMRP_HOST [build]
set -euo pipefail
source_dir=$1 host=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

if [[ ${3:-} != build ]]; then
  "$source_dir/docs/site/stage.sh" "$source_dir" "$host" "$scratch/pages"
  for page in docs/guides/write_a_planner.md reference/experiment.md reference/commands.md reference/planners.md reference/contract.md; do
    [[ -s $scratch/pages/$page ]] || { echo "FAILED: no $page" && exit 1; }
  done
  # a guide that shows a function which is gone cannot be gathered
  cd "$scratch"
  echo '<!-- source: examples/templates/planner/my_plugin.cpp no_such_function -->' >page.md
  ! awk -v root="$source_dir" -f "$source_dir/docs/site/expand.awk" page.md >/dev/null 2>said &&
    grep -q "page.md:1: there is no function no_such_function" said || { echo "FAILED: $(cat said)" && exit 1; }
  exit 0
fi
for tool in mkdocs doxygen; do
  command -v "$tool" >/dev/null || { echo "skipped: no $tool" && exit 77; }
done
"$source_dir/docs/site/build.sh" "$source_dir" "$host" "$scratch/built"
"$source_dir/docs/site/check_site.sh" "$scratch/built/site"
