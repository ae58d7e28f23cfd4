#!/usr/bin/env bash
# Faults of what lies beneath the program while a person's lesson is driven and recorded: the lever goes on or stands
# without force, what is due is told once, run and recording are kept. Clock, GPU, sound and writes fail by a library that
# is preloaded; the disk is a small one of its own.
# Usage: faults.sh GEARSHIFT SOURCE_FOLDER PRELOADED_FAULTS
set -u
needs_machine=yes
gearshift=$1 preloaded=$3
# Root's own disks are mounted where nobody else sees them; where that may not be, these faults are left out.
has_mounts=${GEARSHIFT_OWN_MOUNTS:-}
if [ -z "$has_mounts" ]; then
  [ "$(id -u)" = 0 ] && as_root=-m || as_root=-rm
  export GEARSHIFT_OWN_MOUNTS=yes
  unshare $as_root true 2>/dev/null && exec unshare $as_root bash "$0" "$@"
  has_mounts=no
fi
flows=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$flows/checks.sh"

source "$flows/window.sh"
unset GEARSHIFT_VALIDATION # it has its own word on what the library does not let through
size=160x120
export INJECTED_FAULTS=$work/faults ALSOFT_DRIVERS=null
mkdir faults
beneath=(env LD_PRELOAD="$preloaded")

inject() { echo "$2" >"faults/.$1" && mv "faults/.$1" "faults/$1"; } # fault, number
mend() { rm "faults/$1"; }
logged() { [ "$(grep -cF -- "$1" "$log.txt" "$log.err" | awk -F: '{sum += $2} END {print sum}')" -ge "${2:-1}" ]; }
told_once() { [ "$(cat "$log.txt" "$log.err" | grep -cF -- "$1")" -eq 1 ]; } # sentence
lesson() { # name, arguments ...: a lesson that a person has begun, recorded
  start "$@" --lesson moving_off --learner Ada --mode follow-me --no-help --no-panel --hand grip || return 1
  xdotool windowfocus "$window"
  press_for Return "lesson moving_off begins" 1
}
# The key ends the lesson; the newest run is in the history, left, and its recording is whole.
left_runs() { # of the history, with recordings
  python3 - "$work/data/gearshift" <<'END_OF_PYTHON'
import os, sqlite3, sys
rows = sqlite3.connect(sys.argv[1] + "/history.db").execute(
    "SELECT ended, recording FROM lesson_run ORDER BY id").fetchall()
ended = [row[0] for row in rows]
assert all(ended), ended
print(len(rows))
print(rows[-1][1])
END_OF_PYTHON
}
ended() { ended_by End || { kill "$trainer" && wait "$trainer"; false; }; }
runs=0
kept() {
  local rows recording
  ended || return 1
  said "lesson moving_off is over: not graded.*was left" || return 1
  rows=$(left_runs) || return 1
  runs=$((runs + 1))
  [ "$(head -n 1 <<<"$rows")" -eq $runs ] || return 1
  recording=$(tail -n 1 <<<"$rows")
  "$gearshift" replay "data/gearshift/$recording" | grep -q "^bit for bit"
}
running_again() { [ "$(grep 'guard: ' "$log.txt" | tail -n 1 | sed 's/.*guard: //')" = running ]; }
lever_goes_on() { ! grep -q "guard: damped\|guard: released" "$log.txt"; }

# The picture, the sound and the wall clock.
check "picture: a lesson begins" lesson picture
inject gpu 1
check "picture: told" within 20 logged "the picture is made anew, the lever goes on"
xdotool mousemove --window "$window" 50 50 # a picture of it
check "picture: the lever goes on" lever_goes_on
inject sound 1
check "sound: told" within 10 logged "the sound device was lost"
sleep 1.2 # it is looked for each second
mend sound
check "sound: back, told" within 10 logged "the sound is back"
check "picture: told once" told_once "the picture is made anew"
check "sound: told once" told_once "the sound device was lost"
inject clock 3600
sleep 0.3
inject clock -3600
sleep 0.3
check "clock: the lever goes on" lever_goes_on
check "picture, sound, clock: run and recording are kept" kept
mend clock
span() { # of the newest run [s], as the history has it
  python3 -c '
import sqlite3, sys
print(*sqlite3.connect(sys.argv[1]).execute("SELECT duration_s FROM lesson_run ORDER BY id DESC LIMIT 1").fetchone())' \
    "$work/data/gearshift/history.db"
}
check "clock: the lesson lasted as long as it did, got $(span) s" awk -v s="$(span)" 'BEGIN {exit !(s > 1 && s < 200)}'
check "and nothing else is told, got: $(grep -v picture picture.err)" [ "$(wc -l <picture.err)" -eq 1 ]

