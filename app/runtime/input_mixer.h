// Selects the hand and the controls that the lever receives. Normally these are the user's hand and controls. If a
// driver function drives, they are the driver's, but slope and guidance are the instructor's.
//
// This class is the only writer of the hand's target and of the controls. The frame's thread and the driver's thread
// call it, one at a time. The haptic thread reads the newest values and never waits.
#pragma once

#include <mutex>

#include "app/vehicle/drive_sample.h"
#include "haptics/rt/latest_value.h"

namespace gearshift::runtime {

class InputMixer {
 public:
  // `driven`: a driver function drives, so only slope and guidance from set_controls() are used. `first`: initial hand
  // and controls. `channel` receives the controls and must outlive this object.
  InputMixer(bool driven, const vehicle::DriverAction& first, haptics::LatestValue<haptics::DriverControls>& channel);

  void set_hand(const haptics::HandTarget& target);            // the user's hand; ignored if a driver function drives
  void set_controls(const haptics::DriverControls& controls);  // the user's controls, or the instructor's if driven
  void act(const vehicle::DriverAction& action);               // the driver function's hand and controls

  haptics::LatestValue<haptics::HandTarget>& hand() noexcept { return hand_; }  // read by the device's hand

 private:
  const bool driven_;
  std::mutex mutex_;  // guards everything below
  haptics::DriverControls controls_;
  haptics::LatestValue<haptics::DriverControls>& channel_;
  haptics::LatestValue<haptics::HandTarget> hand_;
};

}  // namespace gearshift::runtime
