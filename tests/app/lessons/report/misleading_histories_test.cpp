// Histories about which an earlier version of the report misled the instructor. For each, a control that must still be
// judged the other way.
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "app/lessons/report/report_page.h"
#include "tests/app/lessons/report/constructed_history.h"
#include "tests/app/lessons/report/page_parts.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

std::vector<Lesson> five_lessons() {
  std::vector<Lesson> lessons(5);
  const char* keys[] = {"start", "bite_point", "moving_off", "reverse", "hill_start"};
  const char* titles[] = {"Start", "Bite point", "Moving off", "Reverse", "Hill start"};
  for (std::size_t i = 0; i < 5; ++i) {
    lessons[i].key = lessons[i].task = keys[i];
    lessons[i].title = titles[i];
  }
  return lessons;
}

struct Told {
  LearnerHistory history;

  LessonResult& drive(const char* lesson, double grade, bool passed) {
    history.runs.push_back(run_with(static_cast<std::int64_t>(history.runs.size()) + 1, 1, grade));
    LessonResult& result = history.runs.back().result;
    result.lesson = result.task = lesson;
    result.passed = passed;
    return result;
  }
  void stall(LessonResult& result, int times) {
    for (int i = 0; i < times; ++i)
      result.errors.push_back(make_driving_error(ErrorKind::stall, Severity::severe, 1.0, 40.0, -1));
  }
  std::string page() const { return report_page(history, {}, five_lessons()); }
  std::string next() const { return without_markup(between(page(), "id=\"next\">", "</p>")); }
  std::string row_of(const char* table, const std::string& name) const {
    const std::string all = page();
    for (const auto& row : table_of(all, table)) {
      if (!row[0].starts_with(name)) continue;
      std::string text;
      for (const std::string& cell : row) text += "|" + cell;
      return text;
    }
    return {};
  }
};

bool has(const std::string& text, const char* words) {
  return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE(
    "six attempts, three guided and three given up, are seen in what the learner can, in errors and in the next "
    "lesson") {
  Told told;
  told.drive("start", 9.0, true);
  for (int i = 0; i < 6; ++i) {
    LessonResult& result = told.drive("bite_point", 0.0, false);
    told.stall(result, 1);
    if (i < 3)
      result.guided = true;
    else
      result.end = LessonEnd::left;
  }
  CHECK(has(told.row_of("standings", "Bite point"), "|not yet|No graded attempt yet: 3 guided, 3 given up."));
  CHECK(has(told.row_of("weaknesses", "Stall"), "||6|"));  // six severe errors
  CHECK(has(told.next(), "Next lesson:  Bite point . You haven't passed Bite point yet (3 guided, 3 given up)."));
  CHECK(has(told.row_of("standings", "Moving off"), "|not tried|"));
  // Control: a run that never ended is no attempt.
  Told open;
  open.drive("bite_point", 0.0, false).end = LessonEnd::running;
  CHECK(has(open.row_of("standings", "Bite point"), "|not tried|"));
}

TEST_CASE("a lesson that was never passed is the next one, before a lesson that was passed and became weak") {
  Told told;
  told.drive("start", 9.0, true);
  told.drive("hill_start", 9.0, true);
  for (int i = 0; i < 3; ++i) told.drive("hill_start", 2.0, false);
  CHECK(has(told.next(), "Next lesson:  Bite point . You haven't passed Bite point yet."));
  // Control: once the others are passed, the weak lesson is next.
  for (const char* lesson : {"bite_point", "moving_off", "reverse"}) told.drive(lesson, 9.0, true);
  CHECK(has(told.next(), "Hill start needs practice: 3 of the last 3 attempts failed"));
}

TEST_CASE("grades 0.0, 9.5 and 10.0 are an improvement, not a weakness; 10.0, 9.5 and 0.0 are a weakness") {
  for (const bool improves : {true, false}) {
    CAPTURE(improves);
    Told told;
    for (const char* lesson : {"start", "bite_point", "moving_off", "hill_start"}) told.drive(lesson, 8.0, true);
    told.drive("reverse", 8.0, true);
    const std::vector<double> grades = improves ? std::vector{0.0, 9.5, 10.0} : std::vector{10.0, 9.5, 0.0};
    for (const double grade : grades) told.drive("reverse", grade, grade == 10.0);  // 9.5 with an error that fails
    CHECK(has(told.next(), "Reverse needs practice") == !improves);
    CHECK(has(told.row_of("standings", "Reverse"), "|can|") == improves);
  }
}

TEST_CASE("eight stalls that are gone are an improvement, and said; eight that come and go are not") {
  // The stalls of each run, oldest first.
  const std::vector<std::vector<int>> gone{
      {1, 1, 1, 1, 1, 1, 1, 1, 0, 0}, {4, 4, 0, 0, 0, 0}, {3, 3, 2, 0, 0, 0}, {8, 0, 0, 0, 0, 0}};
  for (const auto& runs : gone) {
    CAPTURE(runs.size());
    Told told;
    for (const int stalls : runs) told.stall(told.drive("start", 6.0, true), stalls);
    CHECK(has(told.row_of("weaknesses", "Stall"), "gone: none in the last "));
    CHECK(has(without_markup(section_of(told.page(), "weaknesses")), "Improved: stall (8 earlier, none in the last "));
  }
  for (const auto& runs :
       std::vector<std::vector<int>>{{0, 0, 8}, {4, 0, 4}, {1, 0, 2, 1, 0, 2, 2, 0}, {0, 0, 0, 8, 0}}) {
    Told told;
    for (const int stalls : runs) told.stall(told.drive("start", 6.0, true), stalls);
    CHECK_FALSE(has(told.page(), "Improved: stall"));
    CHECK_FALSE(has(told.row_of("weaknesses", "Stall"), "gone"));
  }
  // Other lessons, in which the learner never stalled, say nothing about stalls.
  Told elsewhere;
  elsewhere.stall(elsewhere.drive("start", 2.0, false), 8);
  for (int i = 0; i < 9; ++i) elsewhere.drive("reverse", 9.0, true);
  CHECK_FALSE(has(elsewhere.page(), "Improved: stall"));
}

TEST_CASE("no page speaks of the letters of a formula") {
  Told told;
  for (int i = 0; i < 12; ++i) told.drive("start", 9.9 - 5.0 * std::exp(-i / 1.15) + (i % 2 == 0 ? 0.1 : -0.1), true);
  const std::string text = without_markup(section_of(told.page(), "learning"));
  for (const char* letters : {"A =", "B =", "τ", "±", "exp"}) CHECK_FALSE(has(text, letters));
}
