#!/usr/bin/env bash
# Tests that the lessons of a simulated driver are saved: a passed lesson is in the report, and its recording replays; a
# program that is killed at 20 moments (with --full: 50) loses no shift that it reported; several programs can share a
# history; an unusable history causes one message, and the lesson is driven anyway.
# Usage: lesson.sh GEARSHIFT SOURCE_FOLDER
set -u
gearshift=$1
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
export XDG_DATA_HOME=$work/data

learn() { # takes the name for the output and the arguments; drives a lesson and returns its exit code
  local name=$1
  shift
  "$gearshift" lesson "$@" >"$name.txt" 2>"$name.err" </dev/null
}
report() { "$gearshift" report "$@" >report.txt 2>report.err </dev/null; }
is_sound() { # database
  [ "$(python3 -c '
import sqlite3, sys
print(sqlite3.connect(sys.argv[1]).execute("PRAGMA quick_check").fetchone()[0])' "$1")" = ok ]
}
rows() { tail -n +2 "$1" | wc -l; } # table
exits() { # takes an exit code and a command
  local code=$1
  shift
  "$@"
  [ $? -eq "$code" ]
}
refuse() { # takes a part of the error message, and the arguments
  local part=$1
  shift
  exits 2 learn refused "$@" && [ "$(wc -l <refused.err)" -eq 1 ] && grep -qF -- "$part" refused.err
}

# A passed lesson is in the report, and its recording contains the drive.
check "without a name nothing is saved" learn nobody hill_start
check "and no folder is made" test ! -e data
check "a lesson is passed" learn kim hill_start --learner Kim --verbose
check "and its grade is printed" grep -q '^Run 1: .*Grade [0-9.]*/10. Passed.$' kim.txt
check "each shift was reported, numbered from 1" grep -q '^  run 1, shift 1 saved: ' kim.txt
check "and there is no shift 0" exits 1 grep -q 'shift 0' kim.txt
check "nothing on stderr" test ! -s kim.err
check "the report is written" report --learner Kim --out page --csv
check "it contains the lesson" grep -q "hill_start" page/runs.csv
check "the reported shifts are in the table, number by number" \
  test "$(sed -n 's/^  run \([0-9]*\), shift \([0-9]*\) saved: .*/\1,\2/p' kim.txt)" = \
  "$(tail -n +2 page/shifts.csv | cut -d, -f1,2)"
bit_for_bit() { "$gearshift" replay "$1" 2>&1 | grep -q "^identical bit for bit"; }
check "the recording replays" bit_for_bit "$(ls data/gearshift/recordings/*.trace)"
check "a lesson is failed" exits 1 learn kim hill_start --learner Kim --fault rollback
check "there are deductions" grep -q "  -[0-9.]*  The car rolled back" kim.txt
check "a guided lesson is not passed" exits 1 learn guided hill_start --guidance 1 --fault rollback
check "there is no grade" exits 1 grep -q "Grade" guided.txt
check "and no deductions" exits 1 grep -q "  -[0-9]" guided.txt
learn kim skip_shifts --learner Kim --runs 4 --guided
check "the last of four runs decides the exit code" exits $? grep -q 'Passed\.$' <(grep '^Run ' kim.txt | tail -n 1)
report --learner Kim --out page --csv
check "shifts are drawn from the recordings" grep -q 'class="path"' page/index.html
check "all of them are saved" test "$(rows page/runs.csv)" -eq 6
check "the four guided or unguided runs are in the table" test "$(grep -c ',skip_shifts,' page/runs.csv)" -eq 4
check "a mode can be chosen" learn kim skip_shifts --learner Kim --mode by-yourself
for trace in data/gearshift/recordings/*; do check "$trace replays" bit_for_bit "$trace"; done
rm -rf data/gearshift/recordings
echo >data/gearshift/recordings
check "no folder for recordings: the lesson is driven" learn nowhere hill_start --learner Kim
check "and that is reported" test "$(wc -l <nowhere.err)" -eq 1
rm data/gearshift/recordings

sed 's/^title/speed_unit = "mph"\n&/' "$2/assets/cars/hatchback.toml" >miles.toml
check "a car in miles per hour" exits 1 learn miles rev_matching --car ./miles.toml --fault late_shift
check "the goal and the error are in its unit" grep -q "from third to second at 22 mph" miles.txt
check "and nothing else" exits 1 grep -q "km/h" miles.txt

# One JSON document, with what the text says.
json() { python3 -c "import json; d = json.load(open('json.txt')); runs = d['runs']; run = runs[-1]; assert $1, run"; }
check "JSON" learn json skip_shifts --json
check "has grade and verdict" json "run['verdict'] == 'passed' and run['grade'] >= 6 and d['car'] == 'hatchback'"
check "figures with norms" json "len(run['figures']) == 8 and all(f['norm']['up_to'] > f['norm']['typical'] for f in run['figures'])"
check "and the help of each limb" json "run['lever_help'] == run['pedal_help'] == 0"
check "a failed lesson exits with 1" exits 1 learn json hill_start --fault rollback --json --runs 2
check "its error has severity, time, value and unit" json "len(runs) == 2 and any(e['kind'] == 'rollback' and
  e['severity'] == 'severe' and e['time_s'] > 0 and e['value'] > 0.1 and e['unit'] == 'm' for e in run['errors'])"
learn json up_through_the_gears --learner Dump --database dump.db --runs 6 --guided --fault clutch_dump --json
check "who dumps the clutch gets help with the pedals, not with the lever" json "all(r['lever_help'] == 0 for r in runs) and \
  max(r['pedal_help'] for r in runs) > 0.3"
learn json up_through_the_gears --learner Push --database push.db --runs 6 --guided --fault wrong_column --json
check "who strays into wrong slots gets help with the lever, not with the pedals" json "all(r['pedal_help'] == 0 for r in runs) and \
  max(r['lever_help'] for r in runs) > 0.05"
check "a guided lesson has no grade" exits 1 learn json hill_start --guidance 0.5 --json
check "and says by how much it was guided" json "run['verdict'] == 'not graded' and 'grade' not in run and run['lever_help'] == 0.5 and run['pedal_help'] == 0"

check "an empty name" refuse "a learner's name must not be empty" hill_start --learner ""
check "a name of two lines" refuse "control characters" hill_start --learner $'a\nb'
check "an invalid number of runs" refuse "--runs" hill_start --runs 0
check "a trace for many runs" refuse "--trace" hill_start --runs 2 --trace t
check "two kinds of guidance" refuse "--guid" hill_start --guided --guidance 1
check "a database without a learner" refuse "--database" hill_start --database t.db
check "an invalid mode" refuse "--mode" hill_start --mode both

# Kills the program at 20 or 50 moments, always with the same database.
kills=20
is_full_run && kills=50
reported_shifts() { # prints the shifts that the program reported, each as RUN,SHIFT
  sed -n 's/^  run \([0-9]*\), shift \([0-9]*\) saved: .*/\1,\2/p' "$@"
}
RANDOM=5
: >all_reported
lost=0 unusable=0
for round in $(seq $kills); do
  : >killed.txt
  "$gearshift" lesson skip_shifts --runs 200 --learner K --database kill/h.db --verbose --seed "$round" \
    >>killed.txt 2>killed.err &
  program=$!
  # In every second round, the kill waits until the program has reported something, however slow the machine is.
  [ $((round % 2)) -eq 0 ] || timeout 20 sh -c 'until [ -s killed.txt ]; do sleep 0.005; done'
  sleep "0.$(printf %03d $((RANDOM % 281 + 20)))"
  kill -9 $program
  wait $program 2>/dev/null
  reported_shifts killed.txt >>all_reported
  [ -s killed.err ] && cat killed.err
  [ -e kill/h.db ] || continue
  # skip the round if the kill came before the program added learner K
  if [ ! -s all_reported ] && ! report --learner K --database kill/h.db; then continue; fi
  report --learner K --database kill/h.db --out killed --csv || unusable=$((unusable + 1))
  # Checks the database completely only in every tenth round, because the report above already reads it in every round.
  [ $((round % 10)) -ne 0 ] || is_sound kill/h.db || unusable=$((unusable + 1))
  cut -d, -f1,2 killed/shifts.csv | sort >there
  lost=$((lost + $(sort all_reported | comm -23 - there | wc -l)))
  rm -rf kill/recordings