# A device that is lost again and again: no picture, but lever, lesson and keys.
check "no picture: a lesson begins" lesson blind
inject gpu 2
check "no picture: told" within 20 logged "the picture is made anew"
sleep 2.5 # some attempts
check "no picture: alive" alive
mend gpu
check "no picture: kept" kept
check "no picture: told once, got: $(cat blind.err)" [ "$(wc -l <blind.err)" -eq 1 ]

# The program stands still.
check "stopped: a lesson begins" lesson stopped
sleep 1
pid=$(pgrep -P "$trainer" -x gearshift)
kill -STOP "$pid"
sleep 3
kill -CONT "$pid"
check "stopped: forces again" within 10 running_again
check "stopped: kept" kept
check "stopped: nothing on stderr, got: $(cat stopped.err)" [ ! -s stopped.err ]

# All of it on one core, beside who never sleeps.
check "one core: a lesson begins" lesson hog
pid=$(pgrep -P "$trainer" -x gearshift)
timeout 30 taskset -c 0 sh -c 'while :; do :; done' &
hog=$!
taskset -acp 0 "$pid" >/dev/null
sleep 2
taskset -acp "0-$(($(nproc) - 1))" "$pid" >/dev/null
kill $hog
check "one core: forces again, if they were gone" within 10 running_again
check "one core: kept" kept
check "one core: what the loop missed is counted" said "^loop: [0-9]* deadlines missed, [0-9]* cycles too long, 0 events lost"
check "one core: nothing on stderr, got: $(cat hog.err)" [ ! -s hog.err ]

# The disk's errors make it read-only, and somebody mends it before the end.
check "read-only meanwhile: a lesson begins" lesson refused
inject write 30 # EROFS
check "read-only meanwhile: told" within 20 logged "the recording failed after"
check "read-only meanwhile: the lever goes on" lever_goes_on
mend write
check "read-only meanwhile: its key ends it" ended
check "read-only meanwhile: told once" told_once "the recording failed after"
check "read-only meanwhile: nothing is lost, got: $(cat refused.err)" [ ! -s refused.err ]

if [ "$has_mounts" = yes ]; then
  mkdir small home
  mount -t tmpfs -o size=2m none small
  XDG_DATA_HOME=$work/small
  check "full disk: a lesson begins" lesson full
  dd if=/dev/zero of=small/filler bs=4k 2>/dev/null
  check "full disk: told" within 20 logged "the recording failed after"
  check "full disk: the lever goes on" lever_goes_on
  check "full disk: its key ends it" ended
  check "full disk: told once" told_once "the recording failed after"
  check "full disk: what is lost is told at the end, got: $(cat full.err)" \
    [ "$(grep -c "the disk is full.*lost with this program: 1 run$" full.err)" = "$(wc -l <full.err)" ]

  mount -t tmpfs -o size=1m none home
  mount -o remount,ro home
  XDG_DATA_HOME=$work/home/data XDG_CONFIG_HOME=$work/home/config # a driver without its cache takes its time to begin
  check "read-only home: a lesson begins" lesson read_only
  check "read-only home: its key ends it" ended
  check "read-only home: told at the start" [ "$(grep -c "the history cannot be used: .*Read-only" read_only.txt)" = 1 ]
  check "read-only home: the lesson was driven" said "lesson moving_off is over: not graded.*was left"
  check "read-only home: what is lost is told at the end, got: $(cat read_only.err)" \
    [ "$(grep -c "Read-only file system; lost with this program: 1 run$" read_only.err)" = 1 ]
else
  echo "skipped: no disk may be mounted"
fi
XDG_CONFIG_HOME=$work/config
[ "$has_mounts" = no ] || umount small home

whole && check "a day of lessons: nothing grows" "$flows/soak.sh" "$gearshift" "$2" week "$work/day.csv" 24
finish
