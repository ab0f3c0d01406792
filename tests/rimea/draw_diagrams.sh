#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Draws the fundamental diagrams of docs/measured/pedestrians.md from runs of the tests 4, 15 and 16 that run.sh left in RUNS:
# draw_diagrams.sh RUNS FOLDER
set -euo pipefail
runs=$1
folder=$2

# diagram FILE TITLE X_LABEL X_MAX X_STEP CURVE_LABEL CURVE: points "model<tab>x<tab>y" come from standard input; CURVE is
# an awk expression of x, the reference.
diagram() {
  awk -F'\t' -v title="$2" -v x_label="$3" -v x_max="$4" -v x_step="$5" -v curve_label="$6" '
    function px(x) { return 56 + x / x_max * 448 }
    function py(y) { return 300 - y / 1.6 * 264 }
    function reference(x) { return '"$7"' }
    function curve(   x, y, path) {
      for (x = 0.02 * x_max; x <= x_max; x += 0.01 * x_max) {
        y = reference(x)
        if (y >= 0) path = path (path == "" ? "M" : "L") sprintf("%.1f %.1f", px(x), py(y))
      }
      printf "<path class=\"reference\" d=\"%s\"/>\n", path
    }
    function marker(model, x, y) {
      if (model == "social force") printf "<circle class=\"a\" cx=\"%.1f\" cy=\"%.1f\" r=\"4\"/>\n", x, y
      else if (model == "ORCA") printf "<path class=\"c\" d=\"M%.1f %.1fl9 0l-4.5 -8z\"/>\n", x - 4.5, y + 4
      else printf "<rect class=\"b\" x=\"%.1f\" y=\"%.1f\" width=\"7\" height=\"7\"/>\n", x - 3.5, y - 3.5
    }
    BEGIN {
      print "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 520 344\" font-family=\"sans-serif\" font-size=\"12\">"
      printf "<title>%s</title>\n", title
      print "<style>text{fill:#333}.grid{stroke:#8884;fill:none}.axis{stroke:#777;fill:none}"
      print ".reference{stroke:#777;fill:none;stroke-width:2;stroke-dasharray:5 3}"
      print ".a,.al{fill:#0b6bcb}.b,.bl{fill:#c2570c}.c,.cl{fill:#2c8a3f}"
      print ".line{fill:none;stroke-width:1.5}.al.line{stroke:#0b6bcb;fill:none}.bl.line{stroke:#c2570c;fill:none}.cl.line{stroke:#2c8a3f;fill:none}"
      print "@media(prefers-color-scheme:dark){text{fill:#ddd}.axis,.reference{stroke:#aaa}.a{fill:#5aa9f5}.b{fill:#f0944d}.c{fill:#63c277}"
      print ".al.line{stroke:#5aa9f5}.bl.line{stroke:#f0944d}.cl.line{stroke:#63c277}}</style>"
      for (y = 0; y <= 1.6; y += 0.2) {
        printf "<path class=\"grid\" d=\"M56 %.1fH504\"/><text x=\"48\" y=\"%.1f\" text-anchor=\"end\">%.1f</text>\n", py(y), py(y) + 4, y
      }
      for (x = 0; x <= x_max + 1e-9; x += x_step)
        printf "<text x=\"%.1f\" y=\"316\" text-anchor=\"middle\">%g</text>\n", px(x), x
      print "<path class=\"axis\" d=\"M56 36V300H504\"/>"
      printf "<text x=\"280\" y=\"336\" text-anchor=\"middle\">%s</text>\n", x_label
      print "<text x=\"16\" y=\"168\" text-anchor=\"middle\" transform=\"rotate(-90 16 168)\">speed, m/s</text>"
      curve()
      models[1] = "social force"; models[2] = "collision-free speed"; models[3] = "ORCA"
      class["social force"] = "al"; class["collision-free speed"] = "bl"; class["ORCA"] = "cl"
    }
    { line[$1] = line[$1] sprintf("%s%.1f %.1f", line[$1] == "" ? "M" : "L", px($2), py($3)); n = ++count[$1]; x_of[$1, n] = px($2); y_of[$1, n] = py($3) }
    END {
      x = 64
      for (m = 1; m <= 3; ++m) {
        model = models[m]
        printf "<path class=\"line %s\" d=\"%s\"/>\n", class[model], line[model]
        for (i = 1; i <= count[model]; ++i) marker(model, x_of[model, i], y_of[model, i])
        marker(model, x, 18)
        printf "<text x=\"%d\" y=\"22\">%s</text>\n", x + 10, model
        x += 26 + 6.2 * length(model)
      }
      printf "<path class=\"reference\" d=\"M%d 18h24\"/><text x=\"%d\" y=\"22\">%s</text>\n", x, x + 30, curve_label
      print "</svg>"
    }' >"$folder/$1"
}

