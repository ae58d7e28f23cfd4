#!/usr/bin/env bash
# A force-feedback stick that is unplugged at random moments of the tour and plugged in again: its motors are off within
# the specified time, nothing is lost, and the tour continues when a person has armed it.
# Usage: unplugged.sh GEARSHIFT SOURCE_FOLDER STICK_EMULATOR [UNPLUGS [SEED]]: 10 times, or UNPLUGS rounded up to tens
set -u
pairs=$(((${4:-10} + 9) / 10))
seed=${5:-$RANDOM}
source "$(dirname "${BASH_SOURCE[0]}")/sticks.sh"
echo "seed $seed"
RANDOM=$seed
all_known whole

seconds() { echo "$(($1 / 1000)).$(printf %03d $(($1 % 1000)))"; } # from milliseconds
# five in a tour of about ten seconds; not in a subshell, whose random numbers are not reproducible with a seed
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
declare -A feed=([bus]= [wall]=--own-power) most=([bus]=20 [wall]=330) # [ms] an effect lasts 300 ms
for ((i = 0; i < pairs; ++i)); do
  family=${of_family[$(((seed + i) % 3))]}
  for power in bus wall; do
    choose_moments
    (tour $family.$power.$i $family ${feed[$power]} "${moments[@]}" && touch $family.$power.$i.ok) & running+=($!)
  done
  wait
  running=()
  for power in bus wall; do
    run=$family.$power.$i
    check "$run: the tour comes to its end" [ -e $run.ok ]
    check "$run: every gear of it, in order" in_order $run
    check "$run: each time it was reported" printed "was unplugged" $run 4 # the last one may coincide with the last gear
    check "$run: and its return" printed "is connected again: its motors are off" $run 4
    check "$run: only Enter restored its forces" printed "press Enter" $run 5
    check "$run: its motors were off in ${most[$power]} ms" silent_within ${most[$power]} $run "the unplug"
    check "$run: the whole drive is saved" replays $run
    sed -n "s/^stick_emulator: zero force \([0-9]*\) ms after the unplug.*/$family, $power: \1 ms/p" $run.err
  done
done
finish
