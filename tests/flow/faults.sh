#!/usr/bin/env bash
# Tests system failures while a user drives a recorded lesson. The lever must keep running or have no force, each
# failure must be reported once, and the run and its recording must be saved. A preloaded library makes clock, GPU,
# sound and writes fail. The full and the read-only disk are small file systems that the test mounts.
# Usage: faults.sh GEARSHIFT SOURCE_FOLDER PRELOADED_FAULTS
set -u
gearshift=$1 preloaded=$3
# The test mounts its disks in a private namespace, where no other process sees them. Without the permission to mount,
# the disk faults are not tested, and the test counts as skipped if everything else passes.
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
unset GEARSHIFT_VALIDATION # the validation layer would report errors of its own after injected failures
size=160x120
export INJECTED_FAULTS=$work/faults ALSOFT_DRIVERS=null
mkdir faults
beneath=(env LD_PRELOAD="$preloaded")

in_time() { within "$@" || { needs_machine=yes; false; }; } # a slow host may have caused the timeout, see checks.sh
# Takes a fault and its number, as explained in tests/support/preloaded/faults.cpp; starts the fault.
inject() { echo "$2" >"faults/.$1" && mv "faults/.$1" "faults/$1"; }
mend() { rm "faults/$1"; }
logged() { [ "$(grep -cF -- "$1" "$log.txt" "$log.err" | awk -F: '{sum += $2} END {print sum}')" -ge "${2:-1}" ]; }
is_reported_once() { [ "$(cat "$log.txt" "$log.err" | grep -cF -- "$1")" -eq 1 ]; } # sentence
lesson() { # takes a name for the output and arguments; starts a recorded lesson, as a user does
  start "$@" --lesson moving_off --learner Ada --mode follow-me --no-help --no-panel --hand grip ||
    { needs_machine=yes; return 1; }
  xdotool windowfocus "$window"
  in_time 20 press_until_logged Return "lesson moving_off begins" 1
}
left_runs() { # prints the number of runs in the history, and the newest run's recording
  python3 - "$XDG_DATA_HOME/gearshift" <<'END_OF_PYTHON'
import os, sqlite3, sys
rows = sqlite3.connect(sys.argv[1] + "/history.db").execute(
    "SELECT ended, recording FROM lesson_run ORDER BY id").fetchall()
ended = [row[0] for row in rows]
assert all(ended), ended
print(len(rows))
print(rows[-1][1])
END_OF_PYTHON
}
ended() { ended_by End || { needs_machine=yes; kill "$trainer" && wait "$trainer"; false; }; }
runs=0
hung_up() { find_program && kill -HUP "$pid" && wait "$trainer"; } # sends SIGHUP, as a closed terminal does
# Ends the lesson with its key, or with the given command. Checks that the newest run is then in the history, marked as
# left, and that its recording is complete.
is_saved() {
  local rows recording
  runs=$((runs + 1))
  "${@:-ended}" || return 1
  printed "lesson moving_off is over: not graded.*[Yy]ou left" || return 1
  rows=$(left_runs) || return 1
  [ "$(head -n 1 <<<"$rows")" -eq $runs ] || return 1
  recording=$(tail -n 1 <<<"$rows")
  "$gearshift" replay "data/gearshift/$recording" | grep -q "^identical bit for bit"
}
has_forces() { [ "$(grep -oE '(forces (off|armed|starting|on)|damping only|motors off)$' "$log.txt" | tail -n 1)" = "forces on" ]; }
missed() { sed -n 's/^loop: \([0-9]*\) deadlines missed, .*/\1/p' "$log.txt" | tail -n 1; }
find_program() { pid=$(pgrep -P "$trainer" -x gearshift) && [ -n "$pid" ]; }
lever_keeps_running() { ! grep -q "forces off, damping only\|motors off" "$log.txt"; }

check "closed terminal: a lesson begins" lesson hung_up
check "closed terminal: run and recording are saved" is_saved hung_up

