#include "app/trainer/driver_seat.h"

#include <algorithm>

namespace gearshift {
namespace {

// The driver's pedals and keys on the teacher's road, under the teacher's hand.
DriverControls merged(const DriverControls& driver, const DriverControls& teacher) noexcept {
  DriverControls both = driver;
  both.slope = teacher.slope;
  both.guided_gear = teacher.guided_gear;
  both.guidance = teacher.guidance;
  return both;
}

// A pedal is where it is deepest.
DriverControls pressed(const DriverControls& person, const DriverControls& pedals) noexcept {
  DriverControls both = person;
  both.throttle = std::max(person.throttle, pedals.throttle);
  both.brake = std::max(person.brake, pedals.brake);
  both.clutch = std::max(person.clutch, pedals.clutch);
  return both;
}

}  // namespace

void DriverSeat::connect(LoopChannels& channels) {
  const std::lock_guard lock(mutex_);
  channels_ = &channels;
  write();
}

void DriverSeat::set_hand(const HandTarget& target) {
  const std::lock_guard lock(mutex_);
  if (!driven_) hand_.write(target);
}

void DriverSeat::set_controls(const DriverControls& controls) {
  const std::lock_guard lock(mutex_);
  controls_ = driven_ ? merged(controls_, controls) : controls;
  write();
}

void DriverSeat::act(const DriverAction& action) {
  const std::lock_guard lock(mutex_);
  hand_.write(action.hand);
  controls_ = merged(action.controls, controls_);
  write();
}

void DriverSeat::press(const DriverControls& pedals) {
  const std::lock_guard lock(mutex_);
  pedals_ = pedals;
  write();
}

void DriverSeat::write() {
  if (channels_ != nullptr) channels_->controls.write(pedals_ ? pressed(controls_, *pedals_) : controls_);
}

}  // namespace gearshift
