// Hand, feet, lever, loop and car, run together on a virtual clock, cycle by cycle, as fast as possible.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "app/vehicle/car_load.h"
#include "app/vehicle/drive_sample.h"
#include "haptics/gate/gate.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/haptic_event.h"
#include "haptics/loop/simulated_run.h"
#include "haptics/loop/trace_recorder.h"

namespace gearshift::lessons {

struct SimulatedDriveConfig {
  vehicle::CarSpec car;
  haptics::GateLayout gate;
  vehicle::CarStart start;
  std::uint64_t seed = 1;       // of the tooth positions
  double rate = 1000.0;         // [Hz] cycles per second, 100 to 4000
  std::filesystem::path trace;  // empty: none
  // Called for each event of a cycle, within step(); may be empty.
  std::function<void(const haptics::HapticEvent&)> on_event;
};

// Returns the gate, compiled for the simulated lever of SimulatedDrive. Throws like compile_gate().
haptics::Gate driven_gate(const haptics::GateLayout& layout);

class SimulatedDrive {
 public:
  // The lever starts in the start gear's slot. Throws std::invalid_argument if car and gate do not fit together, and
  // FileError if the trace cannot be created.
  explicit SimulatedDrive(const SimulatedDriveConfig& config);

  // Runs one cycle with this hand and these controls.
  const vehicle::DriveSample& step(const vehicle::DriverAction& action);
  void finish();  // completes the trace; throws FileError

  const haptics::Gate& gate() const noexcept { return gate_; }
  double period() const noexcept { return run_.period(); }  // [s]

 private:
  // Its target is the one that the driver chose after the previous cycle.
  class DecidedHand final : public haptics::HandDriver {
   public:
    haptics::HandTarget next(double, glm::dvec2) noexcept override { return target; }
    haptics::HandTarget target;
  };

  haptics::SimulatedRunConfig run_config() const;
  void report_events();

  SimulatedDriveConfig config_;
  haptics::DeviceSpec device_;
  haptics::Gate gate_;
  haptics::SimulatedRunConfig setup_;
  vehicle::CarLoad car_;
  DecidedHand hand_;
  haptics::SimulatedRun run_;
  vehicle::DriveSample sample_;
  std::optional<haptics::TraceRecorder> recorder_;
  haptics::EventDetector detector_;
  std::vector<haptics::HapticEvent> events_;
};

}  // namespace gearshift::lessons
