#!/usr/bin/env bash
# Tests the stability analysis as a user runs it: the known limits, the map as a drawing and as a table, invalid inputs.
# Usage: stability.sh GEARSHIFT SOURCE_FOLDER
set -u
gearshift=$1
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

answers() { # arguments ...
  "$gearshift" stability "$@" >out 2>err
}
says() { grep -qF -- "$1" out; }
value() { grep -m 1 "\"$1\":" out | sed 's/.*: //; s/,$//; s/"//g'; }
is() { [ "$(value "$1")" = "$2" ]; }
near() { # takes a key, value and relative tolerance; succeeds if the key's value in the output is near the given one
  value "$1" | awk -v want="$2" -v part="$3" \
    '{ off = $1 - want; ok = off <= part * want && -off <= part * want } END { exit !ok }'
}

refuse() { # takes the expected exit code, a part of the error message, and the arguments of the program
  local code=$1 part=$2
  shift 2
  "$gearshift" stability "$@" >out 2>err </dev/null
  local got=$?
  check "stability $*: exit $got (wanted $code), wanted one line with \"$part\", got: $(cat err out)" \
    test $got -eq "$code" -a "$(wc -l <err)" -eq 1 -a ! -s out -a -n "$(grep -F -- "$part" err)"
}

# Expected limits from tests/haptics/analysis/stability_table_test.cpp: 6032 N/m (exact) and 6000 N/m (passive) at 1
# kHz; 217 N/m with one sample of delay at 100 Hz.
check "1 kHz answers" answers --json
check "1 kHz: exact" near k_max_n_per_m 6032 0.001
check "1 kHz: passive" near passive_k_max_n_per_m 6000 1e-9
check "1 kHz: the wall may be used" is may_use true
check "1 kHz: passive" is passive true
check "1 kHz: every input is listed" test "$(grep -cE '"(mass_kg|rate_hz|delay_samples|window_samples|hold)"' out)" -ge 5
answers --rate 100 --delay 1 --json
check "100 Hz, one late: exact" near k_max_n_per_m 217 0.002
check "100 Hz, one late: passive" near passive_k_max_n_per_m 200 1e-9
check "100 Hz, one late: not stable" is stable false
answers --axis y --rate 100 --json
check "Y axis: passive 580" near passive_k_max_n_per_m 580 1e-9
answers --delay 3 --hand grip --wall-damping 40 --json
check "grip, three late" near k_max_n_per_m 11059 0.0001
answers --hand all --rate 100 --json
check "all hands are judged" test "$(grep -c '"name"' out)" -eq 4
check "the bare lever decides" is deciding_hand bare
answers --mass 1000 --damping 10000 --rate 20000 --wall-damping 1e5 --json
check "an infinite limit is null" is k_max_n_per_m null
answers --mass 1000 --damping 10000 --rate 20000 --wall-damping 1e5
check "and is printed in words" says "any K up to 1e9 N/m"
answers --hold observer --delay 3 --json
check "the observer hold: no passive limit is known" is passive_k_max_n_per_m null
check "the observer hold: 5000 N/m three samples late" is stable true
answers --window 15 --wall-damping 10
check "a 15 ms window fails by its damping" says "No: K up to 3465.76 N/m"
check "passivity is called sufficient, not necessary" says "sufficient"

check "the map is made" answers --hand all --svg map.svg --csv map.csv
check "the drawing is whole" grep -q "</svg>" map.svg
check "the drawing names its loop" grep -q "1000 Hz (T = 1 ms), no delay, zero-order hold" map.svg
check "the table's head" test "$(head -n 1 map.csv)" = "b_n_s_per_m,bare_k_max_n_per_m,light_k_max_n_per_m,\
grip_k_max_n_per_m,arm_k_max_n_per_m,passive_k_max_n_per_m"
check "the table begins with the answer" \
  awk -F, 'NR == 2 { ok = $1 == 0 && int($2) == 6031 && $6 == 6000 } END { exit !ok }' map.csv
