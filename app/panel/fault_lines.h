// A fault in words, and below it what to do about it.
#pragma once

#include <cstddef>
#include <vector>

#include "app/training/lesson_result.h"
#include "engine/ui/ui_style.h"

namespace gearshift {

// What to do, the first time that a fault of its kind is told: `told` are those above it. Nothing for what is only noted.
bool needs_advice(const LessonResult& result, std::size_t fault, const std::vector<std::size_t>& told);
void put_advice(FaultKind kind);

}  // namespace gearshift
