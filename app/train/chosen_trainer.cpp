#include "app/train/chosen_trainer.h"

#include <memory>
#include <stdexcept>

#include "app/learner/auto_driver.h"
#include "app/program_name.h"
#include "app/training/lesson_world.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"

namespace gearshift {
namespace {

SelfDriver self_driver(const TrainerConfig& trainer, const CarSpec& car, const Lesson* lesson) {
  const YokeGeometry& yoke = trainer.preset.lever.yoke;
  AutoDriverConfig config;
  config.gate = compile_gate(trainer.layout, workspace_half_extent(yoke), yoke.radius);
  config.car = car;
  config.lesson = lesson ? *lesson : tour_lesson(car, config.gate);
  config.again = lesson == nullptr;
  config.seed = trainer.seed;
  config.period = period_s(trainer.preset.haptics);
  const auto driver = std::make_shared<AutoDriver>(config);
  return [driver](const DriveSample& sample) { return driver->act(sample); };
}

}  // namespace

TrainerConfig chosen_trainer(const SessionChoice& choice, const ChosenCar& chosen, const Lesson* lesson) {
  TrainerConfig config;
  config.preset = read_chosen_preset(choice);
  config.layout = chosen.layout;
  config.car = chosen.spec;
  config.clock = choice.clock;
  config.seed = choice.seed;
  config.program = program_name();
  if (lesson) {
    config.start = car_start(lesson->start);
    config.hand_brake = lesson->start.hand_brake;
  }
  if (choice.stick) config.lever = [stick = choice.stick](double period) { return stick->lever(period); };
  if (choice.hand != kByItself) return config;
  if (choice.stick) throw std::invalid_argument("a hand by itself has the simulated lever: a person holds the stick");
  if (!config.car) throw std::invalid_argument("a hand by itself drives a car: without one a person leads the lever");
  config.driver = self_driver(config, *config.car, lesson);
  return config;
}

}  // namespace gearshift