check "the table ends where nothing is stable" awk -F, 'END { exit !($1 > 190 && $2 == 0 && $6 == 0) }' map.csv

# For a handle on a stiff spring, without damping and with two samples of delay, no wall is stable, whatever its
# damping.
check "a map where nothing is stable ends" \
  timeout 10 "$gearshift" stability --damping 0 --stiffness 95000 --delay 2 --svg none.svg --csv none.csv >out 2>err
check "and reports it" says "not even a soft wall is stable"
check "its drawing is whole" grep -q "</svg>" none.svg
check "its table has a width" awk -F, 'END { exit !(NR == 122 && $1 > 0 && $2 == 0) }' none.csv

# Checks how the trainer would limit a wall of 5000 N/m (the default) and 10 N s/m at 100 Hz.
answers --hold half_sample --rate 100 --wall-damping 10 --json
check "the trainer: K" near admitted_wall_stiffness_n_per_m 237.5 1e-9
check "the trainer: B" near admitted_wall_damping_n_s_per_m 3.325 1e-9
check "the trainer: hold" is admitted_hold half_sample
check "the trainer: K, B and the loop's own damping are limited" test "$(grep -c '"law": ".*quiet only if' out)" -eq 3
answers --hold half_sample --rate 100 --wall-damping 10
check "the trainer's limits in words" says "The trainer would use K = 237.5 N/m, B = 3.325 N s/m, half-sample hold:"
check "with the reason" says "wall_stiffness_n_per_m limited from 5000 to 237.5 (the half-sample hold is quiet only if K <= 0.25 m / tau^2"
answers --hold half_sample --wall-damping 10 --json
check "the shipped wall is used unchanged" is admitted_wall_stiffness_n_per_m 5000.0
check "nothing is limited" is limited "[]"
answers --hold half_sample --wall-damping 10 --encoder-step 419 --json
check "a coarser encoder allows less damping: 3 N T / q" near admitted_wall_damping_n_s_per_m 7.16 1e-3
answers --hold half_sample --rate 4000 --wall-stiffness 90000 --wall-damping 500 --json
check "the requested stiffness is limited to the trainer's maximum" is asked_wall_stiffness_n_per_m 20000.0
check "the requested damping, too" is asked_wall_damping_n_s_per_m 100.0
answers --hold half_sample --rate 4000 --wall-stiffness 90000
check "and that is reported" says "(values out of range were lowered to K = 20000 N/m, B = 0 N s/m, the largest that the trainer accepts)"
for place in "--rate 50" "--rate 8000" "--window 2"; do
  answers $place --json
  check "the trainer does not run at $place: null" is admitted_wall_stiffness_n_per_m null
  answers $place
  check "the trainer does not run at $place: words" says "The trainer does not run with these values"
done

refuse 2 "--rate" --rate 49
refuse 2 "--rate" --rate nan
refuse 2 "--delay" --delay 9
refuse 2 "--delay" --delay 1.5
refuse 2 "--delay" --delay -1
refuse 2 "--window" --window 0
refuse 2 "--axis" --axis z
refuse 2 "--hold" --hold second_order
refuse 2 "--mass" --mass 0
refuse 2 "--mass" --mass -1
refuse 2 "--wall-stiffness" --wall-stiffness inf
refuse 2 "--wall-damping" --wall-damping -1
refuse 2 "--hand" --hand fist
refuse 2 "--hand" --hand 1,2
refuse 2 "hand.mass = 2000" --hand 2000,1,300
refuse 2 "extra" extra
refuse 2 "different files" --svg one --csv one
refuse 1 "/nowhere/x.svg" --svg /nowhere/x.svg
refuse 1 "/nowhere/x.csv" --csv /nowhere/x.csv
check "rejected inputs leave nothing behind" test ! -e one

finish
