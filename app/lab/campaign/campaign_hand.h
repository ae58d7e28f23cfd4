// The scripted hand of a case: shifts, wrong aims, pushes, and two long holds during which the hand keeps still.
#pragma once

#include <vector>

#include "app/lab/campaign/campaign_case.h"
#include "haptics/device/scripted_hand.h"
#include "haptics/gate/gate.h"

namespace gearshift::lab {

// A shift that the hand tries. The gear should be engaged at time `end`.
struct TriedShift {
  int gear = haptics::kNeutralGear;
  double end = 0.0;    // [s] time at which the hand has finished resting in the gear
  bool clean = false;  // the hand aims straight at the gear, without noise or detours
};

// A period in which the hand keeps still: from kSettling after `begin` until `end`, its target and push are constant.
struct Hold {
  double begin = 0.0, end = 0.0;  // [s]
};
inline constexpr double kSettling = 0.5;  // [s]

struct HandScript {
  std::vector<haptics::HandStroke> strokes;
  std::vector<TriedShift> shifts;
  std::vector<Hold> holds;
};

HandScript make_script(const haptics::Gate& gate, const CampaignCase& drawn, glm::dvec2 start);

// Follows the script with a tremor, and keeps still during the holds.
class CampaignHand final : public haptics::HandDriver {
 public:
  // The script must outlive this object.
  CampaignHand(const CampaignCase& drawn, const HandScript& script, glm::dvec2 start);

  haptics::HandTarget next(double time, glm::dvec2 lever) noexcept override;

  double duration() const noexcept { return script_hand_.duration(); }  // [s]
  double time() const noexcept { return time_; }                        // [s] simulated time including jitter
  const haptics::HandTarget& last() const noexcept { return last_; }    // target in the last period

 private:
  const Hold* hold_at(double time) noexcept;

  const HandScript& script_;
  CaseManner manner_;
  haptics::ScriptedHand script_hand_;
  std::size_t hold_ = 0;  // index of the current or next hold
  bool is_still_ = false;
  double time_ = 0.0;
  haptics::HandTarget last_;
};

}  // namespace gearshift::lab
