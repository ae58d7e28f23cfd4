#!/usr/bin/env bash
# Force-feedback sticks as their owner has them, emulated beneath the real libusb: listed, calibrated, driven through a
# tour, taken away by kill -9; one that may not be used, and none at all.
# Usage: devices.sh GEARSHIFT SOURCE_FOLDER STICK_EMULATOR
set -u
needs_machine=yes
source "$(dirname "${BASH_SOURCE[0]}")/sticks.sh"
all_known

# Calibration: the numbers that a person knows, nonsense among them, then hands off, Enter by Enter: some more than there
# are steps, for a machine that is busy measures nonsense, which is refused.
calibrate() {
  printf 'far\n5000\n140 mm\n140\n20\nwhat\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n' |
    with_stick --family "$1" -- "$gearshift" devices --calibrate "${name[$1]}" >"calibrate_$1.txt" 2>"calibrate_$1.err"
}
calibrated=sidewinder # each takes most of a minute
whole && calibrated=$families
for family in $calibrated; do calibrate $family & running+=($!); done

no_stick() {
  with_stick --family vjoy --unplug-at 0 -- \
    bash -c 'for i in $(seq 100); do "$gearshift" devices >none.txt || exit; grep -q "No USB stick" none.txt && exit; sleep 0.1; done; exit 1' 2>none.err
}
check "nothing plugged in is said, and is no failure" no_stick
check "nor is it for a script" with_stick --family vjoy --unplug-at 0 -- bash -c 'sleep 1; "$gearshift" devices --json >none.json' 2>none.err
check "who is told so" python3 -c 'import json; assert json.load(open("none.json")) ["sticks"] == []'
with_stick --family vjoy -- "$gearshift" tour --device rhino --out rhino >/dev/null 2>rhino.err
check "a stick that is not there is refused, with those that are" \
  grep -q '^gearshift: no stick "rhino" is plugged in; these are: vJoy.*1234:bead' rhino.err
check "in one sentence, and no folder is made" [ "$(wc -l <rhino.err)" -ge 1 -a ! -e rhino ]

