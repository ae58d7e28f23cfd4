#include "app/lessons/coach/shipped_lessons.h"

#include <doctest/doctest.h>

#include "app/base/assets_path.h"
#include "app/lessons/assessment/suggest.h"

using namespace gearshift::base;
using namespace gearshift::lessons;

TEST_CASE("every shipped lesson is in the teaching order exactly once") {
  const std::vector<Lesson> lessons = shipped_lessons();
  CHECK(lessons.size() == shipped_names("lessons").size());
  for (std::size_t i = 0; i < lessons.size(); ++i) CHECK(lessons[i].key == kTeachingOrder[i]);
}
