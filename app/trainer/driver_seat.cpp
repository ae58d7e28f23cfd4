#include "app/trainer/driver_seat.h"

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

}  // namespace

void DriverSeat::connect(LoopChannels& channels) {
  const std::lock_guard lock(mutex_);
  channels_ = &channels;
  write(controls_);
}

void DriverSeat::set_hand(const HandTarget& target) {
  const std::lock_guard lock(mutex_);
  if (!driven_) hand_.write(target);
}

void DriverSeat::set_controls(const DriverControls& controls) {
  const std::lock_guard lock(mutex_);
  write(driven_ ? merged(controls_, controls) : controls);
}

void DriverSeat::act(const DriverAction& action) {
  const std::lock_guard lock(mutex_);
  hand_.write(action.hand);
  write(merged(action.controls, controls_));
}

void DriverSeat::write(const DriverControls& controls) {
  controls_ = controls;
  if (channels_ != nullptr) channels_->controls.write(controls_);
}

}  // namespace gearshift
