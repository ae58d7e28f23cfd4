// gearshift school: creates a school's tables on a PostgreSQL server, or prints what is there.
#include <atomic>
#include <memory>
#include <sstream>
#include <string>

#include "app/base/console.h"
#include "app/lessons/school/connection.h"
#include "app/lessons/school/server_schema.h"
#include "app/verbs/verbs.h"
#include "haptics/files/printable.h"

namespace gearshift::verbs {
namespace {

constexpr const char* kSchoolHelp = "Create or show the history that several seats share on a PostgreSQL server.";
constexpr const char* kSchoolExamples =
    "\nA seat's login must be a member of the role gearshift_seat, an instructor's login of gearshift_instructor. Give "
    "passwords in\n~/.pgpass, and TLS settings in the URL (sslmode, sslrootcert), as libpq's manual describes.\n"
    "\nExamples:\n"
    "  gearshift school --database postgresql://owner@school/lessons --make       create or renew tables and roles\n"
    "  psql postgresql://owner@school/lessons -c \"CREATE ROLE seat1 LOGIN IN ROLE gearshift_seat\"\n"
    "  gearshift train --learner Ada --database postgresql://seat1@school/lessons\n"
    "  gearshift report --out class --database postgresql://bo@school/lessons     all seats\n"
    "  echo postgresql://seat1@school/lessons >~/.local/share/gearshift/history.db-server     always use it\n";

struct SchoolArguments {
  std::string database;
  bool make = false;
};

int run_school(const SchoolArguments& arguments) {
  const std::atomic<bool> never = false;
  lessons::Connection server(arguments.database, never);
  if (arguments.make) server.run_script(lessons::server_script());
  std::istringstream lines(server.value("SELECT gearshift.summary()").value_or(""));
  for (std::string line; std::getline(lines, line);) base::print_out("{}\n", haptics::printable(line));
  return 0;
}

}  // namespace

void add_school_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<SchoolArguments>();
  CLI::App* verb = app.add_subcommand("school", kSchoolHelp);
  verb->footer(kSchoolExamples);
  verb->add_option("--database", arguments->database, "the server's address")
      ->type_name("URL")
      ->required()
      ->check([](const std::string& url) {
        return lessons::is_server_address(url) ? std::string() : std::string("must begin with postgresql://");
      });
  verb->add_flag("--make", arguments->make,
                 "create the tables, functions and roles, or renew older ones; as their owner");
  verb->callback([arguments, &action] { action = [arguments] { return run_school(*arguments); }; });
}

}  // namespace gearshift::verbs
