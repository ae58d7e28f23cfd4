#include "app/lab/campaign/shift_campaign.h"

#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/core.h>

#include "app/lab/campaign/broken_laws.h"
#include "app/lab/campaign/case_file.h"
#include "haptics/files/file_error.h"
#include "haptics/files/fnv_1a.h"
#include "haptics/files/printable.h"

namespace gearshift::lab {
namespace {

// Text that identifies the campaign. It contains program and gates, because with different ones a case number means a
// different case.
std::string campaign_id(const CampaignPlan& plan, std::span<const haptics::GateLayout> shipped) {
  std::string gates;
  for (const haptics::GateLayout& layout : shipped) gates += layout.text;
  return fmt::format("gearshift campaign, seed {}, gates {:016x}, by {}", plan.seed, haptics::fnv_1a(gates),
                     plan.program);
}

std::string shard_id(const CampaignPlan& plan, std::span<const haptics::GateLayout> shipped, CampaignShard shard) {
  return fmt::format("{}, shard {} of {}, {} shifts", campaign_id(plan, shipped), shard.number, shard.count,
                     plan.shifts);
}

// CPU time of a thread [s]. Unlike elapsed time, it does not advance while the thread is stopped or preempted.
double processor_time(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

clockid_t clock_of_this_thread() {
  clockid_t clock{};
  pthread_getcpuclockid(pthread_self(), &clock);
  return clock;
}

// Hands out cases in order and collects their outcomes in any order.
class CampaignWork {
 public:
  CampaignWork(const CampaignPlan& plan, std::span<const haptics::GateLayout> shipped) : plan_(plan) {
    if (plan.shard)
      shard_of_ = split_cases(plan.seed, plan.shifts, plan.shard->count, static_cast<int>(shipped.size()));
    if (plan.folder.empty()) return;
    const std::filesystem::path name = plan.folder / "cases.csv";
    if (plan.shard) {
      file_.emplace(name, shard_id(plan, shipped, *plan.shard), plan.shard->count);
    } else {
      file_.emplace(name, campaign_id(plan, shipped));
    }
    cases_ = file_->cases();
    count_finished();
  }

  std::optional<std::uint64_t> next() {
    const std::lock_guard lock(mutex_);
    while (cases_.contains(next_) || is_of_other_shard(next_)) ++next_;
    if (is_enough() || is_beyond_shard(next_) || problem_ || is_ended_) return std::nullopt;
    const clockid_t clock = clock_of_this_thread();
    running_[std::this_thread::get_id()] = {next_, clock, processor_time(clock)};
    return next_++;
  }

  void done(CaseOutcome outcome) {
    const std::lock_guard lock(mutex_);
    if (file_) file_->add(outcome);
    cases_.emplace(outcome.number, std::move(outcome));
    count_finished();
  }

  void fail(std::exception_ptr problem) {
    const std::lock_guard lock(mutex_);
    problem_ = std::move(problem);
  }

  void end() {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
  }

  void leave() {
    const std::lock_guard lock(mutex_);
    running_.erase(std::this_thread::get_id());
    ++finished_threads_;
    changed_.notify_all();
  }

  // Waits until `threads` threads have finished. Returns false after `timeout`.
  bool wait(std::chrono::milliseconds timeout, std::size_t threads) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, timeout, [&] { return finished_threads_ == threads; });
  }

  CampaignStatus status() {
    const std::lock_guard lock(mutex_);
    const double fraction = plan_.shard ? static_cast<double>(finished_cases_) / static_cast<double>(shard_of_.size())
                                        : static_cast<double>(shifts_) / static_cast<double>(plan_.shifts);
    CampaignStatus status{fraction, std::nullopt};
    for (const auto& [thread, running] : running_)
      if (processor_time(running.clock) - running.begin > plan_.case_time_limit) status.overdue = running.number;
    return status;
  }

  std::vector<CaseOutcome> take_outcomes() {
    if (problem_) std::rethrow_exception(problem_);
    std::vector<CaseOutcome> outcomes;
    for (auto& [number, outcome] : cases_)
      if (number < finished_cases_) outcomes.push_back(std::move(outcome));
    return outcomes;
  }

