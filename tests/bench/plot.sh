#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# plot.sh NAME FILE.csv...: draws a figure over commits, from rows that benchmarks appended, as SVG to standard output:
#   tests/bench/plot.sh simulation/mall_bare/real_time_factor tests/bench/results/*.csv > figure.svg
# Commits in the order of their rows' dates, the median of a commit's rows, a line for each CPU. Without a row of that
# name: exit status 1, and the names that there are.
set -euo pipefail
if (($# < 2)); then
  echo "usage: $0 NAME FILE.csv..." >&2
  exit 2
fi
name=$1
shift
# date first, to sort by; a CPU's name may be quoted and have commas
rows=$(awk -F, '
  FNR == 1 { next }
  {
    line = $0
    commit = $1
    date = $2
    line = substr(line, length(commit) + length(date) + 3)
    if (match(line, /^"([^"]|"")*",/)) {
      cpu = substr(line, 2, RLENGTH - 3)
      line = substr(line, RLENGTH + 1)
    } else {
      cpu = substr(line, 1, index(line, ",") - 1)
      line = substr(line, index(line, ",") + 1)
    }
    split(line, field, ",")
    print date "\t" commit "\t" cpu "\t" field[1] "\t" field[2] "\t" field[3]
  }' "$@" | sort -s -k1,1)
chosen=$(awk -F'\t' -v name="$name" '$4 == name' <<<"$rows")
if [[ -z $chosen ]]; then
  {
    echo "plot.sh: no row is named $name; there are:"
    cut -f4 <<<"$rows" | sort -u
  } >&2
  exit 1
fi

awk -F'\t' -v title="$name" '
  function median(text,   n, value, i, j, swap) {
    n = split(text, value, " ")
    for (i = 1; i <= n; ++i)
      for (j = i + 1; j <= n; ++j)
        if (value[j] + 0 < value[i] + 0) { swap = value[i]; value[i] = value[j]; value[j] = swap }
    return n % 2 ? value[(n + 1) / 2] : (value[n / 2] + value[n / 2 + 1]) / 2
  }
  function escaped(text) { gsub(/&/, "\\&amp;", text); gsub(/</, "\\&lt;", text); return text }
  function x(i) { return left + (commits > 1 ? (i - 1) * (width / (commits - 1)) : width / 2) }
  function y(value) { return top + height * (1 - value / highest) }
  {
    if (!($2 in place)) { place[$2] = ++commits; commit_at[commits] = $2 }
    if (!($3 in known)) { known[$3] = ++cpus; cpu_at[cpus] = $3 }
    values[$2, $3] = values[$2, $3] " " $5
    if ($5 > highest) highest = $5
    unit = $6
  }
  END {
    left = 80; top = 50; width = 640; height = 260
    if (highest <= 0) highest = 1
    split("#1f77b4 #d62728 #2ca02c #9467bd #8c564b", color, " ")
    printf "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 800 %d\" font-family=\"sans-serif\" font-size=\"12\">\n", 400 + 18 * cpus
    print "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>"
    printf "<text x=\"%d\" y=\"26\" font-size=\"15\">%s [%s]</text>\n", left, escaped(title), escaped(unit)
    for (i = 0; i <= 4; ++i)
      printf "<path d=\"M%d %.1fh%d\" stroke=\"#ddd\"/><text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">%.4g</text>\n", left, y(highest * i / 4), width, left - 8, y(highest * i / 4) + 4, highest * i / 4
    for (i = 1; i <= commits; ++i)
      printf "<text transform=\"translate(%.1f %d) rotate(-40)\" text-anchor=\"end\">%s</text>\n", x(i) + 4, top + height + 16, escaped(commit_at[i])
    for (c = 1; c <= cpus; ++c) {
      path = ""
      for (i = 1; i <= commits; ++i) {
        if (!((commit_at[i], cpu_at[c]) in values)) continue
        value = median(values[commit_at[i], cpu_at[c]])
        path = path (path == "" ? "M" : "L") sprintf("%.1f %.1f", x(i), y(value))
        printf "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.5\" fill=\"%s\"><title>%s: %.6g</title></circle>\n", x(i), y(value), color[(c - 1) % 5 + 1], escaped(commit_at[i]), value
      }
      printf "<path d=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"1.5\"/>\n", path, color[(c - 1) % 5 + 1]
      printf "<text x=\"%d\" y=\"%d\" fill=\"%s\">%s</text>\n", left, top + height + 76 + 18 * c, color[(c - 1) % 5 + 1], escaped(cpu_at[c])
    }
    print "</svg>"
  }' <<<"$chosen"
