// Rows go from one history to another and arrive as they were; each change is sent, and sent once.
#include "app/lessons/history/exchange.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "app/lessons/history/schema.h"
#include "tests/app/lessons/history/sample_result.h"
#include "tests/support/history_version_1.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::lessons;
using namespace gearshift::test;
using Json = nlohmann::json;

namespace {

void give_seat(Exchange& exchange, std::int64_t number) {
  SeatState state = exchange.seat();
  state.seat = number;
  exchange.set_seat(state);
}

// Everything unsent, marked as sent.
std::vector<Parcel> send_all(Exchange& exchange) {
  std::vector<Parcel> all;
  while (std::optional<Parcel> parcel = exchange.next_parcel("here:")) {
    exchange.mark_sent(*parcel);
    all.push_back(*parcel);
  }
  return all;
}

// A history with one run of Ada's, whose figures have no short decimal form, and a comment.
struct Seat {
  explicit Seat(const std::filesystem::path& file, std::int64_t number) : exchange(file) {
    give_seat(exchange, number);
    ada = exchange.history().find_or_add_learner("Ada");
    drive();
  }
  std::int64_t drive(int shifts = 3) {
    LessonResult result = some_result(shifts);
    result.duration = 1.0 / 3.0;
    const std::int64_t session = exchange.history().begin_session(ada, "1.0");
    const std::int64_t run = exchange.history().begin_run(session, result, "recordings/a.trace");
    exchange.history().end_run(run, result);
    return run;
  }
  std::vector<RunRow> runs() { return exchange.history().runs(ada); }

  Exchange exchange;
  std::int64_t ada = 0;
};

}  // namespace

TEST_CASE("a learner's rows arrive in another history to the last bit, with the place of the recording") {
  const TempFolder folder;
  Seat a(folder / "a/history.db", 1), b(folder / "b/history.db", 2);
  a.exchange.history().add_comment(a.runs()[0].id, "Bo", "Läuft \"so\"; DROP TABLE comment; --");
  const std::vector<Parcel> parcels = send_all(a.exchange);
  REQUIRE(parcels.size() == 1);
  CHECK(parcels[0].runs == 1);
  for (int twice = 0; twice < 2; ++twice) {  // received twice, it is there once
    b.exchange.receive(parcels[0].document, {});
    const std::vector<RunRow> runs = b.runs();
    REQUIRE(runs.size() == 2);
    const auto from_a = std::find_if(runs.begin(), runs.end(), [](const RunRow& run) { return run.id > kRowsPerSeat; });
    REQUIRE(from_a != runs.end());
    CHECK(from_a->id == kRowsPerSeat + a.runs()[0].id);
    check_same(from_a->result, a.runs()[0].result);
    CHECK(from_a->recording.empty());  // never a file of the same name on this seat
    CHECK(from_a->kept_at == "here:" + (folder / "a/recordings/a.trace").string());
    REQUIRE(from_a->comments.size() == 1);
    CHECK(from_a->comments[0].text == "Läuft \"so\"; DROP TABLE comment; --");
  }
  CHECK(b.exchange.history().learners().size() == 1);
  // Only b's own rows are left to send, and b's next rows are numbered on.
  for (const Parcel& parcel : send_all(b.exchange)) CHECK(Json::parse(parcel.document)["runs"].size() == 1);
  CHECK(b.drive() == 2);
}

TEST_CASE("a row that changes while it is sent is sent again") {
  const TempFolder folder;
  Seat a(folder / "history.db", 1);
  Parcel parcel = *a.exchange.next_parcel("");
  a.exchange.history().end_run(a.runs()[0].id, some_result(5));
  a.exchange.mark_sent(parcel);
  parcel = *a.exchange.next_parcel("");
  CHECK(Json::parse(parcel.document)["shifts"].size() == 5);
  CHECK(Json::parse(parcel.document)["sessions"].empty());
  a.exchange.mark_sent(parcel);
  CHECK_FALSE(a.exchange.next_parcel(""));
}

TEST_CASE("rows that a history in memory numbers as in documents are sent once") {
  Exchange exchange("memory", HistoryUse::memory);
  give_seat(exchange, 4);
  exchange.number_as_in_documents();
  const std::int64_t ada = exchange.history().find_or_add_learner("Ada");
  CHECK(ada == 4 * kRowsPerSeat + 1);
  const std::vector<Parcel> parcels = send_all(exchange);
  REQUIRE(parcels.size() == 1);
  CHECK(Json::parse(parcels[0].document)["learner"]["id"] == ada);
  CHECK(Json::parse(parcels[0].document)["learner"]["changed"] == true);
  CHECK(exchange.own_number(ada) == ada);
}

TEST_CASE("deletions are sent as such, and an erased learner leaves nothing else to send") {
  const TempFolder folder;
  Seat a(folder / "history.db", 3);
  const std::int64_t comment = a.exchange.history().add_comment(a.runs()[0].id, "Bo", "Calmer.");
  send_all(a.exchange);
  a.exchange.history().delete_comment(comment);
  std::vector<Parcel> parcels = send_all(a.exchange);
  REQUIRE(parcels.size() == 1);
  CHECK(parcels[0].kind == Parcel::Kind::deleted_comment);
  CHECK(parcels[0].row == 3 * kRowsPerSeat + comment);
  a.drive();
  CHECK(a.exchange.history().erase_learner(a.ada, [](const auto&) {}).empty());
  parcels = send_all(a.exchange);
  REQUIRE(!parcels.empty());
  const auto erased = [](const Parcel& parcel) { return parcel.kind == Parcel::Kind::erased_learner; };
  CHECK(std::count_if(parcels.begin(), parcels.end(), erased) == 1);
  for (const Parcel& parcel : parcels) CHECK(parcel.kind != Parcel::Kind::rows);
}

