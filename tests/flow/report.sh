#!/usr/bin/env bash
# Tests the saved data of learners as an instructor uses them: table, page, CSV, comment, next lesson, deletion.
# Usage: report.sh GEARSHIFT SOURCE_FOLDER FILL_HISTORY
set -u
gearshift=$1
fill=$3
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
export XDG_DATA_HOME=$work/data

report() { # arguments ...
  "$gearshift" report "$@" >out 2>err </dev/null
}
says() { grep -qF -- "$1" out; }
refuse() { # takes the expected exit code, a part of the error message, and the arguments of the program
  local code=$1 part=$2
  shift 2
  "$gearshift" report "$@" >out 2>err </dev/null
  local got=$?
  check "report $*: exit $got (wanted $code), wanted one line with \"$part\", got: $(cat err out)" \
    test $got -eq "$code" -a "$(wc -l <err)" -eq 1 -a ! -s out -a -n "$(grep -F -- "$part" err)"
}

ada="Ada <i>Löwe</i>"
check "no history yet: reported, and none is created" report
check "the list says that there is none" says "No lesson has been driven yet."
check "nothing was made" test ! -e data
refuse 1 "history not found" --learner Ada
refuse 1 "nowhere.db" --database nowhere.db

check "a drive is recorded" "$gearshift" tour --out tour
mkdir -p data/gearshift
cp tour/tour.trace data/gearshift/near.trace
check "a history" "$fill" data/gearshift/history.db near.trace

check "learners are listed" report
check "with runs and next lesson" grep -Eq "^Ada <i>Löwe</i> +1 +12 +20[0-9-]+ +start_and_stop$" out
check "and a learner who has not driven" grep -Eq "^Bob +0 +0 +- " out
report --learner "$ada"
check "a learner's runs" test "$(grep -c up_through_the_gears out)" -eq 12

check "a comment is accepted" report --learner "$ada" --comment 3 'Calmer, "much" <calmer>' --by "Bo & Di"
check "the next lesson is set" report --learner "$ada" --next hill_start
report
check "and is listed" says "hill_start (chosen by the instructor)"

json() { python3 -c "import json; d = json.load(open('out')); assert $1, d"; }
report --json
check "JSON of all learners" json "[l['runs'] for l in d['learners']] == [12, 0] and d['learners'][0]['next']['by_instructor']"
report --learner "$ada" --json
check "JSON of a learner's runs" json "len(d['runs']) == 12 and sum(len(r['shifts']) for r in d['runs']) == 36"
check "with comments" json "d['runs'][2]['comments'][0]['author'] == 'Bo & Di' and d['learner'] == '$ada'"
refuse 2 "--json" --json --out page

check "the page and tables" report --learner "$ada" --out "a folder/ä" --csv
page="a folder/ä/index.html"
check "what was written is reported" says "$page"
check "the page is complete" grep -q "</html>" "$page"
check "the name is text" grep -qF "<h1>Ada &lt;i&gt;Löwe&lt;/i&gt;</h1>" "$page"
check "the comment is shown with the grade" grep -qF "Calmer, &quot;much&quot; &lt;calmer&gt;" "$page"
check "the next lesson" grep -qF "Next lesson: <strong>Hill start</strong>, chosen by the instructor." "$page"
check "a curve was fitted" grep -q "The typical grade rose from 2\.9 to 8\.9 in 12 runs and stays near 9\.0" "$page"
check "force and path of recorded shifts" test "$(grep -c 'class="path"' "$page")" -eq 6
check "nothing runs and nothing is fetched" test "$(grep -cE '<script|src=|https?://[^w]' "$page")" -eq 0
check "the tables have 12 runs, 36 shifts, 12 driving errors" \
  test "$(cat "a folder/ä/"{runs,shifts,errors}.csv | grep -c $'\r$')" -eq $((13 + 37 + 13))
check "a comment in the table is quoted" grep -qF '""much"" <calmer>' "a folder/ä/runs.csv"
mark=$(printf '\357\273\277')
check "a spreadsheet sees that the tables are UTF-8" test "$(head -c 3 "a folder/ä/runs.csv")" = "$mark"
check "tables for a spreadsheet with decimal commas" report --learner "$ada" --out comma --csv --separator semicolon
check "with semicolons" test "$(head -n 1 comma/runs.csv | head -c 23)" = "${mark}run;session;learner;"
check "and decimal commas" grep -q ";60;[0-9],[05];" comma/runs.csv
check "or points" report --learner "$ada" --out comma --csv --separator semicolon --decimal point
check "as in Switzerland" grep -q ";60;[0-9].[05];" comma/runs.csv
check "or tabs" report --learner "$ada" --out comma --csv --separator tab
check "and points" grep -qP "\t60\t[0-9]\.5\t" comma/runs.csv

check "the class" report --out class --csv
check "has a page" grep -q "</html>" class/index.html
check "with each learner" grep -q 'href="#learner-2">Bob</a>' class/index.html
check "with a sentence on a task" grep -q "Passed 10 times, but not yet again on another day" class/index.html
check "and a table, got: $(wc -l <class/standings.csv)" grep -q "^Bob,start_stop,not tried,," class/standings.csv

