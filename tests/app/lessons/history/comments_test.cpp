// An instructor's comment can be edited and deleted.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>

#include <doctest/doctest.h>

#include "app/lessons/history/history.h"
#include "tests/app/lessons/history/sample_result.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

struct CommentRig {
  TempFolder folder;
  std::filesystem::path file = folder / "history.db";
  std::int64_t now = 0, run = 0;
  std::optional<History> history{std::in_place, file, [this] { return now; }};

  CommentRig() {
    run = history->begin_run(history->begin_session(history->find_or_add_learner("Ada"), "1.0"), some_result(0), "");
  }
};

}  // namespace

TEST_CASE("an edited comment keeps its position, date and author, and has its last text") {
  CommentRig rig;
  const std::int64_t first = rig.history->add_comment(rig.run, "Bo", "Calmer.");
  rig.history->add_comment(rig.run, "Di", "Fine.");
  rig.now = 1'000'000'000;  // Unix time; this is 2001-09-09 in UTC
  CHECK(rig.history->edit_comment(first, "Much calmer."));
  CHECK(rig.history->edit_comment(first, "Very calm."));
  History other(rig.file);
  const std::vector<CommentRow> comments = comments_of(other, rig.run);
  REQUIRE(comments.size() == 2);
  CHECK(comments[0].id == first);
  CHECK(comments[0].text == "Very calm.");
  CHECK(comments[0].author == "Bo");
  CHECK(comments[0].at == "1970-01-01T00:00:00Z");
  CHECK(comments[0].edited_at == "2001-09-09T01:46:40Z");
  CHECK(comments[1].text == "Fine.");
  CHECK(comments[1].edited_at.empty());
  CHECK_THROWS_AS(rig.history->edit_comment(first, " "), std::invalid_argument);
  CHECK(comments_of(other, rig.run)[0].text == "Very calm.");
}

TEST_CASE("a deleted comment also disappears from the file's bytes, and its number is not used again") {
  CommentRig rig;
  const std::string secret = "Zymurgic quincunx";
  const std::int64_t other_id = rig.history->add_comment(rig.run, "Bo", "Fine.");
  const std::int64_t deleted_id = rig.history->add_comment(rig.run, "Bo", secret);
  CHECK(rig.history->delete_comment(deleted_id));
  CHECK_FALSE(rig.history->delete_comment(deleted_id));
  CHECK_FALSE(rig.history->edit_comment(deleted_id, "Who reads this?"));
  REQUIRE(comments_of(*rig.history, rig.run).size() == 1);
  CHECK(comments_of(*rig.history, rig.run)[0].id == other_id);
  CHECK(rig.history->add_comment(rig.run, "Bo", "Again.") > deleted_id);
  rig.history.reset();  // closing the last connection empties the write-ahead log
  for (const auto& entry : std::filesystem::directory_iterator(rig.folder.path())) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    CHECK(bytes.find(secret) == std::string::npos);
  }
}
