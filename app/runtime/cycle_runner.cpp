#include "app/runtime/cycle_runner.h"

#include <algorithm>

#include "haptics/rt/monotonic_clock.h"

namespace gearshift::runtime {
namespace {

constexpr std::int64_t kMaxPausePeriods = 11;  // longest time, in periods, by which the pedals advance per cycle

}  // namespace

void CycleRunner::cycle(const haptics::CycleCall& call, const haptics::CycleStatistics* statistics) noexcept {
  if (statistics != nullptr) record_.late_ns = lateness(call, *statistics);
  if (next_.load(std::memory_order_relaxed) != nullptr) run_ = next_.exchange(nullptr, std::memory_order_acquire);
  if (run_ == nullptr) return;
  set_controls(call.deadline_ns);
  run_->loop.cycle(call.deadline_ns, call.skipped);
  publish();
}

void CycleRunner::set_controls(std::int64_t deadline_ns) noexcept {
  (void)controls.update();
  haptics::DriverControls driver = controls.value();
  if (keyboard_) press_keys(deadline_ns, driver.pedals);
  inputs.controls.write(driver);
}

// Moves the keyboard's pedals until this deadline, and presses each pedal at least as far.
void CycleRunner::press_keys(std::int64_t deadline_ns, haptics::Pedals& pedals) noexcept {
  (void)pedal_keys.update();
  const PedalKeyInput& input = pedal_keys.value();
  const bool is_first = record_.run == 0;
  const std::int64_t passed_ns = is_first ? 0 : deadline_ns - record_.cycle.deadline_ns;
  const double seconds = 1e-9 * static_cast<double>(std::min(passed_ns, kMaxPausePeriods * period_ns_));
  const bool coupled = record_.car.gear != haptics::kNeutralGear && record_.car.clutch_capacity > 0.0;
  record_.keyboard = keyboard_->move(input.keys, input.timing, seconds, record_.car.engine_speed, coupled);
  pedals.throttle = std::max(pedals.throttle, record_.keyboard.throttle);
  pedals.brake = std::max(pedals.brake, record_.keyboard.brake);
  pedals.clutch = std::max(pedals.clutch, record_.keyboard.clutch);
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
  if (const vehicle::CarLoad* car_load = run_->car()) record_.car = car_load->state();
  record_.stamps = run_->loop.stamps();
  record_.run = run_->number;
  stream.push(record_);
}

}  // namespace gearshift::runtime
