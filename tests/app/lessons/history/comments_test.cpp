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

TEST_CASE("an edited comment keeps its position, date and author; the last text counts") {
  CommentRig said;
  const std::int64_t first = said.history->add_comment(said.run, "Bo", "Calmer.");
  said.history->add_comment(said.run, "Di", "Fine.");
  said.now = 1'000'000'000;  // the Unix billennium, 2001-09-09
  CHECK(said.history->edit_comment(first, "Much calmer."));
  CHECK(said.history->edit_comment(first, "Very calm."));
  History other(said.file);
  const std::vector<CommentRow> comments = other.comments(said.run);
  REQUIRE(comments.size() == 2);
  CHECK(comments[0].id == first);
  CHECK(comments[0].text == "Very calm.");
  CHECK(comments[0].author == "Bo");
  CHECK(comments[0].at == "1970-01-01T00:00:00Z");
  CHECK(comments[0].edited_at == "2001-09-09T01:46:40Z");
  CHECK(comments[1].text == "Fine.");
  CHECK(comments[1].edited_at.empty());
  CHECK_THROWS_AS(said.history->edit_comment(first, " "), std::invalid_argument);
  CHECK(other.comments(said.run)[0].text == "Very calm.");
}

TEST_CASE("a deleted comment is gone, also from the file's bytes, and its number is not reused") {
  CommentRig said;
  const std::string secret = "Zymurgic quincunx";
  const std::int64_t kept = said.history->add_comment(said.run, "Bo", "Fine.");
  const std::int64_t gone = said.history->add_comment(said.run, "Bo", secret);
  CHECK(said.history->delete_comment(gone));
  CHECK_FALSE(said.history->delete_comment(gone));
  CHECK_FALSE(said.history->edit_comment(gone, "Who reads this?"));
  REQUIRE(said.history->comments(said.run).size() == 1);
  CHECK(said.history->comments(said.run)[0].id == kept);
  CHECK(said.history->add_comment(said.run, "Bo", "Again.") > gone);
  said.history.reset();  // the last connection to close empties the write-ahead log
  for (const auto& entry : std::filesystem::directory_iterator(said.folder.path())) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    CHECK(bytes.find(secret) == std::string::npos);
  }
}
