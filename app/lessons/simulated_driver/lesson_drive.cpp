#include "app/lessons/simulated_driver/lesson_drive.h"

#include "app/lessons/assessment/lesson_run.h"
#include "app/lessons/simulated_driver/simulated_driver.h"

namespace gearshift::lessons {
namespace {

SimulatedDriveConfig drive_config(const LessonDriveConfig& config) {
  return {config.car,   config.gate,    car_start(config.lesson.start), config.seed, config.rate,
          config.trace, config.on_event};
}

class Drive {
 public:
  Drive(const LessonDriveConfig& config, const LessonJudge& judge)
      : config_(config),
        judge_(judge),
        drive_(drive_config(config)),
        driver_(config.lesson, config.car, drive_.gate(), config.skill, config.errors, config.seed, drive_.period()) {
    action_.hand.position = haptics::rest_position(drive_.gate(), config.lesson.start.gear);
    action_.controls.ignition = config.lesson.start.running;
    action_.controls.pedals.hand_brake = config.lesson.start.hand_brake;
    action_.controls.pedals.brake = config.lesson.start.brake;
    action_.controls.slope = config.lesson.start.slope;
  }

  void to_the_end() {
    while (!progress_.is_over && !driver_.has_given_up()) cycle();
    drive_.finish();
  }

 private:
  void cycle() {
    const vehicle::DriveSample& sample = drive_.step(action_);
    progress_ = judge_(sample);
    if (config_.on_cycle) config_.on_cycle(sample);
    action_ = driver_.act(sample, progress_.step);
    if (config_.guidance > 0.0) {
      action_.controls.guidance = config_.guidance;
      action_.controls.guided_gear = progress_.guided_gear;
    }
  }

  const LessonDriveConfig& config_;
  const LessonJudge& judge_;
  LessonProgress progress_;
  SimulatedDrive drive_;
  SimulatedDriver driver_;
  vehicle::DriverAction action_;
};

}  // namespace

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
