#include "app/lab/campaign/shift_campaign.h"

#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
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
    if (plan.folder.empty()) return;
    file_.emplace(plan.folder / "cases.csv", campaign_id(plan, shipped));
    cases_ = file_->cases();
    count_finished();
  }

  std::optional<std::uint64_t> next() {
    const std::lock_guard lock(mutex_);
    while (cases_.contains(next_)) ++next_;
    if (is_enough() || problem_ || is_ended_) return std::nullopt;
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
    CampaignStatus status{static_cast<double>(shifts_) / static_cast<double>(plan_.shifts), std::nullopt};
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

  bool is_enough() const { return shifts_ >= plan_.shifts; }

  // Advances `finished_cases_` to the first case that is not finished, and adds up the shifts. Stops as soon as there
  // are enough shifts.
  void count_finished() {
    for (auto found = cases_.find(finished_cases_); !is_enough() && found != cases_.end();
         found = cases_.find(finished_cases_)) {
      shifts_ += static_cast<std::uint64_t>(found->second.shifts);
      ++finished_cases_;
    }
  }

  const CampaignPlan& plan_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<CaseFile> file_;
  std::map<std::uint64_t, CaseOutcome> cases_;
  std::uint64_t next_ = 0;            // number of the next case to hand out
  std::uint64_t finished_cases_ = 0;  // all cases with a lower number are finished
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
