#include "app/lessons/coach/shipped_lessons.h"

#include <string>
#include <string_view>
#include <vector>

#include "app/base/assets_path.h"
#include "app/lessons/assessment/suggest.h"

namespace gearshift::lessons {

std::vector<Lesson> shipped_lessons() {
  const auto file_of = [](std::string_view key) { return base::find_asset("lessons", std::string(key)); };
  const std::vector<Norm> norms = norms_beside(file_of(kTeachingOrder[0]));
  std::vector<Lesson> lessons;
  for (const std::string_view key : kTeachingOrder) lessons.push_back(read_lesson(file_of(key), norms));
  return lessons;
}

}  // namespace gearshift::lessons
