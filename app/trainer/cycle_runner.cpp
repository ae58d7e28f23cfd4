#include "app/trainer/cycle_runner.h"

#include <algorithm>
#include <numeric>

#include "haptics/rt/monotonic_clock.h"

namespace gearshift {

void CycleRunner::cycle(const CycleCall& call, const CycleStatistics* statistics) noexcept {
  const std::int64_t late_ns = statistics != nullptr ? lateness(call, *statistics) : 0;
  if (next_.load(std::memory_order_relaxed) != nullptr) run_ = next_.exchange(nullptr, std::memory_order_acquire);
  if (run_ == nullptr) return;
  run_->loop.cycle(call.deadline_ns, call.skipped);
  publish(late_ns);
  now_ns_.store(call.deadline_ns, std::memory_order_relaxed);
  ran_.store(run_, std::memory_order_release);
}

// Deadlines skipped for an overrun were not slept for: the thread was at work. All others it slept through.
std::int64_t CycleRunner::lateness(const CycleCall& call, const CycleStatistics& statistics) noexcept {
  const bool was_at_work = statistics.overruns != told_.overruns;
  has_news_ = was_at_work || statistics.skipped != told_.skipped;
  told_.overruns = statistics.overruns;
  told_.skipped = statistics.skipped;
  const std::int64_t slept_for = was_at_work ? 0 : call.skipped * period_ns_;
  return std::max<std::int64_t>(0, monotonic_ns() - call.deadline_ns) + slept_for;
}

void CycleRunner::publish(std::int64_t late_ns) noexcept {
  DriveSample& now = record_.sample;
  now.lever = run_->loop.snapshot();
  --now.lever.cycle;  // the loop counts the next one already
  now.controls = run_->loop.controls();
  if (const CarWorld* behind = run_->car()) {
    now.car = behind->state();
    car.write(now.car);
  }
  record_.late_ns = late_ns;
  (void)records.push(record_);
  if (for_driver) (void)for_driver->push(now);
  const StageStamps& stamps = run_->loop.stamps();
  const bool is_stamped = stamps.cycle == now.lever.cycle;
  if (is_stamped) add_stamps(stamps);
  if (is_stamped || has_news_) figures.write(told_);
}

void CycleRunner::add_stamps(const StageStamps& stamps) noexcept {
  std::array<std::int64_t, 8>& newest = stage_ns_[stamps_++ % kStamps];
  for (std::size_t i = 0; i < newest.size(); ++i) newest[i] = stamps.ns[i + 1] - stamps.ns[i];
  const double count = static_cast<double>(std::min(stamps_, kStamps));
  told_.stage_ns = {};
  for (const auto& stages : stage_ns_) {
    for (std::size_t i = 0; i < stages.size(); ++i) told_.stage_ns[i] += static_cast<double>(stages[i]) / count;
  }
  told_.cycle_ns = std::accumulate(told_.stage_ns.begin(), told_.stage_ns.end(), 0.0);
}

}  // namespace gearshift
