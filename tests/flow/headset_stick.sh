#!/usr/bin/env bash
# Tests the complete trainer with a lever and a headset: both are found; the lever is drawn at its true place after the
# user has touched its knob; only Enter turns the forces on; the stick is unplugged while the headset is worn; the stick
# keeps running when the headset is lost. Prints the timing of the cycles with and without the headset. The stick is
# emulated beneath the real libusb; the headset is the OpenXR test runtime.
# Usage: headset_stick.sh GEARSHIFT SOURCE_FOLDER STICK_EMULATOR MANIFEST
set -u
needs_machine=yes
manifest=$4
flows=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$flows/sticks.sh"
source "$flows/window.sh"
source "$flows/worn.sh"
write_calibrations complete
puts_on=launch

no_force_messages() { ! printed ' s  \(forces\|motors\) '; }
in_room() { python3 "$flows/lever_in_room.py" "$@"; }
# Prints the time of the last frame on the clock of the headset's script [s].
script_time() { sed -n 's/^frame [0-9]* t=\([0-9.]*\).*/\1/p' "$log/log.txt" | tail -n 1; }
is_later() { awk -v now="$(script_time)" -v then="$1" 'BEGIN {exit !(now > then)}'; }
in_round() { within 20 is_later "$(awk -v round="$round" -v t="$1" 'BEGIN {print round + t}')"; }
click() { # takes x and y; clicks at this point of the window
  xdotool mousemove --window "$window" "$1" "$2"
  sleep 0.4
  xdotool click 1
  sleep 0.4
}

# --- the user touches the knob in three gears with forces off; the stick is unplugged while the headset is worn
mkfifo orders
exec 8<>orders
order() { echo "$*" >&8; }
beneath=(umockdev-wrapper "$emulator" --family openffboard --own-power --orders orders --log forces.log --)
size=960x600 panel="--view engineer" hang="left -0.3"
begin "stick and headset are found" wear touched --device ffboard --preset ./patient.toml --lesson none --car none --gate paper < <(
  echo 'capture_every = 2'
  in_room script)
