#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Videos of a trial, by a stand-in of ffmpeg: called as video.sh DMRP_HOST.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

cd "$scratch" || exit 1
expect_status 0 "$host" "$here/crossing.toml" --quiet --trials 1 --out run

# notes its arguments and the number of bytes that it gets, and writes the last argument
mkdir tools empty
cat >tools/ffmpeg <<'END'
#!/bin/sh
printf '%s\n' "$@" >arguments
wc -c >bytes
for file in "$@"; do :; done
echo video >"$file"
END
chmod +x tools/ffmpeg
with_ffmpeg=$PWD/tools:$PATH

for ending in mp4 gif; do
  PATH=$with_ffmpeg expect_status 0 "$host" video run --trial 0 --out "trial.$ending"
  [[ $(cat "trial.$ending") == video && ! -e trial.$ending.part ]] || fail "no trial.$ending"
  frames=$(sed -nE 's/.*: ([0-9]+) frames, .*/\1/p' stdout)
  size=$(grep -xE '[0-9]+x[0-9]+' arguments)
  (($(cat bytes) == frames * 4 * ${size%x*} * ${size#*x})) || fail "$(cat bytes) bytes, not $frames frames of $size"
  rate=$(grep -x -A1 -e -r arguments | tail -1)
  seconds=$(query run "SELECT sim_time_s FROM trial WHERE id = 0")
  # the trial and one second of its end, to a frame or two
  awk -v f="$frames" -v r="$rate" -v s="$seconds" 'BEGIN { exit !(f / r > s + 0.9 && f / r < s + 1.3) }' ||
    fail "$frames frames at $rate a second for $seconds s"
done

# 1080p, and a part of the trial at another speed: two seconds in one, and a second of its end
expect_status 0 env PATH="$with_ffmpeg" "$host" video run --trial 0 --out part.mp4 --from 1 --to 3 --speed 2 --title "a part"
grep -qx 1920x1080 arguments || fail "not 1080p: $(cat arguments)"
[[ $(cat stdout) == "part.mp4: 51 frames, 2.0 s" ]] || fail "$(cat stdout)"
expect_status 2 "$host" video run --trial 0 --out part.mp4 --from 3 --to 1
expect_status 2 "$host" video run --trial 0 --out part.mp4 --from 1000
grep -q -- '--from 1000: trial 0 ends at' stderr || fail "$(cat stderr)"

# a pipe stays one
mkfifo pipe.mp4
timeout 60 cat pipe.mp4 >"$scratch/read" &
PATH=$with_ffmpeg expect_status 0 "$host" video run --trial 0 --out pipe.mp4 --to 0.2
[[ -p pipe.mp4 ]] || fail "the pipe was replaced"
wait
[[ $(cat read) == video && ! -e pipe.mp4.part ]] || fail "no video came through the pipe"

PATH=$PWD/empty expect_status 3 "$host" video run --trial 0 --out none.mp4
grep -q 'there is no ffmpeg on the path.*apt-get install ffmpeg' stderr || fail "$(cat stderr)"

# one that fails at once, and one that fails in the end
printf '#!/bin/sh\nexit 1\n' >tools/ffmpeg
PATH=$with_ffmpeg expect_status 3 "$host" video run --trial 0 --out none.mp4
printf '#!/bin/sh\ncat >/dev/null\nexit 1\n' >tools/ffmpeg
PATH=$with_ffmpeg expect_status 3 "$host" video run --trial 0 --out none.mp4 --to 0.2
grep -q 'ffmpeg failed' stderr || fail "$(cat stderr)"
[[ ! -e none.mp4 && ! -e none.mp4.part ]] || fail "a failed video left files"

expect_status 2 "$host" video run --trial 0 --out none.avi
grep -q -- '--out none.avi: ends in none of .mp4, .gif, .webm' stderr || fail "$(cat stderr)"
expect_status 2 "$host" video run --trial 99 --out none.mp4
grep -q -- '--trial 99: run has 4 finished trials, from 0 to 3' stderr || fail "$(cat stderr)"
expect_status 2 "$host" video empty --trial 0 --out none.mp4
rm run/traces/*
expect_status 2 "$host" video run --trial 0 --out none.mp4
grep -q 'no trace was recorded' stderr || fail "$(cat stderr)"
