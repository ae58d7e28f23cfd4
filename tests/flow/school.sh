#!/usr/bin/env bash
# Two seats and an instructor share a history on a PostgreSQL server, which is killed, stopped, filled and upgraded. What
# a seat has reported as saved is there in the end, on the server and on every seat that knows the learner.
# Usage: school.sh GEARSHIFT SOURCE_FOLDER
set -u
gearshift=$1
tools=$2/tests/support/postgres.sh
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
server=
end_all() {
  [ -z "$server" ] || { ! mountpoint -q "$server/small" || umount -l "$server/small"; "$tools" remove "$server"; }
}
server=$("$tools" new) || exit 1
port=$(<"$server/port")
url() { echo "postgresql://$1@127.0.0.1:$port/postgres"; }
# Passwords are only in this file, as libpq reads it.
export PGPASSFILE=$work/passwords
secret="s3cret:p@ss"
for login in seat1 seat2 seat3; do echo "*:*:*:$login:${secret/:/\\:}-$login"; done >passwords
echo "*:*:*:bo:bo-password" >>passwords
echo "*:*:*:owner:$(<"$server/owner")" >>passwords
chmod 600 passwords
sql() { psql "$(url owner)" -Atqc "$1"; }
for login in seat1 seat2 seat3; do sql "CREATE ROLE $login LOGIN PASSWORD '$secret-$login'"; done
sql "CREATE ROLE bo LOGIN PASSWORD 'bo-password'"

