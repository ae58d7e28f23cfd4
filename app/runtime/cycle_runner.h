// The part of the runtime that runs on the haptic thread: runs the loop cycle by cycle and publishes a record of each
// cycle, in one stream that everything else reads.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "app/runtime/runtime_loop.h"
#include "app/vehicle/drive_sample.h"
#include "app/vehicle/keyboard_pedals.h"
#include "haptics/rt/broadcast.h"
#include "haptics/rt/latest_value.h"
#include "haptics/rt/realtime_thread.h"

namespace gearshift::runtime {

struct CycleRecord {
  haptics::TraceSample cycle;   // inputs and outputs of the loop
  vehicle::VehicleState car;    // default values if there is no car
  haptics::Pedals keyboard;     // positions of the keyboard's pedals
  haptics::StageStamps stamps;  // of this cycle, or of an earlier one
  std::uint64_t run = 0;        // LoopRun::number; 0: before the first cycle
  std::int64_t late_ns = 0;     // [ns] from the deadline to the wake-up of the thread
  std::uint64_t overruns = 0;   // see CycleStatistics
  std::uint64_t missed = 0;     // CycleStatistics::skipped
  vehicle::DriveSample sample() const noexcept { return {cycle.out, cycle.controls, car}; }
};
using CycleStream = haptics::Broadcast<CycleRecord>;

// The user's keys for the pedals.
struct PedalKeyInput {
  vehicle::PedalKeys keys;
  vehicle::PedalTiming timing;
};

class CycleRunner {
 public:
  static constexpr std::size_t kMaxRecords = 8192;  // 8 s of cycles at 1 kHz, 2 s at 4 kHz

  // `period_ns` [ns]: period of the thread. `keyboard`: initial positions of the keyboard's pedals; empty: no keyboard.
  explicit CycleRunner(std::int64_t period_ns, const std::optional<haptics::Pedals>& keyboard = haptics::Pedals{})
      : period_ns_(period_ns) {
    if (keyboard) keyboard_.emplace(*keyboard);
  }

  // Runs one cycle; real-time safe. `statistics`: those of the calling thread; null on the virtual clock, on which no
  // cycle is late.
  void cycle(const haptics::CycleCall& call, const haptics::CycleStatistics* statistics) noexcept;

  // The newest record. Call only on the thread that runs the cycles.
  const CycleRecord& newest() const noexcept { return record_; }

  // Called by the frame side, i.e. not by the haptic thread. From the next cycle on, `next` runs; once a record has its
  // number, the previous run may be destroyed.
  void switch_to(LoopRun& next) noexcept { next_.store(&next, std::memory_order_release); }

  // Inputs of all runs. Each has one writer outside this class, but the loop's controls are written by cycle(): each
  // pedal is as far down as in `controls` or the keyboard's pedal, whichever is further down.
  haptics::LoopInputs inputs;
  haptics::LatestValue<haptics::DriverControls> controls;
  haptics::LatestValue<PedalKeyInput> pedal_keys;

  CycleStream stream{kMaxRecords};

 private:
  void set_controls(std::int64_t deadline_ns) noexcept;
  void press_keys(std::int64_t deadline_ns, haptics::Pedals& pedals) noexcept;
  std::int64_t lateness(const haptics::CycleCall& call, const haptics::CycleStatistics& statistics) noexcept;
  void publish() noexcept;

  std::int64_t period_ns_;
  std::atomic<LoopRun*> next_{nullptr};
  LoopRun* run_ = nullptr;
  std::optional<vehicle::KeyboardPedals> keyboard_;
  CycleRecord record_;
};

}  // namespace gearshift::runtime
