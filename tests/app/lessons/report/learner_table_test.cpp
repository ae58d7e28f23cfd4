#include "app/lessons/report/learner_table.h"

#include <doctest/doctest.h>

#include "tests/app/lessons/report/constructed_history.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

TEST_CASE("the table has one line per learner: sessions, runs, last day and next lesson") {
  std::vector<LearnerHistory> learners(2);
  learners[0].learner.name = "Ada";
  for (int i = 0; i < 3; ++i) learners[0].runs.push_back(run_with(i + 1, 1, 9.0));
  learners[0].runs[2].session = 2;
  learners[1].learner.name = "Bo\n\x1b[31mred";
  learners[1].learner.next_lesson = "reverse";
  std::vector<Lesson> lessons(2);
  lessons[1].key = lessons[1].task = "reverse";
  lessons[0].key = "drill";
  lessons[0].task = "upshift";
  const std::string table = learner_table(learners, lessons);
  CHECK(table ==
        "learner      sessions  runs  last day    next lesson\n"
        "Ada                 2     3  2026-01-04  reverse\n"
        "Bo ?[31mred         0     0  -           reverse (chosen by the instructor)\n");
  learners[1].learner.next_lesson = "lessons/reverse.toml";  // ignored: the coach does not offer this lesson
  CHECK(learner_table(learners, lessons).find("instructor") == std::string::npos);
  CHECK(run_table(learners[0]).find("    3  2026-01-04  drill                     do it yourself    9.0  passed\n") !=
        std::string::npos);
  CHECK(run_table(learners[0]).find("comment") == std::string::npos);
  learners[0].runs[1].comments = {{"2026-01-09T10:00:00Z", "Bo", "Calmer.\nSlower.", 7},
                                  {"2026-01-10T10:00:00Z", "Di", "Fine.", 8, "2026-01-11T10:00:00Z"}};
  const std::string runs = run_table(learners[0]);
  CHECK(runs.substr(runs.find("\n\n")) ==
        "\n\n    2  comment 7, Bo, 2026-01-09: Calmer. Slower.\n"
        "    2  comment 8, Di, 2026-01-10, edited: Fine.\n");
}
