#include "app/coach/shipped_lessons.h"

#include <doctest/doctest.h>

#include "app/assets_path.h"
#include "app/training/suggest.h"

using namespace gearshift;

TEST_CASE("every shipped lesson is taught, once, in the order of teaching") {
  const std::vector<Lesson> lessons = shipped_lessons();
  CHECK(lessons.size() == shipped_names("lessons").size());
  for (std::size_t i = 0; i < lessons.size(); ++i) CHECK(lessons[i].key == kTeachingOrder[i]);
}
