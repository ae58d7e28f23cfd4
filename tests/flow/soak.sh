#!/usr/bin/env bash
# Soak test. Drives lessons with the simulated driver: for hours in real time, in a window that is hidden except for a
# few seconds per minute; or for a simulated week without a window. Records memory, open files, threads and the loop's
# missed deadlines in a table. Growth is the slope per hour in the second half of the table, minus twice its standard
# error; it must not exceed a bound.
# Usage: soak.sh GEARSHIFT SOURCE_FOLDER HOURS|week [CSV [HOURS_OF_WEEK]]
# Run it by hand; ./test --full runs a shorter version.
set -u
gearshift=$(realpath "$1") sources=$(realpath "$2") hours=$3 csv=$(realpath -m "${4:-soak.csv}") week=${5:-168}
flows=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
[ "$hours" = week ] || life=$(awk "BEGIN {print int(3600 * $hours) + 300}")
source "$flows/checks.sh"
# The address sanitizer would keep freed memory until there are 256 MB of it, which looks like growth.
export ASAN_OPTIONS=${ASAN_OPTIONS:+$ASAN_OPTIONS:}quarantine_size_mb=1:thread_local_quarantine_size_kb=64
echo "what,seconds,rss_kb,files,threads,lessons,missed,too_long" >"$csv"

sample() { # appends a row; takes name, process, driven seconds, lessons, missed deadlines, cycles that took too long
  local of=/proc/$2 rss threads files
  rss=$(sed -n 's/^VmRSS:[^0-9]*\([0-9]*\).*/\1/p' "$of/status" 2>/dev/null)
  threads=$(sed -n 's/^Threads:[^0-9]*//p' "$of/status" 2>/dev/null)
  files=$(ls "$of/fd" 2>/dev/null | wc -l)
  [ -z "$rss" ] || [ -z "$threads" ] || echo "$1,$3,$rss,$files,$threads,$4,$5,$6" >>"$csv"
}

