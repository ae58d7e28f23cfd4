#!/usr/bin/env bash
# Force-feedback sticks that report false data in the middle of a tour, emulated beneath the real libusb: only the
# expected message appears, once; without readings the motors go silent and stay so, because nobody presses Enter again;
# the drive so far is saved.
# Usage: faulty_sticks.sh GEARSHIFT SOURCE_FOLDER STICK_EMULATOR
set -u
needs_machine=yes
source "$(dirname "${BASH_SOURCE[0]}")/sticks.sh"
all_known whole
enters=1

# The expected message of each fault: a pattern for the complete output.
blind="forces off: the stick sends no readings"
declare -A due=(
  [jump]="the stick's position jumps by [0-9][0-9] % of its range between two reports"
  [wrong-length]="the stick sends a report of 24 bytes, but its descriptor says 25: it is ignored
$blind"
  [stuck]="the stick's position has not changed for 2 s while its force changed: its sensor counts as dead until it moves
$blind"
  [silent]="$blind"
  [refuses-effects]="the stick refuses a constant force: it reports an error"
  [pool-full]="the stick refuses a constant force: its memory for effects is full"
  [stalls-outputs]="vJoy * stalled: it accepts no more reports
forces off: stopped"
  [slow]="the stick takes [0-9]* ms per output, but answered after 7 ms when it was calibrated: the motors are off until you arm them again
forces off: stopped"
)
messages_of() { # all output before the table, except the tour's own lines
  sed '/^Five speeds/,$d' "$1.txt" | grep -v -e '^The tour: ' -e '^The motors are off' -e '^Shift into ' -e ' engaged$' \
    -e ' answers after '
}
prints_due_message() {
  [[ "$(messages_of "$1")" == ${due[$1]} ]] && return
  messages_of "$1" | sed 's/^/    printed: /'
  return 1
}
# A machine that stalls for a fifth of a second is reported, too: one more message.
was_busy() { messages_of "$1" | grep -q -e "stopped an effect by itself" -e "no force was commanded" -e "too late"; }
lie() { # fault, family, when [s]; 0: before the stick is prepared
  for _ in 1 2 3; do
    rm -rf "$1" "$1.in"
    tour "$1" "$2" --fault "$1@$3"
    echo $? >"$1.status"
    was_busy "$1" || return
  done
}
stop_and_go() { # the program is stopped for 3 s with its hand at a wall
  rm -rf stopped stopped.in
  tour_seconds=6.5 # the rest of the time shows that no force returns
  tour stopped openffboard --stop-at 1.7 --continue-at 4.7
  echo $? >stopped.status
}
ended() { [ "$(cat "$1.status")" -le 1 ]; } # 1: not every gear was reached in the short time

# Only three at a time: sticks in real time need the machine.
tour_seconds=4
lie jump sidewinder 2 & lie wrong-length openffboard 2 & lie stalls-outputs vjoy 2 & wait
lie silent sidewinder 2 & lie pool-full vjoy 0 & lie refuses-effects sidewinder 0 & wait
tour_seconds=5.5 # the force from a dead sensor decays within 3 s
lie slow vjoy 2 & hand_gate=$work/elsewhere.toml lie stuck vjoy 1.55 & hand_gate=$work/elsewhere.toml stop_and_go & wait

for fault in "${!due[@]}"; do
  check "$fault: the program ends as it should" ended $fault
  check "$fault: the expected message, once" prints_due_message $fault
  check "$fault: the drive so far is saved" replays $fault
done
for fault in wrong-length silent stalls-outputs; do
  check "$fault: its last effect ends, and none comes again" silent_within 350 $fault "the fault"
done
check "the force from a dead sensor decays to zero" silent_within 3500 stuck "the fault"
for fault in refuses-effects pool-full; do
  check "$fault: it never pushes" silent_within 0 $fault "the fault"
done
check "a tour without forces is drawn without messages" bash -c '! grep -i warning "$0"' pool-full.err
check "jump: the tour continues" printed "2 engaged at" jump
check "a slow stick is not driven any more" silent_within 1200 slow "the fault"
check "stopped: the program ends as it should" ended stopped
check "stopped: it pushed, and its last effect ends" silent_within 330 stopped "the stop"
check "stopped: not at once" [ "$(zero_force stopped "the stop")" -gt 0 ]
check "stopped: no force returns when it continues" silent_within 0 stopped "the continue"
# Whichever thread wakes first reports its own message.
reports_the_computer() {
  messages_of stopped | grep -q . &&
    ! messages_of stopped | grep -v -e "^forces off: the computer was too late$" -e "^forces off: stopped$" -e "^no force was commanded for 100 ms: "
}
check "stopped: it reports that, and nothing about the stick" reports_the_computer
check "stopped: the drive is saved" replays stopped
for fault in "${!due[@]}" stopped; do
  check "$fault: its motors are off when the program has ended" silent_within 330 $fault "the program's end"
done
sed -n 's/^stick_emulator: \(zero force .* the \(fault\|stop\).*\)/\1/p' *.err
finish
