#!/usr/bin/env bash
# Sticks with the habits of real firmware, beneath the real libusb: each is listed with its effects, or refused in one
# sentence; with ./test --full, some are calibrated by a user.
# Usage: stick_profiles.sh GEARSHIFT SOURCE_FOLDER STICK_EMULATOR
set -u
needs_machine=yes
source "$(dirname "${BASH_SOURCE[0]}")/sticks.sh"

lists() { # profile
  with_stick --family "$1" -- "$gearshift" devices --json >list.json 2>list.err &&
    python3 -c '
import json
[stick] = json.load(open("list.json"))["sticks"]
assert stick["force"] == "pushes" and "constant force" in stick["effects"] and not stick["calibrated"], stick'
}
for profile in "OpenFFBoard, 32-bit" "OpenFFBoard, one motor" "Arduino library" "Arduino library, hat" Fino \
  "adapt-ffb-joy 0.5" "adapt-ffb-joy 0.4" SunFFB AFFBWheel "Arduino-FFB-wheel, two motors" STM32_FFBJoystick \
  "Cyborg Evo Force"; do
  check "$profile is listed" lists "$profile"
done

# The answers of a user: three numbers, and Enter for everything else but what is given.
calibrate() { # profile, id of the stick, answers after the numbers
  profile=$1
  printf "140\n140\n20\n${3:-}\n\n\n\n\n\n\n\n\n\n\n\n\n\n" |
    with_stick --family "$1" -- "$gearshift" devices --calibrate "$2" >calibrated.txt 2>calibrated.err
  code=$?
}
ends_with() { check "$profile: exit status $1" [ $code = "$1" ]; }
shows() { check "$profile: $1" grep -q -- "$1" calibrated.txt; }

write_calibration 2341_8036_HIDEM 0x2341 0x8036 HIDEM -32767 0 32767
write_calibration 2341_8037_HIDEM 0x2341 0x8037 HIDEM -32768 -0.5 32767
write_calibration 03eb_204e 0x03eb 0x204e "" -512 -0.5 511
write_calibration 06a3_ffb5 0x06a3 0xffb5 "" 0 2048 4096

# One motor: the user leaves the step out after a try, and the program says what is missing.
calibrate AFFBWheel 2341:8037 '\n-\n'
shows "Rejected: the stick has a motor for select, but none for shift, and a lever needs one there"
shows "to leave it out: then the stick cannot be used"
shows "Still missing: delay, force direction"
ends_with 1
if is_full_run; then
  calibrate "Arduino library" 2341:8036
  shows "the stick's springs do not keep their dead band, so springs are not used"
  shows "springs  *not used: the stick's springs do not keep their dead band"
  shows "^Calibrated: "
  ends_with 0
  calibrate "adapt-ffb-joy 0.5" 03eb:204e
  shows "the stick's springs have no dead band, so springs are not used"
  shows "^Calibrated: "
  ends_with 0
  calibrate "Cyborg Evo Force" 06a3:ffb5
  shows "springs of up to [34][0-9][0-9] N/m in select"
  shows "^Calibrated: "
  ends_with 0
fi
finish
