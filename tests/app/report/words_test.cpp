#include "app/report/words.h"

#include <doctest/doctest.h>

using namespace gearshift;

TEST_CASE("numbers: a true minus, none before a nought") {
  CHECK(number_words(-0.125, 2) == "−0.12");
  CHECK(number_words(-0.004, 2) == "0.00");
  CHECK(number_words(-0.0, 1) == "0.0");
  CHECK(number_words(12.0, 0) == "12");
}

TEST_CASE("a lesson that is not known any more is called by its key") {
  std::vector<Lesson> lessons(1);
  lessons[0].key = "hill_start";
  lessons[0].title = "Hill start";
  CHECK(lesson_title(lessons, "hill_start") == "Hill start");
  CHECK(lesson_title(lessons, "my_own_lesson") == "My own lesson");
  CHECK(lesson_title({}, "") == "");
}