TEST_CASE("more runs than one document holds are all sent, and comments never before their run") {
  const TempFolder folder;
  Seat a(folder / "history.db", 1);
  for (int i = 0; i < 430; ++i) {
    const std::int64_t run = a.drive(0);
    if (i % 100 == 99) a.exchange.history().add_comment(run, "Bo", "Calmer.");
  }
  std::vector<std::int64_t> runs;
  std::size_t comments = 0;
  for (const Parcel& parcel : send_all(a.exchange)) {
    const Json document = Json::parse(parcel.document);
    for (const Json& run : document["runs"]) runs.push_back(run["id"]);
    for (const Json& comment : document["comments"]) {
      CHECK(std::find(runs.begin(), runs.end(), comment["run"].get<std::int64_t>()) != runs.end());
      ++comments;
    }
  }
  CHECK(runs.size() == 431);
  CHECK(comments == 4);
}

TEST_CASE("a history of an older version is upgraded with everything unsent, and its next numbers are new") {
  const TempFolder folder;
  const auto file = folder / "history.db";
  write_one_run(file, 2);
  {
    History history(file);
    (void)history.erase_learner(history.find_or_add_learner("Zoe"), [](const auto&) {});  // her number stays used
  }
  SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec(kToHistoryVersion1);
  Exchange exchange(file);
  give_seat(exchange, 1);
  const std::vector<Parcel> parcels = send_all(exchange);
  REQUIRE(parcels.size() == 1);
  const Json document = Json::parse(parcels[0].document);
  CHECK(document["learner"]["name"] == "Ada");
  CHECK(document["runs"].size() == 1);
  CHECK(document["shifts"].size() == 2);
  CHECK(exchange.history().find_or_add_learner("Bo") == 3);
}

TEST_CASE("what is not a document, and a value that cannot be, change nothing") {
  const TempFolder folder;
  Seat a(folder / "a.db", 1), b(folder / "b.db", 2);
  Json document = Json::parse(send_all(a.exchange).at(0).document);
  const auto refused = [&](const std::string& text) {
    try {
      b.exchange.receive(text, {});
      return false;
    } catch (const HistoryError&) {
      return true;
    }
  };
  CHECK(refused(""));
  CHECK(refused("{"));
  CHECK(refused("{}"));
  document["shifts"][1].erase("run");
  CHECK(refused(document.dump()));
  document["shifts"][1]["run"] = 99 * kRowsPerSeat;  // a run that is not there
  CHECK(refused(document.dump()));
  CHECK(b.runs().size() == 1);
  const Json unsent = Json::parse(b.exchange.next_parcel("")->document);
  CHECK(unsent["runs"].size() == 1);
}

TEST_CASE("a damaged file is sent as possible values") {
  const TempFolder folder;
  const auto file = folder / "history.db";
  Seat a(file, 1);
  SQLite::Database(file.string(), SQLite::OPEN_READWRITE)
      .exec("UPDATE lesson_run SET duration_s = 9e999, grade = 'text', why = x'ff00', passed = 1.5, score = x'ff'");
  const Json run = Json::parse(a.exchange.next_parcel("")->document)["runs"][0];
  CHECK(run["duration_s"] == 0.0);
  CHECK(run["grade"] == 0.0);
  CHECK(run["passed"] == 1);
  CHECK(run["score"] == 0.0);
  CHECK(run["why"].get<std::string>().find('\0') == std::string::npos);
}

TEST_CASE("learners who are one at the server become one, with all runs, and no erasure is sent") {
  const TempFolder folder;
  Seat a(folder / "history.db", 1);
  const std::int64_t eve = a.exchange.history().find_or_add_learner("Eve");
  const std::int64_t session = a.exchange.history().begin_session(eve, "1.0");
  a.exchange.history().end_run(a.exchange.history().begin_run(session, some_result(0), ""), some_result(1));
  send_all(a.exchange);
  Json document{
      {"learner", {{"id", 5 * kRowsPerSeat}, {"name", "Ada"}, {"made_at", ""}, {"next_lesson", ""}, {"version", 4}}}};
  for (const char* none : {"sessions", "runs", "shifts", "errors", "comments"}) document[none] = Json::array();
  a.exchange.receive(document.dump(), kRowsPerSeat + eve);
  CHECK(a.exchange.history().learners().size() == 2);  // Ada has her name already
  document["learner"]["name"] = "Ada Lovelace";
  a.exchange.receive(document.dump(), kRowsPerSeat + a.ada);
  REQUIRE(a.exchange.history().learners().size() == 1);
  CHECK(a.exchange.history().learners()[0].name == "Ada Lovelace");
  CHECK(a.runs().size() == 2);
  CHECK_FALSE(a.exchange.next_parcel(""));
  REQUIRE(a.exchange.known_learners().size() == 1);
  CHECK(a.exchange.known_learners()[0].version == 4);
}

TEST_CASE("files of several seats are read as one history") {
  const TempFolder folder;
  { Seat a(folder / "a.db", 0), b(folder / "b.db", 0); }
  Exchange all(folder / "all.db");
  for (int twice = 0; twice < 2; ++twice) {
    copy_learners(folder / "a.db", 101, all);
    copy_learners(folder / "b.db", 102, all);
    REQUIRE(all.history().learners().size() == 1);
    CHECK(all.history().runs(all.history().learners()[0].id).size() == 2);
  }
}

TEST_CASE("only one process at a time exchanges rows with the server") {
  const TempFolder folder;
  Exchange a(folder / "history.db");
  {
    Exchange b(folder / "history.db");
    CHECK(b.reserve());
    CHECK_FALSE(a.reserve());
  }
  CHECK(a.reserve());
}
