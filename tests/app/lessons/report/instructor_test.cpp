// Tests that the instructor addresses comments by their numbers, and that the report shows each comment's latest text.
#include "app/lessons/report/instructor.h"

#include <stdexcept>

#include <doctest/doctest.h>

#include "app/lessons/report/learner_history.h"
#include "app/lessons/report/report_page.h"
#include "tests/app/lessons/history/sample_result.h"
#include "tests/app/lessons/report/page_parts.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

TEST_CASE(
    "a comment is added, edited and deleted; the page shows its last text, and other learners' comments are rejected") {
  const TempFolder folder;
  History history(folder / "history.db");
  std::int64_t run[2] = {};
  for (int i = 0; i < 2; ++i) {
    const std::int64_t learner = history.find_or_add_learner(i == 0 ? "Ada" : "Bob");
    run[i] = history.begin_run(history.begin_session(learner, "1.0"), some_result(0), "");
    history.end_run(run[i], some_result(2));
  }
  const LearnerRow ada = history.find_learner("Ada").value(), bob = history.find_learner("Bob").value();
  const auto comment_cell = [&] {
    const LearnerHistory all = read_learner(history, ada);
    return table_of(report_page(all, {}, {}), "runs").at(0).at(6);
  };
  const std::int64_t comment = comment_on_run(history, ada, run[0], "Bo", "Zymurgic.");
  CHECK(comment_cell().find("Zymurgic.") != std::string::npos);
  edit_comment(history, ada, comment, "Quincunx.");
  CHECK(comment_cell().find("Quincunx.") != std::string::npos);
  CHECK(comment_cell().find("Zymurgic.") == std::string::npos);

  CHECK_THROWS_WITH_AS(comment_on_run(history, ada, run[1], "Bo", "No."),
                       "run 2 does not belong to Ada, who has these runs: 1", std::runtime_error);
  CHECK_THROWS_WITH_AS(edit_comment(history, bob, comment, "No."),
                       "comment 1 does not belong to Bob, who has these comments: none", std::runtime_error);
  CHECK_THROWS_AS(delete_comment(history, bob, comment), std::runtime_error);
  CHECK_THROWS_AS(edit_comment(history, ada, comment, "N\to."), std::invalid_argument);
  CHECK(comment_cell().find("Quincunx.") != std::string::npos);
  delete_comment(history, ada, comment);
  CHECK(comment_cell().find("Quincunx.") == std::string::npos);
  CHECK_THROWS_WITH_AS(delete_comment(history, ada, comment),
                       "comment 1 does not belong to Ada, who has these comments: none", std::runtime_error);
}
