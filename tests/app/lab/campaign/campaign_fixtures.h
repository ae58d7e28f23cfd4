// Shared by the campaign's tests: the shipped gates, a case with fixed parameters, and checks of its outcome.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "app/lab/campaign/campaign_laws.h"
#include "app/lab/campaign/shift_campaign.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/trace_reader.h"

namespace gearshift::test {

inline const std::vector<haptics::GateLayout>& layouts() {
  static const std::vector<haptics::GateLayout> shipped = lab::shipped_layouts(GEARSHIFT_ASSETS "/gates");
  return shipped;
}

inline lab::CampaignCase plain_case(std::uint64_t number) {
  lab::CampaignCase drawn;
  drawn.number = number;
  drawn.seed = lab::case_seed(7, number);
  drawn.lever.hand = haptics::kGripHand;
  drawn.lever.actuator.overload_time = 1e4;  // [s] long, because overheating would disable the law `quiet`
  drawn.shifts = 4;
  return drawn;
}

inline bool broken(const lab::CaseOutcome& outcome, lab::CampaignLaw law) {
  return outcome.laws.result(law).broken();
}

inline bool replays(const std::filesystem::path& trace) {
  haptics::TraceReader reader(trace);
  haptics::Replayer replayer(reader.header(), trace.string());
  for (haptics::TraceSample sample; reader.next(sample);)
    if (!replayer.step(sample)) return false;
  return replayer.finish(reader.hash()).bit_for_bit();
}

}  // namespace gearshift::test
