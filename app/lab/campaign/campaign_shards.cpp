#include "app/lab/campaign/campaign_shards.h"

#include <functional>
#include <queue>
#include <utility>

#include "app/lab/campaign/campaign_case.h"

namespace gearshift::lab {
namespace {

// [s] mean simulated times of a case with a hand and of one without, measured on the first 239 cases of seed 1
constexpr double kHandTime = 72.5, kBareTime = 20.0;

double expected_cycles(const CampaignCase& drawn) {
  return drawn.haptics.rate * (drawn.shifts > 0 ? kHandTime : kBareTime);
}

}  // namespace

std::vector<int> split_cases(std::uint64_t campaign_seed, std::uint64_t shifts, int shards, int shipped_gates) {
  using Load = std::pair<double, int>;  // expected cycles so far, shard
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (int shard = 1; shard <= shards; ++shard) loads.emplace(0.0, shard);
  std::vector<int> shard_of;
  for (std::uint64_t tried = 0; tried < shifts;) {
    const CampaignCase drawn = drawn_case(campaign_seed, shard_of.size(), shipped_gates);
    const auto [cycles, shard] = loads.top();
    shard_of.push_back(shard);
    if (is_forbidden(drawn)) continue;
    tried += static_cast<std::uint64_t>(drawn.shifts);
    loads.pop();
    loads.emplace(cycles + expected_cycles(drawn), shard);
  }
  return shard_of;
}

}  // namespace gearshift::lab
