#include "app/session/make_runtime_config.h"

#include <memory>
#include <stdexcept>

#include "app/base/program_name.h"
#include "app/lessons/simulated_driver/auto_driver.h"
#include "app/vehicle/lesson_load.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"

namespace gearshift::session {
namespace {

runtime::DriverFunction automatic_driver(const runtime::RuntimeConfig& runtime, const vehicle::CarSpec& car,
                                         const lessons::Lesson* lesson) {
  const haptics::YokeGeometry& yoke = runtime.preset.lever.yoke;
  lessons::AutoDriverConfig config;
  config.gate = haptics::compile_gate(runtime.layout, haptics::workspace_half_extent(yoke), yoke.radius);
  config.car = car;
  config.lesson = lesson ? *lesson : lessons::tour_lesson(car, config.gate);
  config.again = lesson == nullptr;
  config.seed = runtime.seed;
  config.period = haptics::period_s(runtime.preset.haptics);
  const auto driver = std::make_shared<lessons::AutoDriver>(config);
  return [driver](const vehicle::DriveSample& sample) { return driver->act(sample); };
}

}  // namespace

runtime::RuntimeConfig make_runtime_config(const SessionChoice& choice, const ResolvedCar& chosen,
                                           const lessons::Lesson* lesson) {
  runtime::RuntimeConfig config;
  config.preset = resolve_preset(choice);
  config.layout = chosen.layout;
  config.car = chosen.spec;
  config.clock = choice.clock;
  config.seed = choice.seed;
  config.program = base::program_name();
  if (lesson) {
    config.start = lessons::car_start(lesson->start);
    config.hand_brake = lesson->start.hand_brake;
  }
  if (choice.stick) config.lever = [stick = choice.stick](double period) { return stick->lever(period); };
  if (choice.hand != kAutomaticHand) return config;
  if (choice.stick)
    throw std::invalid_argument("hand \"by itself\" works only with the simulated lever, not with a stick");
  if (!config.car) throw std::invalid_argument("hand \"by itself\" needs a car; choose a car or another hand");
  config.driver = automatic_driver(config, *config.car, lesson);
  return config;
}

}  // namespace gearshift::session
