// Many random cases on all cores. What is done is kept in the folder, so that a stopped campaign goes on where it was; the
// result does not depend on the number of threads or on when it was stopped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/campaign/campaign_summary.h"

namespace gearshift {

struct CampaignPlan {
  std::uint64_t seed = 1;
  std::string program;  // that drives it: no other one goes on with what the folder has. Trees that were changed since
                        // one commit are not told apart
  std::uint64_t shifts = 1'000'000;  // that are tried at least: cases are run whole, in order
  std::filesystem::path folder;  // exists; receives cases.csv: one line a case, as they come. Empty: nothing is kept
  int threads = 1;               // kMostThreads at most
  double patience = 60.0;        // [s] of processor time for a case, which takes a tenth of one
};

struct CampaignStand {
  double share = 0.0;                    // 0 to 1
  std::optional<std::uint64_t> overdue;  // a case that has had more than the patience: its cycle may never end
};

// On the calling thread, some times a second. False: no other case is begun.
using CampaignProgress = std::function<bool(const CampaignStand& stand)>;

// The first cases that together try that many shifts, in order; fewer where it was to end. Throws FileError or
// std::runtime_error in one sentence: the folder holds another campaign, or cannot be written.
std::vector<CaseOutcome> drive_campaign(const CampaignPlan& plan, std::span<const GateLayout> shipped,
                                        const CampaignProgress& progress);

inline constexpr std::size_t kMostTraces = 100;

// Drives the cases that broke a law again, kMostTraces at most, recorded as failures/SEED.trace in the plan's folder, for
// `gearshift replay`. Returns how many there are to record. Throws FileError or std::runtime_error
// in one sentence.
std::size_t record_failures(const CampaignPlan& plan, std::span<const LawBroken> broken,
                            std::span<const GateLayout> shipped, const CampaignProgress& progress);

}  // namespace gearshift
