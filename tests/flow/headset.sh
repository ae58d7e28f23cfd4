#!/usr/bin/env bash
# The trainer in a headset, whole: a lesson is passed in it, it is put down and picked up, lost and found again, the room
# turns, its pictures stop; and the lever goes on through all of it.
# The headset is the OpenXR test runtime with a script for each run.
# Usage: headset.sh GEARSHIFT SOURCE_FOLDER MANIFEST
set -u
needs_machine=yes
gearshift=$1
manifest=$3
flows=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$flows/checks.sh"
source "$flows/window.sh"
source "$flows/worn.sh"

# --- a lesson, by the simulated learner, until the person leaves by the headset's own menu
begin "a lesson starts in the headset" wear lesson --hand "by itself" --lesson hill_start --seat-height 0.05 < <(
  echo 'capture = {every = 3}'
  at 13 exit)
check "which is told" within 20 told "$found"
check "the lesson is passed in it" within 30 said "lesson hill_start is over: grade .* of 10, passed"
check "the window shows it to others" shows_picture
xdotool windowfocus "$window"
key F9
check "a recording" within 10 recorded
check "the headset's menu ends it" ended_by_itself
check "nothing else on stderr" one_line
check "it broke no rule" broke_no_rule
check "each frame has both eyes, depth, the card, and the eyes' late place" each_frame_is_whole
check "and there were some" has_more_frames 5
check "the headset was left by the book" [ "$(tail -n 1 lesson/log.txt)" = "state EXITING" ]
check "the recording was closed, and where it is was told" said "^recorded: .*\.trace"
check "it is whole" bash -c '"$0" replay "$(sed -n "s/^recorded: //p" lesson.txt)" | grep -q "^bit for bit"' "$gearshift"
check "the seat is kept" grep -q "^seat_height_m = 0.05$" "$seat"
for left in lesson/*_left.png; do
  right=${left/left/right}
  check "$left" is_picture "$left"
  check "$right" is_picture "$right"
  check "each eye has its own" differs "$left" "$right" 10000
done
# The card is in what hangs there, its words are drawn, and they follow the lesson.
card=$(ls lesson/*_quad.png | head -n 1) last_card=$(ls lesson/*_quad.png | tail -n 1)
cover() { convert "$1" -alpha extract -format '%[fx:mean]' info: | python3 -c 'import sys; sys.exit(float(input()) < 0.15)'; }
for one in "$card" "$last_card"; do
  check "a card hangs there: $one" cover "$one"
  check "with words" [ "$(colours "$one")" -gt 30 ]
done
check "other words after the lesson" differs "$card" "$last_card" 1000

# --- every state; the room turned; a head that is not seen. The car stands: its picture stays.
begin "it starts, the seat at the right" wear states --lesson none --car none --hand grip --drive right --knob -0.3,0.5,0.3 < <(
  echo 'capture = {every = 1}'
  at 6 visible
  at 7 focused
  at 8 synchronized
  at 9 focused
  at 10 hidden "span = 0.8"
  at 11 stopping
  at 13.5 ready
  at 16 space_change 'space = "local"' "position = [0.2, 0, 0.1]" "yaw = 20"
  at 17 space_change 'space = "stage"' "position = [0.4, 0, -0.3]" "yaw = 90"
  echo '[[tracking_gap]]'
  printf 'from = 18.5\nuntil = 20\nvalid = false\n[[tracking_gap]]\nfrom = 20.1\nuntil = 20.5\n'
  at 22 exit)
check "the headset's menu ends it" ended_by_itself
check "that it was put down is told" told "^gearshift: the headset is put down; the desktop shows the cabin$"
check "no more than that and what it is" [ "$(wc -l <states.err)" = 2 ]
check "it broke no rule" broke_no_rule
check "each frame that is shown is whole" each_frame_is_whole
worn="SYNCHRONIZED VISIBLE FOCUSED " down="VISIBLE SYNCHRONIZED STOPPING IDLE "
check "through every state" [ "$(sed -n 's/^state //p' states/log.txt | tr '\n' ' ')" = \
  "IDLE READY ${worn}VISIBLE FOCUSED VISIBLE SYNCHRONIZED VISIBLE FOCUSED ${down}READY $worn${down}EXITING " ]
hidden_frames() { grep "^frame .* hidden" states/log.txt; }
check "hidden frames there were" [ "$(hidden_frames | wc -l)" -ge 3 ]
check "and the cabin is drawn for nobody" [ "$(hidden_frames | grep -c projection)" = 0 ]
# [s] from, until: a frame of that time whose picture there is
picture_at() {
  sed -n 's/^frame \([0-9]*\) t=\([0-9.]*\) shown.*/\1 \2/p' states/log.txt | awk -v from="$1" -v until="$2" \
    '$2 > from && $2 < until {printf "states/frame_%06d_left.png\n", $1; exit}'
}
before=$(picture_at 14.8 16)
for when in "turned 17.5 18.5" "not_seen 18.5 20" "seen_again 20.5 22"; do
  read -r what from until <<<"$when"
  check "the driver looks ahead: $what" looks_like "$before" "$(picture_at "$from" "$until")"
