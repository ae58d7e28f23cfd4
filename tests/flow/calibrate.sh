#!/usr/bin/env bash
# Calibration of force-feedback sticks by a person, emulated beneath the real libusb: the measured values are the true
# ones, invalid answers are asked again, and the old calibration stays if the user gives up or the stick is unplugged.
# One family; --full: all.
# Usage: calibrate.sh GEARSHIFT SOURCE_FOLDER STICK_EMULATOR
set -u
needs_machine=yes
source "$(dirname "${BASH_SOURCE[0]}")/sticks.sh"
all_known

# Calibration: the numbers that a person knows, with some invalid ones, then hands off and Enter for each step. There
# are more Enters than steps, because measurements on a busy machine may be rejected.
calibrate() {
  printf 'far\n5000\n140 mm\n140\n20\nwhat\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n' |
    with_stick --family "$1" -- "$gearshift" devices --calibrate "${name[$1]}" >"calibrate_$1.txt" 2>"calibrate_$1.err"
}
calibrated=sidewinder # each takes most of a minute
whole && calibrated=$families
for family in $calibrated; do calibrate $family & running+=($!); done

# Calibrates again, in another home folder, beside the calibrated sticks.
again() { # result, options of the emulator ...; the user's input on stdin
  XDG_CONFIG_HOME=$work/another with_stick --family vjoy "${@:2}" -- \
    "$gearshift" devices --calibrate "${id[vjoy]}" --again >"$1.txt" 2>"$1.err"
}
pushes_nothing() {
  echo | again again
  printed "Rejected: no axis moved" again && printed "Still missing: range" again
}
pulled_out() { # between two questions
  mkfifo orders
  exec 8<>orders
  sleep 12 | again pulled_out --orders orders & running+=($!)
  within 8 printed "Enter" pulled_out
  echo unplug >&8
  within 5 printed "was unplugged" pulled_out
  echo plug >&8
  within 5 printed "is connected again" pulled_out
}
elsewhere=$work/another/gearshift/devices
mkdir -p "$elsewhere"
(sticks=$elsewhere; all_known whole)
cp -r "$elsewhere" measured_before
check "a user who pushes nothing gets a message with the missing steps" pushes_nothing
check "unplugging and reconnecting the stick is reported" pulled_out
check "earlier measurements are saved" diff -r measured_before "$elsewhere"

wait
running=()
for family in $calibrated; do
  check "$family is calibrated" grep -q "^Calibrated: " calibrate_$family.txt
  check "invalid answers are asked again" grep -q 'Rejected: "5000" is not a number from 20 to 500 mm' calibrate_$family.txt
  check "hands off is printed before the motors move" grep -q "^HANDS OFF" calibrate_$family.txt
  check "its forces push left and forward, as PID 1.0 says" grep -q "a positive force pushes left.*a positive force pushes forward" calibrate_$family.txt
done
# The emulated handle: 0.095 and 0.086 kg, 3.0 and 2.9 N s/m, 15 and 16 N/m; 400 N/m and 20 N s/m at the largest
# coefficients. Tolerances allow for a busy machine in real time.
measured() { grep -l "^travel_m = 0.14" "$sticks"/*.toml; }
check "the measurements are correct" python3 - $(measured) <<'END'
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
