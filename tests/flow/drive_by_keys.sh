#!/usr/bin/env bash
# Tests driving by keys alone, in a window under Xvfb that draws about ten frames a second: hill start, stop and go, and
# reverse are passed. A user presses a key only after the trainer has printed the step that asks for it.
# Usage: drive_by_keys.sh GEARSHIFT SOURCE_FOLDER [REPEATS]
set -u
needs_machine=yes
gearshift=$1
repeats=${3:-1}
flows=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$flows/checks.sh"
life=$((120 + 240 * repeats))
source "$flows/window.sh"

down() { xdotool keydown "$1"; }
up() { xdotool keyup "$1"; }
tap() { # takes a key and how often; a person needs a tenth of a second for each press
  local i
  for ((i = 0; i < $2; ++i)); do
    xdotool key "$1"
    sleep 0.1
  done
}
step() { # waits for a step of the lesson, and then for the user's reaction
  within 40 printed "step $1 of" && sleep 0.4
}
over() { within 40 printed "is over"; }
move_off() { # takes the steps of the throttle
  tap d "$1"
  sleep 1
  up a
}

hill_start() {
  down a
  step 2
  tap Prior 1 # Page Up
  step 3
  tap d 6
  sleep 1
  up a
  step 4
  tap h 1
  over
}
stop_and_go() {
  local go
  down a
  sleep 0.4
  tap Prior 1
  step 2
  tap h 1
  for go in 3 5 7; do
    step $go
    up s
    move_off 3
    step $((go + 1))
    down s
    down a
  done
  over
  up s
  up a
}
reverse() {
  down a
  step 2
  sleep 1.5
  tap Next 1 # Page Down
  step 3
  tap h 1
  step 4
  move_off 1
  step 5
  down s
  down a
  step 6
  tap Prior 2
  step 7
  up s
  move_off 3
  over
}

size=960x540
for ((run = 1; run <= repeats; ++run)); do
  for lesson in hill_start stop_and_go reverse; do
    check "$lesson starts" start $lesson --lesson $lesson --no-help --silent --mode follow-me
    xdotool windowfocus "$window"
    check "$lesson begins" press_for Return "lesson $lesson begins" 1
    $lesson
    check "$lesson, run $run, is passed: $(tail -n 4 $log.txt)" printed "lesson $lesson is over: grade .*/10, passed"
    for k in a s d; do up $k; done
    check "the End key ends it" ended_by End
  done
done
finish
