#!/usr/bin/env bash
# Tests `gearshift contact` as a device builder and a script run it: figures as text, JSON and drawing, for presets and
# settings; invalid inputs.
# Usage: contact.sh GEARSHIFT SOURCE_FOLDER
set -u
gearshift=$1
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

answers() { "$gearshift" contact --runs 10 "$@" >out 2>err; } # arguments ...
json() { python3 -c "import json; wall = json.load(open('out')); assert $1, wall"; }
refuse() { # takes the expected exit code, a part of the error message, and the arguments of the program
  local code=$1 part=$2
  shift 2
  "$gearshift" contact "$@" >out 2>err </dev/null
  local got=$?
  check "contact $*: exit $got (wanted $code), wanted one line with \"$part\", got: $(cat err out)" \
    test $got -eq "$code" -a "$(wc -l <err)" -eq 1 -a ! -s out -a -n "$(grep -F -- "$part" err)"
}

check "the paper's lever" answers
check "the wall in use is named" grep -q "^wall     5000 N/m and 10 N s/m, half-sample hold$" out
check "every hand has a row" test "$(grep -cE '^(bare|light|grip|arm) ' out)" -eq 4
check "the wall takes energy" grep -q "the wall takes [0-9]* % of the worst impact's energy" out

# A force that acts two cycles late, with figures from an independent search (K 5000 N/m, ripple at most 0.12 mm, Re Z
# at least 0.95 K up to 10 Hz, energy lost in every impact, nothing softened).
check "two cycles late" answers --delay 2 --json
check "its stiffness" json "wall['k_n_per_m'] == 5000 and wall['hold'] == 'observer'"
check "its ripple" json "0.01 < wall['ripple_p95_mm'] <= 0.12"
check "its impacts" json "-1 < wall['energy_worst_fraction'] < 0 and 0 < wall['restitution_worst'] < 1"
check "its stiffness in motion" json "all(wall['re_z_n_per_m'][f] >= 4750 for f in ('2', '5', '10'))"
check "nothing is softened" json "wall['softened_fraction'] == 0 and wall['stopped_fraction'] == 0"
cp out first
answers --delay 2 --json
check "the same seed gives the same figures" cmp first out
answers --delay 2 --json --seed 2
check "another seed gives others" [ "$(cmp -s first out || echo differs)" = differs ]

# Negative controls: a hold that does not know the delay, and a textbook spring at 100 Hz.
answers --delay 2 --hold half_sample --wall-stiffness 5000 --json
check "without the observer the wall is softer" json "wall['k_n_per_m'] < 4000"
textbook='[loop]\nrate_hz = 500\n[tuning]\nwall_damping_n_s_per_m = 0\n[contact]\nhold = "zero_order"\n'
printf "name = \"Textbook\"\n${textbook}study = true\n" >study.toml
printf "name = \"Textbook\"\n$textbook" >textbook.toml
answers --preset study.toml --hand bare --json
check "a textbook spring gives energy" json "wall['energy_worst_fraction'] > 0"
answers --preset textbook.toml --hand bare --json
check "without a study it has the damping that takes it" json "wall['energy_worst_fraction'] < 0 and wall['b_n_s_per_m'] > 10"
answers --preset textbook.toml --hand bare
check "which is reported" grep -q "wall_damping_n_s_per_m raised from 0 to .*gains energy" out

answers --hand random --rate 200 --push 30 4 --speed 0.3 --place 0.5 --json
check "random hands, one run each" json "len(wall['hands']) == 10 and wall['runs'] == 1 and wall['push_n'] == [4, 30]"
check "at any rate every wall is stiff in motion" json "wall['re_z_n_per_m']['5'] >= 0.95 * wall['k_n_per_m']"
check "a hand of three numbers" answers --hand 2.5,20,300 --delay 3
check "is named by them" grep -q "^2.5,20,300 " out
check "another preset" answers --preset measured
check "the drawing" answers --svg wall.svg
check "is whole" grep -q "</svg>" wall.svg
check "it shows Re Z and the damping at eleven frequencies each" test "$(grep -c '<circle' wall.svg)" -eq 22

# Weak motors: the swing and the usual pushes stay within their force, and a push beyond it is reported.
printf 'name = "Weak"\n[lever]\npeak_force_n = 10\ncontinuous_force_n = 5\n' >weak.toml
answers --preset weak.toml --hand grip --json
check "weak motors show the wall in motion" json "all(0.95 < z / 5000 < 1.05 for z in wall['re_z_n_per_m'].values())"
check "their pushes" json "wall['push_n'][1] == 9.5 and wall['re_z_saturated_fraction'] == 0"
answers --preset weak.toml --hand grip --push 20
check "a push beyond them" grep -q "The motors (10 N) were at their limit in 100.0 % of the runs" out
answers --hand grip --speed 0.3 --json
check "impacts at the chosen speed" json "wall['impact_speeds_m_per_s'] == [0.3] and wall['impact_hand'] == 'bare'"
cp out first
answers --hand grip --speed 1 --json
check "another speed" json "wall['energy_worst_fraction'] != json.load(open('first'))['energy_worst_fraction']"

refuse 2 "--push" --push -1
refuse 2 "--wall-stiffness: \"0\" is not a number from 1 to 20000" --wall-stiffness 0
refuse 2 "--delay: \"9\" is not a whole number from 0 to 8" --delay 9
refuse 2 "--hand fist: must be bare, light, grip, arm, elastic, pinch, all, random or M,B,K" --hand fist
refuse 2 "--rate" --rate 50
refuse 1 "preset" --preset no_such_preset
refuse 1 "no stick that matches \"rhino\" is plugged in" --stick rhino
refuse 1 "cannot be written" --svg no/such/folder/wall.svg
finish