done
check "after every kill the report works and the database is sound" test $unusable -eq 0
check "no reported shift is lost" test $lost -eq 0
check "shifts were reported" test "$(wc -l <all_reported)" -ge $((kills / 2))
check "many kills hit a lesson" \
  test "$(python3 -c '
import sqlite3
print(sqlite3.connect("kill/h.db").execute("SELECT count(*) FROM lesson_run WHERE ended = 0").fetchone()[0])')" -gt $((kills * 2 / 5))
check "after the kills a lesson is driven to its end" learn after skip_shifts --learner K --database kill/h.db

# A program stopped by a signal, during a lesson or between two lessons: no run stays open, and each recording is
# complete.
stopped() { # takes a signal; sends it during a lesson; uses env, because background children ignore SIGINT
  rm -f stopped.txt
  env --default-signal=INT "$gearshift" lesson up_through_the_gears --runs 5000 --learner S --database stop/h.db \
    --verbose >stopped.txt 2>stopped.err </dev/null &
  timeout 20 sh -c 'until grep -qs "shift 2" stopped.txt; do sleep 0.005; done'
  kill -"$1" $!
  wait $!
}
newest_recording() { # prints the newest recording, or "a run is open" if a run has not ended
  python3 -c '
import sqlite3, sys
rows = sqlite3.connect(sys.argv[1]).execute("SELECT ended, recording FROM lesson_run ORDER BY id").fetchall()
print("stop/" + rows[-1][1] if all(row[0] for row in rows) else "a run is open")' stop/h.db
}
for signal in INT TERM HUP; do
  check "$signal: exit 1" exits 1 stopped $signal
  check "$signal: one sentence, got: $(cat stopped.err)" test "$(wc -l <stopped.err)" -eq 1
  check "$signal: which names the run" grep -q "^gearshift: interrupted \(during\|before\) run [0-9]* of 5000$" stopped.err
  check "$signal: the newest recording replays, got: $(newest_recording)" bit_for_bit "$(newest_recording)"
  grep -h "You left the lesson" stopped.txt >>told_left