points() {
  sqlite3 -batch -separator $'\t' "$1/results.sqlite" "
    SELECT pedestrian_model, density.value, speed.value
    FROM trial JOIN value AS density ON density.trial_id = id JOIN value AS speed ON speed.trial_id = id
    WHERE density.metric = 'density' AND speed.metric = 'walking_speed' ORDER BY pedestrian_model, density.value"
}

mkdir -p "$folder"
points "$runs/04_fundamental_diagram" | diagram test_04.svg "Speed over density, RiMEA test 4" "people per square metre" \
  4 1 "Weidmann" "1.34 * (1 - exp(-1.913 * (1 / x - 1 / 5.4)))"
points "$runs/16_single_file" | diagram test_16.svg "Speed over density in single file, RiMEA test 16" \
  "people per metre" 2 0.5 "Seyfried et al." "(1 / x - 0.36) / 1.06 > 1.34 ? 1.34 : (1 / x - 0.36) / 1.06"

# test 15: the time round the corner between those of the shortest and the longest way
sqlite3 -batch -separator $'\t' "$runs/15_crowd_round_a_corner/results.sqlite" "
  SELECT pedestrian_model, scenario, value FROM trial JOIN value ON trial_id = id WHERE metric = 'evacuation_time'" |
  awk -F'\t' '
    function px(s) { return 150 + s / 140 * 354 }
    BEGIN {
      print "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 520 172\" font-family=\"sans-serif\" font-size=\"12\">"
      print "<title>Times of a crowd round a corner and straight on, RiMEA test 15</title>"
      print "<style>text{fill:#333}.grid{stroke:#8884}.axis{stroke:#777}.span{stroke:#777;stroke-width:2}.corner{fill:#0b6bcb}"
      print "@media(prefers-color-scheme:dark){text{fill:#ddd}.axis,.span{stroke:#aaa}.corner{fill:#5aa9f5}}</style>"
      for (s = 0; s <= 140; s += 20)
        printf "<path class=\"grid\" d=\"M%.1f 30V130\"/><text x=\"%.1f\" y=\"146\" text-anchor=\"middle\">%d</text>\n", px(s), px(s), s
      print "<path class=\"axis\" d=\"M150 130H504\"/><text x=\"327\" y=\"166\" text-anchor=\"middle\">until everybody is there, s</text>"
      print "<path class=\"span\" d=\"M150 14h30m-30 -5v10m30 -10v10\"/><text x=\"186\" y=\"18\">straight on: 44 m and 75.4 m</text>"
      print "<circle class=\"corner\" cx=\"380\" cy=\"14\" r=\"5\"/><text x=\"390\" y=\"18\">round the corner</text>"
    }
    { time[$1, $2] = $3 }
    END {
      split("social force|collision-free speed|ORCA", models, "|")
      for (m = 1; m <= 3; ++m) {
        y = 20 + 30 * m
        short = px(time[models[m], "straight_short"]); long = px(time[models[m], "straight_long"])
        printf "<text x=\"140\" y=\"%d\" text-anchor=\"end\">%s</text>\n", y + 4, models[m]
        printf "<path class=\"span\" d=\"M%.1f %dH%.1fM%.1f %dv10M%.1f %dv10\"/>\n", short, y, long, short, y - 5, long, y - 5
        printf "<circle class=\"corner\" cx=\"%.1f\" cy=\"%d\" r=\"5\"/>\n", px(time[models[m], "corner"]), y
      }
      print "</svg>"
    }' >"$folder/test_15.svg"
