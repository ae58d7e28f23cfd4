// A periodic thread with absolute deadlines.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>

#include "haptics/rt/cycle_statistics.h"

namespace gearshift::haptics {

enum class RealtimePolicy {
  required,    // start only with real-time scheduling, locked memory and the configured core
  best_effort  // start anyway and report why it is not real-time
};

// No file, option or panel sets these values, so they have no table of parameters (haptics/files/parameter.h).
struct RealtimeConfig {
  std::int64_t period_ns = 1'000'000;  // [ns] > 0
  RealtimePolicy policy = RealtimePolicy::best_effort;
  int priority = 80;              // SCHED_FIFO, 1 to 99
  std::int64_t spin_ns = 50'000;  // [ns] >= 0, length of the busy-wait before each deadline; 0: sleep only
  int core = -1;                  // core to which the thread is pinned; -1: any core
};

struct CycleCall {
  std::int64_t deadline_ns;  // [ns] CLOCK_MONOTONIC, start + k * period
  std::int64_t skipped;      // deadlines missed since the last call, normally 0
  // [ns] From the deadline for which the thread waited to its wake-up. Includes the deadlines that it slept through, but
  // not those that passed during an overrun, when it was busy.
  std::int64_t late_ns = 0;
};

// Runs `cycle` once per period until stop(). After a late cycle the missed deadlines are skipped and never caught up;
// the deadlines stay on the original grid. From one call to the next, the deadline advances by exactly (1 + skipped)
// periods. The statistics are not synchronised; read them after stop() or inside `cycle`.
class RealtimeThread {
 public:
  RealtimeThread() = default;
  ~RealtimeThread() { stop(); }
  RealtimeThread(const RealtimeThread&) = delete;
  RealtimeThread& operator=(const RealtimeThread&) = delete;

  // `cycle` must not throw. Throws std::runtime_error with one sentence if the policy is `required` and cannot be met,
  // std::invalid_argument if the config is out of range, std::logic_error if the thread is already running. Locks the
  // memory of the whole process if permitted, and leaves it locked.
  void start(const RealtimeConfig& config, std::function<void(const CycleCall&)> cycle);
  void stop() noexcept;  // joins the thread within a period; may be called twice, but not inside `cycle`

  bool is_realtime() const noexcept { return realtime_; }                                   // SCHED_FIFO was granted
  const std::string& not_realtime_reason() const noexcept { return not_realtime_reason_; }  // a sentence, or empty
  const CycleStatistics& statistics() const noexcept { return statistics_; }

 private:
  void prepare();  // runs on the new thread, before the first cycle
  void run() noexcept;
  std::int64_t wait_until(std::int64_t deadline) const noexcept;  // returns the wake-up time [ns]

  RealtimeConfig config_;
  std::function<void(const CycleCall&)> cycle_;
  std::thread thread_;
  std::atomic<bool> stop_{false};
  bool realtime_ = false;
  std::string not_realtime_reason_;
  CycleStatistics statistics_;
};

}  // namespace gearshift::haptics
