#!/usr/bin/env bash
# Tests the tour as a user runs it: every shipped gate, plots, a trace that replays bit for bit in a second process, the
# same hash in two runs, and a damaged trace that is rejected.
# Usage: tour_and_replay.sh GEARSHIFT SOURCE_FOLDER
set -u
gearshift=$1
gates=$2/assets/gates
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

tour() { # takes the output folder and the arguments
  local name=$1
  shift
  "$gearshift" tour --out "$name" "$@" >"$name.txt" 2>"$name.err"
}
replays() { "$gearshift" replay "$1/tour.trace" | grep -q "^identical bit for bit"; }
describes() { "$gearshift" gate "$1" --json >"$1.json"; }
draws() { "$gearshift" gate "$1" --svg "$1.svg" >/dev/null 2>&1 && grep -q "</svg>" "$1.svg"; }
hash_of() { grep -o 'hash.*' "$1.txt"; }
same_hash() { [ -n "$(hash_of "$1")" ] && [ "$(hash_of "$1")" = "$(hash_of "$2")" ]; }
order_of() { awk '/engaged/{print $1}' "$1.txt" | tr '\n' ' '; }

for layout in "$gates"/*.toml; do
  gate=$(basename "$layout" .toml)
  check "tour of $gate" tour "$gate" --gate "$gate"
  check "replay of $gate" replays "$gate"
  check "gate $gate" describes "$gate"
  check "drawing of $gate" draws "$gate"
done
check "a trace names the program that recorded it" grep -aq "$("$gearshift" --version | head -n 1)" paper/tour.trace
# The paper's tour with the default preset. If this hash changes, the change must be intended, and CHANGELOG.md must
# name it.
check "the hash of the paper's tour, got: $(hash_of paper)" [ "$(hash_of paper)" = "hash fdc801653b99fbf7" ]
check "order of Fig. 9" [ "$(order_of paper)" = "1 2 3 4 5 R " ]
check "nothing on stderr, because it is no terminal" [ ! -s paper.err ]

for plot in trajectory force; do
  check "$plot.png is a picture" is_png "paper/$plot.png"
  check "$plot.svg is complete" grep -q "</svg>" "paper/$plot.svg"
done
head -n 1 paper/tour.csv >header
check "units in the header of tour.csv" grep -q "time_s,.*lever_x_mm" header

check "JSON" tour json --json
check "has the same figures" python3 -c "import json; d = json.load(open('json.txt'))
assert d['hash'] == 'fdc801653b99fbf7' and d['complete'] and len(d['engaged']) == 6 and d['forces_lost']['times'] == 0, d"

# With a low speed limit, the guard rejects readings as implausible and repeatedly switches the forces off, so the tour
# does not show the gate's feel. This must be reported.
sed 's/^speed_limit_m_per_s = 10 .*/speed_limit_m_per_s = 0.1/' "$2/assets/presets/default.toml" >doubts.toml
check "without forces: exit 1" [ "$(tour doubts --preset doubts.toml; echo $?)" -eq 1 ]
falls() { # counts in tour.csv how often the guard's fault changes from none to a fault
  awk -F, 'NR == 1 {while ($++column != "fault");} NR > 1 {if ($column != "none" && was == "none") n++; was = $column}
    END {print n}' doubts/tour.csv
}
check "without forces: reported once, with number and times, got: $(cat doubts.err), $(falls)" \
  [ "$(grep -cE "the force guard switched the forces off $(falls) times, first after 0\.[0-9]+ s; fault: stale reading$" doubts.err)" -eq 1 ]

spaces="a folder with spaces, ä"
check "a path with spaces" tour "$spaces"
check "two runs, one hash" same_hash "$spaces" paper
in_turkish() { env LC_ALL=tr_TR.UTF-8 "$gearshift" tour --out turkish >turkish.txt 2>/dev/null; }
check "Turkish locale" in_turkish
check "in the Turkish locale, the same hash" same_hash turkish paper
for rate in 100 250 4000; do check "$rate Hz" tour "rate$rate" --rate $rate; done
for hand in light arm 0.3,8,400; do check "hand $hand" tour "hand$hand" --hand $hand; done
check "a different seed" tour seed --seed 2

# Tests three presets: `measured`, `paper` with the paper's own wall, and a longer lever with a delay of two cycles.
printf 'name = "wide"\n[lever.yoke]\nradius_m = 0.15\n[lever]\ndelay_cycles = 2\nhand = "grip"\n' >wide.toml
for preset in measured paper wide.toml; do
  tour "preset_$preset" --preset "$preset" --hand grip
  [ $? -le 1 ] || check "tour with preset $preset" false
  check "it replays" replays "preset_$preset"
done
check "the paper's wall is reported as beyond its bound" grep -q "used anyway; the limit is" preset_paper.err
check "a different seed gives different targets" [ "$(hash_of seed)" != "$(hash_of paper)" ]

# Lists the shifts of a recorded lesson. A tour has no car and therefore no shifts.
"$gearshift" lesson skip_shifts --trace lesson.trace >lesson.txt
check "a lesson's trace replays" sh -c '"$1" replay lesson.trace | grep -q "^identical bit for bit"' sh "$gearshift"
"$gearshift" replay lesson.trace --shifts >shifts.txt
check "it lists as many shifts as the lesson had" \
  test "$(grep -c ' -> ' shifts.txt)" -eq "$(grep -oE '^[0-9]+ shifts?' lesson.txt | grep -oE '[0-9]+')"
check "numbered, with gears" grep -Eq "^ +2 .* [1-5] -> [1-5] " shifts.txt
check "a drive without a car has none" sh -c '"$1" replay paper/tour.trace --shifts | grep -q "no shifts to list"' sh "$gearshift"

# Flips one bit in the middle of the file.
flip_a_bit() {
  local size byte
  size=$(stat -c %s "$1")
  byte=$(od -An -tu1 -j $((size / 2)) -N 1 "$1" | tr -d ' ')
  printf "$(printf '\\x%02x' $((byte ^ 1)))" | dd of="$1" bs=1 seek=$((size / 2)) conv=notrunc status=none
}
flip_a_bit paper/tour.trace
"$gearshift" replay paper/tour.trace >/dev/null 2>err
check "a flipped bit is noticed" [ $? -eq 1 ]
check "and reported in one sentence" [ "$(wc -l <err)" -eq 1 ]

finish
