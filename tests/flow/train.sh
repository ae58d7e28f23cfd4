#!/usr/bin/env bash
# Tests the trainer as a user runs it, in a window under Xvfb: the mouse moves the lever through 1-2-3-4-5-R and the
# gears engage; keys, panel, cameras, full screen, rapid resizing, a recording; and the validation layer reports
# nothing.
# Usage: train.sh GEARSHIFT SOURCE_FOLDER
set -u
gearshift=$1
flows=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$flows/checks.sh"
source "$flows/window.sh"

size=320x200 # small, so that frames are short and the mouse is read sooner
check "it starts" start drive --car none --gate paper --hand grip --no-panel
check "its window exists" [ -n "$window" ]
xdotool windowfocus "$window" mousemove --window "$window" 160 100 click 1
sleep 2 # time for the click to take effect, because no message reports that the mouse moves the lever
while read -r gear x y; do
  check "gear $gear by the mouse" shift_to "$gear" "$x" "$y"
done < <("$gearshift" gate "$2/assets/gates/paper.toml" --json | python3 -c '
import json, sys
gears = {gear["name"]: gear for gear in json.load(sys.stdin)["gears"]}
for gear in "12345R":
    x, y = gears[gear]["rest_mm"]
    print(gear, round(x), round(y * 1.1))')
check "in that order" [ "$(awk '/engaged/ && $3 != "N" {print $3}' drive.txt | tr '\n' ' ')" = "1 2 3 4 5 R " ]
import -window "$window" drive.png
check "the window shows a picture" [ "$(convert drive.png -resize 64x40 -format %k info:)" -gt 500 ]

key Escape
for k in F2 c c F1 F1 r F11; do key $k; done
check "panel, cameras, help and full screen" alive
key F11
key F2
check "the chosen view is kept for the next start" within 10 grep -q "^engineer$" config/gearshift/view.txt
key F2
check "and so is the other" within 10 grep -q "^learner$" config/gearshift/view.txt
for _ in $(seq 30); do xdotool windowsize "$window" $((RANDOM % 900 + 60)) $((RANDOM % 600 + 60)); sleep 0.02; done
xdotool windowunmap "$window"
sleep 0.5
xdotool windowmap "$window"
sleep 0.5
check "rapid resizing and hiding of the window" alive
xdotool windowsize "$window" 640 400 windowfocus "$window"
sleep 0.5
check "the large red button" press_for space "motors off" 1
check "the forces are turned on again" press_for Return "forces starting" 2
stops=1
for _ in 1 2 3; do
  xdotool mousemove --window "$window" 150 150
  sleep 0.7
  xdotool mousemove --window "$window" 565 365 click 1 # the mouse moves and clicks within one frame
  stops=$((stops + 1))
  check "STOP by a click with the mouse coming from the cabin" wait_for "motors off" $stops
  check "the forces are turned on again" press_for Return "forces starting" $((stops + 1))
done
recorded() { ls data/gearshift/recordings/*.trace >/dev/null 2>&1; }
replays() { "$gearshift" replay data/gearshift/recordings/*.trace 2>/dev/null | grep -q "^identical bit for bit"; }
key F9
check "a recording" within 20 recorded
sleep 1 # of driving
key F9
check "it replays" within 20 replays
key F9
check "the End key ends it" ended_by End
check "it closes the recording and prints its path" grep -q "^recorded: .*\.trace" drive.txt
check "the recording is complete" bash -c '"$0" replay "$(sed -n "s/^recorded: //p" drive.txt)" | grep -q "^identical bit for bit"' "$gearshift"
check "nothing on stderr except that there is no sound" [ "$(grep -vci 'sound' drive.err)" = 0 ]

check "it starts in stereo with a different gate" start stereo --stereo --gate five_speed_r_left_up --hand "by itself" --silent
check "the automatic hand shifts" wait_for "1 engaged"
xdotool windowfocus "$window"
check "the End key ends it, too" ended_by End
check "nothing on stderr" [ ! -s stereo.err ]

check "it starts with a lesson" start left --lesson moving_off --hand grip --no-help --silent --no-panel
xdotool windowfocus "$window"
check "the lesson begins" press_for Return "lesson moving_off begins" 1
check "the End key ends it" ended_by End
check "and it is reported as left" printed "lesson moving_off is over: not graded.*You left"

check "a lesson without a window" "$gearshift" train --offscreen memory --hand "by itself" --lesson moving_off --seconds 60 \
  --size 64x36 --no-help --silent >memory.txt
for words in "lesson moving_off begins" "step 6 of 6" "lesson moving_off is over: grade .*, passed"; do
  check "prints: $words" grep -q "$words" memory.txt
done
ended_in_memory() {
  "$gearshift" train --offscreen ended --lesson up_through_the_gears --seconds 600 --size 64x36 --no-help --silent \
    >ended.txt 2>ended.err &
  until grep -q "lesson up_through_the_gears begins" ended.txt || ! kill -0 $!; do sleep 0.005; done
  kill $!
  wait $!
  [ $? -eq 1 ]
}
check "ended early" ended_in_memory
check "the time is reported, got: $(cat ended.err)" grep -q "^gearshift: stopped after [0-9.]* of 600 s$" ended.err
check "in one sentence" [ "$(wc -l <ended.err)" -eq 1 ]
check "the lesson counts as left" grep -q "is over: not graded.*You left" ended.txt
check "its last picture is there" is_png ended/train.png
finish
