// Makes the runtime's configuration from a SessionChoice.
#pragma once

#include "app/lessons/assessment/lesson.h"
#include "app/session/resolve_choice.h"

namespace gearshift::session {

// lesson: defines the state in which the car starts; null: no lesson, the car is parked. The hand "by itself" drives
// the lesson or, without a lesson, laps through all gears. Throws FileError or std::invalid_argument with one sentence.
runtime::RuntimeConfig make_runtime_config(const SessionChoice& choice, const ResolvedCar& chosen,
                                           const lessons::Lesson* lesson);

}  // namespace gearshift::session
