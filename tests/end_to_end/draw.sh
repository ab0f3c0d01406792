#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The mall, drawn and planned: called as draw.sh DMRP_HOST LIBRARY_OF_FAULTS.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

expect_status 0 "$host" draw mall --planner dmrp.planner.cbs --svg "$scratch/mall.svg"
# planned paths alone have lines of this width: four, and the legend's
(($(grep -c 'stroke-width:2.5;' "$scratch/mall.svg") == 5)) || fail "the picture should show four paths"
expect_status 0 "$host" draw mall --planner dmrp.planner.cbs --svg "$scratch/again.svg"
cmp "$scratch/mall.svg" "$scratch/again.svg" || fail "the same picture differs"

# PNG and PDF by the file's ending
expect_status 0 "$host" draw mall --png "$scratch/mall.png"
[[ $(head -c 4 "$scratch/mall.png") == $'\x89PNG' ]] || fail "no PNG"
expect_status 0 "$host" draw mall --planner dmrp.planner.cbs --svg "$scratch/mall.pdf"
[[ $(head -c 5 "$scratch/mall.pdf") == %PDF- ]] || fail "no PDF"
expect_status 2 "$host" draw mall --svg "$scratch/mall.jpg"

# for writing coordinates: axes in metres, numbers and names of robots, names of regions
if command -v pdftotext >/dev/null; then
  pdftotext "$scratch/mall.pdf" "$scratch/mall.txt"
  for text in 0 1 2 3 40 'shoe shop' 'east entrance, north' 'electronics shop to pharmacy' 'planned path'; do
    grep -qw "$text" "$scratch/mall.txt" || fail "the picture should have $text"
  done
fi

# a device and a pipe get the picture and stay what they are; as links, so that a mistake cannot harm the machine
ln -s /dev/null "$scratch/sink" && ln -s /dev/full "$scratch/full" && mkfifo "$scratch/pipe.png"
expect_status 0 "$host" draw mall --svg "$scratch/sink"
expect_status 3 "$host" draw mall --svg "$scratch/full"
timeout 60 cat "$scratch/pipe.png" >"$scratch/read" &
expect_status 0 "$host" draw mall --png "$scratch/pipe.png"
[[ -L $scratch/sink && -L $scratch/full && -p $scratch/pipe.png ]] || fail "replaced: $(ls -l "$scratch")"
wait
cmp "$scratch/read" "$scratch/mall.png" || fail "no picture came through the pipe"

expect_status 0 "$host" draw mall
grep -q '^<svg ' "$scratch/stdout" || fail "no picture on standard output"

# draw and plan draw the same random robots for the same seed
expect_status 0 "$host" draw mall --agents 6 --seed 3 --planner dmrp.planner.cbs --svg "$scratch/six.svg"
(($(grep -c 'stroke-width:2.5;' "$scratch/six.svg") == 7)) || fail "the picture should show six paths"
drawn=$(sed -n 's/^dmrp.planner.cbs: \([0-9.]*\) m in all.*/\1/p' "$scratch/stderr")
expect_status 0 "$host" plan --scenario mall --agents 6 --seed 3 --planner dmrp.planner.cbs --paths "$scratch/six.csv"
planned=$(awk -F, -v agent=none 'NR > 1 { if ($1 == agent) sum += sqrt(($3 - x) ^ 2 + ($4 - y) ^ 2); agent = $1; x = $3; y = $4 }
  END { printf "%.2f", sum }' "$scratch/six.csv") # cells of 1 m
[[ -n $drawn && $drawn == "$planned" ]] || fail "plan should draw the same robots: $planned m, not $drawn m"
expect_status 0 "$host" draw mall --agents 6 --seed 3 --svg "$scratch/six.svg"
expect_status 0 "$host" draw mall --agents 6 --seed 3 --svg "$scratch/again.svg"
expect_status 0 "$host" draw mall --agents 6 --seed 4 --svg "$scratch/other.svg"
cmp "$scratch/six.svg" "$scratch/again.svg" || fail "the same seed should draw the same robots"
cmp -s "$scratch/six.svg" "$scratch/other.svg" && fail "another seed should draw others"
expect_status 2 "$host" draw mall --agents 5000
[[ $(cat "$scratch/stderr") == "--agents 5000: scenario 'mall' has room for "* ]] || fail "$(cat "$scratch/stderr")"

expect_status 2 "$host" draw mal
[[ $(cat "$scratch/stderr") == *"no scenario 'mal'"*"did you mean 'mall'?"* ]] || fail "$(cat "$scratch/stderr")"
expect_status 2 "$host" draw mall --planner dmrp.planner.cbz --svg "$scratch/none.svg"
[[ $(cat "$scratch/stderr") == *"did you mean 'dmrp.planner.cbs'?"* ]] || fail "$(cat "$scratch/stderr")"
expect_status 2 "$host" draw mall --planner dmrp.planner.cbs --set node_limits=5 --svg "$scratch/none.svg"
[[ $(cat "$scratch/stderr") == *"did you mean 'node_limit'?"* ]] || fail "$(cat "$scratch/stderr")"
[[ ! -e $scratch/none.svg ]] || fail "a mistake should leave nothing behind"

# a planner runs apart, as in `plan`: its crash is a line, and so is a path into a wall
expect_status 1 "$host" draw crossing --planner test.planner.faulty --plugin "$2" --set fault=crash --svg "$scratch/none.svg"
[[ $(tail -n 1 "$scratch/stderr") == "crash: test.planner.faulty: plan(): crashed (signal 11, Segmentation fault)" ]] ||
  fail "$(cat "$scratch/stderr")"
expect_status 1 "$host" draw crossing --planner test.planner.faulty --plugin "$2" --set fault=into_wall --svg "$scratch/none.svg"
grep -q "^bad_output: test.planner.faulty: plan(): invalid plan: robot 0, waypoint 2 .* is not on a free cell" "$scratch/stderr" ||
  fail "$(cat "$scratch/stderr")"
[[ ! -e $scratch/none.svg ]] || fail "a fault should leave no picture"

# tasks as difficult as wished
expect_status 0 "$host" draw library --agents 8 --seed 2 --conflicts-min 4 --conflicts-max 5 --in-corridors --svg "$scratch/eight.svg"
grep -Eq '^8 robots: [0-9]+ pairs of individual paths in conflict, [45] in corridors' "$scratch/stderr" ||
  fail "$(cat "$scratch/stderr")"
expect_status 2 "$host" draw mall --agents 2 --conflicts-min 2 --svg "$scratch/none.svg"
[[ $(cat "$scratch/stderr") == "--conflicts-min, --conflicts-max: none of 1000 draws of tasks for 2 robots in 'mall' has as many" ]] ||
  fail "$(cat "$scratch/stderr")"
expect_status 2 "$host" draw mall --agents 2 --conflicts-min 5 --conflicts-max 2 --svg "$scratch/none.svg"
[[ $(cat "$scratch/stderr") == *"--conflicts-min 5: is more than --conflicts-max 2" ]] || fail "$(cat "$scratch/stderr")"
expect_status 2 "$host" draw mall --conflicts-min 2 --svg "$scratch/none.svg"

# a test with levels, at its first one
expect_status 0 "$host" draw course/door --svg "$scratch/door.svg"
