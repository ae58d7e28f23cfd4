# The flow tests with force-feedback sticks source this file. The sticks are emulated beneath the real libusb. These
# tests have the arguments GEARSHIFT SOURCE_FOLDER STICK_EMULATOR.
gearshift=$1
emulator=$3
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
export gearshift XDG_CONFIG_HOME=$work/config XDG_DATA_HOME=$work/data
sticks=$XDG_CONFIG_HOME/gearshift/devices
mkdir -p "$sticks"

running=()
end_all() { kill "${running[@]}" 2>/dev/null; }

with_stick() { timeout 240 umockdev-wrapper "$emulator" "$@"; } # arguments: OPTIONS -- COMMAND
# Takes a pattern, the name of a log, and the minimum number of matching lines (default 1).
printed() { [ "$(cat "$2.txt" 2>/dev/null | grep -c -- "$1")" -ge "${3:-1}" ]; }
within() { # takes seconds and a command; repeats the command until it succeeds, for at most this time
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    [ $SECONDS -lt $end ] || return 1
    sleep 0.1
  done
}

# Writes a calibration file for an emulated stick. The counts of the y axis fall when the lever moves forward, so
# `low_counts` of [shift] is the highest count. Without "complete", the file has only the values that the user enters.
# With "complete", it has all values, as a calibration measures them when program and emulation share two cores.
write_calibration() { # takes file name, vendor, product, serial, low, rest, high, and "complete" or nothing
  local travel=0 force=0 select=0 shift=0 spring=0 spring_force=0 band=0 damper_force=0 mass=0 damping=0 stiffness=0
  local interval=0 delay=0 jitter=0 limit=0
  [ "${8:-}" = complete ] && travel=0.14 force=20 select=-1 shift=1 spring=1 spring_force=350 band=1 damper_force=20 \
    mass=0.09 damping=3 stiffness=15 interval=0.001 delay=0.001 jitter=0.004 limit=1
  cat >"$sticks/$1.toml" <<END
vendor = $2
product = $3
$([ -z "$4" ] || echo "serial = \"$4\"")
[select]
axis = "x"
low_counts = $5
centre_counts = $6
high_counts = $7
travel_m = $travel
full_force_n = $force
constant_sign = $select
spring_sign = $spring
spring_stiffness_n_per_m = $spring_force
damper_sign = $spring
damper_n_s_per_m = $damper_force
spring_dead_band = $band
constant_limit = $limit
constant_slope = 1
[select.handle]
mass_kg = $mass
damping_n_s_per_m = $damping
stiffness_n_per_m = $stiffness
[shift]
axis = "y"
low_counts = $7
centre_counts = $6
high_counts = $5
travel_m = $travel
full_force_n = $force
constant_sign = $shift
spring_sign = $spring
spring_stiffness_n_per_m = $spring_force
damper_sign = $spring
damper_n_s_per_m = $damper_force
spring_dead_band = $band
constant_limit = $limit
constant_slope = 1
[shift.handle]
mass_kg = $mass
damping_n_s_per_m = $damping
stiffness_n_per_m = $stiffness
[timing]
input_interval_s = $interval
output_interval_s = $interval
delay_s = $delay
jitter_s = $jitter
[buttons]
press = 1
lift = 2
stop = 0
END
}
write_calibrations() { # "complete" or nothing
  write_calibration 045e_001b 0x045e 0x001b "" -512 -0.5 511 "${1:-}"
  write_calibration 1209_ffb0_EMULATED01 0x1209 0xffb0 EMULATED01 -32767 0 32767 "${1:-}"
  write_calibration 1234_bead_2_2_2 0x1234 0xbead 2.2.2 0 16383.5 32767 "${1:-}"
}
families="sidewinder openffboard vjoy"
declare -A name=([sidewinder]=SideWinder [openffboard]=FFBoard [vjoy]=vJoy)
declare -A id=([sidewinder]=045e:001b [openffboard]=1209:ffb0 [vjoy]=1234:bead)

# A preset whose guard tolerates the lateness of a busy machine.
printf 'name = "patient"\n[guard]\nstale_time_s = 0.2\noverruns_in_row = 200\n' >patient.toml

# A gate for the emulated hand. Its slots lead the hand into the walls of the paper's gate, which the program renders.
cat >elsewhere.toml <<END
name = "Elsewhere"
[gate]
aisle_width_mm = 14
slot_width_mm = 12
slot_length_mm = 50
chamfer_mm = 5
[[column]]
position_mm = -15
forward = "1"
neutral = true
[[column]]
position_mm = 15
back = "2"
END

# Settings of tour(), which drives the tour of the paper's gate. The emulated hand shifts while the motors are on.
tour_seconds=100 # at most
enters=100       # at most
gate=paper        # of the tour
hand_gate=paper   # the gate that the emulated hand follows
# Takes the log and the process; sends an Enter to file descriptor 9 for each request, until the process ends.
confirm_requests() {
  local confirmed=0
  while kill -0 "$2" 2>/dev/null; do
    if [ $confirmed -lt $enters ] && printed "press Enter" "$1" $((confirmed + 1)); then
      confirmed=$((confirmed + 1))
      echo >&9
    fi
    sleep 0.1
  done
}
tour() { # takes the name for the output, the stick family, and options of the emulator
  local name_of_run=$1 family=$2
  shift 2
  mkfifo "$name_of_run.in"
  exec 9<>"$name_of_run.in"
  with_stick --family "$family" --tour "$hand_gate" "$@" -- "$gearshift" tour --device "${id[$family]}" --gate "$gate" \
    --preset ./patient.toml --seconds $tour_seconds --out "$name_of_run" <&9 >"$name_of_run.txt" 2>"$name_of_run.err" &
  local run=$!
  confirm_requests "$name_of_run" $run
  wait $run
}
in_order() { # takes a log; checks that every gear was engaged in the tour's order
  local wanted gear
  wanted="$(sed -n 's/^The tour visits these gears: \(.*\)\.$/\1/p' "$1.txt" | tr -d ,) "
  for gear in $(awk '/ engaged at/{print $1}' "$1.txt"); do
    [ "$gear" = "${wanted%% *}" ] && wanted=${wanted#* }
  done
  [ -z "$wanted" ]
}
replays() { "$gearshift" replay "$1/tour.trace" | grep -q "^identical bit for bit"; }
zero_force() { # takes a log and an event; prints the longest time [ms] for which the motors still pushed after it
  sed -n "s/^stick_emulator: zero force \([0-9]*\) ms after $2.*/\1/p" "$1.err" | sort -n | tail -n 1
}
silent_within() { # takes a time [ms], a log and an event; the motors must stop within this time after the event
  local ms
  ms=$(zero_force "$2" "$3")
  [ -n "$ms" ] && [ "$ms" -le "$1" ]
}
