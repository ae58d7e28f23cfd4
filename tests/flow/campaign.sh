#!/usr/bin/env bash
# Tests the stability campaign as a user runs it: stopped in the middle and resumed; in shards; a single case; a
# replay of its trace.
# Usage: campaign.sh GEARSHIFT SOURCE_FOLDER
set -u
gearshift=$1
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
export XDG_DATA_HOME=$work/data  # not the history of whoever runs the test

campaign() { "$gearshift" campaign --seed 11 --shifts 200 "$@" >"$work/out" 2>"$work/err"; }
fails() { ! "$@"; }
cut_short() { head -c $(($(stat -c %s "$1") - 300)) "$1" >cut && mv cut "$1"; }
same() { diff <(sort "$1/cases.csv") <(sort "$2/cases.csv") && cmp "$1/summary.json" "$2/summary.json"; }

check "200 shifts" campaign --out once --threads 1
no_law_broken() { # checks that the table has all twelve laws, none broken; "-": no case met the law's precondition
  local law
  for law in finite "free space" "no wall" force slew fades "gear holds"; do
    grep -qE "^\| $law \| .* \| 0 \|$" out || return 1
  done
  for law in lockout energy guard quiet reached; do
    grep -qE "^\| $law \| .* \| (0|-) \|$" out || return 1
  done
}
check "every law is in the table, and none is broken" no_law_broken
check "nothing on stderr, because it is no terminal" [ ! -s err ]
cp -r once again
check "stopped in the middle of a line" cut_short again/cases.csv
check "resumed" campaign --out again --threads 1
check "with the same result" same once again
shards() { # runs shards of the campaign, as gearshift campaign --help shows it
  parallel --will-cite "$gearshift" campaign --seed 11 --shifts 200 --shard {}/3 --threads 1 --out part/{} ::: "$@" >shards.txt
}
merged() { rm -rf merged && campaign --merge part/* --out merged --threads 1; }
not_merged() { ! merged && [ "$(wc -l <err)" = 1 ] && grep -q -- "$1" err; }
refuses() { # arguments: the reason, and the arguments of campaign
  ! "$gearshift" campaign --shifts 200 --out twice "${@:2}" 2>err && [ "$(wc -l <err)" = 1 ] && grep -q "$1" err
}
check "two of three shards by GNU parallel" shards 1 3
check "each names itself" grep -q "^shard 3 of 3: " shards.txt
check "the missing one is named" not_merged "shard 2 of 3 is missing"
check "the third shard" shards 2
check "a shard that was stopped" cut_short part/2/cases.csv
check "is named" not_merged "part/2/cases.csv: shard 2 is not finished"
check "and resumed" shards 2
check "merged" merged
check "the result is that of one run" same once merged
check "in the order of the cases" cmp once/cases.csv merged/cases.csv
check "a shard that is given twice is named" refuses "are both shard 1 of 3" --seed 11 --merge part/* part/1
check "another seed's shards are refused" refuses "holds no shard of this campaign" --seed 12 --merge part/*
check "a folder without a shard is refused" refuses "holds no shard of this campaign" --seed 11 --merge once
# Too little memory for eight threads, but enough for three stacks of 1 GB and the rest of the program.
if [ -z "${ASAN_OPTIONS-}${TSAN_OPTIONS-}" ]; then
  fewer() { (ulimit -s 1000000 -v 4000000 && campaign --out fewer --threads 8); }
  check "with too little memory it uses fewer threads" fewer
  check "with the same result" cmp -s once/summary.json fewer/summary.json
fi
ended() { # starts a campaign and ends it with SIGINT, like Ctrl-C; `env` undoes that background children ignore SIGINT
  env --default-signal=INT "$gearshift" campaign --seed 11 --out ended >out 2>err &
  until [ -s ended/cases.csv ]; do sleep 0.05; done
  sleep 1
  kill -INT $!
  wait $!
  [ $? -eq 1 ]
}
hung_up() { # starts a campaign under nohup and sends it SIGHUP, as a closed terminal does; it must continue
  nohup "$gearshift" campaign --seed 11 --out hung_up --shifts 40 >out 2>err &
  until [ -s hung_up/cases.csv ]; do sleep 0.05; done
  kill -HUP $!
  wait $!
}
check "under nohup it continues when the terminal is closed" hung_up
check "ended by Ctrl-C" ended
check "the interruption is reported, and how to continue" grep -q "^gearshift: interrupted after [0-9]* finished cases\{0,1\}; run the same command to resume" err
check "the same command continues" campaign --out ended --threads 1
check "with the same result" cmp -s once/summary.json ended/summary.json
refused() { # takes the exit code, the error message, and the arguments of campaign
  local code=$1 words=$2
  shift 2
  "$gearshift" campaign "$@" >out 2>err
  [ $? -eq "$code" ] && [ "$(wc -l <err)" = 1 ] && grep -q -- "$words" err && [ ! -e bad ]
}
check "the folder of a different campaign is rejected" refused 1 "another campaign" --seed 12 --out once
unreadable() { # runs the campaign as a user who may write cases.csv, but not read it
  chmod 222 once/cases.csv
  chmod 777 "$work" once
  cp once/cases.csv before
  as_nobody campaign --seed 11 --shifts 200 --out "$work/once" >out 2>err
  [ $? -eq 1 ] && grep -q "cases.csv: cannot be read" err && cmp -s before once/cases.csv
}
as_nobody() { setpriv --reuid=65534 --regid=65534 --clear-groups "$gearshift" "$@"; }
if [ "$(id -u)" = 0 ] && as_nobody gate paper >out 2>&1; then # skipped if only root can read the shipped files
  check "an unreadable file is reported and unchanged" unreadable
fi
check "a single case" "$gearshift" campaign --seed 11 --case 1 --out one
check "its trace replays" sh -c '"$1" replay one/case_1.trace | grep -q "^identical bit for bit"' sh "$gearshift"
not_driven() {
  "$gearshift" campaign --seed 1 --case 42 --out one >out && [ ! -e one/case_42.trace ] &&
    grep -qx "the case was rejected, so nothing was recorded" out
}
check "a case rejected by the loop's checks has no trace" not_driven
# No case of a million breaks a law (app/lab/campaign/README.md), so the text about a broken one is written here. That a
# broken law is found: tests/app/lab/campaign/campaign_laws_test.cpp.
mkdir broken
cp one/case_1.trace broken
law="case_1.trace: case 1 of seed 11 violates fades (held still, a swing decays): 0.002 m, bound 0.001, at 11.000 s"
printf '%s\n' "$law" "gearshift train --replay case_1.trace --from 9.0" >broken/case_1.txt
reports_broken_law() { # replay must print "identical", the broken law, and the command that shows it
  "$gearshift" replay broken/case_1.trace >out && grep -q "^identical bit for bit" out && grep -qxF "$law" out
}
check "replay prints the law, the time and the amount" reports_broken_law
shows() { # runs the command that replay printed, without a window and with the given extra arguments
  $(tail -n 1 out | sed "s|^gearshift|$gearshift|") --offscreen shown --size 64x36 --samples 1 --no-panel "$@" >shown.txt
}
length=$(sed -n 's/^identical bit for bit: .*, \([0-9.]*\) s,.*/\1/p' out)
sed -i "\$s/--from .*/--from $(awk -v s="$length" 'BEGIN {print int(s) - 3}')/" out
check "the printed command shows the case, to the end of the drive" shows
beyond() { ! shows --seconds 1 2>err && [ "$(wc -l <err)" = 1 ] && grep -q "9999 s is outside the drive, which lasts" err; }
sed -i '$s/--from .*/--from 9999/' out
check "a time beyond the drive's end is rejected" beyond
cp one/case_1.trace broken/other.trace && cp broken/case_1.txt broken/other.txt
check "a trace that is not named like a case is not taken for one" fails sh -c '"$1" replay broken/other.trace | grep violates' sh "$gearshift"

for shard in 0/3 4/3 1 1/ /3 1/3x 1/10001; do
  check "--shard $shard is rejected in a sentence" refused 2 "--shard" --shard $shard --out bad
done
for number in -1 99999999999999999999 1.5; do
  for option in --case --seed; do
    check "$option $number is rejected in a sentence" refused 2 "$option" $option $number --out bad
  done
done
finish