done
report --learner S --database stop/h.db --out stop --csv
check "an interrupted lesson counts as left" test "$(grep -c ',left,' stop/runs.csv)" -eq "$(wc -l <told_left)"
check "with as many recordings as runs" test "$(ls stop/recordings | wc -l)" -eq "$(rows stop/runs.csv)"

# Three programs at once on a database that does not exist yet; two of them have the same learner.
learn one skip_shifts --runs 12 --learner Ada --database both/h.db &
one=$!
learn two skip_shifts --runs 12 --learner Bob --database both/h.db --seed 100 &
two=$!
learn three skip_shifts --runs 12 --learner Bob --database both/h.db --seed 200
check "the third, which shares a learner, succeeds" test $? -eq 0
check "the first succeeds" wait $one
check "the second succeeds" wait $two
check "nothing on stderr" test ! -s one.err -a ! -s two.err -a ! -s three.err
for learner in "Ada 12" "Bob 24"; do
  set -- $learner
  report --learner "$1" --database both/h.db --out both --csv
  check "all runs of $1" test "$(rows both/runs.csv)" -eq "$2"
  check "all shifts of $1" test "$(rows both/shifts.csv)" -eq $((2 * $2))
done
check "each run has its own recording" test "$(ls both/recordings | wc -l)" -eq 36
check "and the newest replays" bit_for_bit "$(ls both/recordings/*.trace | tail -n 1)"

# An unusable history: one message, the lesson's normal exit code, and the file stays unchanged.
cp data/gearshift/history.db good.db
spoilt() { # takes the description, a part of the error message, and the file
  cp "$3" before.db
  check "$1: passed" learn spoilt hill_start --runs 2 --learner Kim --database "$3"
  check "$1: one sentence, got: $(cat spoilt.err)" test "$(wc -l <spoilt.err)" -eq 1
  check "$1: the reason is named" grep -qF -- "$2" spoilt.err
  check "$1: not passed" exits 1 learn spoilt hill_start --learner Kim --database "$3" --fault rollback
  check "$1: one sentence again" test "$(wc -l <spoilt.err)" -eq 1
  check "$1: unchanged" cmp -s "$3" before.db
}
set_byte() { printf "$3" | dd of="$1" bs=1 seek="$2" conv=notrunc 2>/dev/null; }
mkdir spoilt
head -c 10000 good.db >spoilt/half.db
spoilt "damaged" "the file is damaged; nothing was changed" spoilt/half.db
echo "learner,grade" >spoilt/text.db
spoilt "no history" "the file is not a gearshift history" spoilt/text.db
cp good.db spoilt/newer.db
set_byte spoilt/newer.db 63 '\377' # the last byte of the user version: sqlite.org/fileformat2.html, 1.3
spoilt "newer" "the file was written by a newer version of gearshift" spoilt/newer.db
check "no other files were made there" test "$(ls spoilt | wc -l)" -eq 3

