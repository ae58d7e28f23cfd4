// The part of the runtime that runs on the haptic thread: runs the loop cycle by cycle and publishes a record of each
// cycle.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "app/runtime/runtime_loop.h"
#include "app/vehicle/drive_sample.h"
#include "app/vehicle/vehicle_state.h"
#include "haptics/rt/latest_value.h"
#include "haptics/rt/realtime_thread.h"
#include "haptics/rt/spsc_queue.h"

namespace gearshift::runtime {

struct CycleRecord {
  vehicle::DriveSample sample;  // if there is no car, sample.car has default values
  std::int64_t late_ns = 0;     // [ns] from the deadline to the wake-up of the thread
};

struct LoopFigures {
  std::uint64_t overruns = 0;        // see CycleStatistics
  std::uint64_t skipped = 0;         // see CycleStatistics
  std::array<double, 8> stage_ns{};  // [ns] mean durations of the stages, see LoopHealth::stage_ns
  double cycle_ns = 0.0;             // [ns] mean duration of a cycle: the sum of stage_ns
};

class CycleRunner {
 public:
  static constexpr std::size_t kMaxRecords = 8192;    // 8 s of cycles at 1 kHz, 2 s at 4 kHz
  static constexpr std::size_t kMaxForDriver = 4096;  // a driver that is further behind misses cycles

  explicit CycleRunner(std::int64_t period_ns) noexcept : period_ns_(period_ns) {}  // [ns] period of the thread

  // Runs one cycle; real-time safe. `statistics`: those of the calling thread; null on the virtual clock, on which no
  // cycle is late.
  void cycle(const haptics::CycleCall& call, const haptics::CycleStatistics* statistics) noexcept;

  // The newest sample. Call only on the thread that runs the cycles.
  const vehicle::DriveSample& newest() const noexcept { return record_.sample; }

  // Called by the frame side, i.e. not by the haptic thread. From the next cycle on, `next` runs; once has_run(next) is
  // true, the previous run may be destroyed.
  void switch_to(LoopRun& next) noexcept { next_.store(&next, std::memory_order_release); }
  bool has_run(const LoopRun& run) const noexcept { return ran_.load(std::memory_order_acquire) == &run; }
  std::int64_t now_ns() const noexcept { return now_ns_.load(std::memory_order_relaxed); }  // newest cycle's deadline

  haptics::SpscQueue<CycleRecord> records{kMaxRecords};  // when full, new records are dropped
  // Samples for the driver; null if there is no driver. Set before the first cycle. When the queue is full, new samples
  // are dropped.
  std::unique_ptr<haptics::SpscQueue<vehicle::DriveSample>> for_driver;
  haptics::LatestValue<LoopFigures> figures;
  haptics::LatestValue<vehicle::VehicleState> car;

 private:
  static constexpr std::size_t kStamps = 16;  // stamped cycles over which LoopFigures are averaged

  std::int64_t lateness(const haptics::CycleCall& call, const haptics::CycleStatistics& statistics) noexcept;
  void publish(std::int64_t late_ns) noexcept;
  void add_stamps(const haptics::StageStamps& stamps) noexcept;

  std::int64_t period_ns_;
  std::atomic<LoopRun*> next_{nullptr};
  std::atomic<LoopRun*> ran_{nullptr};
  std::atomic<std::int64_t> now_ns_{0};
  LoopRun* run_ = nullptr;
  CycleRecord record_;
  LoopFigures latest_figures_;   // published after each stamped cycle or missed deadline
  bool has_new_misses_ = false;  // true if deadlines were missed just before this cycle
  std::array<std::array<std::int64_t, 8>, kStamps> stage_ns_{};  // [ns] ring buffer of the latest stamped cycles
  std::size_t stamps_ = 0;                                       // number of stamped cycles so far
};

}  // namespace gearshift::runtime
