#!/usr/bin/env bash
# Force-feedback sticks calibrated by a person, emulated beneath the real libusb: what is measured is what they are, nonsense
# is asked again, and what was known stays where somebody gives up or the stick is pulled out. One family; --full: all.
# Usage: calibrate.sh GEARSHIFT SOURCE_FOLDER STICK_EMULATOR
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
  mkfifo orders
  exec 8<>orders
  sleep 12 | again pulled_out --orders orders & running+=($!)
  within 8 said "Enter" pulled_out
  echo unplug >&8
  within 5 said "was unplugged" pulled_out
  echo plug >&8
  within 5 said "is back" pulled_out
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
finish