# A user without write permission. Root could write anyway, so root drops that right. (Running as the user "nobody"
# would not work, because that user may not enter a source tree in root's home.)
mkdir read_only
cp good.db read_only/h.db
chmod 755 "$work"
chmod 555 read_only
chmod 444 read_only/h.db
as_others=()
overrides=-dac_override,-dac_read_search
[ "$(id -u)" -eq 0 ] && as_others=(setpriv --bounding-set=$overrides --inh-caps=$overrides)
check "read-only: passed" bash -c '"$@" >ro.txt 2>ro.err' - "${as_others[@]}" \
  "$gearshift" lesson hill_start --runs 2 --learner Kim --database read_only/h.db
check "read-only: one sentence, got: $(cat ro.err)" test "$(wc -l <ro.err)" -eq 1
check "read-only: the reason is named" grep -q "you have no permission to write to the file\|the file is read-only\|the file cannot be opened" ro.err
check "read-only: unchanged" cmp -s read_only/h.db good.db
chmod 755 read_only

# A full disk: a small mounted file system where mounts are allowed, otherwise a limit on the file size.
cat >on_full_disk.sh <<'END'
mkdir full
if mount -t tmpfs -o size=1m none full 2>/dev/null; then
  cp good.db full/h.db
  dd if=/dev/zero of=full/filler bs=4k 2>/dev/null
else
  cp good.db full/h.db
  ulimit -f 8
fi
"$1" lesson hill_start --runs 3 --learner Kim --database full/h.db >full.txt 2>full.err
code=$?
cmp -s full/h.db good.db || code=9
umount full 2>/dev/null # needed only if root mounted it without a namespace
exit $code
END
if unshare -rm true 2>/dev/null; then
  check "full: passed, and the file is unchanged" unshare -rm bash on_full_disk.sh "$gearshift"
else
  check "full: passed, and the file is unchanged" bash on_full_disk.sh "$gearshift"
fi
reports_losses() { # stderr has one message at once, and a summary of the losses at the end
  [ "$(wc -l <full.err)" -eq 2 ] && head -n 1 full.err | grep -q "the disk is full" &&
    tail -n 1 full.err | grep -q "not saved: 3 runs"
}
check "full: reported with the losses, got: $(cat full.err)" reports_losses
check "full: three lessons" test "$(grep -c 'Passed\.$' full.txt)" -eq 3
rm -rf full
check "file size limit: passed, and the file is unchanged" \
  bash -c 'mount() { return 1; }; source on_full_disk.sh' - "$gearshift"
check "file size limit: reported with the losses, got: $(cat full.err)" reports_losses

# The recording itself fills the disk: no file that the history refers to may be removed.
cat >on_small_disk.sh <<'END'
mkdir small && mount -t tmpfs -o size=300k none small || exit 9
"$1" lesson moving_off --learner Kim --database small/h.db >small.txt 2>small.err
code=$?
python3 -c '
import os, sqlite3, sys
rows = sqlite3.connect("small/h.db").execute("SELECT recording FROM lesson_run WHERE recording != ?", ("",)).fetchall()
sys.exit(0 if all(os.path.exists(os.path.join("small", row[0])) for row in rows) else 8)' || code=8
exit $code
END
if unshare -rm true 2>/dev/null; then
  check "a small disk: passed, and every recording that the history names exists" unshare -rm bash on_small_disk.sh "$gearshift"
  check "a small disk: reported, and nothing is lost, got: $(cat small.err)" \
    test "$(grep -c 'the recording failed' small.err)" -eq 1 -a "$(grep -c 'lost' small.err)" -eq 0
