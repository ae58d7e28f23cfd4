#include "app/cabin_sound/warning_hold.h"

#include <algorithm>
#include <utility>

namespace gearshift {

WarningHold::Now WarningHold::update(bool lasts, double time) {
  const bool is_cause = std::exchange(begun_, false) || lasts;
  if (is_cause && !heard_) {
    heard_ = true;
    until_ = time + length_;
    return {true, true};
  }
  until_ = std::min(until_, time + std::max(length_, hold_));
  if (is_cause) until_ = std::max(until_, time + hold_);
  heard_ = is_cause || time < until_;
  return {heard_, false};
}

}  // namespace gearshift
