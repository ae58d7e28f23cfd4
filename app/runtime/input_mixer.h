// Selects the hand and controls that the loop receives: the user's; or, if a driver function drives, the driver's with
// the instructor's slope and guidance.
//
// This class is the only writer of the hand and controls channels. The frame's thread and the driver's thread call it,
// one at a time. The haptic thread only reads the channels and never waits.
#pragma once

#include <mutex>
#include <optional>

#include "app/vehicle/drive_sample.h"
#include "haptics/loop/haptic_loop.h"
#include "haptics/rt/latest_value.h"

namespace gearshift::runtime {

class InputMixer {
 public:
  // driven: a driver function drives, so only slope and guidance from set_controls() are used. first: hand and controls
  // at the start.
  InputMixer(bool driven, const vehicle::DriverAction& first)
      : driven_(driven), controls_(first.controls), hand_(first.hand) {}

  // Sends the controls to the loop of these channels from now on, beginning with the current ones. The loop must not
  // run yet. The channels must stay valid until connect() is called with new ones.
  void connect(haptics::LoopChannels& channels);

  void set_hand(const haptics::HandTarget& target);            // the user's hand; ignored if a driver function drives
  void set_controls(const haptics::DriverControls& controls);  // the user's controls, or the instructor's if driven
  void act(const vehicle::DriverAction& action);               // the driver function's hand and controls
  // The user's keyboard pedals; the loop receives the deeper one of these and of set_controls().
  void press(const haptics::DriverControls& pedals);

  haptics::LatestValue<haptics::HandTarget>& hand() noexcept { return hand_; }  // for the device's hand, which reads it

 private:
  void write();

  const bool driven_;
  std::mutex mutex_;  // guards everything below
  haptics::LoopChannels* channels_ = nullptr;
  haptics::DriverControls controls_;               // the user's, or the driver's with the instructor's
  std::optional<haptics::DriverControls> pedals_;  // from press()
  haptics::LatestValue<haptics::HandTarget> hand_;
};

}  // namespace gearshift::runtime
