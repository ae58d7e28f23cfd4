#!/usr/bin/env bash
# Tests `gearshift drive` as an engineer and a script run it: a script in, car, lever, events, shifts and errors out as
# text, CSV and JSON; other cars, gates and starts; invalid inputs.
# Usage: drive.sh GEARSHIFT SOURCE_FOLDER
set -u
gearshift=$1
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

drives() { "$gearshift" drive "$@" >out 2>err; } # arguments ...
json() { python3 -c "import json; drive = json.load(open('${2:-out}')); rows = drive['samples']; assert $1, rows[-1]"; }
csv() { python3 -c "import csv; rows = list(csv.DictReader(open('${2:-out}'))); assert $1, rows[-1]"; }
refuse() { # takes the expected exit code, a part of the error message, and the arguments of the program
  local code=$1 part=$2
  shift 2
  "$gearshift" drive "$@" >out 2>err </dev/null
  local got=$?
  check "drive $*: exit $got (wanted $code), wanted one line with \"$part\", got: $(cat err out)" \
    test $got -eq "$code" -a "$(wc -l <err)" -eq 1 -a ! -s out -a -n "$(grep -F -- "$part" err)"
}

cat >move_off.csv <<'END'
time_s,throttle,brake,clutch,hand_brake,slope_percent,gear
0,0,0,1,0,0,1
1,0.3,0,1,0,0,1
3,0.3,0,0,0,0,1
6,0.3,0,0,0,0,1
6.2,0,0,1,0,0,1
6.3,0,0,1,0,0,2
7.2,0,0,1,0,0,2
8,0.2,0,0,0,0,2
10,0.2,0,0,0,0,2
END
check "a script" drives move_off.csv
check "the shift is named" grep -q "shift 1 to 2 in" out
check "the end is named" grep -q "end: .* gear 2, engine on" out
check "CSV to stdout" drives move_off.csv --csv
check "it has the columns" csv "all(c in rows[0] for c in ('time_s', 'engine_rpm', 'road_speed_km_per_h', 'distance_m', 'gear', 'clutch_torque_nm', 'clutch_temperature_c', 'running'))"
check "one row each 10 ms" csv "len(rows) == 1001 and float(rows[-1]['time_s']) == 10"
check "it ends in second" csv "rows[-1]['gear'] == '2' and rows[-1]['running'] == '1' and float(rows[-1]['road_speed_km_per_h']) > 10"
cp out first
check "CSV to a file" drives move_off.csv --csv drive.csv
check "it is the same" cmp first drive.csv
check "JSON" drives move_off.csv --json --interval 0.1
check "it has samples, events, shifts and errors" json "len(rows) == 101 and drive['events'] and drive['shifts'][-1]['to_gear'] == '2' and isinstance(drive['errors'], list)"
check "both" drives move_off.csv --json drive.json --csv drive.csv
check "the JSON file is whole" json "drive['car'] == 'hatchback'" drive.json

check "a recording" drives move_off.csv --trace drive.trace
check "it replays" "$gearshift" replay drive.trace
check "another car and gate" drives move_off.csv --car diesel --gate six_speed_r_left_down --csv
check "drives otherwise" [ "$(cmp -s first out || echo differs)" = differs ]
printf 'time_s,throttle\n0,0\n5,0\n' >roll.csv
check "a start" drives roll.csv --start gear=4,speed_km_per_h=80 --csv
check "begins there" csv "abs(float(rows[0]['road_speed_km_per_h']) - 80) < 0.01 and rows[0]['gear'] == '4'"
check "and coasts" csv "float(rows[-1]['road_speed_km_per_h']) < 79"
printf '[[row]]\ntime_s = 0\nslope_percent = -10\n[[row]]\ntime_s = 2\n' >roll.toml
check "a script in TOML" drives roll.toml --start engine=off --csv
check "rolls downhill" csv "float(rows[-1]['distance_m']) > 1 and rows[-1]['running'] == '0'"

# The car does what a real one does: pulls away without throttle, stalls if dumped, brakes by its engine, holds in gear,
# starts by being rolled.
script() { # NAME ROW ...
  local name=$1
  shift
  printf 'time_s,throttle,brake,clutch,hand_brake,slope_percent,gear\n' >"$name"
  printf '%s\n' "$@" >>"$name"
}
script first.csv 0,0,0,1,0,0,1 1,0,0,0.75,0,0,1 2.5,0,0,0.15,0,0,1 8,0,0,0,0,0,1
check "first without throttle, 1.5 s" drives first.csv --csv
check "pulls away and idles along" csv "rows[-1]['running'] == '1' and 6 < float(rows[-1]['road_speed_km_per_h']) < 7"
script dumped.csv 0,0,0,1,0,0,1 1,0,0,0.75,0,0,1 1.05,0,0,0.15,0,0,1 5,0,0,0,0,0,1
check "the same, dumped" drives dumped.csv --csv
check "stalls" csv "rows[-1]['stalled'] == '1'"
script second.csv 0,0,0,1,0,0,2 1,0,0,0.7,0,0,2 4,0,0,0.15,0,0,2 10,0,0,0,0,0,2
check "the diesel in second, 3 s" drives second.csv --car diesel --csv
check "pulls away" csv "rows[-1]['running'] == '1'"
script downhill.csv 0,0,0,0,0,-8,2 60,0,0,0,0,-8,2
check "second on -8 %" drives downhill.csv --start speed_km_per_h=40 --csv
check "settles near 57 km/h" csv "abs(float(rows[-1]['road_speed_km_per_h']) - 57) < 5.7"
for gear in 1 R; do
  for slope in -10 10 30; do
    script parked.csv "0,0,0,0,1,$slope,$gear" "1,0,0,0,0,$slope,$gear" "6,0,0,0,0,$slope,$gear"
    check "parked in $gear on $slope %" drives parked.csv --start engine=off --csv
    check "holds on 10 %, rolls on 30 %" csv "(abs(float(rows[-1]['distance_m'])) < 0.001) == ($slope < 30)"
  done
done
script bump.csv 0,0,0,1,0,0,2 0.5,0,0,1,0,0,2 1.5,0.1,0,0,0,0,2 5,0.1,0,0,0,0,2
check "a bump start" drives bump.csv --start speed_km_per_h=15,engine=off --csv
check "starts the engine" csv "rows[0]['running'] == '0' and rows[-1]['running'] == '1'"

printf 'time_s,throttle\n0,0\n1,2\n' >bad.csv
refuse 1 "bad.csv:3: throttle = 2: must be between 0 and 1" bad.csv
printf 'time_s,gear\n0,6\n' >six.csv
refuse 1 "six.csv: gear = 6 at 0 s: this gate has no such gear" six.csv
refuse 1 "missing.csv" missing.csv
refuse 1 "tractor" move_off.csv --car tractor
refuse 1 "labyrinth" move_off.csv --gate labyrinth
refuse 2 '"speed=3" is not known' move_off.csv --start speed=3
refuse 2 "must be different files" move_off.csv --csv move_off.csv
refuse 2 "--interval" move_off.csv --interval 0
refuse 2 "script" --csv
finish
