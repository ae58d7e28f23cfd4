// Whose hand and feet the loop gets: a person's, or a driver's with a teacher beside him.
//
// The channels of hand and controls have one writer: this, from the frame's thread and the driver's, one at a time. The
// haptic thread only reads the channels and never waits.
#pragma once

#include <mutex>
#include <optional>

#include "app/training/drive_sample.h"
#include "haptics/loop/haptic_loop.h"
#include "haptics/rt/latest_value.h"

namespace gearshift {

class DriverSeat {
 public:
  // driven: a driver acts, and of the frame's controls the road and the teacher's guidance count alone.
  DriverSeat(bool driven, const DriverAction& first) : driven_(driven), controls_(first.controls), hand_(first.hand) {}

  // The controls go to that loop from now on, those of now at once. It must not run yet, and must outlive the next
  // call.
  void connect(LoopChannels& channels);

  void set_hand(const HandTarget& target);            // of a person; nothing where one drives
  void set_controls(const DriverControls& controls);  // of a person, or of the teacher
  void act(const DriverAction& action);               // of the driver
  void press(const DriverControls& pedals);           // of a person's feet: the deeper of these and set_controls()'s

  LatestValue<HandTarget>& hand() noexcept { return hand_; }  // for the device's hand to read

 private:
  void write();

  const bool driven_;
  std::mutex mutex_;  // guards what stands below
  LoopChannels* channels_ = nullptr;
  DriverControls controls_;               // of the person or the driver
  std::optional<DriverControls> pedals_;  // of a person's feet
  LatestValue<HandTarget> hand_;
};

}  // namespace gearshift