on() { # seat number, verb, arguments ...; the seat's server is in the file beside its history
  local seat=$1
  shift
  XDG_DATA_HOME=$work/seat$seat "$gearshift" "$@" </dev/null
}
lesson() { # seat number, learner, arguments ...
  local seat=$1 learner=$2
  shift 2
  on "$seat" lesson hill_start --learner "$learner" "$@"
}
use_server() { # seat number
  mkdir -p "seat$1/gearshift"
  url "seat$1" >"seat$1/gearshift/history.db-server"
}
told() { cat "$@" | grep -c "^Run [0-9]*: "; }
runs_of() { sql "SELECT count(*) FROM gearshift.lesson_run r JOIN gearshift.session s ON s.id = r.session JOIN
  gearshift.learner l ON l.id = s.learner WHERE l.name = '$1' AND r.ended <> 0"; }
on_seat() { on "$1" report --learner "$2" | grep -c hill_start; } # seat number, learner
is_quiet() { [ ! -s "$1" ] || { cat "$1" && false; }; }

# Without tables, and then with them.
use_server 1
use_server 2
lesson 1 Ada >a.out 2>a.err
check "no school yet: one sentence, got: $(cat a.err)" test "$(grep -c "has no school yet; create it with gearshift school --make" a.err)" -eq 1
check "and what is unsent" grep -q "1 run is not on the server yet, but kept here" a.err
check "the owner makes the school" "$gearshift" school --database "$(url owner)" --make >/dev/null
check "and may do so again" "$gearshift" school --database "$(url owner)" --make >/dev/null
sql "GRANT gearshift_seat TO seat1, seat2, seat3"
sql "GRANT gearshift_instructor TO bo"

# Two seats, one learner and one of each seat's own.
check "seat 1" lesson 1 Ada >>a.out 2>quiet
check "says nothing of the server" is_quiet quiet
check "seat 2" lesson 2 Ada --runs 2 >b.out 2>quiet
check "says nothing of the server" is_quiet quiet
lesson 2 Eve >e.out
lesson 1 Ada >>a.out
check "Ada's runs are on the server: $(told a.out b.out), $(runs_of Ada)" test "$(runs_of Ada)" -eq "$(told a.out b.out)"
check "and on seat 1, with those of seat 2" test "$(on_seat 1 Ada)" -eq 5
check "but Eve is only on seat 2" test "$(on 1 report | grep -c Eve)" -eq 0
on 1 report --learner Ada --out ada --csv >/dev/null
check "the page says where a recording is" grep -q "Recording: [^ ]*:$work/seat2/gearshift/recordings/hill_start" ada/index.html
check "and the table" grep -q ":$work/seat2/gearshift/recordings/hill_start" ada/runs.csv

# The server is killed and restarted in the middle of lessons on both seats.
kills=4
! is_full_run || kills=50
XDG_DATA_HOME=$work/seat1 "$gearshift" lesson hill_start --learner Ada --runs 100000 >>a.out 2>kill1.err </dev/null &
first=$!
XDG_DATA_HOME=$work/seat2 "$gearshift" lesson hill_start --learner Ada --runs 100000 >>b.out 2>kill2.err </dev/null &
second=$!
for ((i = 0; i < kills; ++i)); do
  sleep "0.$((RANDOM % 9))"
  "$tools" kill "$server"
  "$tools" start "$server" || exit 1
done
sleep 1
kill -TERM $first $second
wait $first $second
lesson 1 Ada >>a.out
lesson 2 Ada >>b.out
lesson 1 Ada >>a.out
told=$(told a.out b.out)
check "$kills kills: $told runs were reported as saved, and are on the server: $(runs_of Ada)" test "$(runs_of Ada)" -eq "$told"
check "and on seat 1: $(on_seat 1 Ada)" test "$(on_seat 1 Ada)" -eq "$told"
check "with their shifts" test "$(sql "SELECT count(*) FROM gearshift.lesson_run r WHERE ended = 1 AND NOT EXISTS (SELECT
  FROM gearshift.shift WHERE run = r.id)")" -eq 0
# An outage and its end are one line each.
lines() { grep -cF "$2" "$1"; }
for err in kill1.err kill2.err; do
  check "outages and their ends alternate: $(cat $err)" \
    test "$(lines $err "kept here and sent later")" -le $kills -a $(($(lines $err "kept here and sent later") - $(lines $err "can be used again"))) -le 1
done
echo "$kills kills, $told runs reported, $(runs_of Ada) on the server"

# A week without the server.
"$tools" stop "$server"
lesson 1 Ada --runs 3 >>a.out 2>off.err
check "an outage is reported once, got: $(cat off.err)" test "$(wc -l <off.err)" -eq 2 -a -n "$(grep "results are kept here and sent later" off.err)"
check "with the number of unsent runs" grep -q "3 runs are not on the server yet" off.err
lesson 2 Zoe --runs 2 >z.out 2>/dev/null
"$tools" start "$server"
lesson 1 Ada >>a.out 2>quiet
check "it catches up, and says nothing" is_quiet quiet
check "Ada's runs are on the server" test "$(runs_of Ada)" -eq "$(told a.out b.out)"
lesson 2 Zoe >>z.out
check "Zoe's, too" test "$(runs_of Zoe)" -eq 3

# Sent twice, it is there once: the seat forgets what it has sent.
python3 - "$work/seat2/gearshift/history.db" <<'END'
import sqlite3, sys
history = sqlite3.connect(sys.argv[1])
history.execute("INSERT INTO unsent (kind, row) SELECT 'lesson_run', id FROM lesson_run WHERE id < 10000000")
history.commit()
END
content="SELECT count(*), sum(duration_s::numeric), sum(grade::numeric) FROM gearshift.lesson_run"
before=$(sql "$content")
on 2 report --learner Zoe --next reverse >/dev/null
check "sent twice changes nothing" test "$(sql "$content")" = "$before"
check "an instructor's choice on a seat is on the server" test "$(sql "SELECT next_lesson FROM gearshift.learner WHERE name = 'Zoe'")" = reverse

# The instructor.
instructor=$(url bo)
check "sees all learners" test "$("$gearshift" report --database "$instructor" | grep -cE "^(Ada|Eve|Zoe) ")" -eq 3
run=$("$gearshift" report --database "$instructor" --learner Zoe | sed -n 's/^ *\([0-9]*\) .*hill_start.*/\1/p' | head -n 1)
check "comments on a run" "$gearshift" report --database "$instructor" --learner Zoe --comment "$run" 'Calm, "so"' --by Bo >/dev/null
lesson 2 Zoe >>z.out
check "which the seat then shows" test "$(on 2 report --learner Zoe | grep -c 'Bo, .*: Calm, "so"')" -eq 1
comment=$("$gearshift" report --database "$instructor" --learner Zoe | sed -n 's/.* comment \([0-9]*\), Bo.*/\1/p')
check "deletes the comment" "$gearshift" report --database "$instructor" --learner Zoe --delete-comment "$comment" >/dev/null
lesson 2 Zoe >>z.out
check "which is then gone from the seat" test "$(on 2 report --learner Zoe | grep -c 'Calm')" -eq 0
check "renames" "$gearshift" report --database "$instructor" --learner Zoe --rename "Zoe Li" >/dev/null
lesson 2 Zoe >>z.out
lesson 2 "Zoe Li" >>z.out
check "and the seat follows" test "$(on 2 report | grep -c "^Zoe Li ")" -eq 1

# Erased on one seat, erased everywhere, and for good.
recordings() { find "seat$1" -name "*.trace" | wc -l; }
before=$(recordings 2)
check "Ada is erased on seat 1" on 1 report --learner Ada --delete --yes >/dev/null
check "and on the server" test "$(runs_of Ada)" -eq 0 -a "$(sql "SELECT count(*) FROM gearshift.learner WHERE name = 'Ada'")" -eq 0
lesson 2 Eve >>e.out 2>erased.err
check "seat 2 is told once, got: $(cat erased.err)" test "$(grep -c "Ada was deleted on another seat" erased.err)" -eq 1
check "and has nothing of her" test "$(on 2 report | grep -c "^Ada")" -eq 0
check "nor her recordings: $before, $(recordings 2)" test "$(recordings 2)" -lt "$before"
lesson 2 Eve >>e.out 2>quiet
check "no more is said" is_quiet quiet
check "another Ada is another person" lesson 1 Ada >/dev/null
check "with one run" test "$(runs_of Ada)" -eq 1
mkdir -p late/gearshift
use_server 3
mv seat3/gearshift/history.db-server late/
lesson 3 Zoe >/dev/null 2>&1 # a seat that never heard of the server before the erasure
sleep 1
"$gearshift" report --database "$instructor" --learner "Zoe Li" --rename Zoe >/dev/null
check "the instructor erases" "$gearshift" report --database "$instructor" --learner Zoe --delete --yes >/dev/null
mv late/history.db-server seat3/gearshift/
lesson 3 Ada >/dev/null 2>late.err
check "a seat that was away for long brings nobody back, got: $(cat late.err)" test "$(runs_of Zoe)" -eq 0
check "and is told" grep -q "Zoe was deleted on another seat" late.err

# Who may not.
refused() { # part of the message, arguments
  local part=$1
  shift
  "$gearshift" "$@" >out 2>err </dev/null && return 1
  [ "$(wc -l <err)" -eq 1 ] && grep -qF "$part" err && [ ! -s out ]
}
check "a seat may not read all" refused "permission denied for function learners" report --database "$(url seat1)"
check "a seat has no tables, got: $(cat err)" test "$(psql "$(url seat1)" -Atqc "SELECT * FROM gearshift.learner" 2>&1 | grep -c "permission denied for table")" -eq 1
sql "SELECT token FROM gearshift.seat WHERE login = 'seat2' LIMIT 1" >token
check "nor another seat's learners" test "$(psql "$(url seat1)" -Atqc "SELECT gearshift.fetch_learner('$(<token)',
  '[{\"learner\": $(sql "SELECT id FROM gearshift.learner WHERE name = 'Eve'"), \"version\": 0}]')" 2>&1 | grep -c "may not read")" -eq 1
check "an unknown login" refused "no password supplied" report --database "$(url nobody)"
check "no address" refused "libpq can read" report --database "postgresql://u:$secret@127.0.0.1/postgres"
check "a password on the command line stays there" test "$(grep -cF "$secret" err)" -eq 0
check "nor is it in a message" refused "authentication failed" report --database "postgresql://seat1:wrong-pass@127.0.0.1:$port/postgres"
check "got: $(cat err)" test "$(grep -cF "wrong-" err)" -eq 0

# TLS by libpq's own settings.
export PGSSLMODE=verify-full PGSSLROOTCERT=$server/certificate
check "the server's certificate is verified" "$gearshift" report --database "$instructor" >/dev/null
openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 2 -subj /CN=school -keyout key \
  -out other_certificate 2>/dev/null
PGSSLROOTCERT=$work/other_certificate
check "another one is refused in a sentence" refused "certificate verify failed" report --database "$instructor"
lesson 2 Eve >>e.out 2>tls.err
check "a seat keeps its runs meanwhile" grep -q "kept here and sent later" tls.err
unset PGSSLMODE PGSSLROOTCERT
lesson 2 Eve >>e.out 2>/dev/null
check "and sends them" test "$(runs_of Eve)" -eq "$(told e.out)"

# A copied history.
mkdir -p seat4
cp -r seat2/gearshift seat4/
lesson 2 Eve >/dev/null 2>&1
lesson 4 Eve >/dev/null 2>copy.err
check "is refused, got: $(cat copy.err)" test "$(grep -c "this history is a copy or an older state" copy.err)" -eq 1

# The server's disk is full.
mkdir "$server/small"
sql "VACUUM FULL gearshift.shift"
size=$(sql "SELECT pg_table_size('gearshift.shift') / 1024 + 64")
if [ "$(id -u)" -eq 0 ] && mount -t tmpfs -o "size=${size}k,mode=777" none "$server/small" 2>/dev/null; then
  chown nobody "$server/small"
  sql "CREATE TABLESPACE small LOCATION '$server/small'"
  sql "ALTER TABLE gearshift.shift SET TABLESPACE small"
  lesson 2 Max --runs 400 >m.out 2>full.err
  check "a full disk is reported, got: $(head -c 400 full.err)" grep -q "No space left on device\|could not extend" full.err
  check "not everything is there" test "$(runs_of Max)" -lt "$(told m.out)"
  sql "ALTER TABLE gearshift.shift SET TABLESPACE pg_default"
  sql "DROP TABLESPACE small"
  lesson 2 Max >>m.out
  check "with room again, all of it is: $(runs_of Max) of $(told m.out)" test "$(runs_of Max)" -eq "$(told m.out)"
  umount "$server/small"
else
  echo "left out: a full disk of the server, which only root can make"
fi

# The class over three seats, from the server and from the files.
for ((i = 1; i <= 30; ++i)); do lesson $((i % 3 + 1)) "Learner $i" --seed $i --skill-error 0.3 >>class.out 2>/dev/null; done
check "the class from the server" "$gearshift" report --database "$instructor" --out class --csv >/dev/null
check "has 30 learners" test "$(grep -o '>Learner [0-9]*</a>' class/index.html | sort -u | wc -l)" -eq 30
files=()
for seat in 1 2 3; do files+=(--database "seat$seat/gearshift/history.db"); done
check "the class from three files" "$gearshift" report "${files[@]}" --out files --csv >/dev/null
check "is the same, got: $(diff class/standings.csv files/standings.csv | head -n 4)" cmp class/standings.csv files/standings.csv
check "a learner of several files" "$gearshift" report "${files[@]}" --learner "Learner 3" --out three >/dev/null
check "several files are only read" refused "one history at a time only" report "${files[@]}" --learner "Learner 3" --next reverse

# A school of the version before, which lacks a column.
sql "ALTER TABLE gearshift.lesson_run DROP COLUMN pedal_corrections_per_s"
sql "UPDATE gearshift.school SET version = 1"
lesson 1 Ada >old.out 2>old.err
check "an older school is told, got: $(cat old.err)" test "$(grep -c "gearshift school --make" old.err)" -eq 1
before=$(runs_of Ada)
check "the owner upgrades it" "$gearshift" school --database "$(url owner)" --make >/dev/null
lesson 1 Ada >>old.out 2>quiet
check "and the seat sends again: $before, $(runs_of Ada)" test "$(runs_of Ada)" -eq $((before + 2))
check "the new column, too" test "$(sql "SELECT count(*) FROM gearshift.lesson_run WHERE pedal_corrections_per_s IS NOT NULL")" -ge 2

# A newer school.
sql "UPDATE gearshift.school SET version = 99"
lesson 1 Ada >/dev/null 2>newer.err
check "is refused in one sentence, got: $(cat newer.err)" test "$(grep -c "has version 99, but this program knows only version" newer.err)" -eq 1
check "report, too" refused "install a newer gearshift" report --database "$instructor"

check "no password is in any file that the program wrote" test "$(grep -rlaF -e "$secret" -e bo-password seat* *.out *.err ada class | wc -l)" -eq 0
finish
