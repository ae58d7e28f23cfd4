// Splits the cases of a campaign into shards that take about the same time, for several machines.
#pragma once

#include <cstdint>
#include <vector>

namespace gearshift::lab {

inline constexpr int kMaxShards = 10'000;

struct CampaignShard {
  int number = 1, count = 1;  // 1 to count; 1 to kMaxShards
};

// Returns the shard of each case, by number, for as many cases as are needed to try `shifts` shifts if the guard stops
// none of them. Each case goes to the shard whose cases are expected to take the least time so far.
std::vector<int> split_cases(std::uint64_t campaign_seed, std::uint64_t shifts, int shards, int shipped_gates);

}  // namespace gearshift::lab
