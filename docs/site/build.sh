#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the site with MkDocs, its theme Material, and Doxygen (Debian: mkdocs mkdocs-material doxygen).
# Called as: build.sh SOURCE_DIR DMRP_HOST OUT_DIR; the site is OUT_DIR/site.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source_dir=$(realpath "$1") out=$3
"$here/stage.sh" "$source_dir" "$2" "$out/pages"
out=$(realpath "$out")
(
  cd "$here"
  { cat Doxyfile && echo "INPUT = $source_dir/sdk/include" && echo "STRIP_FROM_PATH = $source_dir/sdk/include" &&
    echo "OUTPUT_DIRECTORY = $out/pages"; } | doxygen -
)
cp "$here/mkdocs.yml" "$out"
cd "$out" && mkdocs build --quiet --strict --clean
