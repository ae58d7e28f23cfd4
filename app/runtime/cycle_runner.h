// The part of the runtime that runs on the haptic thread: runs the loop cycle by cycle and publishes a record of each
// cycle, in one stream that everything else reads.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "app/runtime/controls_watch.h"
#include "app/vehicle/car_load.h"
#include "app/vehicle/drive_sample.h"
#include "haptics/loop/haptic_loop.h"
#include "haptics/rt/broadcast.h"
#include "haptics/rt/realtime_thread.h"

namespace gearshift::runtime {

// A haptic loop with the load on its lever. A new loop is created when a recording starts.
struct LoopRun {
  // Gate, device and inputs must outlive this object. The load is the car, else `other`, else none. Throws the same
  // errors as HapticLoop.
  LoopRun(const haptics::HapticConfig& config, const haptics::Gate& gate, haptics::HapticDevice& device,
          haptics::LoopInputs& inputs, std::uint64_t run_number, std::unique_ptr<vehicle::CarLoad> car_load = nullptr,
          int start_gear = haptics::kNeutralGear, std::unique_ptr<haptics::LeverLoad> other_load = nullptr)
      : number(run_number),
        no_load(start_gear),
        car(std::move(car_load)),
        other(std::move(other_load)),
        loop(config, gate, device, load(), inputs) {}
  LoopRun(const LoopRun&) = delete;
  LoopRun& operator=(const LoopRun&) = delete;

  haptics::LeverLoad& load() noexcept {
    if (car) return *car;
    return other ? *other : no_load;
  }

  std::uint64_t number;  // >= 1; distinguishes this run from those before and after it
  haptics::NoLoad no_load;
  std::unique_ptr<vehicle::CarLoad> car;  // null: no car
  std::unique_ptr<haptics::LeverLoad> other;
  haptics::HapticLoop loop;
};

struct CycleRecord {
  haptics::TraceSample cycle;               // inputs and outputs of the loop
  vehicle::VehicleState car;                // default values if there is no car
  haptics::Pedals keyboard;                 // see CarLoad::keyboard()
  haptics::StageStamps stamps;              // of this cycle, or of an earlier one
  std::uint64_t run = 0;                    // LoopRun::number; 0: before the first cycle
  std::int64_t late_ns = 0;                 // [ns] see CycleCall
  std::uint64_t overruns = 0, skipped = 0;  // since the start; see CycleStatistics
  vehicle::DriveSample sample() const noexcept { return {cycle.out, cycle.controls, car}; }
};
using CycleStream = haptics::Broadcast<CycleRecord>;

class CycleRunner {
 public:
  static constexpr std::size_t kMaxRecords = 8192;  // 8 s of cycles at 1 kHz, 2 s at 4 kHz

  // Runs one cycle; real-time safe. `statistics`: those of the calling thread; null on the virtual clock, on which no
  // cycle is late.
  void cycle(const haptics::CycleCall& call, const haptics::CycleStatistics* statistics) noexcept;

  // The newest record. Call only on the thread that runs the cycles.
  const CycleRecord& newest() const noexcept { return record_; }

  // Called by the frame side, i.e. not by the haptic thread. From the next cycle on, `next` runs; once a record has its
  // number, the previous run may be destroyed.
  void switch_to(LoopRun& next) noexcept { next_.store(&next, std::memory_order_release); }

  WatchedForces watched;

  haptics::LoopInputs inputs;  // of all runs; each has one writer outside this class

  CycleStream stream{kMaxRecords};

 private:
  void start_next() noexcept;
  void publish() noexcept;

  std::atomic<LoopRun*> next_{nullptr};
  LoopRun* run_ = nullptr;
  CycleRecord record_;
};

}  // namespace gearshift::runtime