 private:
  struct Running {
    std::uint64_t number = 0;  // of the case
    clockid_t clock{};
    double begin = 0.0;  // [s] start time of the case on the thread's CPU clock
  };

  bool is_beyond_shard(std::uint64_t number) const { return plan_.shard && number >= shard_of_.size(); }
  bool is_of_other_shard(std::uint64_t number) const {
    return plan_.shard && number < shard_of_.size() && shard_of_[number] != plan_.shard->number;
  }
  bool is_enough() const { return plan_.shard ? is_beyond_shard(finished_cases_) : shifts_ >= plan_.shifts; }

  // Advances `finished_cases_` to the first case that is not finished, and adds up the shifts. Stops as soon as there
  // are enough shifts, or at the shard's end.
  void count_finished() {
    for (; !is_enough(); ++finished_cases_) {
      const auto found = cases_.find(finished_cases_);
      if (found == cases_.end() && !is_of_other_shard(finished_cases_)) return;
      if (found != cases_.end()) shifts_ += static_cast<std::uint64_t>(found->second.shifts);
    }
  }

  const CampaignPlan& plan_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<CaseFile> file_;
  std::vector<int> shard_of_;  // by case number; empty without shards
  std::map<std::uint64_t, CaseOutcome> cases_;
  std::uint64_t next_ = 0;            // number of the next case to hand out
  std::uint64_t finished_cases_ = 0;  // all cases with a lower number are finished or of another shard
  std::uint64_t shifts_ = 0;          // number of shifts tried in the finished cases
  std::map<std::thread::id, Running> running_;
  bool is_ended_ = false;
  std::size_t finished_threads_ = 0;
  std::exception_ptr problem_;
};

// Runs a case. An unexpected exception ends the campaign. Its message names the case, so that the case can be repeated.
CaseOutcome outcome_of(std::uint64_t number, const CampaignPlan& plan, std::span<const haptics::GateLayout> shipped) {
  try {
    return run_case(drawn_case(plan.seed, number, static_cast<int>(shipped.size())), shipped);
  } catch (const std::exception& problem) {
    throw std::runtime_error(fmt::format("case {}: {}", number, problem.what()));
  }
}

void work(CampaignWork& work, const CampaignPlan& plan, std::span<const haptics::GateLayout> shipped) {
  try {
    while (const std::optional<std::uint64_t> number = work.next()) work.done(outcome_of(*number, plan, shipped));
  } catch (...) {
    work.fail(std::current_exception());
  }
  work.leave();
}

}  // namespace

std::vector<CaseOutcome> drive_campaign(const CampaignPlan& plan, std::span<const haptics::GateLayout> shipped,
                                        const CampaignProgress& progress) {
  CampaignWork shared(plan, shipped);
  std::vector<std::jthread> threads;
  try {
    while (static_cast<int>(threads.size()) < plan.threads) threads.emplace_back([&] { work(shared, plan, shipped); });
  } catch (const std::system_error&) {
    if (threads.empty()) throw;  // if only some threads could be started, continue with them
  }
  while (!shared.wait(std::chrono::milliseconds(100), threads.size()))
    if (progress && !progress(shared.status())) shared.end();
  threads.clear();
  return shared.take_outcomes();
}

