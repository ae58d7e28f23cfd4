#!/usr/bin/env bash
# Calibrates emulated force-feedback sticks through the real libusb, with the answers of a user. The measured values
# must be the true ones. An invalid answer must repeat the question. Earlier measurements must stay if the user gives up
# or the stick is unplugged. Tests one family of sticks, whose springs the user leaves out because they take most of the
# time; with ./test --full, all families, with springs.
# Usage: calibrate.sh GEARSHIFT SOURCE_FOLDER STICK_EMULATOR
set -u
needs_machine=yes
source "$(dirname "${BASH_SOURCE[0]}")/sticks.sh"
write_calibrations

# The answers of a user: the numbers that the program asks for, some of them invalid, and then one for each
# measurement, also for those that the program rejects and repeats on a busy machine.
answers() { # takes the family
  printf 'far\n5000\n140 mm\n140\n20\nwhat\n'
  local given=1 # "what"
  until printed "^Calibrated: \|^Still missing: " "calibrate_$1" || [ $SECONDS -gt 240 ]; do
    if printed "\[Enter to start" "calibrate_$1" $((given + 1)); then
      given=$((given + 1))
      if tail -n 1 "calibrate_$1.txt" | grep -q "springs and dampers" && ! is_full_run; then echo "-"; else echo; fi
    fi
    sleep 0.1
  done
}
calibrate() {
  answers "$1" | with_stick --realtime --family "$1" -- "$gearshift" devices --calibrate "${name[$1]}" >"calibrate_$1.txt" 2>"calibrate_$1.err"
}
calibrated=sidewinder # only one family, because each takes most of a minute
is_full_run && calibrated=$families
for family in $calibrated; do calibrate $family & running+=($!); done

# Calibrates a stick again with a different configuration folder. Runs in parallel with the calibrations above.
again() { # takes the name for the output and options of the emulator; stdin is the user's input
  XDG_CONFIG_HOME=$work/another with_stick --family vjoy "${@:2}" -- \
    "$gearshift" devices --calibrate "${id[vjoy]}" --again >"$1.txt" 2>"$1.err"
}
has_pedals() { # the sentence that its other axes are set up in another way
  grep -q "vJoy.* has 8 axes. Two are calibrated here.* run: gearshift devices --controls" again.txt
}
pushes_nothing() {
  echo | again again
  printed "Rejected: no axis moved" again && printed "Still missing: range" again
}
pulled_out() { # unplugs and reconnects the stick while the program waits for Enter
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
(sticks=$elsewhere; write_calibrations complete)
cp -r "$elsewhere" measured_before
check "a user who pushes nothing gets a message with the missing steps" pushes_nothing
check "and how to use the axes that are not the lever's" has_pedals
check "unplugging and reconnecting the stick is reported" pulled_out
check "earlier measurements are saved" diff -r measured_before "$elsewhere"

wait
running=()
for family in $calibrated; do
  check "$family is calibrated" grep -q "^Calibrated: " calibrate_$family.txt
  is_full_run || check "springs that were left out are shown" grep -q "^  springs  *not measured  " calibrate_$family.txt
  check "invalid answers are asked again" grep -q 'Rejected: "5000" is not a number from 20 to 500 mm' calibrate_$family.txt
  check "hands off is printed before the motors move" grep -q "^HANDS OFF" calibrate_$family.txt
  check "its forces push left and forward, as PID 1.0 says" grep -q "a positive force pushes left.*a positive force pushes forward" calibrate_$family.txt
done
# True values of the emulated stick: handle (x and y) 0.095 and 0.086 kg, 3.0 and 2.9 N s/m, 15 and 16 N/m; spring
# 400 N/m and damper 20 N s/m at their largest coefficients. The ranges below are wide, because the measurements run in
# real time on a machine that may be busy.
measured() { grep -l "^travel_m = 0.14" "$sticks"/*.toml; }
check "the measurements are correct" python3 - $(measured) <<'END'
import os, pathlib, re, sys
allowed = {"mass_kg": (0.07, 0.13), "damping_n_s_per_m": (2, 5), "stiffness_n_per_m": (0, 40),
           "spring_stiffness_n_per_m": (330, 450), "damper_n_s_per_m": (14, 30), "damper_sign": (1, 1)}
if not os.environ.get("GEARSHIFT_FULL"):
    allowed |= {"spring_stiffness_n_per_m": (0, 0), "damper_n_s_per_m": (0, 0), "damper_sign": (0, 0)}
assert sys.argv[1:]
for file in map(pathlib.Path, sys.argv[1:]):
    for key, value in re.findall(r"^(\w+) = ([-\d.e]+)", file.read_text(), re.M):
        low, high = allowed.get(key, (-1e9, 1e9))
        assert low <= float(value) <= high, f"{file.name}: {key} = {value}"
END
[ $failed = 0 ] || tail -n 15 calibrate_*.txt calibrate_*.err
finish
