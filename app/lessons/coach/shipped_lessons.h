// The lessons that come with the program.
#pragma once

#include <vector>

#include "app/lessons/assessment/lesson.h"

namespace gearshift::lessons {

// Returns the lessons in the order of kTeachingOrder. Throws FileError or std::runtime_error if the program's own files
// are missing.
std::vector<Lesson> shipped_lessons();

}  // namespace gearshift::lessons
