#!/usr/bin/env bash
# Tests force-feedback sticks as a user uses them, emulated beneath the real libusb: they are listed and driven through
# a tour; the program is killed with kill -9; the user may not open a stick, or no stick is plugged in.
# Usage: devices.sh GEARSHIFT SOURCE_FOLDER STICK_EMULATOR
set -u
needs_machine=yes
source "$(dirname "${BASH_SOURCE[0]}")/sticks.sh"
write_calibrations

no_stick() {
  with_stick --family vjoy --unplug-at 0 -- \
    bash -c 'for i in $(seq 100); do "$gearshift" devices >none.txt || exit; grep -q "No USB joystick" none.txt && exit; sleep 0.1; done; exit 1' 2>none.err
}
check "without a stick: a message, no failure" no_stick
check "the same with --json" with_stick --family vjoy --unplug-at 0 -- bash -c 'sleep 1; "$gearshift" devices --json >none.json' 2>none.err
check "the JSON has no sticks" python3 -c 'import json; assert json.load(open("none.json")) ["sticks"] == []'
with_stick --family vjoy -- "$gearshift" tour --device rhino --out rhino >/dev/null 2>rhino.err
check "an unknown stick is rejected with a list of those connected" \
  grep -q '^gearshift: no stick that matches "rhino" is plugged in; available sticks: vJoy.*1234:bead' rhino.err
check "in one sentence, and no folder is made" [ "$(wc -l <rhino.err)" -ge 1 -a ! -e rhino ]

# Root may use any device. If this script runs as root, it therefore runs the program as a different user.
forbidden() {
  with_stick --family sidewinder -- bash -c '
    chmod -R a+rwX "$UMOCKDEV_DIR" # everything that umockdev needs, its sockets included
    as_nobody=; [ "$(id -u)" = 0 ] && as_nobody="setpriv --reuid 65534 --clear-groups"
    chmod 0 "$UMOCKDEV_DIR"/dev/bus/usb/*/*
    $as_nobody "$gearshift" devices' >forbidden.txt 2>forbidden.err
}
check "a stick without access rights is listed" forbidden
check "with its name and effects" grep -q "SideWinder.*045e:001b.*constant force" forbidden.txt
check "with the reason" grep -q "may not be used by this user" forbidden.txt
check "and the rule's commands" grep -q "sudo cp \".*udev/70-gearshift.rules\" /etc/udev/rules.d/" forbidden.txt

write_calibrations complete
with_stick --family openffboard -- "$gearshift" devices --json >devices.json 2>devices.err
check "the list for a script" python3 -c '
import json
[stick] = json.load(open("devices.json"))["sticks"]
assert stick["id"] == "1209:ffb0" and stick["serial"] == "EMULATED01" and stick["force"] == "pushes"
assert {"constant force", "spring", "damper"} <= set(stick["effects"]) and stick["calibrated"], stick'

sed -i 's/^constant_limit/friction_n = 0.15\n&/' "$sticks"/1209_ffb0_EMULATED01.toml
with_stick --family openffboard -- "$gearshift" contact --stick FFBoard --runs 3 --json >wall.json 2>wall.err
check "what a wall feels like on it, with its own springs, late by its calibration" python3 -c '
import json
wall = json.load(open("wall.json"))
assert wall["device"].startswith("FFBoard") and wall["delay_cycles"] >= 5 and 350 < wall["k_n_per_m"] < 5000, wall
assert wall["dry_friction_n"] == 0.15 and wall["device_walls_n_per_m"] == 350, wall
assert wall["energy_worst_fraction"] < 0 and wall["ripple_p95_mm"] < 0.3, wall'

for family in $families; do (tour $family $family && touch $family.ok) & running+=($!); done
wait
running=()
for run in $families; do
  check "the tour of $run succeeds" [ -e $run.ok ]
  check "every gear is engaged, in order" in_order $run
  check "the stick's response time is printed" grep -q "responds after .* ms" $run.txt
  check "and the limited parameters" grep -q "limited from" $run.err
  check "its motors are off after the program ended" silent_within 330 $run "the program's end"
  check "its trace replays" replays $run
  check "its plots are pictures" is_png "$run/trajectory.png"
done

gate=sequential_six hand_gate=sequential_six tour sequential openffboard
check "a sequential gate: the tour succeeds" [ $? = 0 ]
check "one stroke is one gear, up to sixth, down to first, and to reverse with the ring" in_order sequential
check "it visits them all" grep -q "gears: 1, 2, 3, 4, 5, 6, 5, 4, 3, 2, 1, R\." sequential.txt
check "its trace replays" replays sequential

early() {
  printf '\n\n\n\n' | with_stick --family vjoy -- "$gearshift" tour --device vjoy --gate paper --out early >early.txt 2>early.err
}
early
check "Enter before the prompt does not turn the forces on" grep -q "the forces cannot be turned on, because standard input is closed" early.err
check "and the motors never pushed" silent_within 0 early "the start"

# Kills the program while the hand presses into a wall. The stick's effects must then end by themselves.
killed() {
  with_stick --family openffboard --tour elsewhere.toml -- bash -c '
    mkfifo killed.in
    exec 9<>killed.in
    "$gearshift" tour --device ffboard --gate paper --preset ./patient.toml --out killed <&9 >killed.txt 2>&1 &
    for i in $(seq 100); do grep -q "press Enter" killed.txt && break; sleep 0.1; done
    echo >&9
    sleep 1.7
    kill -9 $!' 2>killed.err
}

# If the user turns the forces on while the stop button is held, the forces must stay off. The program must report the
# reason and ask again.
is_prompted() { printed "press Enter" refused "$1"; }
refused() {
  mkfifo refused.in refused.orders
  exec 9<>refused.in 8<>refused.orders
  cp -r "$XDG_CONFIG_HOME" "$work/stop_button"
  sed -i 's/^stop = 0/stop = 3/' "$work"/stop_button/gearshift/devices/*
  XDG_CONFIG_HOME=$work/stop_button with_stick --family vjoy --orders refused.orders -- \
    env --default-signal=INT "$gearshift" tour --device vjoy --gate paper --seconds 20 --out refused <&9 >refused.txt 2>refused.err &
  within 10 is_prompted 1
  echo hold 3 >&8
  echo go 15 20 >&8 # moves the lever to a place behind a wall of the gate
  sleep 0.3
  echo >&9
  within 5 is_prompted 2
  kill -INT "$(pgrep -P $! -f "$gearshift tour")"
  wait $!
}
refused & running=($!)
check "killed at a wall" killed
wait
running=()
check "a held stop button is reported" printed "the forces stay off: the stick's stop button is held" refused
check "and the prompt is repeated" is_prompted 2
check "and the motors never pushed at the wall" silent_within 0 refused "the start"
check "killed: its effects end by themselves" silent_within 330 killed "the program's end"
check "killed: but not at once, so it had pushed" [ "$(zero_force killed "the program's end")" -gt 0 ]
finish
