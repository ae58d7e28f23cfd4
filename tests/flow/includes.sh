#!/usr/bin/env bash
# The direction of the house: every include stays within the rooms that its own room links (haptics/CMakeLists.txt).
# Usage: includes.sh SOURCE_FOLDER
set -u
cd "$1" || exit 1

declare -A sees=(
  [files]="" [rt]="" [joystick]=""
  [gate]="files" [device]="joystick rt" [contact]="gate device files joystick rt"
  [analysis]="contact safety gate device files joystick rt"
  [safety]="device joystick rt" [loop]="analysis contact safety rt gate device files joystick"
)
failed=0
passed=0
for room in "${!sees[@]}"; do
  for file in haptics/"$room"/*.h haptics/"$room"/*.cpp; do
    passed=$((passed + 1))
    while read -r target; do
      case " $room ${sees[$room]} " in
        *" $target "*) ;;
        *) echo "FAILED: $file includes haptics/$target"; failed=$((failed + 1)) ;;
      esac
    done < <(grep -hoE '^#include "haptics/[a-z]+' "$file" | sed 's/.*haptics.//')
    if grep -qE '^#include "(app|engine|tests)/' "$file"; then
      echo "FAILED: $file looks out of haptics"
      failed=$((failed + 1))
    fi
  done
done
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
