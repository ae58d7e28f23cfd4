// Summary of a campaign: worst value of each law, groups of similar cases, rejections and failures.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "app/lab/campaign/campaign_run.h"

namespace gearshift::lab {

struct LawSummary {
  std::uint64_t cases = 0, checks = 0;  // number of cases in which the law was checked; number of checks
  std::uint64_t broken = 0;             // cases
  LawResult worst;                      // value furthest beyond its bound, or else nearest to it
  std::uint64_t worst_case = 0;
};

struct BrokenLaw {
  std::uint64_t number = 0, seed = 0;  // of the case
  CampaignLaw law = CampaignLaw::finite;
  LawResult result;
};

// Statistics of cases with a common property, such as the hand "grip".
struct CaseGroup {
  std::string of, name;  // "hand", "grip"
  std::uint64_t cases = 0, shifts = 0, reached = 0;
  std::uint64_t softened = 0, stopped = 0, limited = 0, failed = 0;  // cases
};

struct RippleCell {
  double slowest = 0.0, fastest = 0.0;  // [Hz] range of the loop's rate
  int delay = 0;                        // [cycles] delay; 4 means 4 or more
  bool promised = true;                 // the stability check guarantees no vibration
  std::uint64_t cases = 0;
  double median = 0.0, p95 = 0.0, max = 0.0;  // [m] statistics of the cases' largest peak-to-peak motion in a hold
};

struct CampaignSummary {
  std::uint64_t seed = 0, cases = 0, refused = 0, shifts = 0, clean = 0, cycles = 0;
  double seconds = 0.0;  // [s] simulated time
  std::array<LawSummary, kCampaignLaws> laws;
  std::vector<BrokenLaw> broken;                  // sorted by case
  std::map<std::string, std::uint64_t> refusals;  // number of rejections by reason; numbers are removed from the reason
  std::vector<CaseGroup> groups;
  std::vector<RippleCell> ripple;
};

CampaignSummary summarise(std::uint64_t campaign_seed, std::span<const CaseOutcome> outcomes, int shipped_gates);

}  // namespace gearshift::lab
