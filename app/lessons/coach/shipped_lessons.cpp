#include "app/lessons/coach/shipped_lessons.h"

#include <string>

#include "app/base/assets_path.h"
#include "app/lessons/assessment/suggest.h"

namespace gearshift::lessons {

std::vector<Lesson> shipped_lessons() {
  std::vector<Lesson> lessons;
  for (const std::string_view name : kTeachingOrder)
    lessons.push_back(read_lesson(base::find_asset("lessons", std::string(name))));
  return lessons;
}

}  // namespace gearshift::lessons
