// What the hand of a case does: shifts, wrong aims, pushes, and two long holds in which it keeps still.
#pragma once

#include <vector>

#include "haptics/device/scripted_hand.h"
#include "haptics/gate/gate.h"
#include "tests/bench/campaign/campaign_case.h"

namespace gearshift {

// A shift that was tried: at `end` the gear should be in.
struct TriedShift {
  int gear = kNeutralGear;
  double end = 0.0;    // [s] the hand has dwelt
  bool clean = false;  // aimed at, and nothing but that
};

// The hand keeps still: target and push as they were kSettling after the beginning.
struct Hold {
  double begin = 0.0, end = 0.0;  // [s]
};
inline constexpr double kSettling = 0.5;  // [s]

struct HandScript {
  std::vector<HandStroke> strokes;
  std::vector<TriedShift> shifts;
  std::vector<Hold> holds;
};

HandScript make_script(const Gate& gate, const CampaignCase& drawn, glm::dvec2 start);

// Follows the script, trembles, and keeps still in the holds.
class CampaignHand final : public HandDriver {
 public:
  // The script must outlive the hand.
  CampaignHand(const CampaignCase& drawn, const HandScript& script, glm::dvec2 start);

  HandTarget next(double time, glm::dvec2 lever) noexcept override;

  double duration() const noexcept { return script_hand_.duration(); }  // [s]
  double time() const noexcept { return time_; }                        // [s] on the hand's clock, jitter included
  const HandTarget& last() const noexcept { return last_; }             // what it did in the last period

 private:
  const Hold* hold_at(double time) noexcept;

  const HandScript& script_;
  CaseManner manner_;
  ScriptedHand script_hand_;
  std::size_t hold_ = 0;  // now or next
  bool keeps_still_ = false;
  double time_ = 0.0;
  HandTarget last_;
};

}  // namespace gearshift
