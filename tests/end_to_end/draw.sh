#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The mall, drawn and planned: called as draw.sh DMRP_HOST LIBRARY_OF_FAULTS.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

expect_status 0 "$host" draw mall --planner dmrp.planner.cbs --svg "$scratch/mall.svg"
(($(grep -c 'class="path"' "$scratch/mall.svg") >= 4)) || fail "the picture should show four paths"

for robot in 0 1 2 3; do
  grep -q "class=\"label\"[^>]*>$robot</text>" "$scratch/mall.svg" || fail "the picture should name robot $robot"
done
grep -q 'class="label"[^>]*>4</text>' "$scratch/mall.svg" && fail "the four robots have the numbers 0 to 3"

# for writing coordinates: axes in metres, a grid, regions with names, flows as arrows, names of robots
for text in 'axis">40</text>' 'name">shoe shop</text>' 'name ends">east entrance, north</text>' \
  'name">electronics shop to pharmacy</text>' 'class="flow"' 'class="major-grid"'; do
  grep -q "$text" "$scratch/mall.svg" || fail "the picture should have $text"
done

# PNG and PDF by rsvg-convert, here by a stand-in
mkdir "$scratch/tools" "$scratch/nothing"
cat >"$scratch/tools/rsvg-convert" <<'END'
#!/bin/sh
printf '%s\n' "$*" >"${0%/*}/arguments"
while [ "$1" != --output ]; do shift; done
grep -q '^<svg' "$3" && echo picture >"$2"
END
chmod +x "$scratch/tools/rsvg-convert"
PATH=$scratch/tools:$PATH expect_status 0 "$host" draw mall --png "$scratch/mall.png"
[[ $(cat "$scratch/mall.png") == picture ]] || fail "no picture: $(cat "$scratch/tools/arguments")"
PATH=$scratch/tools:$PATH expect_status 0 "$host" draw mall --svg "$scratch/mall.pdf"
grep -q -e '--format pdf' "$scratch/tools/arguments" || fail "$(cat "$scratch/tools/arguments")"
PATH=$scratch/nothing expect_status 3 "$host" draw mall --png "$scratch/other.png"
grep -q 'there is no rsvg-convert on the path.*apt-get install librsvg2-bin' "$scratch/stderr" || fail "$(cat "$scratch/stderr")"
compgen -G "$scratch/*.part" >/dev/null && fail "something was left behind: $(ls "$scratch")"
[[ ! -e $scratch/other.png ]] || fail "something was left behind: $(ls "$scratch")"
expect_status 2 "$host" draw mall --png "$scratch/mall.jpg"


# a device and a pipe get the picture and stay what they are; as links, so that a mistake cannot harm the machine
ln -s /dev/null "$scratch/sink" && ln -s /dev/full "$scratch/full" && mkfifo "$scratch/pipe.png"
expect_status 0 "$host" draw mall --svg "$scratch/sink"
expect_status 3 "$host" draw mall --svg "$scratch/full"
timeout 60 cat "$scratch/pipe.png" >"$scratch/read" &
PATH=$scratch/tools:$PATH expect_status 0 "$host" draw mall --png "$scratch/pipe.png"
[[ -L $scratch/sink && -L $scratch/full && -p $scratch/pipe.png ]] || fail "replaced: $(ls -l "$scratch")"
wait
[[ $(cat "$scratch/read") == picture ]] || fail "no picture came through the pipe"

expect_status 0 "$host" draw mall
grep -q '^<svg' "$scratch/stdout" || fail "no picture on standard output"

# draw and plan draw the same random robots for the same seed
starts() { sed -nE 's/.*<circle cx="([0-9.]+)" cy="([0-9.]+)"[^>]* class="robot".*/\1,\2/p' "$1"; }
relative() { awk -F, -v scale="$1" 'NR == 1 { x = $1; y = $2 } { print ($1 - x) / scale, ($2 - y) / scale }'; }
expect_status 0 "$host" draw mall --agents 6 --seed 3 --planner dmrp.planner.cbs --svg "$scratch/six.svg"
(($(grep -c 'class="path"' "$scratch/six.svg") >= 6)) || fail "the picture should show six paths"
expect_status 0 "$host" draw mall --agents 6 --seed 3 --svg "$scratch/again.svg"
expect_status 0 "$host" draw mall --agents 6 --seed 4 --svg "$scratch/other.svg"
[[ $(starts "$scratch/six.svg") == "$(starts "$scratch/again.svg")" ]] || fail "the same seed should draw the same robots"
[[ $(starts "$scratch/six.svg") != "$(starts "$scratch/other.svg")" ]] || fail "another seed should draw others"
expect_status 0 "$host" plan --scenario mall --agents 6 --seed 3 --planner dmrp.planner.cbs --paths "$scratch/six.csv"
[[ $(starts "$scratch/six.svg" | wc -l) == 6 && $(starts "$scratch/six.svg" | relative 20) == \
  "$(awk -F, '$2 == 0 { print $3 "," $4 }' "$scratch/six.csv" | relative 1)" ]] || # 20 px a cell of 1 m
  fail "plan should draw the same robots: $(starts "$scratch/six.svg") $(grep ',0,' "$scratch/six.csv")"
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
