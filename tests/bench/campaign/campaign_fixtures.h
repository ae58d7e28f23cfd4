// What the campaign's tests share: the shipped gates, a case without anything drawn, and what is asked of its end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "haptics/loop/replay.h"
#include "haptics/loop/trace_reader.h"
#include "tests/bench/campaign/campaign_laws.h"
#include "tests/bench/campaign/shift_campaign.h"

namespace gearshift {

inline const std::vector<GateLayout>& layouts() {
  static const std::vector<GateLayout> shipped = shipped_layouts(GEARSHIFT_ASSETS "/gates");
  return shipped;
}

inline CampaignCase plain_case(std::uint64_t number) {
  CampaignCase drawn;
  drawn.number = number;
  drawn.seed = case_seed(7, number);
  drawn.lever.hand = kGripHand;
  drawn.lever.actuator.overload_time = 1e4;  // its motors never tire: that would excuse a wall
  drawn.shifts = 4;
  return drawn;
}

inline bool broken(const CaseOutcome& outcome, CampaignLaw law) {
  return outcome.laws.seen(law).broken();
}

inline bool replays(const std::filesystem::path& trace) {
  TraceReader reader(trace);
  Replayer replayer(reader.header(), trace.string());
  for (TraceSample sample; reader.next(sample);)
    if (!replayer.step(sample)) return false;
  return replayer.finish(reader.hash()).bit_for_bit();
}

}  // namespace gearshift
