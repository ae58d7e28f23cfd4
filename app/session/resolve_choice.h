// Resolves the names of a car and a gate in a SessionChoice, and makes them fit each other and a lesson.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/lessons/assessment/lesson.h"
#include "app/session/session_choice.h"
#include "app/vehicle/car_spec.h"
#include "haptics/gate/gate_layout.h"

namespace gearshift::session {

inline constexpr std::string_view kDefaultCar = "hatchback";

struct ResolvedCar {
  std::string car, gate;                 // same kinds of names as in SessionChoice, but never empty
  std::optional<vehicle::CarSpec> spec;  // empty: kNoCar
  haptics::GateLayout layout;
};

// Replaces empty names in the choice: the car by the default car, or none in a gate of aisles, the gate by the car's. Throws FileError or
// std::runtime_error with a one-sentence message.
ResolvedCar resolve_car(const SessionChoice& choice);

// Returns the choice with its gate replaced. Keeps the car if it has every gear of the new gate. Otherwise the choice
// gets the first shipped car that has every gear, or kNoCar if there is no such car. Throws like resolve_car().
SessionChoice with_gate(SessionChoice choice, const std::string& gate);

// Returns the choice with the lesson's car and gate, if the lesson names them. Otherwise keeps the chosen ones, with
// two exceptions: the default car replaces kNoCar, and the car's gate replaces a gate that does not fit lesson and car.
// Throws like resolve_car().
SessionChoice with_lesson(SessionChoice choice, const lessons::Lesson& lesson);
// Says why with_lesson() has replaced the chosen gate; empty if the choice named none, the lesson names its own, or the
// gate fits.
std::string describe_replaced_gate(const SessionChoice& choice, const SessionChoice& with,
                                   const lessons::Lesson& lesson);

}  // namespace gearshift::session
