#include "app/runtime/cycle_runner.h"

#include <algorithm>
#include <numeric>

#include "haptics/rt/monotonic_clock.h"

namespace gearshift::runtime {

void CycleRunner::cycle(const haptics::CycleCall& call, const haptics::CycleStatistics* statistics) noexcept {
  const std::int64_t late_ns = statistics != nullptr ? lateness(call, *statistics) : 0;
  if (next_.load(std::memory_order_relaxed) != nullptr) run_ = next_.exchange(nullptr, std::memory_order_acquire);
  if (run_ == nullptr) return;
  run_->loop.cycle(call.deadline_ns, call.skipped);
  publish(late_ns);
  now_ns_.store(call.deadline_ns, std::memory_order_relaxed);
  ran_.store(run_, std::memory_order_release);
}

// [ns] How late the thread woke up. This includes the deadlines that the thread slept through, but not those that
// passed during an overrun, when it was busy.
std::int64_t CycleRunner::lateness(const haptics::CycleCall& call,
                                   const haptics::CycleStatistics& statistics) noexcept {
  const bool was_at_work = statistics.overruns != latest_figures_.overruns;
  has_new_misses_ = was_at_work || statistics.skipped != latest_figures_.skipped;
  latest_figures_.overruns = statistics.overruns;
  latest_figures_.skipped = statistics.skipped;
  const std::int64_t slept_for = was_at_work ? 0 : call.skipped * period_ns_;
  return std::max<std::int64_t>(0, haptics::monotonic_ns() - call.deadline_ns) + slept_for;
}

void CycleRunner::publish(std::int64_t late_ns) noexcept {
  vehicle::DriveSample& now = record_.sample;
  now.lever = run_->loop.snapshot();
  --now.lever.cycle;  // undo: the loop has already counted this cycle
  now.controls = run_->loop.controls();
  if (const vehicle::CarLoad* car_load = run_->car()) {
    now.car = car_load->state();
    car.write(now.car);
  }
  record_.late_ns = late_ns;
  (void)records.push(record_);
  if (for_driver) (void)for_driver->push(now);
  const haptics::StageStamps& stamps = run_->loop.stamps();
  const bool is_stamped = stamps.cycle == now.lever.cycle;
  if (is_stamped) add_stamps(stamps);
  if (is_stamped || has_new_misses_) figures.write(latest_figures_);
}

void CycleRunner::add_stamps(const haptics::StageStamps& stamps) noexcept {
  std::array<std::int64_t, 8>& newest = stage_ns_[stamps_++ % kStamps];
  for (std::size_t i = 0; i < newest.size(); ++i) newest[i] = stamps.ns[i + 1] - stamps.ns[i];
  const double count = static_cast<double>(std::min(stamps_, kStamps));
  latest_figures_.stage_ns = {};
  for (const auto& stages : stage_ns_) {
    for (std::size_t i = 0; i < stages.size(); ++i)
      latest_figures_.stage_ns[i] += static_cast<double>(stages[i]) / count;
  }
  latest_figures_.cycle_ns = std::accumulate(latest_figures_.stage_ns.begin(), latest_figures_.stage_ns.end(), 0.0);
}

}  // namespace gearshift::runtime
