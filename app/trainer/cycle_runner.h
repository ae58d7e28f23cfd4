// The haptic thread's side of a trainer: runs the loop cycle by cycle, and tells the frame how each one went.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "app/trainer/loop_run.h"
#include "app/training/drive_sample.h"
#include "app/vehicle/vehicle_state.h"
#include "haptics/rt/latest_value.h"
#include "haptics/rt/realtime_thread.h"
#include "haptics/rt/spsc_queue.h"

namespace gearshift {

struct CycleRecord {
  DriveSample sample;        // its car as at the start where there is none
  std::int64_t late_ns = 0;  // [ns] woken behind the deadline
};

struct LoopFigures {
  std::uint64_t overruns = 0;        // as CycleStatistics counts them
  std::uint64_t skipped = 0;         // the same
  std::array<double, 8> stage_ns{};  // [ns] read .. write, mean of the last stamps
  double cycle_ns = 0.0;             // [ns] of these
};

class CycleRunner {
 public:
  static constexpr std::size_t kMostRecords = 8192;    // 8 s at 1 kHz, 2 s at 4 kHz
  static constexpr std::size_t kMostForDriver = 4096;  // further behind, cycles are left out

  explicit CycleRunner(std::int64_t period_ns) noexcept : period_ns_(period_ns) {}  // [ns] of the thread

  // One cycle: real-time safe. statistics: of the thread that calls; null on a virtual clock, which is never late.
  void cycle(const CycleCall& call, const CycleStatistics* statistics) noexcept;

  // On the thread of the cycles: the last one.
  const DriveSample& newest() const noexcept { return record_.sample; }

  // Frame side. The next cycle is that of `next`, and has_run() from its end on; the one before may go then.
  void hand_over(LoopRun& next) noexcept { next_.store(&next, std::memory_order_release); }
  bool has_run(const LoopRun& run) const noexcept { return ran_.load(std::memory_order_acquire) == &run; }
  std::int64_t now_ns() const noexcept { return now_ns_.load(std::memory_order_relaxed); }  // newest deadline

  SpscQueue<CycleRecord> records{kMostRecords};        // full: the newest are left out
  std::unique_ptr<SpscQueue<DriveSample>> for_driver;  // set before the first cycle; null: nobody. Full: the same
  LatestValue<LoopFigures> figures;
  LatestValue<VehicleState> car;

 private:
  static constexpr std::size_t kStamps = 16;  // that the means are taken over

  std::int64_t lateness(const CycleCall& call, const CycleStatistics& statistics) noexcept;
  void publish(std::int64_t late_ns) noexcept;
  void add_stamps(const StageStamps& stamps) noexcept;

  std::int64_t period_ns_;
  std::atomic<LoopRun*> next_{nullptr};
  std::atomic<LoopRun*> ran_{nullptr};
  std::atomic<std::int64_t> now_ns_{0};
  LoopRun* run_ = nullptr;
  CycleRecord record_;
  LoopFigures told_;       // with each stamp, and at once when a deadline was missed
  bool has_news_ = false;  // of missed deadlines, in this cycle
  std::array<std::array<std::int64_t, 8>, kStamps> stage_ns_{};  // the last ones, in a ring
  std::size_t stamps_ = 0;                                       // so far
};

}  // namespace gearshift