# Tests faults of the picture, the sound and the wall clock.
check "picture: a lesson begins" lesson picture
inject gpu 1
check "picture: reported" in_time 20 logged "restarting the display. The lever keeps running."
xdotool mousemove --window "$window" 50 50
check "picture: the lever continues" lever_keeps_running
inject sound 1
check "sound: reported" in_time 10 logged "the sound device was lost"
# The clock jumps while the sound device is lost. Otherwise OpenAL's null device, which measures time with this clock,
# would first mix an hour of sound, and the program would end late.
inject clock 3600
sleep 0.3
inject clock -3600
sleep 1.2 # the program retries the sound device every second
check "clock: the lever continues" lever_keeps_running
mend sound
check "sound: back, reported" in_time 10 logged "sound works again"
check "picture: reported once" is_reported_once "restarting the display"
check "sound: reported once" is_reported_once "the sound device was lost"
check "picture, sound, clock: run and recording are saved" is_saved
mend clock
span() { # prints the duration of the newest run in the history [s]
  python3 -c '
import sqlite3, sys
print(*sqlite3.connect(sys.argv[1]).execute("SELECT duration_s FROM lesson_run ORDER BY id DESC LIMIT 1").fetchone())' \
    "$XDG_DATA_HOME/gearshift/history.db"
}
check "clock: the duration of the lesson is correct, got $(span) s" awk -v s="$(span)" 'BEGIN {exit !(s > 1 && s < 200)}'
check "and nothing else is reported, got: $(grep -v picture picture.err)" [ "$(wc -l <picture.err)" -eq 1 ]

# The clock jumps by an hour while OpenAL plays to its null device (ALSOFT_DRIVERS above). OpenAL 1.19 first mixes an
# hour of sound, so the program ends late. The lever must not wait for this. With OpenAL 1.24 the program ends at once.
check "late end: a lesson begins" lesson late
check "late end: it has forces" in_time 10 has_forces
check "late end: it runs" find_program
real_time_threads() { ps -L -o cls= -p "$pid" | grep -c FF; }
ended_lever() { [ "$(real_time_threads)" -eq 0 ]; }
had=$(real_time_threads)
inject clock 3600
sleep 0.3
check "late end: the lesson is left" in_time 20 press_until_logged End "lesson moving_off is over" 1
[ "$had" -gt 0 ] && check "late end: the lever has ended" in_time 5 ended_lever
if "$gearshift" --version | grep -q "openal 1.19"; then
  check "late end: the sound has not ended" alive
else
  echo "not shown: that the lever ends before the sound (the sound may end at once)"
fi
[ "$had" -gt 0 ] || echo "not shown: that the lever ends before the sound (no real-time thread is allowed here)"
kill -KILL "$pid" 2>/dev/null
wait "$trainer" 2>/dev/null
mend clock
late_is_saved() { runs=$((runs + 1)) && [ "$(left_runs | sed -n 1p)" -eq $runs ]; }
check "late end: the run is saved" late_is_saved

# Tests a GPU device that is lost again and again: there is no picture, but lever, lesson and keys still work.
check "no picture: a lesson begins" lesson blind
rm -f faults/gpu_lost
attempts() { wc -c <faults/gpu_lost; }
attempted() { [ "$(attempts)" -ge "$1" ]; }
begin=$SECONDS
inject gpu 2
check "no picture: reported" in_time 20 logged "restarting the display"
check "no picture: attempted again" in_time 20 attempted 4 # each new GPU device is lost at once; one attempt per second
elapsed=$((SECONDS - begin))
check "no picture: not more than each second, got: $(attempts) in $elapsed s" [ "$(attempts)" -le $((elapsed + 3)) ]
check "no picture: alive" alive
mend gpu
check "no picture: the lever continues" lever_keeps_running
check "no picture: saved" is_saved
check "no picture: reported once, got: $(cat blind.err)" [ "$(wc -l <blind.err)" -eq 1 ]

# Tests a process that is stopped for 3 s. The wall clock is an hour slow from the start of this test. The history must
# contain the wrong time. This proves that the injected clock errors reach the program.
inject clock -3600
check "stopped: a lesson begins" lesson stopped
is_stopped() { grep -q "^State:.T" "/proc/$pid/status"; }
check "stopped: it has forces" in_time 10 has_forces
check "stopped: it runs" find_program
kill -STOP "$pid"
check "stopped: the process is stopped" in_time 5 is_stopped
sleep 3
kill -CONT "$pid"
check "stopped: saved" is_saved
mend clock
begun_behind() { # prints how long ago the newest run began, according to the history [s]
  python3 - "$XDG_DATA_HOME/gearshift" <<'END_OF_PYTHON'
import datetime, sqlite3, sys
history = sqlite3.connect(sys.argv[1] + "/history.db")
begun, = history.execute("SELECT begun_at FROM lesson_run ORDER BY id DESC").fetchone()
begun = datetime.datetime.fromisoformat(begun.replace("Z", "+00:00"))
print((datetime.datetime.now(datetime.timezone.utc) - begun.replace(tzinfo=datetime.timezone.utc)).total_seconds())
END_OF_PYTHON
}
check "clock: the history has the injected time, got: $(begun_behind) s ago" \
  awk -v s="$(begun_behind)" 'BEGIN {exit !(s >= 3600 && s < 3900)}'
