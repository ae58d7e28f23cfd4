// Makes the runtime's configuration from a SessionChoice.
#pragma once

#include "app/lessons/assessment/lesson.h"
#include "app/session/resolve_choice.h"

namespace gearshift::session {

// `lesson`: defines the car's state at the start. If it is null, the car is parked. The hand "by itself" drives the
// lesson or, without a lesson, shifts through all gears again and again. Throws FileError or std::invalid_argument with
// a one-sentence message.
runtime::RuntimeConfig make_runtime_config(const SessionChoice& choice, const ResolvedCar& chosen,
                                           const lessons::Lesson* lesson);

}  // namespace gearshift::session
