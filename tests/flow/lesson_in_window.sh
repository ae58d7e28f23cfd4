#!/usr/bin/env bash
# Tests a lesson in the window: a user drives it with mouse and keys under Xvfb, and passes. Then the simulated driver
# passes the same lesson without a window. Both runs must be in the report.
# Usage: lesson_in_window.sh GEARSHIFT SOURCE_FOLDER
set -u
needs_machine=yes
gearshift=$1
flows=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$flows/checks.sh"
source "$flows/window.sh"

down() { xdotool keydown "$1"; }
up() { xdotool keyup "$1"; }
is_over() { printed "lesson moving_off is over"; }
at_step() { printed "step $1 of 6"; }
# [s] Time for the engine to respond to the throttle. A key press takes effect up to one frame late, and frames are long
# on a busy machine.
revs=1.2
first=$("$gearshift" gate "$2/assets/gates/five_speed_r_right_down.toml" --json | python3 -c '
import json, sys
gears = {gear["name"]: gear for gear in json.load(sys.stdin)["gears"]}
x, y = gears["1"]["rest_mm"]
print(round(x), round(y * 1.1))')

size=320x200 # small, so that frames are short and keys are read sooner
check "it starts with the lesson" start drive --lesson moving_off --learner Ada --mode follow-me --no-help --no-panel
check "and prints the lesson's goal" wait_for "lesson moving_off is ready to start: Move off smoothly"
xdotool windowfocus "$window" mousemove --window "$window" 160 50 click 1
sleep 2 # time for the click to take effect, because no message reports that the mouse moves the lever
check "Enter begins it" press_for Return "lesson moving_off begins" 1
down a
check "clutch down" within 20 at_step 2
check "first gear" shift_to 1 $first
check "the lesson notices first gear" within 20 at_step 3
key h
check "the lesson notices the released handbrake" within 20 at_step 4
for _ in 1 2 3; do key d; done # the throttle stays there until the brake lets it off
sleep $revs
up a
check "the car moves off" within 20 at_step 5
down a
down s
check "the car stops" within 20 at_step 6
up s
for _ in 1 2 3; do key d; done # the throttle stays there until the brake lets it off
sleep $revs
up a
check "the car moves off again, and the lesson is over" within 20 is_over
check "passed" printed "lesson moving_off is over: grade .*/10, passed"
import -window root over.png
check "the End key ends it" ended_by End
check "nothing on stderr except that there is no sound" [ "$(grep -vci 'sound' drive.err)" = 0 ]

check "the simulated driver passes it, too" \
  "$gearshift" lesson moving_off --learner Ada --database "$work/data/gearshift/history.db" >headless.txt
check "the report is written" "$gearshift" report --learner Ada --out page --csv
check "both runs are in it" [ "$(grep -c moving_off page/runs.csv)" = 2 ]
passed_runs() { python3 -c 'import csv; print(sum(row["passed"] == "1" for row in csv.DictReader(open("page/runs.csv", encoding="utf-8-sig"))))'; }
check "both passed" [ "$(passed_runs)" = 2 ]
check "with the shifts" [ "$(wc -l <page/shifts.csv)" -ge 2 ]
[ -n "${GEARSHIFT_PICTURES:-}" ] && cp -r over.png page drive.txt data "$GEARSHIFT_PICTURES"
finish