namespace {

// The shard that a file of cases holds. Throws std::runtime_error.
CampaignShard shard_in(const std::filesystem::path& file, const CampaignPlan& plan,
                       std::span<const haptics::GateLayout> shipped) {
  std::string line;
  if (!std::getline(std::ifstream(file), line)) throw std::runtime_error(file.string() + ": cannot be read");
  CampaignShard shard;
  const std::string id = "# " + campaign_id(plan, shipped);
  const bool is_shard = line.starts_with(id) &&
                        std::sscanf(line.c_str() + id.size(), ", shard %d of %d", &shard.number, &shard.count) == 2;
  if (!is_shard || shard.count < 1 || shard.count > kMaxShards || line != "# " + shard_id(plan, shipped, shard))
    throw std::runtime_error(
        fmt::format("{}: the file holds no shard of this campaign (\"{}\" instead of \"{}, shard I of "
                    "N, {} shifts\"); --seed and --shifts must be those of the shards",
                    file.string(), haptics::printable(line.substr(0, 200)), id, plan.shifts));
  return shard;
}

struct FoundShard {
  std::filesystem::path file;
  std::map<std::uint64_t, CaseOutcome> cases;
};

// "shard 3 of 8 is" or "shards 3, 5 of 8 are"; empty if none is missing.
std::string missing_shards(const std::map<int, FoundShard>& found, int count) {
  std::string names;
  int missing = 0;
  for (int number = 1; number <= count; ++number)
    if (!found.contains(number)) names += fmt::format("{}{}", missing++ == 0 ? "" : ", ", number);
  if (missing == 0) return {};
  return fmt::format("shard{} {} of {} {}", missing == 1 ? "" : "s", names, count, missing == 1 ? "is" : "are");
}

}  // namespace

void merge_shards(const CampaignPlan& plan, std::span<const std::filesystem::path> folders,
                  std::span<const haptics::GateLayout> shipped) {
  std::map<int, FoundShard> found;
  int count = 1;
  for (const std::filesystem::path& folder : folders) {
    const std::filesystem::path file = folder / "cases.csv";
    const CampaignShard shard = shard_in(file, plan, shipped);
    const auto twin = found.find(shard.number);
    if (twin != found.end())
      throw std::runtime_error(fmt::format("{} and {} are both shard {} of {}", twin->second.file.string(),
                                           file.string(), shard.number, shard.count));
    if (!found.empty() && shard.count != count)
      throw std::runtime_error(fmt::format("{} is one of {} shards, {} one of {}", found.begin()->second.file.string(),
                                           count, file.string(), shard.count));
    count = shard.count;
    found[shard.number] = {file, CaseFile(file, shard_id(plan, shipped, shard), count).cases()};
  }
  if (const std::string missing = missing_shards(found, count); !missing.empty())
    throw std::runtime_error(fmt::format(
        "{} missing; run gearshift campaign --shard I/{} with the same --seed and --shifts", missing, count));
  CaseFile whole(plan.folder / "cases.csv", campaign_id(plan, shipped));
  const std::vector<int> shard_of = split_cases(plan.seed, plan.shifts, count, static_cast<int>(shipped.size()));
  for (std::uint64_t number = 0; number < shard_of.size(); ++number) {
    const FoundShard& shard = found.at(shard_of[number]);
    const auto outcome = shard.cases.find(number);
    if (outcome == shard.cases.end())
      throw std::runtime_error(fmt::format("{}: shard {} is not finished; run its command again to resume it",
                                           shard.file.string(), shard_of[number]));
    if (!whole.cases().contains(number)) whole.add(outcome->second);
  }
}

std::size_t record_failures(const CampaignPlan& plan, std::span<const BrokenLaw> broken,
                            std::span<const haptics::GateLayout> shipped, const CampaignProgress& progress) {
  std::map<std::uint64_t, std::vector<BrokenLaw>> cases;
  for (const BrokenLaw& one : broken) cases[one.number].push_back(one);
  const std::filesystem::path folder = plan.folder / "failures";
  std::error_code error;
  if (!cases.empty()) std::filesystem::create_directories(folder, error);
  if (error) throw haptics::FileError(folder.string(), 0, "cannot be created (" + error.message() + ")");
  std::size_t saved = 0;
  for (const auto& [number, of_case] : cases) {
    if (saved == kMaxTraces) break;
    const CampaignCase drawn = drawn_case(plan.seed, number, static_cast<int>(shipped.size()));
    const std::filesystem::path trace = folder / fmt::format("{:016x}.trace", drawn.seed);
    run_case(drawn, shipped, trace);
    write_broken_laws(trace, plan.seed, of_case);
    ++saved;
    const double fraction = static_cast<double>(saved) / static_cast<double>(std::min(cases.size(), kMaxTraces));
    if (progress && !progress({fraction, std::nullopt})) break;
  }
  return cases.size();
}

}  // namespace gearshift::lab
