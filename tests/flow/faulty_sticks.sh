#!/usr/bin/env bash
# Tests force-feedback sticks that fail during a tour, emulated beneath the real libusb. Only the expected message may
# appear, and only once. Without readings the motors must stop. They must stay off, because nobody presses Enter again.
# The part of the tour before the fault must be saved.
# Usage: faulty_sticks.sh GEARSHIFT SOURCE_FOLDER STICK_EMULATOR
set -u
needs_machine=yes
source "$(dirname "${BASH_SOURCE[0]}")/sticks.sh"
write_calibrations complete
enters=1

# The message expected for each fault: a pattern that the complete output must match.
blind="forces off: the stick sends no readings"
declare -A due=(
  [jump]="the stick's position jumped by [0-9][0-9] % of its range between two reports"
  [wrong-length]="the stick sends a report of 24 bytes, but its descriptor declares 25; the report is ignored
$blind"
  [stuck]="the stick's position has not changed for 2 s while the force changed; its readings are ignored until the position changes; if you felt no force, check the stick's power supply and its safety switch
$blind"
  [silent]="$blind"
  [refuses-effects]="a constant force cannot be created, because the stick reports an error"
  [pool-full]="a constant force cannot be created, because the stick's memory for effects is full; unplug it and plug it in again"
  [stalls-outputs]="vJoy * has stopped accepting data. Unplug it and plug it in again.
forces off: the motors were switched off"
  [slow]="the stick takes [0-9]* ms per output, but responded after 7 ms when it was calibrated; the motors are off until you turn them on again
forces off: the motors were switched off"
)
# Prints the output before the table, without the tour's usual lines. The hand of some tours is stronger than the stick.
messages_of() {
  sed '/^Five speeds/,$d' "$1.txt" | grep -v -e '^The tour visits these gears: ' -e '^The forces are off' -e '^Shift into ' -e ' engaged$' \
    -e ' responds after ' -e '^over-push: ' -e "^the lever moved by [0-9]* mm against the stick's full force; if you felt no force"
}
prints_due_message() {
  [[ "$(messages_of "$1")" == ${due[$1]} ]] && return
  messages_of "$1" | sed 's/^/    printed: /'
  return 1
}
# Succeeds if the program also reported that the machine was too slow.
was_busy() { messages_of "$1" | grep -q -e "stopped an effect by itself" -e "no force was commanded" -e "too late"; }
# Takes a fault, a stick family and a time [s]; drives a tour in which the fault begins at this time. A fault at time 0
# is present before the program has prepared the stick.
drive_with_fault() {
  for _ in 1 2 3; do
    rm -rf "$1" "$1.in"
    tour "$1" "$2" --fault "$1@$3"
    echo $? >"$1.status"
    was_busy "$1" || return
  done
}
stop_and_go() { # drives a tour and pauses the program for 3 s while the hand presses into a wall
  rm -rf stopped stopped.in
  tour_seconds=6.5 # long enough to show that no force returns after 4.7 s
  tour stopped openffboard --stop-at 1.7 --continue-at 4.7
  echo $? >stopped.status
}
ended() { [ "$(cat "$1.status")" -le 1 ]; } # exit status 1 is allowed: the time may not suffice for every gear

# At most three sticks run at a time, because each stick and its program run in real time.
tour_seconds=4
drive_with_fault jump sidewinder 2 & drive_with_fault wrong-length openffboard 2 & drive_with_fault stalls-outputs vjoy 2 & wait
drive_with_fault silent sidewinder 2 & drive_with_fault pool-full vjoy 0 & drive_with_fault refuses-effects sidewinder 0 & wait
tour_seconds=5.5 # enough for the sensor to get stuck at 1.55 s and the force to decay within the next 3 s
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
# Two threads notice the pause. The one that wakes first reports it with its own message.
reports_the_computer() {
  messages_of stopped | grep -q . &&
    ! messages_of stopped | grep -v -e "^forces off: the computer was too slow$" -e "^forces off: the motors were switched off$" -e "^no force was commanded for 100 ms; "
}
check "stopped: the late computer is reported, and nothing about the stick" reports_the_computer
check "stopped: the drive is saved" replays stopped
for fault in "${!due[@]}" stopped; do
  check "$fault: the motors are off after the program ended" silent_within 330 $fault "the program's end"
done
sed -n 's/^stick_emulator: \(zero force .* the \(fault\|stop\).*\)/\1/p' *.err
finish
