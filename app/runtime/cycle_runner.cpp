#include "app/runtime/cycle_runner.h"

#include <algorithm>

#include "haptics/rt/monotonic_clock.h"

namespace gearshift::runtime {

void CycleRunner::cycle(const haptics::CycleCall& call, const haptics::CycleStatistics* statistics) noexcept {
  if (statistics != nullptr) record_.late_ns = lateness(call, *statistics);
  if (next_.load(std::memory_order_relaxed) != nullptr) start_next();
  if (run_ == nullptr) return;
  run_->loop.cycle(call.deadline_ns, call.skipped);
  publish();
}

// The next car was made some cycles ago; its driver's feet stay where they are now.
void CycleRunner::start_next() noexcept {
  LoopRun* const next = next_.exchange(nullptr, std::memory_order_acquire);
  if (run_ != nullptr && run_->car && next->car) next->car->place_pedals(run_->car->keyboard());
  run_ = next;
}

// [ns] How late the thread woke up. This includes the deadlines that the thread slept through, but not those that
// passed during an overrun, when it was busy.
std::int64_t CycleRunner::lateness(const haptics::CycleCall& call,
                                   const haptics::CycleStatistics& statistics) noexcept {
  const bool was_at_work = statistics.overruns != record_.overruns;
  record_.overruns = statistics.overruns;
  record_.missed = statistics.skipped;
  const std::int64_t slept_for = was_at_work ? 0 : call.skipped * period_ns_;
  return std::max<std::int64_t>(0, haptics::monotonic_ns() - call.deadline_ns) + slept_for;
}

void CycleRunner::publish() noexcept {
  record_.cycle = run_->loop.published();
  if (run_->car) {
    record_.car = run_->car->state();
    record_.keyboard = run_->car->keyboard();
  }
  record_.stamps = run_->loop.stamps();
  record_.run = run_->number;
  stream.push(record_);
}

}  // namespace gearshift::runtime
