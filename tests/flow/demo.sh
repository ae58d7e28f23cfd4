#!/usr/bin/env bash
# Tests the demo as a user without a display runs it: pictures, sound, traces, report and page are complete, a second
# run writes the same files, and the validation layer reports nothing.
# Usage: demo.sh GEARSHIFT SOURCE_FOLDER
set -u
gearshift=$1
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
unset DISPLAY WAYLAND_DISPLAY
export GEARSHIFT_VALIDATION=1 XDG_CACHE_HOME=$work/cache XDG_RUNTIME_DIR=$work/runtime XDG_DATA_HOME=$work/data
mkdir -m 700 runtime

size=192x108
demo() { # takes the output folder and the arguments of the demo
  local name=$1
  shift
  "$gearshift" demo --out "$name" --size $size "$@" >"$name.txt" 2>"$name.err"
}
same() { cmp -s "$1" "$2"; }
shown_files_exist() {
  local file
  for file in $(grep -oE '(src|href)="[^"]+"' one/index.html | sed 's/.*="//; s/"//'); do
    [ -s "one/$file" ] || { echo "missing: $file"; return 1; }
  done
}

captioned() {
  local pictures
  pictures=$(grep -c "<img " one/index.html)
  [ "$pictures" -ge 15 ] && [ "$(grep -cE "<figcaption>[^<]{8,}</figcaption>" one/index.html)" = "$pictures" ]
}
has_no() { ! grep -qE "$2" "$1"; }

check "demo of the paper's gate" demo one
check "nothing on stderr, validation included" [ ! -s one.err ]
check "six gears in the order of Fig. 9" [ "$(awk '/engaged/{print $1}' one.txt | tr '\n' ' ')" = "1 2 3 4 5 R " ]
for picture in cabin driver clamp gearbox cluster gear_1 gear_R hill_start_bite up_through_the_gears_ring contact_sheet; do
  check "$picture.png is a picture" is_png "one/$picture.png"
done
check "everything that the page shows is there" shown_files_exist
check "each picture of the page has alternative text" captioned
check "pictures are laid out side by side, on a screen and on paper" [ "$(grep -c "grid-template-columns" one/index.html)" = 3 ]
check "the page loads nothing from other hosts" has_no one/index.html "http|<script|@import|url\("
check "sound is a WAV file" grep -q WAVE <(head -c 16 one/demo.wav)
check "its trace replays" "$gearshift" replay one/tour.trace
for lesson in hill_start up_through_the_gears; do
  check "the trace of $lesson replays" "$gearshift" replay "one/$lesson.trace"
done
check "both lessons and the drive through every gear are passed" [ "$(grep -c "^  Passed in .* with a grade of" one.txt)" = 3 ]
check "the learner's report has both lessons" [ "$(grep -oE "Hill start|Up through the gears" one/report.html | sort -u | wc -l)" = 2 ]
check "nothing is saved for the user" [ -z "$(find data -name history.db 2>/dev/null)" ]
if is_full_run; then
  check "the demo runs again" demo two
  check "both runs wrote the same files, including the page" diff -rq one two
fi
# `./run` without a display starts the full-size demo, like the command below. Without ./test --full, this test stops
# the demo after its first picture.
stale() { DISPLAY=:987 WAYLAND_DISPLAY=wayland-0 "$gearshift" train --or-demo stale >stale.txt 2>stale.err; }
begins() {
  DISPLAY=:987 WAYLAND_DISPLAY=wayland-0 "$gearshift" train --or-demo stale >stale.txt 2>stale.err &
  for _ in $(seq 600); do [ -s stale/cabin.png ] && break; sleep 0.1; done
  kill $!
  wait $!
  [ $? -eq 1 ]
}
pictures_are_complete() { # checks that every picture that exists is complete
  local picture
  for picture in stale/*.png; do tail -c 8 "$picture" | grep -qa IEND || { echo "torn: $picture"; return 1; }; done
  is_png stale/cabin.png && [ ! -e stale/index.html ] && ! compgen -G "stale/*part*" >/dev/null
}
if is_full_run; then
  check "train without a reachable display runs the demo" stale
  check "its page is there" [ -s stale/index.html ]
else
  check "train without a reachable display runs the demo, ended early here" begins
  check "it says where, got: $(cat stale.err)" [ "$(cat stale.err)" = \
    "gearshift: interrupted during \"pictures\"; finished files were kept, but no page was written" ]
  check "no partial file is left" pictures_are_complete
fi
check "the missing display is reported" grep -q "^No display" stale.txt
different() { ! same "$1" "$2"; }
check "first and fifth gear do not look the same" different one/gear_1.png one/gear_5.png
size=64x36
check "a different gate, stereo and a film" demo film --gate six_speed_r_left_up --stereo --film 0.1 --samples 1
check "the film has frames" is_png film/film/00003.png

refused() { # takes the text of the error and the arguments of gearshift
  local sentence=$1
  shift
  "$gearshift" "$@" >refused.txt 2>refused.err && return 1
  [ "$(wc -l <refused.err)" = 1 ] && grep -q -- "$sentence" refused.err
}
check "an invalid size" refused "must be WIDTHxHEIGHT" demo --out no --size 1280
check "a size that is too large" refused "16 to 8192" demo --out no --size 99999x2
check "three samples" refused "samples" demo --out no --samples 3
check "no folder was made" [ ! -e no ]
check "train without a display reports that there is none" refused "no display" train
check "an unknown GPU is named" env GEARSHIFT_GPU=nonesuch bash -c "! '$gearshift' demo --out gpu 2>gpu.err && [ \$(wc -l <gpu.err) = 1 ]"
finish
