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

# Ended from outside, too, it leaves nothing running; where it cannot end them itself, their time is up soon.
trainer= server=
end_all() {
  kill $trainer $server 2>/dev/null
  rm -rf "$work"
}
trap end_all EXIT
trap 'exit 1' HUP INT TERM
timeout 290 Xvfb -displayfd 3 -screen 0 1280x720x24 -noreset 3>display 2>xvfb.err &
server=$!

within() { # seconds, command ...: until it succeeds
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    [ $SECONDS -lt $end ] || return 1
    sleep 0.1
  done
}
has_display() { [ -s display ]; }
within 20 has_display || { cat xvfb.err; exit 1; }
DISPLAY=:$(cat display)
export DISPLAY

start() { # name of the result, arguments ...
  local name=$1
  shift
  timeout 200 "$gearshift" train --size 640x400 "$@" >"$name.txt" 2>"$name.err" &
  trainer=$!
  log=$name
  within 20 find_window && wait_for "running"
}
find_window() { window=$(xdotool search --onlyvisible --name '^gearshift$' 2>/dev/null | head -n 1) && [ -n "$window" ]; }
said() { [ "$(grep -c -- "$1" "$log.txt")" -ge "${2:-1}" ]; }
wait_for() { within 20 said "$@"; } # pattern in the log, and how often
key() { xdotool key "$1" && sleep 0.3; }
# A key that may be pressed again: until the log has the pattern so often, or the trainer is gone.
press_until_said() { key "$1" && within 3 said "$2" "$3"; }
press_for() { within 20 press_until_said "$@"; }
alive() { kill -0 $trainer 2>/dev/null; }
is_gone() { ! alive; }
press_until_gone() { key "$1" && within 5 is_gone; }
ended_by() { within 20 press_until_gone "$1" && wait $trainer; } # with the exit code 0

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
# A machine that is busy may draw few frames: then the hand cuts a corner, hangs at a wall, and goes again.
shift_to() { # gear, x and y of its end in mm
  for _ in 1 2 3; do
    go "$at_mm" 0
    go "$2" 0
    go "$2" "$3"
    at_mm=$2
    within 6 said " $1 engaged" && return 0
  done
  return 1
}

check "it starts" start drive --hand grip --no-panel
check "its window is there" [ -n "$window" ]
xdotool windowfocus "$window" mousemove --window "$window" 320 200 click 1
sleep 2 # until the mouse leads: nothing tells of it
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
for k in F2 c c F1 F1 r F11; do key $k; done
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
check "the large red button" press_for space released 1
check "armed again" press_for Return ramping 2
stops=1
for _ in 1 2 3; do
  xdotool mousemove --window "$window" 150 150
  sleep 0.7
  xdotool mousemove --window "$window" 565 365 click 1 # all in a frame
  stops=$((stops + 1))
  check "STOP by a click of a mouse that comes from the cabin" wait_for released $stops
  check "and armed again" press_for Return ramping $((stops + 1))
done
recorded() { ls data/gearshift/recordings/*.trace >/dev/null 2>&1; }
replays() { "$gearshift" replay data/gearshift/recordings/*.trace 2>/dev/null | grep -q "^bit for bit"; }
key F9
check "a recording" within 20 recorded
sleep 1 # of driving
key F9
check "it replays" within 20 replays
key F9
check "its key ends it" ended_by End
check "and closes what it recorded, and says where" grep -q "^recorded: .*\.trace" drive.txt
check "it is whole" bash -c '"$0" replay "$(sed -n "s/^recorded: //p" drive.txt)" | grep -q "^bit for bit"' "$gearshift"
check "nothing on stderr but that there is no sound" [ "$(grep -vci 'sound' drive.err)" = 0 ]

check "again, stereo, another gate" start stereo --stereo --gate five_speed_r_left_up --hand "by itself" --silent
check "the hand that needs nobody shifts" wait_for "1 engaged"
xdotool windowfocus "$window"
check "its key ends it, too" ended_by End
check "nothing on stderr" [ ! -s stereo.err ]
finish
