#!/usr/bin/env bash
# Tests the identification as a user runs it: the paper's m, b and k are recovered from the simulated lever, also with
# noise and delay, and plotted; a different lever is identified correctly, too.
# Usage: identify.sh GEARSHIFT SOURCE_FOLDER
set -u
gearshift=$1
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

identify() { # takes the name for the output and the arguments
  local name=$1
  shift
  "$gearshift" identify "$@" >"$name.txt" 2>"$name.err"
}
# Takes the name of a JSON output and n; prints the nth "found" number: mass, damping and stiffness of x, then of y.
found() { grep -o '"found": [0-9.e-]*' "$1.txt" | sed -n "$2p" | cut -d' ' -f2; }
near() { # takes a name, n, a value and a relative tolerance; succeeds if the nth number is near the value
  awk -v a="$(found "$1" "$2")" -v b="$3" -v s="$4" 'BEGIN { exit !(a != "" && a / b < 1 + s && a / b > 1 - s) }'
}
far() { ! near "$@"; }
says() { grep -qF -- "$2" "$1.txt"; }

check "identify" identify plain --out plain
check "Table 2" says plain "10.83 Nm"
check "the paper's literal amplitude drives the lever to the stop" says plain "drives the lever to the stop (the lever would move by 484 mm)"
check "eq (7) of the paper" says plain "f_s = 19.04"
check "nothing on stderr, because it is no terminal" [ ! -s plain.err ]
for axis in x y; do
  check "bode_$axis.png is a picture" is_png plain/bode_$axis.png
  check "bode_$axis.svg is whole" grep -q "</svg>" plain/bode_$axis.svg
  check "24 test points" [ "$(wc -l <plain/bode_$axis.csv)" -eq 25 ]
done
check "units in the header" grep -q "^frequency_hz,amplitude_n" plain/bode_x.csv

cat >noisy.toml <<'TOML'
name = "Noise and delay"
[lever]
delay_cycles = 2
[lever.force_sensor]
noise_gw = 20
TOML
cat >other.toml <<'TOML'
name = "Not the paper's"
[lever]
seed = 5
model_error = 0.3
[lever.axis_x]
mass_kg = 0.3
damping_n_s_per_m = 1
stiffness_n_per_m = 60
TOML
check "a noisy lever" identify noisy --preset noisy.toml --json
i=0
for value in 0.095 3.0 14.8 0.086 2.9 15.7; do
  i=$((i + 1))
  check "number $i within 2 %" near noisy $((i + (i > 3))) $value 0.02 # after stiffness comes dry friction
done
check "a different seed" identify seed --preset noisy.toml --seed 2 --json
check "a different seed gives different noise" [ "$(found seed 1)" != "$(found noisy 1)" ]
check "the paper's rate" identify slow --preset paper --json
check "mass at 100 Hz" near slow 1 0.095 0.02
check "a different rate" identify fast --rate 4000 --axis y --json
check "stiffness at 4 kHz" near fast 3 15.7 0.02
check "a lever with model errors" identify other --preset other.toml --axis x --json
check "its true mass is found, not the nominal one" far other 1 0.3 0.02
check "which differ by at most the model error" near other 1 0.3 0.3

printf 'name = "x"\n[lever.axis_x]\nstiffness_n_per_m = 0\n' >springless.toml
check "a lever without a spring" identify springless --preset springless.toml --axis x
check "is reported in words" says springless "the axis has no spring, so it has no damping ratio or bandwidth"
check "and has no invalid number" [ "$(grep -c nan springless.txt)" -eq 0 ]

# Bad command lines and levers must give the documented exit code, one sentence, and nothing on stdout.
refuses() { # takes the expected exit code, a part of the error message, and the arguments of the program
  local code=$1 part=$2
  shift 2
  "$gearshift" identify "$@" >out 2>err
  [ $? -eq "$code" ] && [ "$(wc -l <err)" -eq 1 ] && [ ! -s out ] && grep -qF -- "$part" err
}
printf 'name = "x"\n[lever]\nmass = 1\n' >unknown.toml
printf 'name = "x"\n[lever]\npeak_force_n = 0\ncontinuous_force_n = 0\n' >weak.toml
check "no such axis" refuses 2 "--axis" --axis z
check "rate out of range" refuses 2 "--rate" --rate 99
check "a negative seed" refuses 2 "--seed" --seed -1
check "no such preset" refuses 1 "default, measured, paper" --preset spaceship
check "an unknown key" refuses 1 "unknown.toml:3: mass is not a known key" --preset unknown.toml
check "a lever without motors" refuses 1 "axis x cannot be measured, because max_force of the device = 0" --preset weak.toml
check "an impossible folder" refuses 1 "/proc" --out /proc/nowhere

finish
