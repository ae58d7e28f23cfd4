// Undo history of the tuning. It has two slots, A and B, which the user can compare with one click.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "haptics/loop/haptic_config.h"

namespace gearshift::ui {

enum class TuningSlot : int { a, b };

class TuningHistory {
 public:
  explicit TuningHistory(const haptics::HapticTuning& start = {});  // start: initial tuning of both slots

  const haptics::HapticTuning& current() const noexcept;
  TuningSlot slot() const noexcept { return slot_; }

  // Adds an undo step. same_drag: this change comes from the same drag of a slider as the previous change; both become
  // one step.
  void change(const haptics::HapticTuning& tuning, bool same_drag = false);
  void undo() noexcept;  // no effect if there is nothing to undo
  void redo() noexcept;
  void reset();                                      // returns to the start tuning; can be undone
  void switch_slot() noexcept;                       // adds no undo step: each slot has its own history
  void restart(const haptics::HapticTuning& start);  // call for a new run; resets both slots and clears their history

  bool can_undo() const noexcept;
  bool can_redo() const noexcept;

 private:
  struct Track {
    std::vector<haptics::HapticTuning> steps;  // never empty
    std::size_t now = 0;
  };
  static constexpr std::size_t kMaxSteps = 500;
  Track& track() noexcept { return tracks_[static_cast<std::size_t>(slot_)]; }
  const Track& track() const noexcept { return tracks_[static_cast<std::size_t>(slot_)]; }

  std::array<Track, 2> tracks_;
  haptics::HapticTuning start_;
  TuningSlot slot_ = TuningSlot::a;
};

}  // namespace gearshift::ui
