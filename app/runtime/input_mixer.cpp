#include "app/runtime/input_mixer.h"

#include <algorithm>

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

// Returns `person` with each pedal pressed as far as in `person` or `pedals`, whichever is further.
haptics::DriverControls pressed(const haptics::DriverControls& person, const haptics::DriverControls& pedals) noexcept {
  haptics::DriverControls both = person;
  both.throttle = std::max(person.throttle, pedals.throttle);
  both.brake = std::max(person.brake, pedals.brake);
  both.clutch = std::max(person.clutch, pedals.clutch);
  return both;
}

}  // namespace

void InputMixer::connect(haptics::LoopChannels& channels) {
  const std::lock_guard lock(mutex_);
  channels_ = &channels;
  write();
}

void InputMixer::set_hand(const haptics::HandTarget& target) {
  const std::lock_guard lock(mutex_);
  if (!driven_) hand_.write(target);
}

void InputMixer::set_controls(const haptics::DriverControls& controls) {
  const std::lock_guard lock(mutex_);
  controls_ = driven_ ? merged(controls_, controls) : controls;
  write();
}

void InputMixer::act(const vehicle::DriverAction& action) {
  const std::lock_guard lock(mutex_);
  hand_.write(action.hand);
  controls_ = merged(action.controls, controls_);
  write();
}

void InputMixer::press(const haptics::DriverControls& pedals) {
  const std::lock_guard lock(mutex_);
  pedals_ = pedals;
  write();
}

void InputMixer::write() {
  if (channels_ != nullptr) channels_->controls.write(pedals_ ? pressed(controls_, *pedals_) : controls_);
}

}  // namespace gearshift::runtime
