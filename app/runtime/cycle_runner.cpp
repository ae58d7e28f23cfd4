#include "app/runtime/cycle_runner.h"

namespace gearshift::runtime {

void CycleRunner::cycle(const haptics::CycleCall& call, const haptics::CycleStatistics* statistics) noexcept {
  record_.late_ns = call.late_ns;
  if (statistics != nullptr) {
    record_.overruns = statistics->overruns;
    record_.skipped = statistics->skipped;
  }
  if (next_.load(std::memory_order_relaxed) != nullptr) start_next();
  if (run_ == nullptr) return;
  const haptics::GuardState guard = record_.cycle.out.guard;
  const bool has_forces = guard != haptics::GuardState::idle && guard != haptics::GuardState::released;
  if (watched.must_end(call.deadline_ns, has_forces)) inputs.stop.store(true, std::memory_order_relaxed);
  run_->loop.cycle(call.deadline_ns, call.skipped);
  publish();
}

// The next car was made some cycles ago; its driver's feet stay where they are now.
void CycleRunner::start_next() noexcept {
  LoopRun* const next = next_.exchange(nullptr, std::memory_order_acquire);
  if (run_ != nullptr && run_->car && next->car) next->car->place_pedals(run_->car->keyboard());
  run_ = next;
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
