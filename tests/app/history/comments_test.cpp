// What an instructor says can be said otherwise, and taken back.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>

#include <doctest/doctest.h>

#include "app/history/history.h"
#include "tests/app/history/some_result.h"
#include "tests/support/temp_folder.h"

using namespace gearshift;

namespace {

struct Said {
  TempFolder folder;
  std::filesystem::path file = folder / "history.db";
  std::int64_t now = 0, run = 0;
  std::optional<History> history{std::in_place, file, [this] { return now; }};

  Said() { run = history->begin_run(history->begin_session(history->learner("Ada"), "1.0"), some_result(0), ""); }
};

}  // namespace

TEST_CASE("a comment that is edited keeps its place, its day and who said it; the last text counts") {
  Said said;
  const std::int64_t first = said.history->add_comment(said.run, "Bo", "Calmer.");
  said.history->add_comment(said.run, "Di", "Fine.");
  said.now = 1'000'000'000;  // the billennium
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

TEST_CASE("a comment that is taken back is gone, from the file's bytes too, and its number is not given again") {
  Said said;
  const std::string secret = "Zymurgic quincunx";
  const std::int64_t kept = said.history->add_comment(said.run, "Bo", "Fine.");
  const std::int64_t gone = said.history->add_comment(said.run, "Bo", secret);
  CHECK(said.history->delete_comment(gone));
  CHECK_FALSE(said.history->delete_comment(gone));
  CHECK_FALSE(said.history->edit_comment(gone, "Who reads this?"));
  REQUIRE(said.history->comments(said.run).size() == 1);
  CHECK(said.history->comments(said.run)[0].id == kept);
  CHECK(said.history->add_comment(said.run, "Bo", "Again.") > gone);
  said.history.reset();  // the last to go empties the log
  for (const auto& entry : std::filesystem::directory_iterator(said.folder.path())) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    CHECK(bytes.find(secret) == std::string::npos);
  }
}
