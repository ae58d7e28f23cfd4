#include "app/session/resolve_choice.h"

#include <algorithm>
#include <vector>

#include <fmt/core.h>

#include "app/base/assets_path.h"
#include "haptics/gate/gate.h"

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
  if (!layout.aisles.empty()) return false;  // no car has a gate of aisles
  const std::vector<int> gears = gears_of(layout);
  return std::all_of(gears.begin(), gears.end(), [&car](int gear) {
    return gear == haptics::kNeutralGear || vehicle::shaft_per_road(car, gear) != 0.0;
  });
}

// Lessons teach gates with a slot per gear.
bool has_gears_of(const haptics::GateLayout& layout, const lessons::Lesson& lesson) {
  if (layout.sequential_gears > 0 || !layout.aisles.empty()) return false;
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

}  // namespace

ResolvedCar resolve_car(const SessionChoice& choice) {
  ResolvedCar chosen;
  const bool has_car = choice.gate.empty() || read_gate(choice.gate).aisles.empty();
  chosen.car = !choice.car.empty() ? choice.car : has_car ? std::string(kDefaultCar) : std::string(kNoCar);
  if (chosen.car != kNoCar) chosen.spec = read_shipped_car(chosen.car);
  chosen.gate = choice.gate;
  if (chosen.gate.empty()) chosen.gate = chosen.spec ? chosen.spec->gate : "paper";
  chosen.layout = read_gate(chosen.gate);
  return chosen;
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
  if (choice.car.empty() || choice.car == kNoCar) choice.car = kDefaultCar;  // a gate of aisles has none by itself
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
  const haptics::GateLayout layout = read_gate(choice.gate);
  const bool has_slots = layout.sequential_gears == 0 && layout.aisles.empty();
  const char* needs = has_slots ? "other gears" : "a slot for each gear";
  return fmt::format("This lesson needs {}, so the gate is {} instead of {}.", needs, with.gate, choice.gate);
}

}  // namespace gearshift::session
