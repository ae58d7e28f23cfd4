#!/usr/bin/env bash
# Force-feedback sticks, emulated beneath the real libusb, that fail during a tour: only the expected message appears,
# once; without readings the motors go silent, and stay silent, because nobody presses Enter again; the drive so far is
# saved.
# Usage: faulty_sticks.sh GEARSHIFT SOURCE_FOLDER STICK_EMULATOR
set -u
needs_machine=yes
source "$(dirname "${BASH_SOURCE[0]}")/sticks.sh"
write_calibrations complete
enters=1

# The expected message of each fault: a pattern for the complete output.
blind="forces off: the stick sends no readings"
declare -A due=(
  [jump]="the stick's position jumped by [0-9][0-9] % of its range between two reports"
  [wrong-length]="the stick sends a report of 24 bytes, but its descriptor declares 25; the report is ignored
$blind"
  [stuck]="the stick's position has not changed for 2 s while the force changed; its readings are ignored until the position changes
$blind"
  [silent]="$blind"
  [refuses-effects]="the stick refuses a constant force, because it reports an error"
  [pool-full]="the stick refuses a constant force, because its memory for effects is full; unplug it and plug it in again"
  [stalls-outputs]="vJoy * has stopped accepting data. Unplug it and plug it in again.
forces off: the motors were switched off"
  [slow]="the stick takes [0-9]* ms per output, but responded after 7 ms when it was calibrated; the motors are off until you turn them on again
forces off: the motors were switched off"
)
messages_of() { # all output before the table, except the tour's own lines
  sed '/^Five speeds/,$d' "$1.txt" | grep -v -e '^Gears of the tour: ' -e '^The forces are off' -e '^Shift into ' -e ' engaged$' \
    -e ' responds after '
}
prints_due_message() {
  [[ "$(messages_of "$1")" == ${due[$1]} ]] && return
  messages_of "$1" | sed 's/^/    printed: /'
  return 1
}
# True if the program also reported that the machine stalled for a fifth of a second or longer.
was_busy() { messages_of "$1" | grep -q -e "stopped an effect by itself" -e "no force was commanded" -e "too late"; }
drive_with_fault() { # fault, family, time [s]: drives a tour with the fault; time 0: before the stick is prepared
  for _ in 1 2 3; do
    rm -rf "$1" "$1.in"
    tour "$1" "$2" --fault "$1@$3"
    echo $? >"$1.status"
    was_busy "$1" || return
  done
}
stop_and_go() { # drives a tour and stops the program for 3 s while the hand presses into a wall
  rm -rf stopped stopped.in
  tour_seconds=6.5 # the rest of the time shows that no force returns
  tour stopped openffboard --stop-at 1.7 --continue-at 4.7
  echo $? >stopped.status
}
ended() { [ "$(cat "$1.status")" -le 1 ]; } # 1: not every gear was reached in the short time

# At most three sticks at a time, because each stick and its program run in real time.
tour_seconds=4
drive_with_fault jump sidewinder 2 & drive_with_fault wrong-length openffboard 2 & drive_with_fault stalls-outputs vjoy 2 & wait
drive_with_fault silent sidewinder 2 & drive_with_fault pool-full vjoy 0 & drive_with_fault refuses-effects sidewinder 0 & wait
tour_seconds=5.5 # enough for the force from a stuck sensor, which decays within 3 s
drive_with_fault slow vjoy 2 & hand_gate=$work/elsewhere.toml drive_with_fault stuck vjoy 1.55 & hand_gate=$work/elsewhere.toml stop_and_go & wait

for fault in "${!due[@]}"; do
  check "$fault: the program ends as it should" ended $fault
  check "$fault: the expected message, once" prints_due_message $fault
  check "$fault: the drive so far is saved" replays $fault
done
for fault in wrong-length silent stalls-outputs; do
  check "$fault: the last effect ends, and no effect follows" silent_within 350 $fault "the fault"
done
check "stuck: the force decays to zero" silent_within 3500 stuck "the fault"
for fault in refuses-effects pool-full; do
  check "$fault: the motors never push" silent_within 0 $fault "the fault"
done
check "the plots of a tour without forces cause no warnings" bash -c '! grep -i warning "$0"' pool-full.err
check "jump: the tour continues" printed "2 engaged at" jump
check "slow: the motors are switched off" silent_within 1200 slow "the fault"
check "stopped: the program ends as it should" ended stopped
check "stopped: the last effect ends" silent_within 330 stopped "the stop"
check "stopped: but not at once, so it had pushed" [ "$(zero_force stopped "the stop")" -gt 0 ]
check "stopped: no force returns when it continues" silent_within 0 stopped "the continue"
# Two threads notice the stop. The one that wakes first reports its own message.
reports_the_computer() {
  messages_of stopped | grep -q . &&
    ! messages_of stopped | grep -v -e "^forces off: the computer was too late$" -e "^forces off: the motors were switched off$" -e "^no force was commanded for 100 ms; "
}
check "stopped: the late computer is reported, and nothing about the stick" reports_the_computer
check "stopped: the drive is saved" replays stopped
for fault in "${!due[@]}" stopped; do
  check "$fault: the motors are off after the program ended" silent_within 330 $fault "the program's end"
done
sed -n 's/^stick_emulator: \(zero force .* the \(fault\|stop\).*\)/\1/p' *.err
finish
