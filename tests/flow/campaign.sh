#!/usr/bin/env bash
# The stability campaign as a user runs it: stopped in the middle and gone on with, one case alone, its trace replayed.
# Usage: campaign.sh GEARSHIFT SOURCE_FOLDER
set -u
gearshift=$1
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

campaign() { "$gearshift" campaign --seed 11 --shifts 200 "$@" >"$work/out" 2>"$work/err"; }
cut_short() { head -c $(($(stat -c %s "$1") - 300)) "$1" >cut && mv cut "$1"; }
same() { diff <(sort "$1/cases.csv") <(sort "$2/cases.csv") && cmp "$1/summary.json" "$2/summary.json"; }

check "200 shifts" campaign --out once --threads 1
check "every law is in the table" [ "$(grep -c '^| .* | 0 |$' out)" -ge 12 ]
check "no word on stderr where it is no terminal" [ ! -s err ]
cp -r once again
check "stopped in the middle of a line" cut_short again/cases.csv
check "gone on with" campaign --out again --threads 1
check "with the same result" same once again
"$gearshift" campaign --seed 12 --out once >out 2>err
check "another campaign's folder is refused" [ $? -eq 1 ] && grep -q "another campaign" err
check "one case alone" "$gearshift" campaign --seed 11 --case 1 --out one
check "its trace replays" sh -c '"$1" replay one/case_1.trace | grep -q "^bit for bit"' sh "$gearshift"

for number in -1 99999999999999999999 1.5; do
  for option in --case --seed; do
    "$gearshift" campaign $option $number --out bad >out 2>err
    check "$option $number is refused in a sentence" [ $? -eq 2 ] && [ "$(wc -l <err)" = 1 ] && [ ! -e bad ]
  done
done
finish