check "the headset is reported" within 20 warned "$found"
xdotool windowfocus "$window"
check "the window shows it" within 20 shows_picture
# The panel has 960 x 540 pixels and is in the middle of the window. The open tab is blue. The pixel that is read below
# is in the tab that is open at the start. It is no longer blue when the XR tab is open.
tab_is_open() { window_picture && [[ $(convert "$log.png" -crop 1x1+733+144 txt:-) != *"#285C7A"* ]]; }
opens_tab() { click 935 149 && tab_is_open; }
check "the panel's XR tab opens" within 20 opens_tab
before=$(ls touched/*_left.png | tail -n 1)
touch_is_saved() { grep -qs "^\[touched\]" "$seat"; }
# Touches the knob in three gears during one round of the headset's script: moves the lever to each gear before the
# controller pulls its trigger there, and saves before the first pull of the next round.
touch_in_a_round() {
  round=$(script_time | awk '{print 10 * int(($1 + 1.6) / 10 + 1)}')
  in_round -1.5
  click 770 369 # touch the knob
  in_round 2
  order go -30 0
  sleep 0.2
  order go -30 35.8
  in_round 5
  order go -30 0
  sleep 0.2
  order go 30 0
  sleep 0.4
  order go 30 -35.8
  in_round 8.4
  click 750 412 # save it
  order go 30 0
  sleep 0.2
  order go 0 0
  within 4 touch_is_saved
}
touch_in_some_round() { touch_in_a_round || touch_in_a_round || touch_in_a_round; } # on a slow machine a round may fail
check "the touches are saved" touch_in_some_round
check "the knob is at its true place" in_room found "$seat"
check "no forces so far" no_force_messages
sleep 1.5 # gives the lever time to return, and the picture time to show it
touched=$(ls touched/*_left.png | tail -n 1)

check "Enter turns the forces on" press_for Return "forces on" 1
order go 15 0
sleep 0.2
order go 15 20 # presses into the wall next to a slot
sleep 1
drawn=$(frames)
window_picture && cp "$log.png" plugged.png
order unplug
check "unplugged, the forces are off" within 5 printed "motors off"
check "the headset's pictures continue" within 10 has_more_frames $((drawn + 3))
panel_reports() { window_picture && differs plugged.png "$log.png" 3000; }
check "the panel reports it" within 10 panel_reports
order go 0 0
order plug
sleep 1.5
check "reconnected, the forces stay off" [ "$(grep -c "forces on" touched.txt)" = 1 ]
check "until Enter turns them on" press_for Return "forces on" 2
check "the End key ends it" ended_by End
check "no OpenXR rule was broken" broke_no_rule
check "each frame is complete" each_frame_is_complete
zero() { sed -n "s/^stick_emulator: zero force \([0-9]*\) ms after $1.*/\1/p" "$log.err"; }
is_silent_after() { local ms; ms=$(zero "$1") && echo "    zero force $ms ms after $1" && [ -n "$ms" ] && [ "$ms" -le 330 ]; }
check "unplugged, the motors stop after the length of an effect" is_silent_after "the unplug"
check "the motors stop after the program's end" is_silent_after "the program's end"

# --- a second start with the calibrated seat: the headset is lost while the forces are on
in_room truth "$seat"
beneath=(umockdev-wrapper "$emulator" --family openffboard --tour paper --log lost.log --)
panel=--no-panel hang="left -0.3 right 0.3"
begin "a new start" wear lost --device ffboard --preset ./patient.toml --lesson none --car none --gate paper < <(
  echo 'capture_every = 2'
  in_room script | grep "^head\|^stage_origin"
  fails 36 xrEndFrame XR_ERROR_RUNTIME_FAILURE
  for i in 2 3 4 5 6 7; do fails $i xrGetSystem XR_ERROR_FORM_FACTOR_UNAVAILABLE; done)
check "the headset is found" within 20 warned "$found"
check "the headset is worn" within 30 has_more_frames 4
xdotool windowfocus "$window"
check "the knob is drawn at its true place" in_room drawn "$touched" "$(ls lost/*_left.png | tail -n 1)" "$before"
check "Enter turns the forces on" press_for Return "forces on" 1
uptime_now() { read -r now _ </proc/uptime; echo "$now"; }
armed_at=$(uptime_now)
rm -rf data/gearshift/recordings
recorded_at=$(uptime_now)
key F9
check "a recording" within 10 recorded
check "the headset is lost" soon 40 warned "$lost"
lost_at=$(uptime_now)
sleep 5
check "the window shows the cabin" within 5 shows_desktop
checked_at=$(uptime_now)
check "the forces stay on all the time" [ "$(grep -c "motors off\|forces off, damping only" lost.txt)" = 0 ]

key F9
check "the recording is complete" within 10 replays
check "the End key ends it" ended_by End
# The first check reads the output reports in the stick's log, which has the stick's clock. The second check
# reads the recorded cycles, except those within 1 s of the headset's loss.
check "the stick received force commands all the time" python3 - lost.log "$armed_at" "$checked_at" <<'END'
import sys
begin, end = map(float, sys.argv[2:])
times = [t for t in (float(line.split()[0]) for line in open(sys.argv[1]) if " out " in line) if begin < t < end]
longest = max(b - a for a, b in zip(times, times[1:]))
print(f"    {len(times)} reports in {end - begin:.1f} s, longest gap {1e3 * longest:.0f} ms")
sys.exit(not (len(times) > 100 and longest < 0.2 and end - times[-1] < 0.2))
END
check "the cycles continued" python3 - lost.csv "$(awk -v a="$recorded_at" -v b="$lost_at" 'BEGIN {print b - a}')" <<'END'
import csv, sys
times = [float(row["time_s"]) for row in csv.DictReader(open(sys.argv[1]))]
start, lost = times[0], float(sys.argv[2])
ok = True
for name, part in ("stick and headset", [t for t in times if t - start < lost - 1]), ("stick alone", [t for t in times if t - start > lost + 1]):
    gaps = sorted(b - a for a, b in zip(part, part[1:]))
    span = part[-1] - part[0]
    fraction = len(part) / (1 + round(1000 * span))
    print(f"    {name}: {len(part)} cycles in {span:.1f} s, {100 * fraction:.1f} %; apart p50 {1e3 * gaps[len(gaps) // 2]:.2f}, "
          f"p99 {1e3 * gaps[len(gaps) * 99 // 100]:.2f}, at most {1e3 * gaps[-1]:.1f} ms")
    ok = ok and span > 2 and fraction > 0.8 and gaps[-1] < 0.2
sys.exit(not ok)
END
check "no OpenXR rule was broken" broke_no_rule
check "the motors stop after the program's end" is_silent_after "the program's end"
check "no validation message" validates
finish
