#include "app/runtime/input_mixer.h"

namespace gearshift::runtime {
namespace {

// Combines the driver's controls with the instructor's slope and guidance.
haptics::DriverControls merged(const haptics::DriverControls& driver,
                               const haptics::DriverControls& instructor) noexcept {
  haptics::DriverControls both = driver;
  both.slope = instructor.slope;
  both.guided_gear = instructor.guided_gear;
  both.guidance = instructor.guidance;
  return both;
}

}  // namespace

InputMixer::InputMixer(bool driven, const vehicle::DriverAction& first,
                       haptics::LatestValue<haptics::DriverControls>& channel)
    : driven_(driven), controls_(first.controls), channel_(channel), hand_(first.hand) {
  channel_.write(controls_);
}

void InputMixer::set_hand(const haptics::HandTarget& target) {
  const std::lock_guard lock(mutex_);
  if (!driven_) hand_.write(target);
}

void InputMixer::set_controls(const haptics::DriverControls& controls) {
  const std::lock_guard lock(mutex_);
  controls_ = driven_ ? merged(controls_, controls) : controls;
  channel_.write(controls_);
}

void InputMixer::act(const vehicle::DriverAction& action) {
  const std::lock_guard lock(mutex_);
  hand_.write(action.hand);
  controls_ = merged(action.controls, controls_);
  channel_.write(controls_);
}

}  // namespace gearshift::runtime
