#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# results_table.sh DMRP_HOST [RUN_DIR]: draws docs/results_table.png, the README's picture of a results table, from the
# report of RUN_DIR, or of a new run of examples/paper_table_3.toml. Needs Chromium and python3-pil.
set -euo pipefail
host=$(realpath "$1")
docs=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

run=${2:-$scratch/run}
(($# > 1)) || "$host" "$docs/../examples/paper_table_3.toml" --jobs 2 --out "$run"

# the report without what is not the table of driving
hidden='body > :not(main), main > :not(#tables), #tables > h2, #tables::before, .section-body > :not(.tables),
  .tables > :not(:has(#table-driving))'
sed "s|</head>|<style>${hidden//$'\n'/} { display: none !important }</style>&|" "$run/report.html" >"$scratch/table.html"
chromium --headless --no-sandbox --hide-scrollbars --window-size=988,2000 --screenshot="$scratch/page.png" \
  "file://$scratch/table.html" 2>/dev/null
python3 - "$scratch/page.png" "$docs/results_table.png" <<'END'
import sys
from PIL import Image, ImageOps
page = Image.open(sys.argv[1]).convert("RGB")
left, top, right, bottom = ImageOps.invert(page).getbbox()
margin = 16
table = page.crop((left - margin, top - margin, right + margin, bottom + margin))
table.quantize(64, dither=Image.Dither.NONE).save(sys.argv[2], optimize=True)
END
