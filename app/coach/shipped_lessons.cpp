#include "app/coach/shipped_lessons.h"

#include <string>

#include "app/assets_path.h"
#include "app/training/suggest.h"

namespace gearshift {

std::vector<Lesson> shipped_lessons() {
  std::vector<Lesson> lessons;
  for (const std::string_view name : kTeachingOrder)
    lessons.push_back(read_lesson(find_asset("lessons", std::string(name))));
  return lessons;
}

}  // namespace gearshift
