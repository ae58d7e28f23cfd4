# The flow tests with a headset source this file after window.sh. The headset is the OpenXR test runtime of $manifest,
# with a script for each run.
grep -q library_path "$manifest" || { echo "no manifest of the test runtime: $manifest"; exit 1; }
ls /usr/share/openxr/1/api_layers/explicit.d/*core_validation* >/dev/null 2>&1 || {
  echo "flows with a headset need the OpenXR layer XR_APILAYER_LUNARG_core_validation (Debian: openxr-layer-corevalidation)"
  exit 1
}
unset XR_LOADER_DEBUG
# Khronos' validation layer checks the program's calls. The test runtime refuses a program that runs without it.
export XR_ENABLE_API_LAYERS=XR_APILAYER_LUNARG_core_validation XR_CORE_VALIDATION_EXPORT_TYPE=text

seat=config/gearshift/headset.toml
found="gearshift test headset connected through gearshift test runtime"
lost="; the desktop shows the cabin. The lever keeps running.$"

# The controllers hang down, so that they do not point at the text card.
hang="left -0.3 right 0.3"
puts_on=start panel=--no-panel
hanging() { printf '%s = [{position = [%s, -0.6, 0], pitch = -80}]\n' "$@"; }
# Takes the name of the run, which is also the name of its script and output, and arguments; starts the trainer. The
# rest of the script comes from stdin. The eyes' pictures are small, because the CPU draws them.
wear() {
  {
    printf 'pacing = "real"\nrecommended = [256, 192]\n'
    hanging $hang
    cat
  } >"$1.toml"
  mkdir "$1"
  export XR_RUNTIME_JSON=$manifest GEARSHIFT_XR_SCRIPT=$work/$1.toml GEARSHIFT_XR_OUT=$work/$1
  export XR_CORE_VALIDATION_FILE_NAME=$work/$1/validation.txt
  $puts_on "$1" --xr --silent $panel "${@:2}"
}
begin() { # like check, but ends the test if the trainer has ended, because nothing can follow
  check "$@"
  alive && return
  cat "$log.err"
  finish
  exit $?
}
# Succeeds also if the trainer has ended, so that soon() does not wait for the whole time.
succeeds_or_has_ended() { "$@" || has_ended; }
soon() { within "$1" succeeds_or_has_ended "${@:2}" && "${@:2}"; }
at() { # prints an event for the script; takes its time [s], the event, and its parameters
  printf '[[event]]\nat = %s\nwhat = "%s"\n' "$1" "$2"
  printf '%s\n' "${@:3}"
}
fails() { # prints a [[failure]] entry for the runtime's script; takes n, the function whose nth call fails, the result
  printf '[[failure]]\nnth = %s\nfunction = "%s"\nresult = "%s"\n' "$1" "$2" "$3"
}
warned() { [ "$(grep -c -- "$1" "$log.err")" -ge "${2:-1}" ]; }
is_reported_times() { [ "$(grep -c -- "$1" "$log.err")" = "$2" ]; }
ended_by_itself() { within 60 has_ended && wait $trainer; } # succeeds if the exit code is 0
frames() { grep -c "^frame .* shown" "$log/log.txt"; }
has_more_frames() { [ "$(frames)" -gt "$1" ]; }
# The layer creates its file only if it has something to report; since OpenXR 1.1, also when it starts.
broke_no_rule() {
  grep -q "^frame" "$log/log.txt" && ! grep "^violation\|^leak" "$log/log.txt" &&
    ! grep -v VALID_DEBUG "$log/validation.txt" 2>/dev/null  # VALID_DEBUG: it starts or ends
}
# layers=2: picture and text card. locates=2: the eyes' poses are queried a second time, after the rest of the frame is
# prepared.
each_frame_is_complete() {
  grep "^frame .* shown" "$log/log.txt" >shown && ! grep -v " layers=2 locates=2 projection+depth quad$" shown
}
validates() { ! grep "validation:" ./*.err; }
colours() { convert "$@" -format %k info:; }
is_picture() { [ "$(colours "$1")" -gt 500 ]; }
# Succeeds if the two pictures differ in more pixels than the third argument.
differs() { [ "$(compare -metric AE "$1" "$2" null: 2>&1)" -gt "$3" ]; }
looks_like() { compare -metric RMSE "$1" "$2" null: 2>&1 | python3 -c '
import re, sys
sys.exit(float(re.search(r"\((.*)\)", sys.stdin.read())[1]) > 0.08)'; }
window_picture() { import -window "$window" "$log.png" 2>/dev/null; }
shows_picture() { window_picture && is_picture "$log.png"; }
# True if the window shows the cabin at its left edge. If it showed the headset's picture, which is narrower than the
# window, the edges would be black.
shows_desktop() { window_picture && [ "$(colours "$log.png" -crop 40x300+0+50)" -gt 50 ]; }
engaged() { grep -c " engaged" "$log.txt"; }
shifts_after() { [ "$(engaged)" -gt "$1" ]; }
one_line() { [ "$(wc -l <"$log.err")" = 1 ]; }

recorded() { ls data/gearshift/recordings/*.trace >/dev/null 2>&1; }
record() { # takes the duration [s], default 6
  rm -rf data/gearshift/recordings
  xdotool windowfocus "$window"
  key F9
  within 10 recorded && sleep "${1:-6}" && key F9 && within 10 replays
}
replays() { "$gearshift" replay data/gearshift/recordings/*.trace --csv "$log.csv" 2>/dev/null | grep "^identical bit for bit"; }
# Checks the cycles of a recording. Prints their number, also in % of one cycle per millisecond, and the longest gap
# between two cycles [ms]. headset.sh stops the headset's frames for half a second at a time. The largest allowed gap,
# 0.25 s, is shorter than that, but longer than the gaps on a busy machine.
never_stopped() { # takes the minimum duration [s], default 5
  python3 - "$log.csv" "${1:-5}" <<'END'
import csv, sys
times = [float(row["time_s"]) for row in csv.DictReader(open(sys.argv[1]))]
longest = max(b - a for a, b in zip(times, times[1:]))
fraction = len(times) / (1 + round(1000 * (times[-1] - times[0])))
print(f"    {len(times)} cycles in {times[-1] - times[0]:.2f} s, {100 * fraction:.2f} %, longest gap {1e3 * longest:.0f} ms")
sys.exit(not (times[-1] - times[0] > float(sys.argv[2]) and fraction > 0.8 and longest < 0.25))
END
}
