#include "app/session/resolve_choice.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

#include <fmt/core.h>

#include "app/base/assets_path.h"
#include "app/base/program_name.h"
#include "app/lessons/simulated_driver/auto_driver.h"
#include "app/session/preset_store.h"
#include "haptics/device/hand.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"

namespace gearshift::session {
namespace {

std::vector<int> gears_of(const haptics::GateLayout& layout) {
  std::vector<int> gears{haptics::kNeutralGear};
  if (layout.sequential_gears > 0) {
    gears.push_back(haptics::kReverseGear);
    for (int gear = 1; gear <= layout.sequential_gears; ++gear) gears.push_back(gear);
    return gears;
  }
  for (const haptics::ColumnLayout& column : layout.columns) {
    gears.push_back(column.forward.gear);
    gears.push_back(column.back.gear);
  }
  return gears;
}

bool has_gears_of(const vehicle::CarSpec& car, const haptics::GateLayout& layout) {
  const std::vector<int> gears = gears_of(layout);
  return std::all_of(gears.begin(), gears.end(), [&car](int gear) {
    return gear == haptics::kNeutralGear || vehicle::shaft_per_road(car, gear) != 0.0;
  });
}

// Lessons teach gates with a slot per gear.
bool has_gears_of(const haptics::GateLayout& layout, const lessons::Lesson& lesson) {
  if (layout.sequential_gears > 0) return false;
  const std::vector<int> gears = gears_of(layout);
  const auto has = [&gears](int gear) { return std::find(gears.begin(), gears.end(), gear) != gears.end(); };
  return has(lesson.start.gear) &&
         std::all_of(lesson.steps.begin(), lesson.steps.end(), [&has](const lessons::LessonStep& step) {
           return has(step.gear) && has(step.until.gear.value_or(haptics::kNeutralGear));
         });
}

haptics::GateLayout read_gate(const std::string& name) {
  return haptics::read_gate_layout(base::find_asset("gates", name));
}

vehicle::CarSpec read_shipped_car(const std::string& name) {
  return vehicle::read_car(base::find_asset("cars", name));
}

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

haptics::Preset resolve_preset(const SessionChoice& choice) {
  haptics::Preset preset = haptics::read_preset(preset_file(choice.preset).string());
  if (choice.haptics) preset.haptics = *choice.haptics;
  if (choice.hand.empty() || choice.hand == kAutomaticHand) return preset;
  const std::optional<haptics::HandImpedance> hand = haptics::parse_hand(choice.hand);
  if (!hand || hand->stiffness < haptics::kMinLeadingStiffness)
    throw std::invalid_argument(fmt::format(
        "\"{}\" is not a valid hand: use light, grip, arm, \"{}\" or M,B,K (kg, N s/m and N/m, with a stiffness of at "
        "least {:g} N/m)",
        choice.hand, kAutomaticHand, haptics::kMinLeadingStiffness));
  preset.lever.hand = *hand;
  return preset;
}

ResolvedCar resolve_car(const SessionChoice& choice) {
  ResolvedCar chosen;
  chosen.car = choice.car.empty() ? std::string(kDefaultCar) : choice.car;
  if (chosen.car != kNoCar) chosen.spec = read_shipped_car(chosen.car);
  chosen.gate = choice.gate;
  if (chosen.gate.empty()) chosen.gate = chosen.spec ? chosen.spec->gate : "paper";
  chosen.layout = read_gate(chosen.gate);
  return chosen;
}

runtime::RuntimeConfig make_runtime_config(const SessionChoice& choice, const ResolvedCar& chosen,
                                           const lessons::Lesson* lesson) {
  runtime::RuntimeConfig config;
  config.preset = resolve_preset(choice);
  config.layout = chosen.layout;
  config.car = chosen.spec;
  config.clock = choice.clock;
  config.seed = choice.seed;
  config.pedal_timing = choice.pedal_timing;
  config.program = base::program_name();
  if (lesson) {
    config.start = lessons::car_start(lesson->start);
    config.pedals.hand_brake = lesson->start.hand_brake;
  }
  if (choice.stick) config.lever = [stick = choice.stick](double period) { return stick->lever(period); };
  if (choice.hand != kAutomaticHand) return config;
  if (choice.stick)
    throw std::invalid_argument("hand \"by itself\" works only with the simulated lever, not with a stick");
  if (config.layout.sequential_gears > 0)
    throw std::invalid_argument(
        "hand \"by itself\" needs a gate with a slot for each gear, and this one is sequential; choose another gate or "
        "another hand");
  if (!config.car) throw std::invalid_argument("hand \"by itself\" needs a car; choose a car or another hand");
  config.driver = automatic_driver(config, *config.car, lesson);
  return config;
}

SessionChoice with_gate(SessionChoice choice, const std::string& gate) {
  const haptics::GateLayout layout = read_gate(gate);
  choice.gate = gate;
  if (choice.car == kNoCar) return choice;
  if (has_gears_of(*resolve_car(choice).spec, layout)) return choice;
  const std::vector<std::string> cars = base::shipped_names("cars");
  const auto fits = [&layout](const std::string& car) { return has_gears_of(read_shipped_car(car), layout); };
  const auto other = std::find_if(cars.begin(), cars.end(), fits);
  choice.car = other == cars.end() ? std::string(kNoCar) : *other;
  return choice;
}

SessionChoice with_lesson(SessionChoice choice, const lessons::Lesson& lesson) {
  if (!lesson.car.empty()) choice.car = lesson.car;
  if (choice.car == kNoCar) choice.car = kDefaultCar;
  const vehicle::CarSpec car = *resolve_car(choice).spec;
  if (!lesson.gate.empty()) choice.gate = lesson.gate;
  if (choice.gate.empty()) choice.gate = car.gate;
  const haptics::GateLayout layout = read_gate(choice.gate);
  const bool fits = has_gears_of(layout, lesson) && has_gears_of(car, layout);
  if (!fits && lesson.gate.empty()) choice.gate = car.gate;
  return choice;
}

std::string describe_replaced_gate(const SessionChoice& choice, const SessionChoice& with,
                                   const lessons::Lesson& lesson) {
  if (choice.gate.empty() || !lesson.gate.empty() || with.gate == choice.gate) return {};
  const char* needs = read_gate(choice.gate).sequential_gears > 0 ? "a slot for each gear" : "other gears";
  return fmt::format("This lesson needs {}, so the gate is {} instead of {}.", needs, with.gate, choice.gate);
}

}  // namespace gearshift::session
