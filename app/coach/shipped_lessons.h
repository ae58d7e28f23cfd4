// The lessons that come with the program.
#pragma once

#include <vector>

#include "app/training/lesson.h"

namespace gearshift {

// As they build on each other: kTeachingOrder. Throws FileError, std::runtime_error: the program's own files are not
// there.
std::vector<Lesson> shipped_lessons();

}  // namespace gearshift
