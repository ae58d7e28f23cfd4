#include "app/learner/lesson_drive.h"

#include <optional>
#include <utility>

#include "app/learner/simulated_learner.h"
#include "app/training/guided_world.h"
#include "app/training/lesson_run.h"
#include "app/training/lesson_world.h"
#include "app/vehicle/car_world.h"
#include "haptics/files/file_error.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/loop/simulated_run.h"
#include "haptics/loop/trace_recorder.h"

namespace gearshift {
namespace {

constexpr const char* kProgram = "lesson drive";
constexpr std::uint64_t kPumpEvery = 4096;  // [cycles] half of what the loop's queue holds

// The hand at the device's end: what the learner decided after the cycle before.
class GivenHand final : public HandDriver {
 public:
  HandTarget next(double, glm::dvec2) noexcept override { return target; }
  HandTarget target;
};

DeviceSpec paper_lever() {
  RestingHand nobody;
  return SimulatedLever(SimulatedLeverConfig{}, 1'000'000, nobody).spec();
}

SimulatedRunConfig run_config(const LessonDriveConfig& config, const Gate& gate) {
  SimulatedRunConfig run;
  run.haptics.rate = config.rate;
  run.haptics.guard.ramp_time = 0.01;
  run.gate = gate;
  run.start = rest_position(gate, config.lesson.start.gear);
  run.lever.hand = kGripHand;
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
        guided_(car_, gate_),
        run_(setup_, hand_, config.guidance > 0.0 ? static_cast<LeverWorld*>(&guided_) : &car_),
        learner_(config.lesson, config.car, gate_, config.skill, config.faults, config.seed, run_.period()) {
    hand_.target.position = setup_.start;
    sample_.controls.ignition = config.lesson.start.running;
    sample_.controls.hand_brake = config.lesson.start.hand_brake;
    sample_.controls.slope = config.lesson.start.slope;
    if (config.trace.empty()) return;
    const TraceHeader header{kProgram,
                             setup_.haptics,
                             device_,
                             config.gate.file,
                             config.gate.text,
                             config.guidance > 0.0 ? guided_.name() : car_.name(),
                             true};
    recorder_.emplace(config.trace, header, run_.channels(), TracePump::by_caller);
  }

  void to_the_end() {
    while (!stand_.over && !learner_.gives_up()) cycle();
    const RecordingResult recorded = recorder_ ? recorder_->finish() : RecordingResult{};
    if (!recorded.problem.empty()) throw FileError(config_.trace.string(), 0, recorded.problem);
  }

 private:
  void cycle() {
    run_.channels().controls.write(sample_.controls);
    sample_.lever = run_.step();
    sample_.car = car_.state();
    stand_ = judge_(sample_);
    for (HapticEvent event; run_.channels().events.pop(event);) {
      if (config_.hear) config_.hear(event);
    }
    if (config_.watch) config_.watch(sample_);
    const DriverAction action = learner_.act(sample_, stand_.step);
    hand_.target = action.hand;
    sample_.controls = action.controls;
    if (config_.guidance > 0.0) {
      sample_.controls.guidance = config_.guidance;
      sample_.controls.guided_gear = stand_.guided_gear;
    }
    if (recorder_ && sample_.lever.cycle % kPumpEvery == 0) recorder_->pump();
  }

  const LessonDriveConfig& config_;
  const LessonJudge& judge_;
  LessonStand stand_;
  DeviceSpec device_;
  Gate gate_;
  SimulatedRunConfig setup_;
  CarWorld car_;
  GuidedWorld guided_;
  GivenHand hand_;
  SimulatedRun run_;
  SimulatedLearner learner_;
  DriveSample sample_;
  std::optional<TraceRecorder> recorder_;
};

}  // namespace

Gate driven_gate(const GateLayout& layout) {
  const DeviceSpec device = paper_lever();
  return compile_gate(layout, device.workspace, device.yoke_radius);
}

void drive_lesson(const LessonDriveConfig& config, const LessonJudge& judge) {
  Drive(config, judge).to_the_end();
}

LessonResult drive_lesson(const LessonDriveConfig& config) {
  LessonRun run(config.lesson, config.car, driven_gate(config.gate), {config.mode, config.guidance, config.hints});
  drive_lesson(config, [&run](const DriveSample& sample) {
    run.add(sample);
    return LessonStand{run.view().step, run.view().guided_gear, run.is_over()};
  });
  run.leave();  // where the learner has given up
  return run.result();
}

}  // namespace gearshift