# Checks only the second half of each process's rows, because memory use always rises at first. The bound is 1 MB per
# hour (24 MB per day). Saving a learner's lessons grows the memory by less. A run without a window is faster than real
# time, so sixty lessons count as one hour, the time that a learner would need. Such a run may also keep the memory of
# one finished loop's channels (3.4 MB). That is a single step, but in a short run it looks like a slope.
check_growth() { # takes the largest allowed single step of memory [kB]
  python3 - "$csv" "$1" <<'END_OF_PYTHON'
import collections, csv, sys
bound = {"rss_kb": 1000.0, "files": 0.5, "threads": 0.5}  # per hour
rows = collections.defaultdict(list)
for row in csv.DictReader(open(sys.argv[1])):
    rows[row["what"]].append(row)

def hours(row):
    return float(row["seconds"]) / 3600 if row["what"] == "window" else float(row["lessons"]) / 60

def slope(half, column):  # returns the slope per hour, and its standard error
    x = [hours(row) for row in half]
    y = [float(row[column]) for row in half]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    spread = sum((a - mx) ** 2 for a in x)
    k = sum((a - mx) * (b - my) for a, b in zip(x, y)) / spread
    rest = sum((b - my - k * (a - mx)) ** 2 for a, b in zip(x, y))
    return k, (rest / (len(x) - 2) / spread) ** 0.5

grown = False
for what, all_rows in rows.items():
    half = all_rows[len(all_rows) // 2:]
    if len({row["seconds"] for row in half}) < 4:
        sys.exit(f"{what}: {len(all_rows)} samples are too few to judge")
    words = []
    for column, limit in bound.items():
        k, error = slope(half, column)
        is_step = column == "rss_kb" and int(half[-1][column]) - int(half[0][column]) <= int(sys.argv[2])
        grown = grown or (k - 2 * error > limit and not is_step)
        words.append(f"{column} {half[0][column]} to {half[-1][column]}, {k:+.1f} +- {error:.1f} an hour (bound {limit:g})")
    last = all_rows[-1]
    print(f"{what}, {last['seconds']} s, {last['lessons']} lessons: " + "; ".join(words))
sys.exit(grown)
END_OF_PYTHON
}

loop_sum() {
  sed -n "s/^loop: \([0-9]*\) deadlines missed, \([0-9]*\) cycles.*/\\$1/p" soak.txt | awk '{sum += $1} END {print sum + 0}'
}
elapsed() { awk -v from="$began" -v to="$EPOCHREALTIME" 'BEGIN {printf "%.1f", to - from}'; } # [s]
over() { grep -c ' is over: ' soak.txt; }
drives() { [[ "$(grep "  lesson .* \(begins\|is over\|is ready to start\)" soak.txt | tail -n 1)" == *begins ]]; }
# Presses Enter twice: after a lesson, the first Enter offers the next lesson, and the second begins it.
show_for_a_moment() {
  xdotool windowmap "$window" windowfocus "$window"
  sleep 1
  for _ in 1 2; do
    drives || xdotool key Return
    sleep 1
  done
  xdotool windowunmap "$window"
}
soak_in_window() {
  source "$flows/window.sh"
  unset GEARSHIFT_VALIDATION # the validation layer's own memory would count as the trainer's
  local end=$((SECONDS + life - 300)) period=60 process
  [ "$life" -gt 900 ] || period=5
  check "it starts" start soak --hand "by itself" --lesson up_through_the_gears --no-help --silent
  process=$(pgrep -P "$trainer" -x gearshift)
  began=$EPOCHREALTIME
  while alive && [ $SECONDS -lt $end ]; do
    show_for_a_moment
    sleep $((period - 3))
    sample window "$process" "$(elapsed)" "$(over)" "$(loop_sum 1)" "$(loop_sum 2)"
  done
  check "the trainer is alive at the end" alive
  xdotool windowmap "$window" windowfocus "$window"
  check "the End key ends it" ended_by End
  check "nothing on stderr, got: $(head -n 3 soak.err)" [ ! -s soak.err ]
  check "lessons were driven" [ "$(over)" -ge 1 ]
  check "no cycle was left unread" bash -c '! grep "^loop: " soak.txt | grep -qv ", 0 cycles unread"'
  echo "$(over) lessons, $(loop_sum 1) deadlines missed, $(loop_sum 2) cycles too long"
}

driven_seconds() { # prints the simulated seconds that the process has driven so far
  awk 'match($0, / in [0-9.]+ s\. /) {split(substr($0, RSTART + 4), word, " "); sum += word[1]}
       END {printf "%.0f", sum}' week.txt
}
# Drives a lesson for some simulated time, again and again in a single process. The output of the last drive must equal
# that of a fresh process, word for word, which shows that no error has accumulated. The mode is fixed, because a pass
# would change it, and with it the norms.
drive_fraction() { # takes the lesson's name, and the time [s]
  local lesson=$1 lesson_seconds=$2 mode="--mode by-yourself" seconds runs program
  "$gearshift" lesson "$lesson" $mode >first.txt
  seconds=$(sed -n 's/.* in \([0-9]*\)\.[0-9] s\. .*/\1/p' first.txt | tail -n 1)
  runs=$((lesson_seconds / seconds + 1))
  stdbuf -oL "$gearshift" lesson "$lesson" $mode --runs $runs --seed 1 >week.txt & # line-buffered, for the progress
  program=$!
  while kill -0 $program 2>/dev/null; do
    sample "$lesson" $program "$(driven_seconds)" "$(grep -c ' in .* s\. ' week.txt)" 0 0
    sleep "$pause"
  done
  wait $program
  simulated=$((simulated + $(driven_seconds)))
  driven=$((driven + runs))
  "$gearshift" lesson "$lesson" $mode --seed $runs | tail -n +2 >fresh.txt
  check "$lesson: drive $runs equals that of a fresh process" \
    cmp -s <(tail -n "$(wc -l <fresh.txt)" week.txt) fresh.txt
}
soak_headless() {
  local lessons=("$sources"/assets/lessons/*.toml) lesson simulated=0 driven=0 pause=2
  [ "$week" -gt 24 ] || pause=0.2
  began=$EPOCHREALTIME
  for lesson in "${lessons[@]}"; do
    drive_fraction "$(basename "$lesson" .toml)" $((week * 3600 / ${#lessons[@]}))
  done
  echo "$driven lessons, $((simulated / 3600)) h simulated in $(elapsed) s"
}

if [ "$hours" = week ]; then
  soak_headless
  check "memory, files and threads do not grow" check_growth 5000
else
  soak_in_window
  check "memory, files and threads do not grow" check_growth 0
fi
finish
