// Runs many random cases on several threads. Finished cases are saved in a folder, so that a stopped campaign can be
// resumed. The result does not depend on the number of threads or on interruptions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/lab/campaign/campaign_shards.h"
#include "app/lab/campaign/campaign_summary.h"

namespace gearshift::lab {

struct CampaignPlan {
  std::uint64_t seed = 1;
  // Program and commit; uncommitted changes are not distinguished. A different program cannot resume the campaign.
  std::string program;
  std::uint64_t shifts = 1'000'000;    // minimum number of tried shifts; cases are run completely and in order
  std::filesystem::path folder;        // existing folder for cases.csv, with one line per case; empty: nothing is saved
  int threads = 1;                     // at most kMaxThreads
  double case_time_limit = 60.0;       // [s] of CPU time; a case normally takes 0.1 s
  std::optional<CampaignShard> shard;  // runs only the shard's cases
};

struct CampaignStatus {
  double fraction = 0.0;                 // 0 to 1
  std::optional<std::uint64_t> overdue;  // number of a case that exceeds the time limit and may never end
};

// Called on the calling thread: about every 0.1 s by drive_campaign(), after each case by record_failures(). If the
// function returns false, no more cases are started.
using CampaignProgress = std::function<bool(const CampaignStatus& status)>;

// Runs as many cases as are needed to try `plan.shifts` shifts, or those of the shard, and returns their outcomes in
// order. Returns fewer outcomes if stopped. Throws FileError, or std::runtime_error with one sentence if the folder holds a different
// campaign or cannot be written.
std::vector<CaseOutcome> drive_campaign(const CampaignPlan& plan, std::span<const haptics::GateLayout> shipped,
                                        const CampaignProgress& progress);

// Copies the cases of all shards to cases.csv in the plan's folder, from where drive_campaign() resumes the campaign: if
// the guard has stopped cases, they tried fewer shifts, and a few more cases are needed. `folders`: one per shard, in any
// order. Throws std::runtime_error with one sentence if a shard is missing, unfinished or given twice, if a folder holds
// no shard of this campaign, or if a file cannot be read or written.
void merge_shards(const CampaignPlan& plan, std::span<const std::filesystem::path> folders,
                  std::span<const haptics::GateLayout> shipped);

inline constexpr std::size_t kMaxTraces = 100;

// Runs the failed cases again, at most kMaxTraces of them. Records each as failures/SEED.trace in the plan's folder,
// where SEED is the case's seed in hexadecimal, and writes its text file (broken_laws.h). Returns the number of failed
// cases. Throws FileError, or std::runtime_error with one sentence.
std::size_t record_failures(const CampaignPlan& plan, std::span<const BrokenLaw> broken,
                            std::span<const haptics::GateLayout> shipped, const CampaignProgress& progress);

}  // namespace gearshift::lab
