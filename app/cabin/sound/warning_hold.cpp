#include "app/cabin/sound/warning_hold.h"

#include <algorithm>
#include <utility>

namespace gearshift::cabin {

WarningHold::Now WarningHold::update(bool lasts, double time) {
  const bool is_cause = std::exchange(has_begun_, false) || lasts;
  if (is_cause && !is_audible_) {
    is_audible_ = true;
    until_ = time + length_;
    return {true, true};
  }
  until_ = std::min(until_, time + std::max(length_, hold_));
  if (is_cause) until_ = std::max(until_, time + hold_);
  is_audible_ = is_cause || time < until_;
  return {is_audible_, false};
}

}  // namespace gearshift::cabin
