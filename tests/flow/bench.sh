#!/usr/bin/env bash
# Tests the bench as a user runs it: its output files, and pages that contain the measurements. If the file of the last
# run is unreadable, the bench must only warn.
# Usage: bench.sh GEARSHIFT SOURCE_FOLDER
set -u
gearshift=$1
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
export XDG_DATA_HOME=$work/data XDG_CACHE_HOME=$work/cache XDG_RUNTIME_DIR=$work/runtime
mkdir -m 700 runtime

is_refused() { ! "$@"; }
bench() { "$gearshift" bench "$@" >out 2>err; }
says() { grep -qF -- "$1" out; }
complains() { grep -qF -- "$1" err; }
is_xml() { python3 -c 'import sys, xml.etree.ElementTree as tree; tree.parse(sys.argv[1])' "$1"; }
in_json() { python3 -c "import json, sys; run = json.load(open('x/bench.json')); sys.exit(not ($1))"; }

check "a quick run of two families" bench --quick --family feel --family plant --out x
check "nothing on stderr" test ! -s err
check "it prints which files it wrote" says x/bench.html
check "feel has no methods, so no plot" test ! -e x/feel.svg
for file in x/bench.html x/plant.svg; do check "$file is well-formed" is_xml $file; done
check "the page contains the plot" grep -q "Runge-Kutta 4</text>" x/bench.html
check "the page describes the machine" grep -q "<th>Processor</th>" x/bench.html
check "CSV: one line per row" test "$(wc -l <x/bench.csv)" -eq 8
check "JSON: one row per line of the CSV" in_json 'len(run["rows"]) == 7 and run["quick"]'
check "JSON: the default is the exact step" \
  in_json '[r["name"] for r in run["rows"] if r.get("trade", {}).get("chosen")] == ["exact at 1 ms", "exact at 10 ms"]'
check "JSON: the rows of the design's table are marked" \
  in_json '{r["design"] for r in run["rows"] if "design" in r} == {"delivered", "plant"}'
check "a quick run is not saved" test ! -e data/gearshift/bench

# The family `methods`: a method whose wall is free of vibration only because it displays too little stiffness is not a
# candidate for the default.
check "a run of the family methods" bench --quick --family methods --out x
check "JSON: only methods that display 97 % of the stiffness are candidates" in_json 'all(
    [b["value"] <= 3 for b in r["beside"] if b["what"] == "error in displayed stiffness"] == [True]
    for r in run["rows"] if "peak-to-peak" in r.get("trade", {}).get("error", {}).get("what", ""))'
check "JSON: the default is one of them" in_json '"1000 Hz, delay 0: half-sample hold, B = 10" in
    [r["name"] for r in run["rows"] if r.get("trade", {}).get("chosen")]'
check "JSON: other methods are listed, but are no candidates" in_json 'any(r["name"].endswith("energy bounding") and "trade" not in r for r in run["rows"])'

# The complete quick run. Its duration is printed but not checked, because the machine may be busy.
quick_seconds() { TIMEFORMAT='bench --quick took %R s, the processors %U + %S s'; time bench --quick --json; }
if is_full_run; then check "a complete quick run" quick_seconds; fi

# If a family cannot be measured, only its own rows have no values.
check "a run without a Vulkan driver fails" is_refused env VK_ICD_FILENAMES=/nonexistent.json \
  "$gearshift" bench --quick --family plant --family picture --family feel --out x >out 2>err
check "it is reported once" test "$(grep -c "^gearshift: cannot measure family picture: " err)" -eq 1 -a \
  "$(wc -l <err)" -eq 1
check "JSON: the other families have values, and this one a reason" in_json \
  '{r["family"] for r in run["rows"] if r["value"] is not None} == {"plant", "feel"} and
   {r.get("design") for r in run["rows"] if r["value"] is None and r["note"]} == {"first_frame", "cabin"}'
check "the page is well-formed" is_xml x/bench.html

