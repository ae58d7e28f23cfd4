// Summary of a campaign: worst value of each law, groups of drawn cases, rejections and failures.
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
  std::uint64_t cases = 0, checks = 0;  // number of cases in which the law was checked, and of checks
  std::uint64_t broken = 0;             // cases
  LawResult worst;                      // the value nearest to its bound, or furthest beyond it
  std::uint64_t worst_case = 0;
};

struct BrokenLaw {
  std::uint64_t number = 0, seed = 0;  // of the case
  CampaignLaw law = CampaignLaw::finite;
  LawResult result;
};

// Cases with a common property.
struct CaseGroup {
  std::string of, name;  // "hand", "grip"
  std::uint64_t cases = 0, shifts = 0, reached = 0;
  std::uint64_t softened = 0, stopped = 0, limited = 0, failed = 0;  // cases
};

struct RippleCell {
  double slowest = 0.0, fastest = 0.0;  // [Hz] of the loop
  int delay = 0;                        // [cycles] delay; 4 means 4 or more
  bool promised = true;                 // quiet is promised
  std::uint64_t cases = 0;
  double median = 0.0, p95 = 0.0, max = 0.0;  // [m] peak-to-peak motion in the worst hold of each case
};

struct CampaignSummary {
  std::uint64_t seed = 0, cases = 0, refused = 0, shifts = 0, clean = 0, cycles = 0;
  double seconds = 0.0;  // [s] simulated
  std::array<LawSummary, kCampaignLaws> laws;
  std::vector<BrokenLaw> broken;                  // by case
  std::map<std::string, std::uint64_t> refusals;  // number of rejections by reason, without its values
  std::vector<CaseGroup> groups;
  std::vector<RippleCell> ripple;
};

CampaignSummary summarise(std::uint64_t campaign_seed, std::span<const CaseOutcome> outcomes, int shipped_gates);

}  // namespace gearshift::lab
