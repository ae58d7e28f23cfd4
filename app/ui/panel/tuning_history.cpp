#include "app/ui/panel/tuning_history.h"

namespace gearshift::ui {

TuningHistory::TuningHistory(const haptics::HapticTuning& start) {
  restart(start);
}

const haptics::HapticTuning& TuningHistory::current() const noexcept {
  return track().steps[track().now];
}

void TuningHistory::change(const haptics::HapticTuning& tuning, bool same_drag) {
  Track& t = track();
  if (tuning == current()) return;
  t.steps.resize(t.now + 1);  // drops the steps that the user has undone
  if (same_drag && t.now > 0) {
    t.steps.back() = tuning;
    return;
  }
  t.steps.push_back(tuning);
  if (t.steps.size() > kMaxSteps) t.steps.erase(t.steps.begin());
  t.now = t.steps.size() - 1;
}

void TuningHistory::undo() noexcept {
  if (can_undo()) --track().now;
}

void TuningHistory::redo() noexcept {
  if (can_redo()) ++track().now;
}

void TuningHistory::reset() {
  change(start_);
}

void TuningHistory::switch_slot() noexcept {
  slot_ = slot_ == TuningSlot::a ? TuningSlot::b : TuningSlot::a;
}

void TuningHistory::restart(const haptics::HapticTuning& start) {
  start_ = start;
  slot_ = TuningSlot::a;
  for (Track& t : tracks_) t = {{start}, 0};
}

bool TuningHistory::can_undo() const noexcept {
  return track().now > 0;
}

bool TuningHistory::can_redo() const noexcept {
  return track().now + 1 < track().steps.size();
}

}  // namespace gearshift::ui
