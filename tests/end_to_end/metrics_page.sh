#!/bin/sh
# SPDX-License-Identifier: MIT
# metrics_page.sh DMRP_HOST SOURCE_DIR: docs/metrics.md agrees with the descriptors of the built-in metrics. The
# text above the comment is written by hand; the rest is the output of the command in the comment.
set -eu
host=$1
page=$2/docs/metrics.md
said=$(mktemp)
trap 'rm -f "$said"' EXIT

"$2/docs/site/plugins_page.py" "$host" libdmrp_metrics.so > "$said"
if ! sed -n '/^<!-- docs\/site\/plugins_page/,$p' "$page" | diff -u - "$said"; then
  echo "docs/metrics.md is out of date: put the output of 'docs/site/plugins_page.py dmrp-host libdmrp_metrics.so' below its text"
  exit 1
fi
grep -q '^- `pfd` (>= 0 m; lower; robots): ' "$said" || { echo "the page does not list pfd"; exit 1; }
