// Rules of arming and motors-off. Runtime has one state, whether forces are wanted, and only this table changes it. A
// force comes back by a person only: `on` appears beside a user's action, and at the start of a simulated lever, which
// cannot hurt anybody.
//
// Two rules act in the haptic cycle, because they must not wait for a frame. Held down, the stick's panic button
// switches the motors off and refuses arming (HapticLoop::arm); the table sees this as `fault`. A simulated lever whose
// fault has passed gets its forces back by itself (rearms_itself()); the table does not see this as a fault.
#pragma once

#include <algorithm>
#include <cstddef>

namespace gearshift::runtime {

enum class ForceCause {
  start,               // the session's first lever
  user_arms,           // Enter, or "Forces on"; refused while the stick is not plugged in
  user_disarms,        // "Forces off"
  user_stops,          // STOP
  fault,               // the guard ended the forces or refused to arm, or a stick's new lever could not be made
  new_lever,           // another gate, car, hand or preset, or a lesson
  new_lever_of_armed,  // the same in the frame in which the user armed, as Enter on the lesson card does
  stick_lost,          // the stick was unplugged
  recording            // a recording starts, in a new loop; its end changes nothing
};
enum class ForceEffect {
  keep,
  on,         // forces ramp up from zero
  off,        // no forces
  motors_off  // no forces at once, and the motors switched off, as by an emergency stop button
};
struct ForceRule {
  ForceCause cause;
  ForceEffect simulated, stick;  // effect on the forces of a simulated lever and of a real stick
};
inline constexpr ForceRule kForceRules[] = {
    {ForceCause::start, ForceEffect::on, ForceEffect::off},
    {ForceCause::user_arms, ForceEffect::on, ForceEffect::on},
    {ForceCause::user_disarms, ForceEffect::off, ForceEffect::off},
    {ForceCause::user_stops, ForceEffect::motors_off, ForceEffect::motors_off},
    {ForceCause::fault, ForceEffect::motors_off, ForceEffect::motors_off},
    {ForceCause::new_lever, ForceEffect::keep, ForceEffect::off},
    {ForceCause::new_lever_of_armed, ForceEffect::keep, ForceEffect::keep},
    {ForceCause::stick_lost, ForceEffect::keep, ForceEffect::motors_off},
    {ForceCause::recording, ForceEffect::keep, ForceEffect::keep},
};
constexpr const ForceRule& rule_of(ForceCause cause) {
  return kForceRules[static_cast<std::size_t>(cause)];
}
static_assert(std::ranges::all_of(kForceRules, [](const ForceRule& rule) { return &rule_of(rule.cause) == &rule; }),
              "the rules are in the order of ForceCause");

constexpr ForceEffect force_effect(ForceCause cause, bool is_stick) {
  return is_stick ? rule_of(cause).stick : rule_of(cause).simulated;
}
// True if forces are wanted after this. `before`: they were wanted before.
constexpr bool wants_forces_after(ForceCause cause, bool is_stick, bool before) {
  const ForceEffect effect = force_effect(cause, is_stick);
  return effect == ForceEffect::keep ? before : effect == ForceEffect::on;
}

}  // namespace gearshift::runtime
