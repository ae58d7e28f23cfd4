# Sourced by the flows that wear a headset, after window.sh: the OpenXR test runtime of $manifest, with a script for each run.
grep -q library_path "$manifest" || { echo "no manifest of the test runtime: $manifest"; exit 1; }
unset XR_LOADER_DEBUG

seat=config/gearshift/headset.toml
found="gearshift test headset at gearshift test runtime"
lost="; the desktop shows the cabin, the lever goes on$"

# name of the script and of all results, arguments ...; the script's own part on stdin. Small eyes: a CPU draws them. The
# hands hang down: what they point at is none of the card.
hang="left -0.3 right 0.3"
puts_on=start panel=--no-panel
hanging() { printf '%s = {aim = [{position = [%s, -0.6, 0], pitch = -80}]}\n' "$@"; }
wear() {
  {
    printf 'pacing = "real"\nrecommended = [256, 192]\n'
    hanging $hang
    cat
  } >"$1.toml"
  mkdir "$1"
  export XR_RUNTIME_JSON=$manifest GEARSHIFT_XR_SCRIPT=$work/$1.toml GEARSHIFT_XR_OUT=$work/$1
  $puts_on "$1" --xr --silent $panel "${@:2}"
}
begin() { # what, command ...: without it there is nothing to wait for
  check "$@"
  alive && return
  cat "$log.err"
  finish
  exit $?
}
# As within, while the trainer is there.
is_so_or_gone() { "$@" || is_gone; }
soon() { within "$1" is_so_or_gone "${@:2}" && "${@:2}"; }
at() { # [s] of the script, what happens, and its own words
  printf '[[event]]\nat = %s\nwhat = "%s"\n' "$1" "$2"
  printf '%s\n' "${@:3}"
}
fails() { # nth call of a function, the function, its result
  printf '[[failure]]\nnth = %s\nfunction = "%s"\nresult = "%s"\n' "$1" "$2" "$3"
}
told() { [ "$(grep -c -- "$1" "$log.err")" -ge "${2:-1}" ]; }
told_so_often() { [ "$(grep -c -- "$1" "$log.err")" = "$2" ]; }
ended_by_itself() { within 60 is_gone && wait $trainer; } # with the exit code 0
frames() { grep -c "^frame .* shown" "$log/log.txt"; }
has_more_frames() { [ "$(frames)" -gt "$1" ]; }
broke_no_rule() { grep -q "^frame" "$log/log.txt" && ! grep "^violation\|^leak" "$log/log.txt"; }
# Where the eyes are is asked for again when the rest of the frame is done.
each_frame_is_whole() {
  grep "^frame .* shown" "$log/log.txt" >shown && ! grep -v " layers=2 locates=2 projection+depth quad$" shown
}
validates() { ! grep "validation:" ./*.err; }
colours() { convert "$@" -format %k info:; }
is_picture() { [ "$(colours "$1")" -gt 500 ]; }
differs() { [ "$(compare -metric AE "$1" "$2" null: 2>&1)" -gt "$3" ]; } # in more than so many pixels
looks_like() { compare -metric RMSE "$1" "$2" null: 2>&1 | python3 -c '
import re, sys
sys.exit(float(re.search(r"\((.*)\)", sys.stdin.read())[1]) > 0.08)'; }
window_picture() { import -window "$window" "$log.png" 2>/dev/null; }
shows_picture() { window_picture && is_picture "$log.png"; }
# The headset's picture is narrower than the window: beside it the window is black.
shows_desktop() { window_picture && [ "$(colours "$log.png" -crop 40x300+0+50)" -gt 50 ]; }
engaged() { grep -c " engaged" "$log.txt"; }
shifts_after() { [ "$(engaged)" -gt "$1" ]; }
one_line() { [ "$(wc -l <"$log.err")" = 1 ]; }

recorded() { ls data/gearshift/recordings/*.trace >/dev/null 2>&1; }
record() { # [s] 6 where nothing is said
  rm -rf data/gearshift/recordings
  xdotool windowfocus "$window"
  key F9
  within 10 recorded && sleep "${1:-6}" && key F9 && within 10 replays
}
replays() { "$gearshift" replay data/gearshift/recordings/*.trace --csv "$log.csv" 2>/dev/null | grep "^bit for bit"; }
# Cycles of the loop, their share of those that were due, and the longest time without one [ms]. A bound that a stall of
# half a second would break; and a busy machine alone does not.
never_stopped() { # [s] 5 at least where nothing is said
  python3 - "$log.csv" "${1:-5}" <<'END'
import csv, sys
times = [float(row["time_s"]) for row in csv.DictReader(open(sys.argv[1]))]
longest = max(b - a for a, b in zip(times, times[1:]))
share = len(times) / (1 + round(1000 * (times[-1] - times[0])))
print(f"    {len(times)} cycles in {times[-1] - times[0]:.2f} s, {100 * share:.2f} %, longest gap {1e3 * longest:.0f} ms")
sys.exit(not (times[-1] - times[0] > float(sys.argv[2]) and share > 0.8 and longest < 0.25))
END
}
