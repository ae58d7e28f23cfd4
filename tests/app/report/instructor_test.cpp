// The instructor's word by its number, and the report that shows the last one.
#include "app/report/instructor.h"

#include <stdexcept>

#include <doctest/doctest.h>

#include "app/report/learner_history.h"
#include "app/report/report_page.h"
#include "tests/app/history/some_result.h"
#include "tests/app/report/page_parts.h"
#include "tests/support/temp_folder.h"

using namespace gearshift;

TEST_CASE("said, said otherwise, taken back: the page shows the last text, and nobody else's can be touched") {
  const TempFolder folder;
  History history(folder / "history.db");
  std::int64_t run[2] = {};
  for (int i = 0; i < 2; ++i) {
    const std::int64_t learner = history.learner(i == 0 ? "Ada" : "Bob");
    run[i] = history.begin_run(history.begin_session(learner, "1.0"), some_result(0), "");
    history.end_run(run[i], some_result(2));
  }
  const LearnerRow ada = history.find_learner("Ada").value(), bob = history.find_learner("Bob").value();
  const auto said = [&] {
    const LearnerHistory all = read_learner(history, ada);
    return table_of(report_page(all, {}, {}), "runs").at(0).at(6);
  };
  const std::int64_t word = comment_on_run(history, ada, run[0], "Bo", "Zymurgic.");
  CHECK(said().find("Zymurgic.") != std::string::npos);
  edit_comment(history, ada, word, "Quincunx.");
  CHECK(said().find("Quincunx.") != std::string::npos);
  CHECK(said().find("Zymurgic.") == std::string::npos);

  CHECK_THROWS_WITH_AS(comment_on_run(history, ada, run[1], "Bo", "No."), "run 2 is none of Ada's; known: 1",
                       std::runtime_error);
  CHECK_THROWS_WITH_AS(edit_comment(history, bob, word, "No."), "comment 1 is none of Bob's; known: none yet",
                       std::runtime_error);
  CHECK_THROWS_AS(delete_comment(history, bob, word), std::runtime_error);
  CHECK_THROWS_AS(edit_comment(history, ada, word, "No. "), std::invalid_argument);
  CHECK(said().find("Quincunx.") != std::string::npos);
  delete_comment(history, ada, word);
  CHECK(said().find("Quincunx.") == std::string::npos);
  CHECK_THROWS_WITH_AS(delete_comment(history, ada, word), "comment 1 is none of Ada's; known: none yet",
                       std::runtime_error);
}
