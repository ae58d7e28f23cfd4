// Selects whose hand and pedals the loop receives: a person's, or those of a driver function plus the instructor's.
//
// This class is the only writer of the hand and controls channels. It is called from the frame's and the driver's
// threads, one at a time. The haptic thread only reads the channels and never waits.
#pragma once

#include <mutex>
#include <optional>

#include "app/vehicle/drive_sample.h"
#include "haptics/loop/haptic_loop.h"
#include "haptics/rt/latest_value.h"

namespace gearshift::runtime {

class InputMixer {
 public:
  // driven: a driver function acts; from the frame's controls only the slope and the guidance are used.
  InputMixer(bool driven, const vehicle::DriverAction& first)
      : driven_(driven), controls_(first.controls), hand_(first.hand) {}

  // Connects the controls to that loop and writes the current ones at once. The loop must not run yet, and must outlive
  // the next call.
  void connect(haptics::LoopChannels& channels);

  void set_hand(const haptics::HandTarget& target);            // a person's hand; ignored if a driver acts
  void set_controls(const haptics::DriverControls& controls);  // a person's or the instructor's
  void act(const vehicle::DriverAction& action);               // the driver's
  void press(
      const haptics::DriverControls& pedals);  // a person's pedals: each is the deeper of this and set_controls()

  haptics::LatestValue<haptics::HandTarget>& hand() noexcept { return hand_; }  // read by the device's hand

 private:
  void write();

  const bool driven_;
  std::mutex mutex_;  // guards everything below
  haptics::LoopChannels* channels_ = nullptr;
  haptics::DriverControls controls_;               // the person's or the driver's
  std::optional<haptics::DriverControls> pedals_;  // the person's pedals
  haptics::LatestValue<haptics::HandTarget> hand_;
};

}  // namespace gearshift::runtime