decomposed="Ada <i>Lo\xcc\x88we</i>"
check "another form of the name" report --learner "$(printf "%b" "$decomposed")"
check "is the same learner" test "$(grep -c up_through_the_gears out)" -eq 12
check "in any case" report --learner "ada <i>löwe</i>"
check "a learner is renamed" report --learner Bob --rename "Bob  Li"
check "and that is reported" says "Bob is now called Bob Li"
refuse 1 "Ada <i>Löwe</i> is another learner; add something that tells them apart" --learner "Bob Li" --rename "$ada"
refuse 2 "--rename: a learner's name must not contain control characters" --learner "Bob Li" --rename $'a\nb'
check "and back" report --learner "bob li" --rename Bob
cp "$page" first.html
report --learner "$ada" --out "a folder/ä"
check "the same history, the same page" cmp -s first.html "$page"
check "an empty value restores the suggestion" report --learner "$ada" --next ""
report
check "the suggested lesson is listed again" grep -Eq "start_and_stop$" out

refuse 1 "known learners: Ada <i>Löwe</i>, Bob" --learner Eve
refuse 1 "who has these runs: 1, 2, 3" --learner "$ada" --comment 99 text --by Bo
refuse 1 "who has these runs: none" --learner Bob --comment 1 text --by Bo
refuse 2 "--by" --learner "$ada" --comment 1 text
refuse 2 "--comment" --learner "$ada" --by Bo
refuse 2 "--comment" --learner "$ada" --comment one text --by Bo
refuse 1 "; the shipped lessons are start_and_stop, " --learner "$ada" --next flying
refuse 1 "; the shipped lessons are " --learner "$ada" --next "$2/assets/lessons/reverse.toml"
cp data/gearshift/history.db a\ folder/runs.csv
refuse 2 "different files" --database "a folder/runs.csv" --learner "$ada" --out "a folder/../a folder" --csv
check "no report over its history" cmp -s data/gearshift/history.db "a folder/runs.csv"
rm "a folder/runs.csv"
mkdir folder.db
refuse 1 "this is a folder" --database folder.db
refuse 2 "--csv" --separator tab
refuse 2 "--separator" --out t --csv --separator pipe
refuse 2 "--learner: must not be empty" --learner "" --delete --yes
refuse 2 "--out: must not be empty" --learner "$ada" --out ""
refuse 2 "--comment" --learner "$ada" --comment 1 "" --by Bo
refuse 2 "--by: an instructor's name must not be empty" --learner "$ada" --comment 1 text --by ""
refuse 2 "--out" --learner "$ada" --csv
refuse 2 "--delete" --learner "$ada" --yes
refuse 2 "--delete" --learner "$ada" --delete --out t
refuse 1 "/proc" --learner "$ada" --out /proc/nowhere
head -c 4096 /dev/urandom >noise.db
cp noise.db noise.before
refuse 1 "the file is not a gearshift history; nothing was changed" --database noise.db
check "and the file is unchanged" cmp -s noise.db noise.before

# For a deletion the user must type the learner's name again. A different name or no name is rejected.
deletes() { # takes the name that the user types
  printf '%s\n' "$1" | "$gearshift" report --learner "$ada" --delete >out 2>err
}
check "a different name deletes nothing" test "$(deletes Bob; echo $?)" -eq 1
# The message must be on a line of its own, not after the prompt.
refusal_on_own_line() { [ "$(tail -n 1 err)" = "gearshift: $ada was not deleted: $1" ]; }
check "and it reports it, got: $(tail -n 1 err)" refusal_on_own_line "the name does not match"
check "nor does an empty name" test "$(report --learner "$ada" --delete; echo $?)" -eq 1
report --learner "$ada" --delete
check "and it reports it, got: $(tail -n 1 err)" refusal_on_own_line "no answer given"
report --learner "$ada"
check "all runs are there" test "$(grep -c up_through_the_gears out)" -eq 12
check "the name deletes" deletes "$ada"
check "and the deleted files are listed" says "1 session, 12 runs, 36 shifts, 12 driving errors, 1 comment, 1 recording"
check "the recording is deleted" test ! -e data/gearshift/near.trace
check "no byte of the name is left" test "$(cat data/gearshift/* | grep -ac Löwe)" -eq 0
report
check "the other learner is still there" says Bob

# While a second program reads, the database's log still contains the deleted rows. This must be reported, and a second
# deletion must remove the rows.
python3 -c '
import sqlite3, time
reader = sqlite3.connect("data/gearshift/history.db", isolation_level=None)
reader.execute("BEGIN")
reader.execute("SELECT count(*) FROM learner").fetchone()
print("reads", flush=True)
time.sleep(60)' >reads.out &
reader=$!
until grep -qs reads reads.out; do sleep 0.05; done
report --learner Bob --delete --yes
check "--yes while a second program reads: exit 1" test $? -eq 1
check "the deleted files are listed" says "deleted Bob: 0 sessions"
check "and those not deleted, got: $(cat err)" test "$(wc -l <err)" -eq 1 -a -n "$(grep -F "not yet erased from the file" err)"
kill $reader
wait $reader 2>/dev/null
check "the second deletion succeeds" report --learner Bob --delete --yes
check "and reports it" says "an earlier, incomplete deletion is now finished"
check "no byte of the name is left" test "$(cat data/gearshift/history.db* | grep -ac Bob)" -eq 0
refuse 1 "no learner named \"Bob\"" --learner Bob --delete --yes

finish