check "a full run" bench --family feel
check "there is no earlier run to compare with" test -z "$(grep 'since last' out)"
check "the run is saved" test "$(ls data/gearshift/bench | wc -l)" -eq 1
check "the next run is compared with it" bench --family feel --json
check "and is equal, because it is a simulation" grep -q '"changed": false' out
last=$(ls data/gearshift/bench/*.json)
echo broken >"$last"
check "the run works with an unreadable last run" bench --family feel
check "and prints one sentence" test "$(wc -l <err)" -eq 1
check "which names the file's new place" complains "$last.unreadable"
check "and the new run is saved" test -n "$(grep feel "$last")"

# An output that cannot be written does not affect the other outputs.
check "a full disk for the CSV is a failure" is_refused bench --family feel --csv /dev/full --out full
check "is reported" complains "/dev/full: cannot be written"
check "the page exists anyway" is_xml full/bench.html
check "the table is printed, too" says "feel"
check "the page names the commit" grep -q "gearshift [0-9.]* \([0-9a-f]\{12\}\|unknown\)" full/bench.html
mkdir -p blocked/bench.html
check "a page that cannot be written is a failure" is_refused bench --family feel --out blocked
check "is reported, and the JSON is complete" test -s blocked/bench.json
"$gearshift" bench --family feel --out unread --csv unread.csv >/dev/full 2>err
check "a full standard output is a failure" test $? -eq 1
check "and the page is well-formed" is_xml unread/bench.html
check "and the CSV is complete" test "$(wc -l <unread.csv)" -eq 2

# If the bench ends early, each output file must keep its old content or contain all rows of the completed families.
running() { # takes a signal, seconds, arguments; sends the bench the signal this long after it made its output folder
  local signal=$1 after=$2
  shift 2
  rm -rf begun
  "$gearshift" bench --out begun --csv kept.csv "$@" >out 2>err &
  until [ -d begun ] || ! kill -0 $! 2>/dev/null; do sleep 0.02; done
  sleep "$after"
  kill -"$signal" $!
  wait $! 2>/dev/null
}
as_of_old() { [ "$(cat kept.csv)" = "of old" ] && [ ! -e begun/bench.html ]; }
echo "of old" >kept.csv
running KILL 0 --family cycle
check "a killed bench changes no file" as_of_old
running TERM 0 --family contact
check "stopped in the first family: exit 1" test $? -eq 1
check "and reports it" complains "interrupted while measuring family contact: no family was completed"
check "and changes no file" as_of_old
running TERM 4 --family plant --family contact # after 4 s `plant` is complete, and `contact` still takes minutes
check "stopped in the second family: exit 1" test $? -eq 1
check "and names the family" complains "interrupted while measuring family contact: only completed families are reported"
check "the completed family is saved" test "$(grep -c '^plant,' kept.csv) $(grep -c '^contact,' kept.csv)" = "6 0"
check "the page, too" is_xml begun/bench.html

# In the family `jitter` one measurement takes a minute. A stop request must end it early, and also end the program
# cyclictest. Without real-time priority, which an ordinary user may lack, nothing is measured.
if command -v cyclictest >/dev/null && chrt -f 10 true 2>/dev/null; then
  running TERM 2 --family jitter
  check "a stop ends the wake-up measurements: exit 1" test $? -eq 1
  check "and reports it" complains "interrupted while measuring family jitter: no family was completed"
  check "and leaves no process behind" is_refused pgrep -s 0 cyclictest
fi

# The results must be written under the given name, even if the CSV file is moved or replaced during the run.
meanwhile() { # takes a command; runs the bench, and the command as soon as the bench has opened its CSV file
  echo "of old" >moving.csv
  "$gearshift" bench --family contact --quick --csv moving.csv >out 2>err &
  until compgen -G "moving.csv.part*" >/dev/null || ! kill -0 $! 2>/dev/null; do sleep 0.01; done
  "$@"
  wait $!
}
check "the CSV is moved during the run" meanwhile mv moving.csv moved.csv
check "the moved file is unchanged" test "$(cat moved.csv)" = "of old"
check "the results are written under the original name" grep -q '^contact,' moving.csv
another() { echo other >other.csv && mv other.csv moving.csv; }
check "the CSV is replaced during the run" meanwhile another
check "the results are there" grep -q '^contact,' moving.csv
kept=$(ls data/gearshift/bench/*.json)
cp "$kept" as_kept
check "a CSV over the saved last run is rejected" is_refused bench --family feel --csv "$kept"
check "no table is written" cmp "$kept" as_kept
check "the reason is printed" complains "must be different files"

rm -r data && echo "a file" >data
check "the run works without a place to save it" bench --family feel --csv rows.csv
check "and prints one sentence" test "$(wc -l <err)" -eq 1
check "the results are there" test "$(wc -l <rows.csv)" -eq 2
finish
