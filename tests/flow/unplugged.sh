#!/usr/bin/env bash
# A force-feedback stick that is pulled out at random moments of the tour, and plugged in again: its motors are off in the
# stated time, nothing is lost, and the tour goes on when a person has armed it.
# Usage: unplugged.sh GEARSHIFT SOURCE_FOLDER STICK_EMULATOR [UNPLUGS [SEED]]: 5, or as many fives as are asked for
set -u
tours=$(((${4:-5} + 4) / 5))
seed=${5:-$RANDOM}
source "$(dirname "${BASH_SOURCE[0]}")/sticks.sh"
echo "seed $seed"
RANDOM=$seed
all_known whole

seconds() { echo "$(($1 / 1000)).$(printf %03d $(($1 % 1000)))"; } # of milliseconds
moments() { # of five, in a tour of some ten seconds
  local ms=0
  for _ in 1 2 3 4 5; do
    ms=$((ms + 700 + RANDOM % 900))
    echo "--unplug-at $(seconds $ms)"
    ms=$((ms + 150 + RANDOM % 750))
    echo "--replug-at $(seconds $ms)"
  done
}

of_family=($families)
for ((i = 0; i < tours; ++i)); do
  family=${of_family[$(((seed + i) % 3))]} power=bus most=20
  # Of one tour it is the harder case: an effect lasts 300 ms.
  [ $tours = 1 ] || [ $((RANDOM % 2)) = 1 ] && power=wall most=330
  run=$family.$i
  check "$run: the tour comes to its end" tour $run $family $([ $power = wall ] && echo --own-power) $(moments)
  check "$run: every gear of it, in order" in_order $run
  check "$run: each time it was told" said "was unplugged" $run 4 # the last may come with the last gear
  check "$run: and that it is back" said "is back: its motors are off" $run 4
  check "$run: its forces came back by Enter alone" said "press Enter" $run 5
  check "$run: its motors were off in $most ms" silent_within $most $run "the unplug"
  check "$run: the whole drive is kept" replays $run
  sed -n "s/^stick_emulator: zero force \([0-9]*\) ms after the unplug.*/$family, $power: \1 ms/p" $run.err
done
finish