check "stopped: the lever continued" lever_keeps_running
check "stopped: the cycles of 3 s are counted as missed, got: $(missed)" [ "$(missed)" -ge 2900 ]
check "stopped: nothing on stderr, got: $(cat stopped.err)" [ ! -s stopped.err ]

# Tests all threads of the program on one core, together with a busy loop.
check "one core: a lesson begins" lesson hog
check "one core: it runs" find_program
timeout 30 taskset -c 0 sh -c 'while :; do :; done' &
hog=$!
check "one core: all its threads are sent there" taskset -acp 0 "$pid" >/dev/null
stay_there() { [ "$(cat /proc/"$pid"/task/*/status | sed -n 's/^Cpus_allowed_list:\t//p' | sort -u)" = 0 ]; }
check "one core: they stay there" stay_there
sleep 2
check "one core: the busy loop has run until now" kill $hog
taskset -acp "0-$(($(nproc) - 1))" "$pid" >/dev/null
check "one core: saved" is_saved
check "one core: forces to the end, switched on again if necessary" has_forces
check "one core: missed deadlines are counted" \
  printed "^loop: [0-9]* deadlines missed, [0-9]* cycles too long, 0 cycles unread"
check "one core: nothing on stderr, got: $(cat hog.err)" [ ! -s hog.err ]

# Tests a disk that is temporarily read-only, as after disk errors, and works again before the lesson's end.
check "read-only meanwhile: a lesson begins" lesson refused
inject write 30 # EROFS
check "read-only meanwhile: reported" in_time 20 logged "the recording failed after"
check "read-only meanwhile: the lever continues" lever_keeps_running
mend write
check "read-only meanwhile: the End key ends it" ended
check "read-only meanwhile: reported once" is_reported_once "the recording failed after"
check "read-only meanwhile: no loss is reported, got: $(cat refused.err)" [ ! -s refused.err ]
check "read-only meanwhile: the run is in the history" [ "$(left_runs | sed -n 1p)" = $((runs + 1)) ]

if [ "$has_mounts" = yes ]; then
  mkdir small home
  mount -t tmpfs -o size=2m none small
  XDG_DATA_HOME=$work/small
  check "full disk: a lesson begins" lesson full
  dd if=/dev/zero of=small/filler bs=4k 2>/dev/null
  check "full disk: reported" in_time 20 logged "the recording failed after"
  check "full disk: the lever continues" lever_keeps_running
  check "full disk: the End key ends it" ended
  check "full disk: reported once" is_reported_once "the recording failed after"
  check "full disk: no loss is reported, got: $(cat full.err)" [ ! -s full.err ]
  # If the run needed the room, its truncated recording was deleted. Otherwise the run names it.
  names_its_recording() { [ "$(left_runs | sed -n 2p | sed 's|.*/||')" = "$(ls small/gearshift/recordings)" ]; }
  check "full disk: the run is in the history" [ "$(left_runs | sed -n 1p)" = 1 ]
  check "full disk: with its truncated recording, or without any" names_its_recording

  rm -r small/*
  check "space again: a lesson begins" lesson room
  dd if=/dev/zero of=small/filler bs=4k 2>/dev/null
  check "space again: reported" in_time 20 logged "the recording failed after"
  rm small/filler
  check "space again: the End key ends it" ended
  check "space again: no loss is reported, got: $(cat room.err)" [ ! -s room.err ]
  check "space again: the run is in the history" [ "$(left_runs | sed -n 1p)" = 1 ]

  mount -t tmpfs -o ro,size=1m none home
  # The cache folder stays writable, because the GPU driver starts slowly without its cache.
  XDG_DATA_HOME=$work/home/data XDG_CONFIG_HOME=$work/home/config
  check "read-only home: a lesson begins" lesson read_only
  check "read-only home: the End key ends it" ended
  check "read-only home: reported at the start" [ "$(grep -c "the history cannot be used because .*Read-only" read_only.txt)" = 1 ]
  check "read-only home: the lesson was driven" printed "lesson moving_off is over: not graded.*[Yy]ou left"
  check "read-only home: losses are reported at the end, got: $(cat read_only.err)" \
    [ "$(grep -c "Read-only file system); not saved: 1 run$" read_only.err)" = 1 ]
fi
XDG_CONFIG_HOME=$work/config
[ "$has_mounts" = no ] || umount small home

is_full_run && check "a day of lessons: nothing grows" "$flows/soak.sh" "$gearshift" "$2" week "$work/day.csv" 24
finish || exit
[ "$has_mounts" = no ] || exit 0
echo "not shown: a full disk, a home that is read-only: no disk may be mounted here"
exit 77