fi

# The recordings of several runs fill the disk. All rows must be saved, even if recordings are lost.
cat >on_filling_disk.sh <<'END'
mkdir filling && mount -t tmpfs -o size=4m none filling || exit 9
"$1" lesson up_through_the_gears --learner Kim --database filling/h.db --runs 6 >filling.txt 2>filling.err
"$1" report --learner Kim --database filling/h.db --out filling_page --csv >/dev/null || exit 7
dd if=/dev/zero of=filling/filler bs=4k 2>/dev/null
"$1" report --learner Kim --database filling/h.db --delete --yes >filling_gone.txt 2>&1 || exit 6
[ "$(ls filling/recordings | wc -l)" -eq 0 ] || exit 5
END
if unshare -rm true 2>/dev/null; then
  check "a disk that fills: six lessons, and a deletion when it is full" \
    unshare -rm bash on_filling_disk.sh "$gearshift"
  check "a disk that fills: six completed runs, got: $(cat filling.err)" \
    test "$(grep -c ',done,' filling_page/runs.csv)" -eq 6
  check "a disk that fills: with all shifts" test "$(rows filling_page/shifts.csv)" -eq 24
  check "a disk that fills: recordings were deleted with the rows, got: $(cat filling_gone.txt)" \
    grep -q "deleted Kim: 1 session, 6 runs, 24 shifts" filling_gone.txt
fi

