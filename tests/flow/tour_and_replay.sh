#!/usr/bin/env bash
# The tour as a user runs it: every shipped gate, plots that are pictures, a trace that replays bit for bit in another
# process, the same hash twice, and a damaged trace refused.
# Usage: tour_and_replay.sh GEARSHIFT
set -eu
gearshift=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() { echo "FAILED: $*"; exit 1; }

for gate in paper five_speed_r_left_up five_speed_r_right_down six_speed_r_left_up six_speed_r_left_down \
            six_speed_r_right_down dog_leg_five four_speed; do
  "$gearshift" tour --out "$gate" --gate "$gate" >"$gate.txt" || fail "tour of $gate"
  "$gearshift" replay "$gate/tour.trace" | grep -q "^bit for bit" || fail "replay of $gate"
  "$gearshift" gate "$gate" --json >"$gate.json" || fail "gate $gate"
  "$gearshift" gate "$gate" --svg "$gate.svg" >/dev/null && grep -q "</svg>" "$gate.svg" || fail "drawing of $gate"
done
grep -A6 "Hz" paper.txt | awk '/engaged/{print $1}' | tr '\n' ' ' | grep -q "^1 2 3 4 5 R $" || fail "order of Fig. 9"

for plot in trajectory force; do
  [ "$(head -c 4 paper/$plot.png | tail -c 3)" = PNG ] || fail "$plot.png is no picture"
  grep -q "</svg>" paper/$plot.svg || fail "$plot.svg is not whole"
done
head -n 1 paper/tour.csv | grep -q "time_s,.*lever_x_mm" || fail "units in the header of tour.csv"

"$gearshift" tour --out "a folder with spaces, ä" >again.txt || fail "a path with spaces"
[ "$(grep -o 'hash.*' again.txt)" = "$(grep -o 'hash.*' paper.txt)" ] || fail "two runs, two hashes"
LC_ALL=tr_TR.UTF-8 "$gearshift" tour --out turkish >turkish.txt 2>/dev/null || fail "Turkish locale"
[ "$(grep -o 'hash.*' turkish.txt)" = "$(grep -o 'hash.*' paper.txt)" ] || fail "another locale, another hash"
for rate in 100 250 4000; do "$gearshift" tour --out "rate$rate" --rate $rate >/dev/null 2>&1 || fail "$rate Hz"; done
for hand in light arm 0.3,8,400; do "$gearshift" tour --out "hand" --hand $hand >/dev/null || fail "hand $hand"; done

# One bit in the middle of the file.
size=$(stat -c %s paper/tour.trace)
byte=$(od -An -tu1 -j $((size / 2)) -N 1 paper/tour.trace | tr -d ' ')
printf "$(printf '\\x%02x' $((byte ^ 1)))" | dd of=paper/tour.trace bs=1 seek=$((size / 2)) conv=notrunc status=none
"$gearshift" replay paper/tour.trace >/dev/null 2>err && fail "a flipped bit went unnoticed"
[ "$(wc -l <err)" -eq 1 ] || fail "one sentence wanted"
echo "1 passed, 0 failed"
