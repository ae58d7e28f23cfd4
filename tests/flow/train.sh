#!/usr/bin/env bash
# The trainer as a person uses it, in a window under Xvfb: the mouse through 1-2-3-4-5-R and the gears engage; keys,
# panel, cameras, full screen, storms of sizes, a recording; and validation has nothing to say.
# Usage: train.sh GEARSHIFT SOURCE_FOLDER
set -u
gearshift=$1
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
export GEARSHIFT_VALIDATION=1 XDG_RUNTIME_DIR=$work/runtime XDG_CACHE_HOME=$work/cache XDG_DATA_HOME=$work/data
export XDG_CONFIG_HOME=$work/config
mkdir -m 700 runtime

start() { # name of the result, arguments ...
  local name=$1
  shift
  "$gearshift" train --size 640x400 "$@" >"$name.txt" 2>"$name.err" &
  trainer=$!
  log=$name
  wait_for "running" && window=$(xdotool search --onlyvisible --name '^gearshift$' | head -n 1)
}
wait_for() { # pattern in the log, at most 20 s
  for _ in $(seq 200); do
    grep -q -- "$1" "$log.txt" && return 0
    kill -0 $trainer 2>/dev/null || return 1
    sleep 0.1
  done
  return 1
}
key() { xdotool key "$1" && sleep 0.3; }
alive() { kill -0 $trainer; }
ended() { # with the exit code 0, within 10 s
  for _ in $(seq 100); do kill -0 $trainer 2>/dev/null || { wait $trainer; return; }; sleep 0.1; done
  kill -9 $trainer
  return 1
}

# The mouse leads the hand, 0.12 mm a pixel, up = forward, in steps as a hand makes them.
at_x=0 at_y=0
go() { # x, y in mm
  local to_x=$(($1 * 100 / 12)) to_y=$(($2 * 100 / 12)) step=20 dx dy
  while [ $at_x -ne $to_x ] || [ $at_y -ne $to_y ]; do
    dx=$((to_x - at_x)) dy=$((to_y - at_y))
    [ $dx -gt $step ] && dx=$step
    [ $dx -lt -$step ] && dx=-$step
    [ $dy -gt $step ] && dy=$step
    [ $dy -lt -$step ] && dy=-$step
    xdotool mousemove_relative -- $dx $((-dy))
    at_x=$((at_x + dx)) at_y=$((at_y + dy))
    sleep 0.03
  done
  sleep 0.3
}
shift_to() { # gear, x and y of its end in mm
  go "$at_mm" 0
  go "$2" 0
  go "$2" "$3"
  at_mm=$2
  wait_for " $1 engaged"
}

check "it starts" start drive --hand grip --no-panel
check "its window is there" [ -n "$window" ]
xdotool windowfocus "$window" mousemove --window "$window" 320 200 click 1
sleep 0.5
at_mm=0
while read -r gear x y; do
  check "gear $gear by the mouse" shift_to "$gear" "$x" "$y"
done < <("$gearshift" gate "$2/assets/gates/paper.toml" --json | python3 -c '
import json, sys
gears = {gear["name"]: gear for gear in json.load(sys.stdin)["gears"]}
for gear in "12345R":
    x, y = gears[gear]["rest_mm"]
    print(gear, round(x), round(y * 1.1))')
check "in that order" [ "$(awk '/engaged/ && $3 != "N" {print $3}' drive.txt | tr '\n' ' ')" = "1 2 3 4 5 R " ]
import -window root drive.png
check "the window shows a picture" [ "$(convert drive.png -resize 64x40 -format %k info:)" -gt 500 ]

key Escape
for k in Tab c c F1 F1 r F11; do key $k; done
check "panel, cameras, help and full screen" alive
key F11
for _ in $(seq 30); do xdotool windowsize "$window" $((RANDOM % 900 + 60)) $((RANDOM % 600 + 60)); sleep 0.02; done
xdotool windowunmap "$window"
sleep 0.5
xdotool windowmap "$window"
sleep 0.5
check "a storm of sizes and a window that hides" alive
xdotool windowsize "$window" 640 400 windowfocus "$window"
sleep 0.5
key space
check "the large red button" wait_for released
key Return
rampings() { [ "$(grep -c ramping drive.txt)" -ge "$1" ]; }
check "armed again" rampings 2
key F9
sleep 1
key F9
check "a recording" bash -c 'ls data/gearshift/recordings/*.trace'
check "it replays" bash -c '"$0" replay data/gearshift/recordings/*.trace | grep -q "^bit for bit"' "$gearshift"
key End
check "its key ends it" ended
check "nothing on stderr but that there is no sound" [ "$(grep -vci 'sound' drive.err)" = 0 ]

check "again, stereo, another gate" start stereo --stereo --gate five_speed_r_left_up --hand "by itself" --silent
check "the hand that needs nobody shifts" wait_for "1 engaged"
xdotool windowfocus "$window"
key End
check "its key ends it, too" ended
check "nothing on stderr" [ ! -s stereo.err ]
finish
