// A drive with every kind of event that a loop can meet: shifts, walls, a frozen sensor, invalid readings, the stop
// button, late cycles, changes of tuning and controls, and commands. The device also renders walls.
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

namespace gearshift::test {

// Passes the lever's readings on, except in the cycles in which the sensor fails.
class FailingSensor final : public haptics::HapticDevice {
 public:
  explicit FailingSensor(haptics::SimulatedLever& lever) : lever_(lever) {}
  const haptics::DeviceSpec& spec() const noexcept override { return lever_.spec(); }
  haptics::LeverReading read(std::int64_t now_ns) noexcept override {
    haptics::LeverReading reading = lever_.read(now_ns);
    const std::uint64_t cycle = cycle_++;
    if (cycle >= 1500 && cycle < 1540) return frozen_;  // longer than stale_time
    if (cycle == 1700) reading.position.x = std::numeric_limits<double>::quiet_NaN();
    if (cycle == 1710) reading.hand_force.y = std::numeric_limits<double>::infinity();
    if (cycle == 1720) reading.position.y += 0.5;  // a jump that is faster than any hand
    reading.stop = cycle >= 3300 && cycle < 3320;
    return frozen_ = reading;
  }
  void write(glm::dvec2 force) noexcept override { lever_.write(force); }
  void set_device_walls(const haptics::LeverWalls& walls) noexcept override { lever_.set_device_walls(walls); }
  void release() noexcept override { lever_.release(); }

 private:
  haptics::SimulatedLever& lever_;
  haptics::LeverReading frozen_;
  std::uint64_t cycle_ = 0;
};

class RecordedDrive {
 public:
  static constexpr std::uint64_t kCycles = 4000;

  explicit RecordedDrive(haptics::LeverLoad* load = nullptr)
      : gate_(paper_gate()),
        hand_(haptics::touring_hand({0.0, 0.0}), strokes(gate_), 0.001),
        lever_(lever_config(), 1'000'000, hand_),
        sensor_(lever_),
        loop_(config(), gate_, sensor_, load != nullptr ? *load : no_load_, inputs_),
        load_parameters_(load != nullptr ? load->replay_parameters() : no_load_.replay_parameters()) {
    loop_.arm();
  }

  haptics::TraceHeader header() const {
    haptics::TraceHeader header = paper_header();
    header.config = config();
    header.device = lever_.spec();
    header.load = load_parameters_;
    return header;
  }

  haptics::LoopInputs& inputs() { return inputs_; }
  haptics::HapticLoop& loop() { return loop_; }

  // Runs one cycle with its scripted events.
  void step() noexcept {
    const std::uint64_t cycle = next_cycle_++;
    if (cycle == 600) inputs_.controls.write({{.throttle = 0.3, .clutch = 1.0}, true, false});
    if (cycle == 900) inputs_.tuning.write(softer());
    if (cycle == 1300) inputs_.tuning.write(loop_.admitted().tuning);
    if (cycle == 2600) (void)inputs_.commands.push(haptics::LoopCommand::disarm);
    if (cycle == 2650) (void)inputs_.commands.push(haptics::LoopCommand::arm);
    if (cycle == 3310 || cycle == 3350)
      (void)inputs_.commands.push(haptics::LoopCommand::arm);  // button held; released
    if (cycle == 3800) (void)inputs_.commands.push(haptics::LoopCommand::stop);
    // Each of these 12 cycles runs one period late and so skips a deadline: more overruns in a row than the guard
    // tolerates.
    const std::int64_t skipped = cycle >= 2000 && cycle < 2012 ? 1 : 0;
    now_ns_ += 1'000'000 * (1 + skipped);
    loop_.cycle(now_ns_, skipped);
  }

  haptics::RecordingResult record(const std::filesystem::path& file) {
    haptics::TraceRecorder recorder(file, header());
    for (std::uint64_t i = 0; i < kCycles; ++i) {
      step();
      recorder.add(loop_.published());
    }
    return recorder.finish();
  }

 private:
  static haptics::HapticConfig config() {
    haptics::HapticConfig config;
    config.estimator.smoothing = 0.0005;  // [s] so short that a flipped last bit changes 1 - exp(-period / smoothing)
    config.tuning.speed_limit = 0.15;     // [m/s] low, so that the hand's strokes exceed it
    config.guard.slew = 5.5;              // [N/cycle] low, so that impacts exceed it, but not the stiffness
    config.guard.ramp_time = 0.2;
    return config;
  }

  haptics::HapticTuning softer() const noexcept {
    haptics::HapticTuning tuning = loop_.admitted().tuning;
    tuning.wall_stiffness = 2000.0;
    return tuning;
  }

  static haptics::SimulatedLeverConfig lever_config() {
    haptics::SimulatedLeverConfig config;
    config.hand = haptics::kGripHand;
    config.device_wall_stiffness = 300.0;
    return config;
  }

  // The hand shifts through some gears, then pushes hard against the left end of the neutral aisle.
  static std::vector<haptics::HandStroke> strokes(const haptics::Gate& gate) {
    const int gears[] = {1, 2, 3, haptics::kNeutralGear};
    std::vector<haptics::HandStroke> strokes = haptics::shift_strokes(gate, {0.0, 0.0}, gears);
    haptics::HandStroke against_wall;
    against_wall.to = {-0.05, 0.0};
    against_wall.duration = 0.25;
    against_wall.dwell = 1.0;
    against_wall.push = {-10.0, 0.0};
    strokes.push_back(against_wall);
    return strokes;
  }

  haptics::Gate gate_;
  haptics::ScriptedHand hand_;
  haptics::SimulatedLever lever_;
  FailingSensor sensor_;
  haptics::NoLoad no_load_;
  haptics::LoopInputs inputs_;
  haptics::HapticLoop loop_;
  std::string load_parameters_;
  std::uint64_t next_cycle_ = 0;
  std::int64_t now_ns_ = 5'000'000;  // [ns] the clock does not start at zero
};

}  // namespace gearshift::test
