#!/usr/bin/env bash
# The direction of the house: every include stays within the rooms that its own room links (the CMakeLists.txt of
# haptics, engine and app). Usage: includes.sh SOURCE_FOLDER
set -u
cd "$1" || exit 1

haptics="haptics/files haptics/rt haptics/joystick haptics/gate haptics/device haptics/contact haptics/analysis haptics/safety haptics/loop haptics/hid haptics/usb haptics/hardware"
shared="app/assets_path app/energy_words app/event_words app/hold_words app/limited_words app/output_folder app/print_out app/program_name app/user_cache"
pictures="engine/gpu engine/image engine/model engine/render engine/scene engine/ui engine/window engine/xr"
declare -A sees=(
  [haptics/files]="" [haptics/rt]="" [haptics/joystick]=""
  [haptics/gate]="haptics/files" [haptics/device]="haptics/joystick haptics/rt"
  [haptics/contact]="haptics/gate haptics/device haptics/files haptics/joystick haptics/rt"
  [haptics/analysis]="haptics/contact haptics/safety haptics/gate haptics/device haptics/files haptics/joystick haptics/rt"
  [haptics/safety]="haptics/device haptics/joystick haptics/rt" [haptics/loop]="haptics/files haptics/rt haptics/joystick haptics/gate haptics/device haptics/contact haptics/analysis haptics/safety"
  [haptics/hid]="" [haptics/usb]="haptics/files haptics/hid haptics/rt"
  [haptics/hardware]="haptics/device haptics/joystick haptics/files haptics/hid haptics/rt"
  [engine/image]="" [engine/model]="engine/image" [engine/scene]="engine/model engine/image"
  [engine/light]="engine/image" [engine/gpu]="engine/image"
  [engine/render]="engine/gpu engine/scene engine/light engine/model engine/image"
  [engine/ui]="engine/gpu engine/image" [engine/window]="engine/gpu engine/image" [engine/sound]=""
  [engine/xr]="engine/gpu engine/scene engine/model engine/image"
  [app/vehicle]="$haptics" [app/training]="$haptics app/vehicle"
  [app/history]="$haptics app/training app/vehicle"
  [app/replay]="$haptics app/training app/vehicle"
  [app/coach]="$haptics $shared app/training app/history app/vehicle"
  [app/draw]="$haptics" [app/bench]="$haptics app/draw tests/bench"
  [app/report]="$haptics $shared app/history app/training app/vehicle app/draw app/replay"
  [app/learner]="$haptics app/training app/vehicle"
  [app/devices]="$haptics $shared app/input engine/window engine/gpu engine/image"
  [app/trainer]="$haptics app/vehicle app/training" [app/input]="$haptics engine/window engine/gpu engine/image"
  [app/stage]="$haptics app/vehicle engine/scene engine/model engine/image"
  [app/cabin_sound]="$haptics app/vehicle engine/scene engine/model engine/image engine/sound"
  [app/headset]="$haptics app/stage app/vehicle engine/xr engine/gpu engine/scene engine/model engine/image"
  [app/panel]="$haptics $shared app/trainer app/vehicle app/training app/history app/coach app/replay app/headset app/stage engine/xr engine/scene engine/model engine/ui engine/gpu engine/image"
  [app/view]="$haptics $shared app/stage app/vehicle $pictures"
  [app/train]="$haptics $shared app/devices app/input app/trainer app/vehicle app/training app/history app/coach app/replay app/learner app/stage app/cabin_sound app/panel app/headset app/view engine/sound $pictures"
)
failed=0
passed=0
for room in "${!sees[@]}"; do
  for file in "$room"/*.h "$room"/*.cpp; do
    passed=$((passed + 1))
    while read -r target; do
      case " $room ${sees[$room]} " in
        *" $target "*) ;;
        *) echo "FAILED: $file includes $target"; failed=$((failed + 1)) ;;
      esac
    done < <(grep -hoE '^#include "(haptics|engine|app|tests)/[a-z_]*' "$file" | sed 's/.*"//')
  done
done
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
