#!/usr/bin/env bash
# Tests a force-feedback stick that is unplugged at random moments of the tour and plugged in again: its motors are off
# within the specified time, nothing is lost, and the tour continues when the user has turned the forces on again.
# Usage: unplugged.sh GEARSHIFT SOURCE_FOLDER STICK_EMULATOR [UNPLUGS [SEED]]
# Unplugs 10 times, or UNPLUGS times, rounded up to tens.
set -u
pairs=$(((${4:-10} + 9) / 10))
seed=${5:-$RANDOM}
source "$(dirname "${BASH_SOURCE[0]}")/sticks.sh"
echo "seed $seed"
RANDOM=$seed
write_calibrations complete

seconds() { echo "$(($1 / 1000)).$(printf %03d $(($1 % 1000)))"; } # from milliseconds
# Chooses five moments in a tour of about ten seconds. Must not run in a subshell, where the random numbers do not
# follow the seed.
choose_moments() {
  local ms=0
  moments=()
  for _ in 1 2 3 4 5; do
    ms=$((ms + 700 + RANDOM % 900))
    moments+=(--unplug-at "$(seconds $ms)")
    ms=$((ms + 150 + RANDOM % 750))
    moments+=(--replug-at "$(seconds $ms)")
  done
}

of_family=($families)
# [ms] Time limits until the motors are off. A stick powered by the bus stops at once; its limit is a tolerance of 20
# ms. A stick with its own power plays the current effect to the end, for at most 300 ms; its limit adds a tolerance of
# 30 ms.
declare -A power_option=([bus]= [wall]=--own-power) max_ms=([bus]=20 [wall]=330)
for ((i = 0; i < pairs; ++i)); do
  family=${of_family[$(((seed + i) % 3))]}
  for power in bus wall; do
    choose_moments
    (tour $family.$power.$i $family ${power_option[$power]} "${moments[@]}" && touch $family.$power.$i.ok) & running+=($!)
  done
  wait
  running=()
  for power in bus wall; do
    run=$family.$power.$i
    check "$run: the tour succeeds" [ -e $run.ok ]
    check "$run: every gear is engaged, in order" in_order $run
    # Only four of the five reports are required, because the last unplug may coincide with the last gear. Five requests
    # for Enter are required: one per report, and one at the start, when the forces are off.
    check "$run: each unplug is reported" printed "was unplugged" $run 4
    check "$run: and each reconnection" printed "is connected again; its motors are still off" $run 4
    check "$run: only Enter restored its forces" printed "press Enter" $run 5
    check "$run: its motors were off in ${max_ms[$power]} ms" silent_within ${max_ms[$power]} $run "the unplug"
    check "$run: the whole drive is saved" replays $run
    sed -n "s/^stick_emulator: zero force \([0-9]*\) ms after the unplug.*/$family, $power: \1 ms/p" $run.err
  done
done
finish
