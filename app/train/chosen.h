// From the names of a choice to gate, car and preset.
#pragma once

#include <optional>
#include <string>

#include "app/train/session_choice.h"
#include "app/training/lesson.h"
#include "app/vehicle/car_spec.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/preset.h"

namespace gearshift {

inline constexpr std::string_view kUsualCar = "hatchback";

// Throws FileError or std::invalid_argument with one sentence.
Preset read_chosen_preset(const SessionChoice& choice);

struct ChosenCar {
  std::string car, gate;        // names, as SessionChoice has them; none is empty
  std::optional<CarSpec> spec;  // none: kNoCar
  GateLayout layout;
};

// What the choice leaves open is the car's or usual. Throws FileError or std::runtime_error with one sentence.
ChosenCar read_chosen_car(const SessionChoice& choice);

// The choice for another gate: its car, where it has every gear of the gate, else the first shipped one that has, else
// kNoCar. Throws as read_chosen_car().
SessionChoice with_gate(SessionChoice choice, const std::string& gate);

// The choice for that lesson: its own car and gate go before what is chosen, what is chosen stays where the lesson leaves
// it open and it has the lesson's gears. Throws as read_chosen_car().
SessionChoice with_lesson(SessionChoice choice, const Lesson& lesson);

}  // namespace gearshift
