// Without a server: addresses, messages without passwords, and an outage reported once. tests/flow/school.sh has servers.
#include <atomic>
#include <chrono>
#include <fstream>
#include <optional>
#include <string>

#include <doctest/doctest.h>

#include "app/lessons/school/connection.h"
#include "app/lessons/school/server_link.h"
#include "app/lessons/school/server_schema.h"
#include "tests/app/lessons/history/sample_result.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

constexpr const char* kNobodyListens = "postgresql://ada:hunter2@127.0.0.1:1/lessons";  // port 1: tcpmux, unused

std::string message_of(const std::string& address) {
  const std::atomic<bool> never = false;
  try {
    Connection connection(address, never, std::chrono::seconds(5));
  } catch (const ServerError& problem) {
    return problem.what();
  }
  return {};
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("an address is told from a file, and shown without its password") {
  CHECK(is_server_address("postgresql://host/name"));
  CHECK(is_server_address("postgres://host/name"));
  CHECK_FALSE(is_server_address("history.db"));
  CHECK(printable_address(kNobodyListens) == "127.0.0.1:1/lessons");
  CHECK(printable_address("host=school dbname=lessons password=hunter2") == "school/lessons");
  for (const char* bad : {"postgresql://ada:hunt@er2@school/lessons", "postgresql://ada:hunter2@[school/lessons",
                          "password=hunter2 nothing", "postgresql://ada:hunter2@school/lessons?none=1"}) {
    CAPTURE(bad);
    CHECK(printable_address(bad) == "the server's address");
    CHECK(contains(message_of(bad), "is none that libpq can read"));
    for (const char* secret : {"hunt", "er2"}) CHECK_FALSE(contains(message_of(bad), secret));
  }
}

TEST_CASE("a refused connection is one sentence without the password") {
  const std::string message = message_of(kNobodyListens);
  CHECK(contains(message, "the server cannot be used because"));
  CHECK_FALSE(contains(message, "hunter2"));
  CHECK_FALSE(contains(message, "\n"));
}

TEST_CASE("the server of a history is named in a file beside it") {
  const TempFolder folder;
  CHECK(server_of(folder / "history.db").empty());
  CHECK(server_of("").empty());
  std::ofstream(folder / "history.db-server") << kNobodyListens << "\n";
  CHECK(server_of(folder / "history.db") == kNobodyListens);
  std::ofstream(folder / "history.db-server").flush();
  CHECK_THROWS_AS(server_of(folder / "history.db"), HistoryError);
}

TEST_CASE("without its server a seat reports the outage once, and what is unsent at the end") {
  const TempFolder folder;
  const auto file = folder / "history.db";
  write_one_run(file, 2);
  ServerLink link(file, kNobodyListens);
  link.finish(std::chrono::seconds(20));
  const std::optional<std::string> outage = link.take_message(), unsent = link.take_message();
  REQUIRE(outage);
  REQUIRE(unsent);
  CHECK(contains(*outage, "results are kept here and sent later"));
  CHECK(contains(*unsent, "1 run is not on the server yet"));
  CHECK_FALSE(link.take_message());
  CHECK(Exchange(file, HistoryUse::read).unsent_runs() == 1);
}

TEST_CASE("the server's tables have the columns of the history") {
  const std::string script = server_script();
  each_field(LessonResult(), [&](const RecordField& field, const auto&) {
    CHECK(contains(script, std::string(field.name) + " = excluded." + field.name));
  });
  CHECK_FALSE(contains(script, "AUTOINCREMENT"));
  CHECK_FALSE(contains(script, "{per}"));
}
