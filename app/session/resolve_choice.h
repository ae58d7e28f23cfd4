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

// Fills names that the choice leaves empty from the car or with defaults. Throws FileError or std::runtime_error with
// one sentence.
ResolvedCar resolve_car(const SessionChoice& choice);

// The choice with another gate. Keeps the car if it has every gear of the gate, else takes the first shipped car that
// has, else kNoCar. Throws like resolve_car().
SessionChoice with_gate(SessionChoice choice, const std::string& gate);

// The choice with the lesson's car and gate, where the lesson names them. Otherwise keeps the chosen ones, but replaces
// a gate that lacks one of the lesson's gears. Throws like resolve_car().
SessionChoice with_lesson(SessionChoice choice, const lessons::Lesson& lesson);

}  // namespace gearshift::session
