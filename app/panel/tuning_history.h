// What was tuned, step by step, in two slots A and B that are compared by one press.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "haptics/loop/haptic_config.h"

namespace gearshift {

enum class TuningSlot : int { a, b };

class TuningHistory {
 public:
  explicit TuningHistory(const HapticTuning& start = {});  // in both slots

  const HapticTuning& current() const noexcept;
  TuningSlot slot() const noexcept { return slot_; }

  // One step, which undo takes back whole. goes_on: the same drag as the last change, and the same step.
  void change(const HapticTuning& tuning, bool goes_on = false);
  void undo() noexcept;  // nothing where there is nothing
  void redo() noexcept;
  void reset();                             // to the start, as a step
  void other_slot() noexcept;               // no step: each slot has its own
  void restart(const HapticTuning& start);  // another run: both slots, all steps forgotten

  bool can_undo() const noexcept;
  bool can_redo() const noexcept;

 private:
  struct Track {
    std::vector<HapticTuning> steps;  // never empty
    std::size_t now = 0;
  };
  static constexpr std::size_t kMostSteps = 500;
  Track& track() noexcept { return tracks_[static_cast<std::size_t>(slot_)]; }
  const Track& track() const noexcept { return tracks_[static_cast<std::size_t>(slot_)]; }

  std::array<Track, 2> tracks_;
  HapticTuning start_;
  TuningSlot slot_ = TuningSlot::a;
};

}  // namespace gearshift
