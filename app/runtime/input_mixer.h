// Selects the hand and the controls that the loop receives. Normally these are the user's hand and controls. If a
// driver function drives, they are the driver's, but slope and guidance are the instructor's.
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
  // `driven`: a driver function drives, so only slope and guidance from set_controls() are used. `first`: initial hand
  // and controls.
  InputMixer(bool driven, const vehicle::DriverAction& first)
      : driven_(driven), controls_(first.controls), hand_(first.hand) {}

  // Sends the controls to the loop with these channels from now on, beginning with the current controls. The loop must
  // not be running yet. The channels must stay valid until connect() is called with new ones.
  void connect(haptics::LoopChannels& channels);

  void set_hand(const haptics::HandTarget& target);            // the user's hand; ignored if a driver function drives
  void set_controls(const haptics::DriverControls& controls);  // the user's controls, or the instructor's if driven
  void act(const vehicle::DriverAction& action);               // the driver function's hand and controls
  // The user's keyboard pedals. For each pedal, the loop receives this position or the one from set_controls(),
  // whichever is pressed further.
  void press(const haptics::DriverControls& pedals);

  haptics::LatestValue<haptics::HandTarget>& hand() noexcept { return hand_; }  // read by the device's hand

 private:
  void write();

  const bool driven_;
  std::mutex mutex_;  // guards everything below
  haptics::LoopChannels* channels_ = nullptr;
  haptics::DriverControls controls_;               // from set_controls() and act()
  std::optional<haptics::DriverControls> pedals_;  // from press()
  haptics::LatestValue<haptics::HandTarget> hand_;
};

}  // namespace gearshift::runtime