# Root may use any device: it looks as a user who is none.
forbidden() {
  with_stick --family sidewinder -- bash -c '
    chmod -R a+rwX "$UMOCKDEV_DIR" # its sockets, too
    as_nobody=; [ "$(id -u)" = 0 ] && as_nobody="setpriv --reuid 65534 --clear-groups"
    chmod 0 "$UMOCKDEV_DIR"/dev/bus/usb/*/*
    $as_nobody "$gearshift" devices' >forbidden.txt 2>forbidden.err
}
check "a stick that may not be used is listed" forbidden
check "with what it is" grep -q "SideWinder.*045e:001b.*constant force" forbidden.txt
check "with the reason" grep -q "may not be used by this user" forbidden.txt
check "and the rule's commands" grep -q "sudo cp \".*udev/70-gearshift.rules\" /etc/udev/rules.d/" forbidden.txt

# Measured again, beside those that are calibrated: another home has it.
again() { # result, options of the emulator ...: with what a person does on stdin
  XDG_CONFIG_HOME=$work/another with_stick --family vjoy "${@:2}" -- \
    "$gearshift" devices --calibrate "${id[vjoy]}" --again >"$1.txt" 2>"$1.err"
}
pushes_nothing() {
  echo | again again
  said "Not taken: no axis moved" again && said "Still missing: range" again
}
pulled_out() { # between two questions
  sleep 5 | again pulled_out --unplug-at 2 --replug-at 3
  said "was unplugged" pulled_out && said "is back" pulled_out
}
elsewhere=$work/another/gearshift/devices
mkdir -p "$elsewhere"
(sticks=$elsewhere; all_known whole)
cp -r "$elsewhere" measured_before
check "a person who pushes nothing is told, and what is missing" pushes_nothing
check "a person whose stick is pulled out meanwhile is told, and that it is back" pulled_out
check "what was measured before is kept" diff -r measured_before "$elsewhere"

wait
running=()
for family in $calibrated; do
  check "$family is calibrated" grep -q "^Calibrated: " calibrate_$family.txt
  check "nonsense is asked again" grep -q 'Not taken: "5000" is no number from 20 to 500 mm' calibrate_$family.txt
  check "hands off is said before the motors move" grep -q "^HANDS OFF" calibrate_$family.txt
  check "its forces push left and forward, as PID 1.0 says" grep -q "plus pushes left.*plus pushes forward" calibrate_$family.txt
done
# The emulated handle: 0.095 and 0.086 kg, 3.0 and 2.9 N s/m, 15 and 16 N/m; 400 N/m and 20 N s/m at the greatest
# coefficients. Measured in real time on a machine that is busy.
measured() { grep -l "^travel_m = 0.14" "$sticks"/*.toml; }
check "what was measured is what it is" python3 - $(measured) <<'END'
import pathlib, re, sys
allowed = {"mass_kg": (0.08, 0.11), "damping_n_s_per_m": (2, 5), "stiffness_n_per_m": (0, 40),
           "spring_stiffness_n_per_m": (330, 450), "damper_n_s_per_m": (14, 30), "damper_sign": (1, 1)}
assert sys.argv[1:]
for file in map(pathlib.Path, sys.argv[1:]):
    for key, value in re.findall(r"^(\w+) = ([-\d.e]+)", file.read_text(), re.M):
        low, high = allowed.get(key, (-1e9, 1e9))
        assert low <= float(value) <= high, f"{file.name}: {key} = {value}"
END
# How late a busy machine measured them is not looked at from here on.
all_known whole
with_stick --family openffboard -- "$gearshift" devices --json >devices.json 2>devices.err
check "the list for a script" python3 -c '
import json
[stick] = json.load(open("devices.json"))["sticks"]
assert stick["id"] == "1209:ffb0" and stick["serial"] == "EMULATED01" and stick["force"] == "pushes"
assert {"constant force", "spring", "damper"} <= set(stick["effects"]) and stick["calibrated"], stick'

for family in $families; do (tour $family $family && touch $family.ok) & running+=($!); done
wait
running=()
for run in $families; do
  check "the tour of $run ends well" [ -e $run.ok ]
  check "every gear of it, in order" in_order $run
  check "it says how late the stick answers" grep -q "answers after .* ms" $run.txt
  check "and what it does not carry" grep -q "limited from" $run.err
  check "its motors are off when the program has ended" silent_within 330 $run "the program's end"
  check "its trace replays" replays $run
  check "its plots are pictures" is_png "$run/trajectory.png"
done

early() {
  printf '\n\n\n\n' | with_stick --family vjoy -- "$gearshift" tour --device vjoy --gate paper --out early >early.txt 2>early.err
}
early
check "Enter before it is asked for arms nothing" grep -q "nobody can arm the stick" early.err
check "and its motors never pushed" silent_within 0 early "the program's end"

# Killed while a hand presses into a wall, its effects end by themselves.
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

# Armed while its stop button is held, it has no forces, and says why and asks again.
asked() { said "press Enter" refused "$1"; }
refused() {
  mkfifo refused.in refused.orders
  exec 9<>refused.in 8<>refused.orders
  cp -r "$XDG_CONFIG_HOME" "$work/stop_button"
  sed -i 's/^stop = 0/stop = 3/' "$work"/stop_button/gearshift/devices/*
  XDG_CONFIG_HOME=$work/stop_button with_stick --family vjoy --orders refused.orders -- \
    "$gearshift" tour --device vjoy --gate paper --seconds 20 --out refused <&9 >refused.txt 2>refused.err &
  within 10 asked 1
  echo hold 3 >&8
  sleep 0.1
  echo >&9
  within 5 asked 2
  kill -INT "$(pgrep -P $! -f "$gearshift tour")"
  wait $!
}
refused & running=($!)
check "killed at a wall" killed
wait
running=()
check "a stop button that is held is said" said "no forces: its stop button is held" refused
check "and asked for again" asked 2
check "and its motors never pushed" silent_within 0 refused "the program's end"
check "it pushed then, and its effects end by themselves" silent_within 330 killed "the program's end"
check "not at once" [ "$(zero_force killed "the program's end")" -gt 0 ]
finish
