#!/usr/bin/env bash
# Tests the trainer with --xr if there is no runtime or no headset, or if the seat options are invalid: it runs in a
# window as usual, or prints one error.
# Usage: no_headset.sh GEARSHIFT SOURCE_FOLDER MANIFEST
set -u
needs_machine=yes
gearshift=$1
manifest=$3
flows=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$flows/checks.sh"
source "$flows/window.sh"
source "$flows/worn.sh"

# --- no runtime: the trainer runs in a window as usual
export XR_RUNTIME_JSON=/nowhere
begin "without a runtime" start nowhere --xr --silent --no-panel --lesson none --hand "by itself"
check "the window shows the cabin" within 20 shows_desktop
xdotool windowfocus "$window"
check "the End key ends it" ended_by End
check "one message, and nothing from the loader" one_line
check "the message names the remedy" grep -q "^gearshift: no OpenXR runtime found; .*XR_RUNTIME_JSON.*; the desktop" nowhere.err

# --- no headset: reported once, however often the program searches for one
begin "without a headset" wear nothing --lesson none --hand "by itself" < <(echo 'headset = false')
check "the window shows the cabin" within 20 shows_desktop
sleep 3 # long enough for the program to search again
check "one message" one_line
check "the missing headset is reported" warned "^gearshift: no headset is connected to gearshift test runtime.*; the desktop shows the cabin"
xdotool windowfocus "$window"
check "the End key ends it" ended_by End

# --- a runtime whose service is off: reported once, and what its client library prints reaches nobody
begin "without the runtime's service" wear off --lesson none --hand "by itself" < <(
  echo 'prints = true'
  for i in 1 1 1; do fails $i xrCreateInstance XR_ERROR_RUNTIME_FAILURE; done)
check "the window shows the cabin" within 20 shows_desktop
tried() { [ "$(grep -c "^planted xrCreateInstance" off/log.txt)" -ge "$1" ]; }
check "it is tried again, after 2 s and after 4 s" within 20 tried 3
check "one message" one_line
check "it says what to start" warned "^gearshift: the OpenXR runtime is installed, but its service does not run; start .*monado-service"
check "the service is started" within 20 warned "$found"
xdotool windowfocus "$window"
check "the End key ends it" ended_by End

# --- rejected options
refused() { # takes the exit code, a part of the error message, and the arguments of train
  timeout 20 "$gearshift" train "${@:3}" >refused.txt 2>refused.err
  [ $? -eq "$1" ] && [ ! -s refused.txt ] && [ "$(wc -l <refused.err)" = 1 ] && grep -q -- "$2" refused.err
}
mkdir -p "$(dirname "$seat")"
printf '# as it is kept\n\ndrive = "left"\nseat_height_m = 0.05\n' >"$seat"
check "a seat beyond its range" refused 2 "seat-height.*5.*0\.3" --xr --seat-height 5
check "a knob of two numbers" refused 2 "knob" --xr --knob 0.3,0.5
check "a knob beyond its range" refused 2 "knob.*9.*1\.5" --xr --knob 0.3,0.5,9
for option in "--seat-height 0.1" "--knob 0.3,0.5,0.3" "--xr-scale 1.2"; do
  check "$option without --xr" refused 2 "requires --xr" $option
done
check "the seat is unchanged" grep -q '^seat_height_m = 0.05$' "$seat"
sed -i 's/^seat_height_m.*/seat_height_m = 7.5/' "$seat"
check "a bad seat in the file" refused 1 "headset.toml:4.*seat_height_m.*7\.5.*-0\.3.*0\.3" --xr --silent
check "the file is unchanged" grep -q "7.5" "$seat"

check "no validation message" validates
[ -n "${GEARSHIFT_PICTURES:-}" ] && cp ./*.png ./*.txt ./*.err "$GEARSHIFT_PICTURES"
finish
