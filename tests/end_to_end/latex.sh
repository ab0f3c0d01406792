#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# pdflatex sets the tables of a run, narrow and wide ones, in two columns without an error, within the page.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
command -v pdflatex >/dev/null || { echo "SKIPPED: no pdflatex" && exit 77; }

run=$scratch/run
sed -e 's/^use = "crossing"/&\nrobots = [2, 3, 4]/' -e 's/^label = "together"/label = "50%_a\&b{c}\\\\d~e^f$#"/' \
  "$here/crossing.toml" >"$scratch/drawn.toml"
expect_status 0 "$host" "$scratch/drawn.toml" --quiet --out "$run"
expect_status 0 "$host" export "$run" --latex --out "$scratch/report.tex"
expect_status 0 "$host" export "$run" --latex --rows controller --columns robots,planner \
  --metric success,completion_time,pfd,path_length --out "$scratch/across.tex"
metrics=$(query "$run" "SELECT group_concat(name) FROM (SELECT DISTINCT metric AS name FROM value)")
expect_status 0 "$host" export "$run" --latex --metric "$metrics" --where robots=3 --out "$scratch/all.tex"
grep -q 'part 2 of' "$scratch/across.tex" && grep -q 'part 2 of' "$scratch/all.tex" || fail "the wide tables are not in parts"

# a narrow page, and that of IEEE where its class and fonts are installed
classes=article
kpsewhich IEEEtran.cls >/dev/null && kpsewhich ptmr7t.tfm >/dev/null && classes+=" IEEEtran"
for class in $classes; do
  printf '%s\n' "\\documentclass[twocolumn]{$class}" '\usepackage{booktabs}' '\begin{document}' '\input{report}' '\clearpage' \
    '\input{across}' '\clearpage' '\input{all}' '\end{document}' >"$scratch/paper.tex"
  (cd "$scratch" && pdflatex -interaction=nonstopmode -halt-on-error paper.tex >paper.out) ||
    fail "$class: LaTeX refuses the tables: $(tail -20 "$scratch/paper.out")"
  ! grep -A2 -E 'Overfull .hbox|Float too large' "$scratch/paper.out" || fail "$class: tables leave the page"
done
