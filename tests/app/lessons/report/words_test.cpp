#include <doctest/doctest.h>

#include "app/lessons/report/report_text.h"

using namespace gearshift::lessons;

TEST_CASE("numbers have a true minus sign, and none before a zero") {
  CHECK(format_number(-0.125, 2) == "−0.12");
  CHECK(format_number(-0.004, 2) == "0.00");
  CHECK(format_number(-0.0, 1) == "0.0");
  CHECK(format_number(12.0, 0) == "12");
}

TEST_CASE("the length of a break is written in hours or days") {
  CHECK(format_pause(20.0 * 3600.0) == "20 hours");
  CHECK(format_pause(47.4 * 3600.0) == "47 hours");
  CHECK(format_pause(7.2 * 86400.0) == "7 days");
}

TEST_CASE("an unknown lesson is shown by its key") {
  std::vector<Lesson> lessons(1);
  lessons[0].key = "hill_start";
  lessons[0].title = "Hill start";
  CHECK(lesson_title(lessons, "hill_start") == "Hill start");
  CHECK(lesson_title(lessons, "my_own_lesson") == "My own lesson");
  CHECK(lesson_title({}, "") == "");
}
