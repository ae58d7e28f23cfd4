#include "app/lessons/simulated_driver/lesson_drive.h"

#include <optional>
#include <utility>

#include "app/lessons/assessment/lesson_run.h"
#include "app/lessons/simulated_driver/simulated_driver.h"
#include "app/vehicle/car_load.h"
#include "haptics/files/file_error.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/loop/simulated_run.h"
#include "haptics/loop/trace_recorder.h"

namespace gearshift::lessons {
namespace {

constexpr const char* kProgram = "lesson drive";

// The hand on the simulated lever. Its target is the one that the driver chose after the previous cycle.
class DecidedHand final : public haptics::HandDriver {
 public:
  haptics::HandTarget next(double, glm::dvec2) noexcept override { return target; }
  haptics::HandTarget target;
};

haptics::DeviceSpec paper_lever() {
  haptics::IdleHand idle_hand;
  return haptics::SimulatedLever(haptics::SimulatedLeverConfig{}, 1'000'000, idle_hand).spec();
}

haptics::SimulatedRunConfig run_config(const LessonDriveConfig& config, const haptics::Gate& gate) {
  haptics::SimulatedRunConfig run;
  run.haptics.rate = config.rate;
  run.haptics.guard.ramp_time = 0.01;
  run.gate = gate;
  run.start = haptics::rest_position(gate, config.lesson.start.gear);
  run.lever.hand = haptics::kGripHand;
  return run;
}

class Drive {
 public:
  Drive(const LessonDriveConfig& config, const LessonJudge& judge)
      : config_(config),
        judge_(judge),
        device_(paper_lever()),
        gate_(driven_gate(config.gate)),
        setup_(run_config(config, gate_)),
        car_(config.car, gate_, device_.max_force.y, car_start(config.lesson.start), config.seed),
        run_(setup_, hand_, &car_),
        driver_(config.lesson, config.car, gate_, config.skill, config.errors, config.seed, run_.period()) {
    hand_.target.position = setup_.start;
    sample_.controls.ignition = config.lesson.start.running;
    sample_.controls.pedals.hand_brake = config.lesson.start.hand_brake;
    sample_.controls.slope = config.lesson.start.slope;
    if (config.trace.empty()) return;
    const haptics::TraceHeader header{kProgram,         setup_.haptics,           device_, config.gate.file,
                                      config.gate.text, car_.replay_parameters(), true};
    recorder_.emplace(config.trace, header);
  }

  void to_the_end() {
    while (!progress_.is_over && !driver_.has_given_up()) cycle();
    const haptics::RecordingResult recorded = recorder_ ? recorder_->finish() : haptics::RecordingResult{};
    if (!recorded.problem.empty()) throw haptics::FileError(config_.trace.string(), 0, recorded.problem);
  }

 private:
  void cycle() {
    run_.inputs().controls.write(sample_.controls);
    sample_.lever = run_.step();
    sample_.car = car_.state();
    progress_ = judge_(sample_);
    if (recorder_) recorder_->add(run_.loop().published());
    if (config_.on_event) report_events();
    if (config_.on_cycle) config_.on_cycle(sample_);
    const vehicle::DriverAction action = driver_.act(sample_, progress_.step);
    hand_.target = action.hand;
    sample_.controls = action.controls;
    if (config_.guidance > 0.0) {
      sample_.controls.guidance = config_.guidance;
      sample_.controls.guided_gear = progress_.guided_gear;
    }
  }

  void report_events() {
    events_.clear();
    detector_.update(run_.loop().published(), events_);
    for (const haptics::HapticEvent& event : events_) config_.on_event(event);
  }

  const LessonDriveConfig& config_;
  const LessonJudge& judge_;
  LessonProgress progress_;
  haptics::DeviceSpec device_;
  haptics::Gate gate_;
  haptics::SimulatedRunConfig setup_;
  vehicle::CarLoad car_;
  DecidedHand hand_;
  haptics::SimulatedRun run_;
  SimulatedDriver driver_;
  vehicle::DriveSample sample_;
  std::optional<haptics::TraceRecorder> recorder_;
  haptics::EventDetector detector_;
  std::vector<haptics::HapticEvent> events_;
};

}  // namespace

haptics::Gate driven_gate(const haptics::GateLayout& layout) {
  const haptics::DeviceSpec device = paper_lever();
  return haptics::compile_gate(layout, device.workspace, device.yoke_radius);
}

void drive_lesson(const LessonDriveConfig& config, const LessonJudge& judge) {
  Drive(config, judge).to_the_end();
}

LessonResult drive_lesson(const LessonDriveConfig& config) {
  LessonRun run(config.lesson, config.car, driven_gate(config.gate), {config.mode, config.guidance, config.hints});
  drive_lesson(config, [&run](const vehicle::DriveSample& sample) {
    run.add(sample);
    return LessonProgress{run.view().step, run.view().guided_gear, run.is_over()};
  });
  run.leave();  // ends the run if the driver has given up
  return run.result();
}

}  // namespace gearshift::lessons
