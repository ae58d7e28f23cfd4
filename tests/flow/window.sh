# Sourced by the flows that run the trainer in a window: an X server of their own, and a person at mouse and keys.
export GEARSHIFT_VALIDATION=1 XDG_RUNTIME_DIR=$work/runtime XDG_CACHE_HOME=$work/cache XDG_DATA_HOME=$work/data
export XDG_CONFIG_HOME=$work/config
mkdir -m 700 runtime

# Ended from outside, too, it leaves nothing running; where it cannot end them itself, their time is up soon.
trainer= server=
end_all() { kill $trainer $server 2>/dev/null; }
life=${life:-290} # [s] of server and trainer at most
timeout "$life" Xvfb -displayfd 3 -screen 0 1280x720x24 -noreset 3>display 2>xvfb.err &
server=$!

within() { # seconds, command ...: until it succeeds
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

beneath=()   # what runs the program, and its arguments
size=640x400 # of the window
launch() { # name of the result, arguments ...
  local name=$1
  shift
  timeout "$life" "${beneath[@]}" "$gearshift" train --size $size "$@" >"$name.txt" 2>"$name.err" &
  trainer=$!
  log=$name
  within 20 find_window
}
start() { launch "$@" && wait_for "running"; }
find_window() { window=$(xdotool search --onlyvisible --name '^gearshift$' 2>/dev/null | head -n 1) && [ -n "$window" ]; }
said() { [ "$(grep -c -- "$1" "$log.txt")" -ge "${2:-1}" ]; }
wait_for() { within 20 said "$@"; } # pattern in the log, and how often
key() { xdotool key "$1" && sleep 0.3; }
# A key that may be pressed again: until the log has the pattern so often, or the trainer is gone.
press_until_said() { key "$1" && within 3 said "$2" "$3"; }
press_for() { within 20 press_until_said "$@"; }
alive() { kill -0 $trainer 2>/dev/null; }
is_gone() { ! alive; }
press_until_gone() { key "$1" && within 5 is_gone; }
ended_by() { within 20 press_until_gone "$1" && wait $trainer; } # with the exit code 0

# The mouse leads the hand, 0.12 mm a pixel, up = forward, in steps as a hand makes them.
at_x=0 at_y=0
go() { # x, y in mm
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
# A machine that is busy may draw few frames: then the hand cuts a corner, hangs at a wall, and goes again.
at_mm=0
shift_to() { # gear, x and y of its end in mm
  for _ in 1 2 3; do
    go "$at_mm" 0
    go "$2" 0
    go "$2" "$3"
    at_mm=$2
    within 6 said " $1 engaged" && return 0
  done
  return 1
}
