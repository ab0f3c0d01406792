#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Writes the closed rings of tests 4 and 16, one file for each density, beside their experiments in FOLDER, as the build
# does: rings.sh FOLDER
#
# A ring keeps its density, and has no ends, entrances or corners. People start evenly in its four quarters and walk
# counter-clockwise through 16 gates, for more laps than anybody can finish in the time.
set -euo pipefail
to=$1
mkdir -p "$to/04_fundamental_diagram" "$to/16_single_file"

# ring INNER OUTER PEOPLE NAME TITLE DESCRIPTION LIMIT LAPS: radii of the corners of both walls, 48-sided, m; people a quarter
ring() {
  awk -v inner="$1" -v outer="$2" -v people="$3" -v name="$(basename "$4")" -v title="$5" -v description="$6" -v limit="$7" -v laps="$8" '
    function at(radius, side) { return sprintf("[%.4f, %.4f]", c + radius * cos(side * step), c + radius * sin(side * step)) }
    function low(a, b) { return a < b ? a : b }
    function high(a, b) { return a < b ? b : a }
    function region(name, x0, y0, x1, y1) {
      printf "\n[[region]]\nname = \"%s\"\nlower_m = [%.2f, %.2f]\nupper_m = [%.2f, %.2f]\n", name, x0, y0, x1, y1
    }
    BEGIN {
      sides = 48; gates = 16; pi = atan2(0, -1); step = 2 * pi / sides
      c = outer + 0.1
      print "# SPDX-License-Identifier: MIT"
      print "# Written by tests/rimea/rings.sh."
      printf "\n[scenario]\nname = \"%s\"\ntitle = \"%s\"\ndescription = \"%s\"\n", name, title, description
      printf "size_m = [%.1f, %.1f]\ntime_limit_s = %.1f\n", 2 * c, 2 * c, limit
      print "\n[people]\nspeed_mean = 1.34  # Weidmann'"'"'s adults\nspeed_sd = 0.26"

      printf "\n[[polygon]]\nname = \"inside\"\nvertices_m = [\n"
      for (i = 0; i < sides; ++i) printf "  %s,\n", at(inner, i)
      print "]"
      for (i = 0; i < sides; ++i)
        printf "\n[[polygon]]\nname = \"outer wall %d\"\nvertices_m = [%s, %s, %s, %s]\n", i + 1, at(outer, i),
          at(1.5 * outer, i), at(1.5 * outer, i + 1), at(outer, i + 1)

      # a gap at the axes, so that people of adjacent quarters do not overlap
      gap = 0.23
      region("quarter 1", c + gap, c + gap, 2 * c, 2 * c)
      region("quarter 2", 0, c + gap, c - gap, 2 * c)
      region("quarter 3", 0, 0, c - gap, c - gap)
      region("quarter 4", c + gap, 0, 2 * c, c - gap)
      for (g = 1; g <= gates; ++g) {
        x = cos(g * 2 * pi / gates); y = sin(g * 2 * pi / gates); edge = 0.2
        region("gate " g, c + low(inner * x, outer * x) - edge, c + low(inner * y, outer * y) - edge,
               c + high(inner * x, outer * x) + edge, c + high(inner * y, outer * y) + edge)
      }
      for (q = 1; q <= 4; ++q) {
        printf "\n[[flow]]\nname = \"from quarter %d\"\nfrom = \"quarter %d\"\nvia = [\n", q, q
        for (lap = 0; lap < laps; ++lap) {
          printf " "
          for (g = 0; g < gates; ++g) printf " \"gate %d\",", (q * gates / 4 + g) % gates + 1
          print ""
        }
        printf "]\nto = \"gate %d\"\npeople = %d\nstart = \"from\"\nrespawn = false\n", q * gates / 4 % gates + 1, people
      }
    }' >"$to/$4.toml"
}

# test 4: 3 m wide, 160 m2 between the walls: 24 sin(2 pi / 48) (outer^2 - inner^2)
for people in 10 20 40 60 80 120 160; do
  density=$(awk -v n="$people" 'BEGIN { printf "%.4g", 4 * n / 160 }')
  ring 7.0126 10.0126 "$people" "04_fundamental_diagram/ring_$density" "RiMEA 4: $density people/m2" \
    "$((4 * people)) people walk round a ring of 160 m2" 70 3
done

# test 16: 0.8 m wide, as the corridor of Seyfried et al. (2005), 24 m along the middle:
# 96 sin(pi / 48) (outer + inner) / 2
for people in 1 2 3 4 6 8 10 12; do
  density=$(awk -v n="$people" 'BEGIN { printf "%.4g", 4 * n / 24 }')
  ring 3.4225 4.2225 "$people" "16_single_file/ring_$density" "RiMEA 16: $density people/m" \
    "$((4 * people)) people walk in a line round a ring of 24 m" 70 7
done
