// Runs many random cases on all cores. Finished cases are saved in the folder, so that a stopped campaign can be
// resumed. The result does not depend on the number of threads or on when it was stopped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/lab/campaign/campaign_summary.h"

namespace gearshift::lab {

struct CampaignPlan {
  std::uint64_t seed = 1;
  std::string program;  // program and commit; another one may not resume the campaign. Uncommitted changes are not
                        // distinguished
  std::uint64_t shifts = 1'000'000;  // minimum number of shifts tried; cases are run completely and in order
  std::filesystem::path folder;      // must exist; receives cases.csv, one line per case. Empty: nothing is saved
  int threads = 1;                   // at most kMaxThreads
  double case_time_limit = 60.0;     // [s] of CPU time; a case normally takes 0.1 s
};

struct CampaignStatus {
  double fraction = 0.0;                 // 0 to 1
  std::optional<std::uint64_t> overdue;  // a case beyond the time limit, which may never end
};

// Called a few times per second on the calling thread. After false is returned, no more cases are started.
using CampaignProgress = std::function<bool(const CampaignStatus& status)>;

// Runs the first cases that together try `plan.shifts` shifts and returns them in order; fewer if stopped. Throws
// FileError or std::runtime_error with one sentence if the folder holds a different campaign or cannot be written.
std::vector<CaseOutcome> drive_campaign(const CampaignPlan& plan, std::span<const haptics::GateLayout> shipped,
                                        const CampaignProgress& progress);

inline constexpr std::size_t kMaxTraces = 100;

// Runs failed cases again, at most kMaxTraces, and records them as failures/SEED.trace in the plan's folder for
// `gearshift replay`. Returns the number of failed cases. Throws FileError or std::runtime_error with one sentence.
std::size_t record_failures(const CampaignPlan& plan, std::span<const BrokenLaw> broken,
                            std::span<const haptics::GateLayout> shipped, const CampaignProgress& progress);

}  // namespace gearshift::lab
