#!/usr/bin/env bash
# Force-feedback sticks that lie, beneath the real libusb, each in the middle of a tour: all that is told is the sentence
# that is due, once; where the program is blind the motors go silent, and stay so, for nobody presses Enter again; the
# drive so far is kept.
# Usage: lying_sticks.sh GEARSHIFT SOURCE_FOLDER STICK_EMULATOR
set -u
needs_machine=yes
source "$(dirname "${BASH_SOURCE[0]}")/sticks.sh"
all_known whole
enters=1

# What each shall tell, a pattern for all of it.
blind="forces off: no readings of the stick arrive"
declare -A due=(
  [jump]="the stick's position jumps by [0-9][0-9] % of its range between two reports"
  [wrong-length]="the stick sends a report of 24 bytes where its descriptor says 25: it is not used
$blind"
  [stuck]="the stick has said one place for 2 s while its force changed: its sensor is taken for dead until it moves
$blind"
  [silent]="$blind"
  [refuses-effects]="the stick refuses a constant force: it says that there was an error"
  [pool-full]="the stick refuses a constant force: its memory for effects is full"
  [stalls-outputs]="vJoy * stalls: it takes no reports any more
forces off: stopped"
  [slow]="the stick takes [0-9]* ms for an output, and answered after 7 ms when it was calibrated: the motors are off until they are armed again
forces off: stopped"
)
told() { # all that is said before the table but the tour's own words
  sed '/^Five speeds/,$d' "$1.txt" | grep -v -e '^The tour: ' -e '^The motors are off' -e '^Shift to ' -e ' engaged$' \
    -e ' answers after '
}
tells() {
  [[ "$(told "$1")" == ${due[$1]} ]] && return
  told "$1" | sed 's/^/    told: /'
  return 1
}
# A machine that stands still for a fifth of a second is told of, too: once more.
was_busy() { told "$1" | grep -q -e "stopped an effect by itself" -e "no force was commanded" -e "too late"; }
lie() { # fault, family, when [s]; 0: before the stick is prepared
  for _ in 1 2 3; do
    rm -rf "$1" "$1.in"
    tour "$1" "$2" --fault "$1@$3"
    echo $? >"$1.status"
    was_busy "$1" || return
  done
}
stop_and_go() { # the program stands still for 3 s, its hand at a wall
  rm -rf stopped stopped.in
  tour_seconds=6.5 # the rest shows that no force comes again
  tour stopped openffboard --stop-at 1.7 --continue-at 4.7
  echo $? >stopped.status
}
ended() { [ "$(cat "$1.status")" -le 1 ]; } # 1: not every gear, in so short a time

# Three at a time: sticks that keep their own time need the machine.
tour_seconds=4
lie jump sidewinder 2 & lie wrong-length openffboard 2 & lie stalls-outputs vjoy 2 & wait
lie silent sidewinder 2 & lie pool-full vjoy 0 & lie refuses-effects sidewinder 0 & wait
tour_seconds=5.5 # a dead sensor's force yields in 3 s
lie slow vjoy 2 & hand_gate=$work/elsewhere.toml lie stuck vjoy 1.55 & hand_gate=$work/elsewhere.toml stop_and_go & wait

for fault in "${!due[@]}"; do
  check "$fault: the program ends as it should" ended $fault
  check "$fault: it tells what is due, once" tells $fault
  check "$fault: the drive so far is kept" replays $fault
done
for fault in wrong-length silent stalls-outputs; do
  check "$fault: its last effect ends, and none comes again" silent_within 350 $fault "the fault"
done
check "a dead sensor's force yields to nothing" silent_within 3500 stuck "the fault"
for fault in refuses-effects pool-full; do
  check "$fault: it never pushes" silent_within 0 $fault "the fault"
done
check "a tour without forces is drawn without a word" bash -c '! grep -i warning "$0"' pool-full.err
check "jump: the tour goes on" said "2 engaged at" jump
check "a stick that has become slow is driven no longer" silent_within 1200 slow "the fault"
check "stopped: the program ends as it should" ended stopped
check "stopped: it pushed, and its last effect ends" silent_within 330 stopped "the stop"
check "stopped: not at once" [ "$(zero_force stopped "the stop")" -gt 0 ]
check "stopped: none comes again when it goes on" silent_within 0 stopped "the continue"
# Which of its threads wakes first tells its own.
tells_of_the_computer() {
  told stopped | grep -q . &&
    ! told stopped | grep -v -e "^forces off: the computer was too late$" -e "^forces off: stopped$" -e "^no force was commanded for 100 ms: "
}
check "stopped: it tells that, and nothing of the stick" tells_of_the_computer
check "stopped: the drive is kept" replays stopped
for fault in "${!due[@]}" stopped; do
  check "$fault: its motors are off when the program has ended" silent_within 330 $fault "the program's end"
done
sed -n 's/^stick_emulator: \(zero force .* the \(fault\|stop\).*\)/\1/p' *.err
finish