# The database is upgraded by a newer program, or removed, while lessons are driven. The program must report this, and
# what it could not save.
learn taken hill_start --learner Kim --database taken/h.db
meanwhile() { # takes a command; starts 40 lesson runs, and runs the command during the third run or later
  "$gearshift" lesson skip_shifts --runs 40 --learner Kim --database taken/h.db --verbose \
    >taken.txt 2>taken.err </dev/null &
  local program=$!
  timeout 60 sh -c 'until grep -q "^  run [3-9], shift" taken.txt; do sleep 0.01; done'
  "$@"
  wait $program
}
set_version() { python3 -c 'import sqlite3; sqlite3.connect("taken/h.db").execute("PRAGMA user_version = 99")'; }
count_runs() { python3 -c '
import sqlite3
print(sqlite3.connect("taken/h.db").execute("SELECT count(*) FROM lesson_run").fetchone()[0])'; }
upgrade_history() {
  set_version
  before=$(count_runs)
}
meanwhile upgrade_history
check "upgraded: no further run is written" test "$(count_runs)" -eq "$before"
check "upgraded: reported with the losses, got: $(cat taken.err)" test "$(wc -l <taken.err)" -eq 2 -a \
  -n "$(grep "a newer version of gearshift has upgraded the file" taken.err)" -a -n "$(grep "not saved: [0-9]* runs" taken.err)"
rm -rf taken
learn taken hill_start --learner Kim --database taken/h.db
meanwhile rm -f taken/h.db taken/h.db-wal taken/h.db-shm
check "removed: reported with the losses, got: $(cat taken.err)" test "$(wc -l <taken.err)" -eq 2 -a \
  -n "$(grep "the file was removed" taken.err)" -a -n "$(grep "not saved: [0-9]* runs" taken.err)"
check "removed: not created again" test ! -e taken/h.db

# Standard output is full, closed, or a pipe without a reader. Everything must be saved, and the exit code must report
# the failure.
undelivered() { # takes a name, the exit code, and a script that drives three runs with "$@"
  local runs="$gearshift lesson skip_shifts --runs 3 --verbose --learner Kim --database $1.db"
  check "$1: exit $2" exits "$2" bash -c "$3" - $runs
  check "$1: the report is written" report --learner Kim --database "$1.db" --out "$1" --csv
  check "$1: it has three completed runs" test "$(grep -c ',done,' "$1/runs.csv")" -eq 3
}
undelivered said_to_full 1 '"$@" >/dev/full 2>undelivered.err'
check "said_to_full: reported, got: $(cat undelivered.err)" grep -q "cannot write to standard output" undelivered.err
undelivered said_to_nobody 1 '{ "$@" 2>undelivered.err; echo $? >undelivered.code; } | head -n 1 >/dev/null; exit "$(cat undelivered.code)"'
check "said_to_nobody: reported, got: $(cat undelivered.err)" grep -q "cannot write to standard output" undelivered.err
undelivered said_to_closed 1 '"$@" >&- 2>undelivered.err'
check "said_to_closed: reported, got: $(cat undelivered.err)" grep -q "cannot write to standard output" undelivered.err
# A file has the name of the recordings folder, so nothing can be recorded. The message about this cannot be printed.
mkdir no_folder && touch no_folder/recordings
for way in '2>/dev/full' '2>&-'; do
  cp good.db no_folder/h.db
  check "output to $way: passed" bash -c "\"\$@\" >undelivered.txt $way" - \
    "$gearshift" lesson hill_start --runs 2 --learner Kim --database no_folder/h.db
  check "output to $way: both runs" test "$(grep -c 'Passed\.$' undelivered.txt)" -eq 2
done
check "closed output: exit 1" exits 1 bash -c '"$@" >&- 2>/dev/null' - \
  "$gearshift" lesson skip_shifts --verbose --trace closed.trace
check "closed output: the trace replays" bit_for_bit closed.trace

# A mistyped file name must never overwrite a history. A recording may be overwritten.
cp good.db theirs.db
check "a history is not overwritten by a recording" exits 2 learn over hill_start --learner Kim --database good.db --trace theirs.db
check "in a sentence, got: $(cat over.err)" \
  test "$(wc -l <over.err)" -eq 1 -a -n "$(grep "theirs.db already exists and is not a recording" over.err)"
check "and it is unchanged" cmp -s good.db theirs.db
check "a recording is overwritten" learn over skip_shifts --trace closed.trace
check "by a recording that replays" bit_for_bit closed.trace

# A history that was moved together with its recordings: the recordings must be found, drawn and deleted at the new
# place.
learn moved skip_shifts --learner Kim --database before/h.db
mv before after_the_move
report --learner Kim --database after_the_move/h.db --out moved
check "moved: drawn" grep -q 'class="path"' moved/index.html
check "moved: deleted" report --learner Kim --database after_the_move/h.db --delete --yes
check "moved: with its recording" test "$(ls after_the_move/recordings | wc -l)" -eq 0

# Names with a special meaning in SQLite are plain file names for gearshift.
for name in :memory: file:name.db?mode=memory; do
  check "$name: passed" learn named hill_start --learner Kim --database "$name"
  check "$name: the file exists" test -s "$name"
  check "$name: Kim is in it" report --learner Kim --database "$name"
done

# Makes a history with one run, and locks it from a second program, whose process ID is $holder.
hold() { # name, duration [s]
  learn "$1" hill_start --learner Kim --database "$1.db"
  python3 -c '
import sqlite3, sys, time
held = sqlite3.connect(sys.argv[1], isolation_level=None)
held.execute("BEGIN IMMEDIATE")
print("held", flush=True)
time.sleep(float(sys.argv[2]))' "$1.db" "$2" >"$1.out" &
  holder=$!
  until grep -qs held "$1.out"; do sleep 0.05; done
}

# A history that is locked for longer than the program waits. The wait is long, so its result is checked at the end.
hold held_on 60
holder_on=$holder
learn held_on hill_start --learner Kim --database held_on.db &
held_on=$!

# A history that is locked for 5 s: longer than the lesson, but shorter than the program waits after the lesson.
hold held 5
check "held by another program: passed" learn held hill_start --learner Kim --database held.db
wait $holder
check "held: reported, and nothing is lost, got: $(cat held.err)" test "$(wc -l <held.err)" -eq 1
report --learner Kim --database held.db --out held --csv
check "held: both runs are there" test "$(rows held/runs.csv)" -eq 2
check "held: and completed" test "$(grep -c running held/runs.csv)" -eq 0
check "held: with their recordings" bit_for_bit "$(ls recordings/*.trace | tail -n 1)"

# The history held_on, which was locked above: the loss must be reported, although the wait was already reported.
check "held on: passed" wait $held_on
kill $holder_on
wait $holder_on 2>/dev/null
check "held on: the wait is reported, then the loss, got: $(cat held_on.err)" test "$(wc -l <held_on.err)" -eq 2 -a \
  -n "$(tail -n 1 held_on.err | grep "not saved: 1 run")"

finish
