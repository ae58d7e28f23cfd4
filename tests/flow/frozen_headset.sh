#!/usr/bin/env bash
# A hung OpenXR runtime must not keep a force on. Freezes the runtime for ever in each of the calls that the program
# makes, one by one, while the emulated stick presses into a wall with the forces on. Prints a row per call: the time from
# the STOP key to zero force on the wire, and from SIGTERM to the end of the program.
# Usage: frozen_headset.sh GEARSHIFT SOURCE_FOLDER STICK_EMULATOR MANIFEST [CALL...]
set -u
needs_machine=yes
life=1800
manifest=$4
flows=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$flows/sticks.sh"
source "$flows/window.sh"
source "$flows/worn.sh"
write_calibrations complete
puts_on=launch size=320x200

opening="EnumerateInstanceExtensionProperties CreateInstance GetInstanceProperties GetSystem GetSystemProperties
  EnumerateViewConfigurationViews EnumerateEnvironmentBlendModes GetVulkanGraphicsRequirements2KHR CreateVulkanInstanceKHR
  GetVulkanGraphicsDevice2KHR CreateVulkanDeviceKHR CreateSession EnumerateReferenceSpaces CreateReferenceSpace
  EnumerateSwapchainFormats CreateSwapchain EnumerateSwapchainImages StringToPath CreateActionSet CreateAction
  SuggestInteractionProfileBindings AttachSessionActionSets CreateActionSpace BeginSession"
framing="PollEvent WaitFrame BeginFrame SyncActions LocateViews LocateSpace GetActionStateBoolean GetActionStateVector2f
  AcquireSwapchainImage WaitSwapchainImage ReleaseSwapchainImage EndFrame ConvertTimespecTimeToTimeKHR"
closing="RequestExitSession DestroySpace DestroySwapchain DestroyActionSet DestroySession DestroyInstance"
calls="CreateInstance PollEvent WaitFrame EndFrame DestroySession"
is_full_run && calls="$opening $framing EndSession $closing"
[ $# -gt 4 ] && calls=${*:5}

is_one_of() { [[ " $(echo $2) " == *" $1 "* ]]; }
hangs() { grep -q "^hangs xr$1$" "$log/log.txt" 2>/dev/null; }
order() { echo "$*" >&8; }
zero_after() { sed -n "s/^stick_emulator: zero force \([0-9]*\) ms after $1 .*/\1/p" "$log.err"; }
stopped_at() { sed -n 's/^stick_emulator: zero force .* after STOP (\([0-9.]*\) s)/\1/p' "$log.err"; }
# The process of the trainer, below timeout, umockdev-wrapper and the emulator.
descendants() { local child; for child in $(pgrep -P "$1"); do echo "$child"; descendants "$child"; done; }
program() { local pid; for pid in $(descendants $trainer); do [ "$(readlink /proc/$pid/exe)" = "$gearshift" ] && echo "$pid"; done; }
milliseconds_since() { awk -v a="$1" -v b="$EPOCHREALTIME" 'BEGIN {printf "%.0f", 1000 * (b - a)}'; }

gearshift=$(readlink -f "$gearshift")
printf '    %-40s %12s %14s\n' "frozen in" "STOP [ms]" "SIGTERM [ms]"
for call in $calls; do
  run=frozen_$call
  mkfifo "$run.orders"
  exec 8<>"$run.orders"
  beneath=(umockdev-wrapper "$emulator" --family openffboard --own-power --orders "$run.orders" --)
  at=4
  is_one_of "$call" "$opening" && at=0
  check "$call: it starts" wear "$run" --device ffboard --preset ./patient.toml --lesson none --car none --gate paper < <(
    printf '[[hang]]\nfunction = "xr%s"\nat = %s\n' "$call" "$([ "$call" = EndSession ] || is_one_of "$call" "$closing" && echo 0 || echo $at)"
    [ "$call" = EndSession ] && at 4 stopping
    is_one_of "$call" "$closing" && at 4 instance_loss)
  xdotool windowfocus "$window" 2>/dev/null
  check "$call: Enter turns the forces on" press_for Return "forces on" 1
  order go 15 0
  check "$call: it hangs" within 30 hangs "$call"
  order go 15 14 # presses into the wall next to a slot
  sleep 0.8
  order mark STOP
  xdotool key space
  sleep 1.2
  pid=$(program)
  began=$EPOCHREALTIME
  kill -TERM "$pid"
  for _ in $(seq 1000); do [ -d "/proc/$pid" ] && ! grep -q "^State:.Z" "/proc/$pid/status" 2>/dev/null || break; sleep 0.01; done
  ended=$(milliseconds_since "$began")
  [ -d "/proc/$pid" ] && kill -KILL "$pid"
  wait $trainer
  [ -z "${GEARSHIFT_DEBUG:-}" ] || tail -n 5 "$run.err" "$run.txt" "$run/log.txt"
  zero=$(zero_after STOP)
  printf '    %-40s %12s %14s\n' "xr$call" "$zero" "$ended"
  # Until STOP the motors pushed: the last force after the start is as late as STOP.
  check "$call: the motors pushed" awk -v last="$(zero_after "the start")" -v stop="$(stopped_at)" 'BEGIN {exit !(last > 1000 * stop - 100)}'
  # The goal is 50 ms. The figure contains the start of xdotool, and other work on the machine delays both.
  check "$call: STOP" [ "${zero:-10000}" -le "${GEARSHIFT_STOP_MS:-150}" ]
  check "$call: SIGTERM" [ "$ended" -le 1000 ]
  check "$call: one sentence at most for each event" [ "$(grep -vc "^stick_emulator" "$run.err")" -le 3 ]
done
finish
