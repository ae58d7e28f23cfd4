# The flow tests that run the trainer in a window source this file. It starts a private X server and simulates a user's
# mouse and keys.
export GEARSHIFT_VALIDATION=1 XDG_RUNTIME_DIR=$work/runtime XDG_CACHE_HOME=$work/cache XDG_DATA_HOME=$work/data
export XDG_CONFIG_HOME=$work/config
mkdir -m 700 runtime

# No process may be left behind: the test ends server and trainer, and if the test is killed, their time limit ends
# them.
trainer= server=
end_all() { kill $trainer $server 2>/dev/null; }
life=${life:-290} # [s] maximum lifetime of server and trainer
timeout "$life" Xvfb -displayfd 3 -screen 0 1280x720x24 -noreset 3>display 2>xvfb.err &
server=$!

within() { # takes seconds and a command; repeats the command until it succeeds, for at most this time
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    [ $SECONDS -lt $end ] || return 1
    sleep 0.1
  done
}
has_display() { [ -s display ]; }
within 20 has_display || { cat xvfb.err; exit 1; }
DISPLAY=:$(cat display)
export DISPLAY

beneath=()   # a command, with arguments, through which gearshift is started; empty: none
size=640x400 # of the window
launch() { # takes the name for the output and arguments; starts the trainer and waits for its window
  local name=$1
  shift
  timeout "$life" "${beneath[@]}" "$gearshift" train --size $size "$@" >"$name.txt" 2>"$name.err" &
  trainer=$!
  log=$name
  within 20 find_window
}
start() { launch "$@" && wait_for "forces on$"; }
find_window() { window=$(xdotool search --onlyvisible --name '^gearshift$' 2>/dev/null | head -n 1) && [ -n "$window" ]; }
printed() { [ "$(grep -c -- "$1" "$log.txt")" -ge "${2:-1}" ]; }
wait_for() { within 20 printed "$@"; } # takes a pattern and how often the log must match it
key() { xdotool key "$1" && sleep 0.3; }
# Takes a key, a pattern and a count; presses the key and waits until the log has matched the pattern count times. Only
# for keys that may be pressed repeatedly.
press_until_logged() { key "$1" && within 3 printed "$2" "$3"; }
press_for() { within 20 press_until_logged "$@"; }
alive() { kill -0 $trainer 2>/dev/null; }
has_ended() { ! alive; }
press_until_ended() { key "$1" && within 5 has_ended; }
ended_by() { within 20 press_until_ended "$1" && wait $trainer; } # succeeds if the exit code is 0

# The mouse moves the hand by 0.12 mm per pixel (up is forward), in steps as small as a user's.
at_x=0 at_y=0
go() { # takes x and y [mm]
  local to_x=$(($1 * 100 / 12)) to_y=$(($2 * 100 / 12)) step=20 dx dy
  while [ $at_x -ne $to_x ] || [ $at_y -ne $to_y ]; do
    dx=$((to_x - at_x)) dy=$((to_y - at_y))
    [ $dx -gt $step ] && dx=$step
    [ $dx -lt -$step ] && dx=-$step
    [ $dy -gt $step ] && dy=$step
    [ $dy -lt -$step ] && dy=-$step
    xdotool mousemove_relative -- $dx $((-dy))
    at_x=$((at_x + dx)) at_y=$((at_y + dy))
    sleep 0.03
  done
  sleep 0.3
}
# A busy machine may draw so few frames that the hand cuts a corner and is blocked by a wall. The hand then tries again.
at_mm=0
shift_to() { # takes a gear, and x and y of the gear's end position [mm]
  for _ in 1 2 3; do
    go "$at_mm" 0
    go "$2" 0
    go "$2" "$3"
    at_mm=$2
    within 6 printed " $1 engaged" && return 0
  done
  return 1
}
