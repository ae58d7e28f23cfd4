// A drive in which everything happens that can happen to a loop: shifts, walls, a frozen sensor, readings
// that are no numbers, the panic button, late cycles, new tuning, other controls, commands. The device keeps walls itself.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "haptics/device/scripted_hand.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/loop/haptic_loop.h"
#include "haptics/loop/shift_script.h"
#include "haptics/loop/trace_recorder.h"
#include "tests/haptics/loop/trace_bench.h"
#include "tests/support/gates.h"

namespace gearshift {

// Passes on what the lever says, except where the sensor fails.
class FailingSensor final : public HapticDevice {
 public:
  explicit FailingSensor(SimulatedLever& lever) : lever_(lever) {}
  const DeviceSpec& spec() const noexcept override { return lever_.spec(); }
  LeverReading read(std::int64_t now_ns) noexcept override {
    LeverReading reading = lever_.read(now_ns);
    const std::uint64_t cycle = cycle_++;
    if (cycle >= 1500 && cycle < 1540) return frozen_;  // longer than stale_time
    if (cycle == 1700) reading.position.x = std::numeric_limits<double>::quiet_NaN();
    if (cycle == 1710) reading.hand_force.y = std::numeric_limits<double>::infinity();
    if (cycle == 1720) reading.position.y += 0.5;  // faster than any hand
    reading.stop = cycle >= 3300 && cycle < 3320;
    return frozen_ = reading;
  }
  void write(glm::dvec2 force) noexcept override { lever_.write(force); }
  void hold_walls(const LeverWalls& walls) noexcept override { lever_.hold_walls(walls); }
  void release() noexcept override { lever_.release(); }

 private:
  SimulatedLever& lever_;
  LeverReading frozen_;
  std::uint64_t cycle_ = 0;
};

class RecordedDrive {
 public:
  static constexpr std::uint64_t kCycles = 4000;

  explicit RecordedDrive(LeverWorld* world = nullptr)
      : gate_(paper_gate()),
        hand_(touring_hand({0.0, 0.0}), strokes(gate_), 0.001),
        lever_(lever_config(), 1'000'000, hand_),
        sensor_(lever_),
        loop_(config(), gate_, sensor_, world != nullptr ? *world : nothing_, channels_),
        world_name_(world != nullptr ? world->name() : nothing_.name()) {
    loop_.arm();
  }

  TraceHeader header() const {
    TraceHeader header = paper_header();
    header.config = config();
    header.device = lever_.spec();
    header.world = world_name_;
    return header;
  }

  LoopChannels& channels() { return channels_; }
  HapticLoop& loop() { return loop_; }

  // One cycle, with whatever the script of the drive has for it.
  void step() noexcept {
    const std::uint64_t cycle = loop_.snapshot().cycle;
    if (cycle == 600) channels_.controls.write({0.3, 0.0, 1.0, 0.0, true, false});
    if (cycle == 900) channels_.tuning.write(softer());
    if (cycle == 1300) channels_.tuning.write(loop_.admitted().tuning);
    if (cycle == 2600) (void)channels_.commands.push(LoopCommand::disarm);
    if (cycle == 2650) (void)channels_.commands.push(LoopCommand::arm);
    if (cycle == 3310 || cycle == 3350) (void)channels_.commands.push(LoopCommand::arm);  // held still; let go
    if (cycle == 3800) (void)channels_.commands.push(LoopCommand::stop);
    // Every second deadline missed for a while: more overruns in a row than the guard bears.
    const std::int64_t skipped = cycle >= 2000 && cycle < 2012 ? 1 : 0;
    now_ns_ += 1'000'000 * (1 + skipped);
    loop_.cycle(now_ns_, skipped);
  }

  // The whole drive, recorded to `file`.
  RecordingResult record(const std::filesystem::path& file) {
    TraceRecorder recorder(file, header(), channels_, TracePump::by_caller);
    for (std::uint64_t i = 0; i < kCycles; ++i) {
      step();
      if (i % 1000 == 0) recorder.pump();
    }
    return recorder.finish();
  }

 private:
  static HapticConfig config() {
    HapticConfig config;
    config.estimator.smoothing = 0.0005;  // [s] short: its last bit is not rounded away in 1 - exp(-T / s)
    config.tuning.speed_limit = 0.15;     // [m/s] so that strokes are faster
    config.guard.slew = 2.0;              // [N/cycle] so that impacts are
    config.guard.ramp_time = 0.2;
    return config;
  }

  HapticTuning softer() const noexcept {
    HapticTuning tuning = loop_.admitted().tuning;
    tuning.wall_stiffness = 2000.0;
    return tuning;
  }

  static SimulatedLeverConfig lever_config() {
    SimulatedLeverConfig config;
    config.hand = kGripHand;
    config.own_stiffness = 300.0;
    return config;
  }

  // Through some gears, then hard against the left end of the neutral aisle.
  static std::vector<HandStroke> strokes(const Gate& gate) {
    const int gears[] = {1, 2, 3, kNeutralGear};
    std::vector<HandStroke> strokes = shift_strokes(gate, {0.0, 0.0}, gears);
    HandStroke against_wall;
    against_wall.to = {-0.05, 0.0};
    against_wall.duration = 0.25;
    against_wall.dwell = 1.0;
    against_wall.push = {-10.0, 0.0};
    strokes.push_back(against_wall);
    return strokes;
  }

  Gate gate_;
  ScriptedHand hand_;
  SimulatedLever lever_;
  FailingSensor sensor_;
  NullWorld nothing_;
  LoopChannels channels_;
  HapticLoop loop_;
  std::string world_name_;
  std::int64_t now_ns_ = 5'000'000;  // [ns] not the loop's period, not zero
};

}  // namespace gearshift
