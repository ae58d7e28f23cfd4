// Resolves the names in a SessionChoice to a preset, a car and a gate.
#pragma once

#include <optional>
#include <string>

#include "app/lessons/assessment/lesson.h"
#include "app/session/session_choice.h"
#include "app/vehicle/car_spec.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/preset.h"

namespace gearshift::session {

inline constexpr std::string_view kDefaultCar = "hatchback";

// Throws FileError or std::invalid_argument with one sentence.
haptics::Preset resolve_preset(const SessionChoice& choice);

struct ResolvedCar {
  std::string car, gate;                 // names as in SessionChoice; never empty
  std::optional<vehicle::CarSpec> spec;  // empty: kNoCar
  haptics::GateLayout layout;
};

// Replaces empty names in the choice: the car by the default car, the gate by the car's gate. Throws FileError or
// std::runtime_error with one sentence.
ResolvedCar resolve_car(const SessionChoice& choice);

// Returns the choice with its gate replaced. Keeps the car if it has every gear of the new gate; otherwise takes the
// first shipped car that does, or kNoCar if none does. Throws like resolve_car().
SessionChoice with_gate(SessionChoice choice, const std::string& gate);

// Returns the choice with the lesson's car and gate, if the lesson names them. Otherwise keeps the chosen ones, except
// that the default car replaces kNoCar, and the car's gate replaces a gate that does not fit lesson and car. Throws
// like resolve_car().
SessionChoice with_lesson(SessionChoice choice, const lessons::Lesson& lesson);

}  // namespace gearshift::session
