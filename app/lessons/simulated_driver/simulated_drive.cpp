#include "app/lessons/simulated_driver/simulated_drive.h"

#include "haptics/files/file_error.h"
#include "haptics/gate/gate_compiler.h"

namespace gearshift::lessons {
namespace {

constexpr const char* kProgram = "lesson drive";

haptics::DeviceSpec paper_lever() {
  haptics::IdleHand idle_hand;
  return haptics::SimulatedLever(haptics::SimulatedLeverConfig{}, 1'000'000, idle_hand).spec();
}

}  // namespace

haptics::Gate driven_gate(const haptics::GateLayout& layout) {
  const haptics::DeviceSpec device = paper_lever();
  return haptics::compile_gate(layout, device.workspace, device.yoke_radius);
}

SimulatedDrive::SimulatedDrive(const SimulatedDriveConfig& config)
    : config_(config),
      device_(paper_lever()),
      gate_(driven_gate(config.gate)),
      setup_(run_config()),
      car_(config.car, gate_, device_.max_force.y, config.start, config.seed),
      run_(setup_, hand_, &car_) {
  if (config.trace.empty()) return;
  const haptics::TraceHeader header{kProgram,         setup_.haptics,           device_, config.gate.file,
                                    config.gate.text, car_.replay_parameters(), true};
  recorder_.emplace(config.trace, header);
}

haptics::SimulatedRunConfig SimulatedDrive::run_config() const {
  haptics::SimulatedRunConfig run;
  run.haptics.rate = config_.rate;
  run.haptics.guard.ramp_time = 0.01;
  run.gate = gate_;
  run.start = haptics::rest_position(gate_, config_.start.gear);
  run.lever.hand = haptics::kGripHand;
  return run;
}

const vehicle::DriveSample& SimulatedDrive::step(const vehicle::DriverAction& action) {
  hand_.target = action.hand;
  sample_.controls = action.controls;
  run_.inputs().controls.write(action.controls);
  sample_.lever = run_.step();
  sample_.car = car_.state();
  if (recorder_) recorder_->add(run_.loop().published());
  if (config_.on_event) report_events();
  return sample_;
}

void SimulatedDrive::finish() {
  const haptics::RecordingResult recorded = recorder_ ? recorder_->finish() : haptics::RecordingResult{};
  if (!recorded.problem.empty()) throw haptics::FileError(config_.trace.string(), 0, recorded.problem);
}

void SimulatedDrive::report_events() {
  events_.clear();
  detector_.update(run_.loop().published(), events_);
  for (const haptics::HapticEvent& event : events_) config_.on_event(event);
}

}  // namespace gearshift::lessons