done
check "the seat at the right is kept" grep -q '^drive = "right"$' "$seat"
check "with its height" grep -q '^seat_height_m = 0.05$' "$seat"
for line in 'right_m = -0.3' 'down_m = 0.5' 'ahead_m = 0.3'; do check "$line is kept" grep -q "^$line$" "$seat"; done

process() { pgrep -P $trainer; }
open_files() { ls "/proc/$(process)/fd" | wc -l; }
# The fewest of many looks: what was left behind is in all of them, a thread that waits for one frame is not.
threads() { for i in $(seq 60); do ls "/proc/$(process)/task" | wc -l; sleep 0.02; done | sort -n | head -n 1; }
code_kb() { awk '$2 ~ /^rwx/ {own = 1; next} /^[0-9a-f]+-/ {own = 0} own && /^Size:/ {sum += $2} END {print sum + 0}' "/proc/$(process)/smaps"; }

# --- lost, in two ways, or in four, and found again; nothing is left behind
begin "it starts" wear losses --lesson none --hand "by itself" < <(
  fails 25 xrEndFrame XR_ERROR_RUNTIME_FAILURE
  at 12 instance_loss
  whole && at 24 loss_pending
  whole && fails 110 xrWaitFrame XR_ERROR_RUNTIME_FAILURE)
seen=0 losses=2 is_spoiled=
whole && losses=4
for i in $(seq $losses); do
  check "$i. found" soon 30 told "$found" $i
  check "$i. lost" soon 30 told "$lost" $i
  drawn=$(frames) shifts=$(engaged)
  within 4 shows_desktop && seen=$((seen + 1)) # it is found again soon
  check "$i. found again" soon 30 told "$found" $((i + 1))
  # As many frames as it takes to be settled: two of a headset that is worn.
  check "$i. and shown again" soon 20 has_more_frames $((drawn + 1))
  [ $i = 1 ] && files=$(open_files) tasks=$(threads) code=$(code_kb) && told "$lost" 2 && is_spoiled=yes
done
# A view that is owed a frame leaves on a thread of its own, when it gets it.
no_more_threads() { now=$(threads) && alive && [ "$now" -le "$tasks" ]; }
if [ -z "$is_spoiled" ]; then # else lost while it was counted: sanitizers are as slow
  check "no more open files ($files, $(open_files))" [ "$(open_files)" -le "$files" ]
  check "no more threads than $tasks" within 20 no_more_threads
  check "no driver left its code behind ($code, $(code_kb) KiB)" [ "$(code_kb)" -le $((code + 4096)) ]
fi
check "meanwhile the window showed the cabin ($seen times)" [ "$seen" -ge 1 ]
check "the lever shifts on" soon 30 shifts_after "$shifts"
xdotool windowfocus "$window"
check "its key ends it" ended_by End
check "it broke no rule" broke_no_rule
check "each frame is whole" each_frame_is_whole
check "a sentence each, no more" [ "$(wc -l <losses.err)" = $((2 * losses + 1)) ]
# By the event or by the first call after it.
ways=("xrEndFrame failed: XR_ERROR_RUNTIME_FAILURE" "\(the OpenXR runtime goes away\|.* failed: XR_ERROR_INSTANCE_LOST\)"
  "\(the headset is lost\|.* failed: XR_ERROR_SESSION_LOST\)" "xrWaitFrame failed: XR_ERROR_RUNTIME_FAILURE")
for what in "${ways[@]:0:losses}"; do
  check "told: $what" told_so_often "^gearshift: $what$lost" 1
done

# --- pictures that stop for half a second, again and again, do not stop the lever
begin "it starts" wear stalled --lesson none --hand "by itself" < <(
  for i in $(seq 2 8); do at $((3 * i / 2)).$((5 * (i % 2))) stall "periods = 45"; done
  at 14 stall "periods = 900")
check "worn" within 20 has_more_frames 2
check "a recording while pictures stop" record
check "they did" [ "$(awk '/^frame/ {sub("t=", "", $3); n += $3 - last > 0.45; last = $3} END {print n}' stalled/log.txt)" -ge 3 ]
check "the loop went on" never_stopped
check "and the motors stayed on" [ "$(grep -c "released\|fault" stalled.txt)" = 0 ]
xdotool windowfocus "$window"
# The runtime holds a frame back for 10 s; whole seconds are counted, so that "within 4" is between 3 and 4.
is_held() { drawn=$(frames) && sleep 1 && ! has_more_frames "$drawn"; }
check "no frame comes" within 20 is_held
xdotool key space
check "STOP needs none" within 4 said "guard: released"
check "and none has come" [ "$(frames)" = "$drawn" ]
check "its key ends it" ended_by End
check "one sentence" one_line
check "it broke no rule" broke_no_rule

check "validation has nothing to say" validates
[ -n "${GEARSHIFT_PICTURES:-}" ] && cp -r lesson states losses ./*.png ./*.txt ./*.err "$GEARSHIFT_PICTURES"
finish
