// gearshift report: learners' results as a table, a page or CSV. Also edits comments, sets the next lesson, renames and
// deletes learners.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/base/console.h"
#include "app/base/output_folder.h"
#include "app/lessons/coach/shipped_lessons.h"
#include "app/lessons/history/history.h"
#include "app/lessons/report/delete_learner.h"
#include "app/lessons/report/instructor.h"
#include "app/lessons/report/learner_table.h"
#include "app/lessons/report/report_csv.h"
#include "app/lessons/report/report_files.h"
#include "app/lessons/report/report_json.h"
#include "app/lessons/report/report_page.h"
#include "app/lessons/school/exchange_with_server.h"
#include "app/verbs/distinct_outputs.h"
#include "app/verbs/history_choice.h"
#include "app/verbs/lesson_options.h"
#include "app/verbs/print_json.h"
#include "app/verbs/verbs.h"
#include "haptics/files/printable.h"

namespace gearshift::verbs {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReportHelp =
    "Show the results of all learners, or of one learner, as a table, a web page, CSV files or JSON.";
constexpr const char* kReportExamples =
    "\nExamples:\n"
    "  gearshift report                                      all learners\n"
    "  gearshift report --learner Ada                        Ada's runs\n"
    "  gearshift report --out class --csv                    all learners: class/index.html, standings.csv\n"
    "  gearshift report --out class --database a.db --database b.db     all learners of two seats\n"
    "  gearshift report --learner Ada --out ada --csv        ada/index.html, runs.csv, shifts.csv, errors.csv\n"
    "  gearshift report --learner Ada --out ada --csv --separator semicolon    for a spreadsheet with decimal commas\n"
    "  gearshift report --learner Ada --comment 12 \"Much calmer.\" --by Bo\n"
    "  gearshift report --learner Ada --edit-comment 3 \"Calmer.\"   3 is the number of the comment in the table of "
    "runs\n"
    "  gearshift report --learner Ada --delete-comment 3\n"
    "  gearshift report --learner Ada --next hill_start      overrides the suggested lesson; \"\" restores the "
    "suggestion\n"
    "  gearshift report --learner Ada --rename \"Ada Lovelace\"\n"
    "  gearshift report --learner Ada --delete               permanently deletes Ada's results and recordings\n";

constexpr std::int64_t kFirstFileSeat = 900'000'000;  // for files of no school's seat

constexpr const char *kPage = "index.html", *kRuns = "runs.csv", *kShifts = "shifts.csv", *kErrors = "errors.csv",
                     *kStandings = "standings.csv";

const std::map<std::string, char> kSeparators{{"comma", ','}, {"semicolon", ';'}, {"tab", '\t'}};

using NumberedText = std::pair<std::int64_t, std::string>;

struct ReportArguments {
  std::string learner, out, by, next, name;
  std::vector<std::string> databases;           // empty: the user's own history
  std::string separator = "comma", decimal;     // decimal: empty, "point" or "comma"
  std::optional<NumberedText> comment, edit;    // `comment`: run number, text; `edit`: comment number, new text
  std::optional<std::int64_t> deleted_comment;  // number of the comment to delete
  bool csv = false, json = false, sets_next = false, deletes_learner = false, yes = false;
};

bool has_instructor_options(const ReportArguments& arguments) {
  return arguments.comment || arguments.edit || arguments.deleted_comment || arguments.sets_next ||
         !arguments.name.empty();
}

std::string known_names(lessons::History& history) {
  std::string names;
  for (const lessons::LearnerRow& row : history.learners())
    names += (names.empty() ? "" : ", ") + haptics::printable(row.name);
  return names.empty() ? "none yet" : names;
}

lessons::LearnerRow known_learner(lessons::History& history, const std::string& name) {
  if (std::optional<lessons::LearnerRow> row = history.find_learner(name)) return *row;
  throw std::runtime_error(
      fmt::format("no learner named \"{}\"; known learners: {}", haptics::printable(name), known_names(history)));
}

// Where a list separator is a semicolon, the decimal sign is a comma, except in a few locales (Switzerland).
base::CsvFormat csv_format(const ReportArguments& arguments) {
  const bool has_comma = arguments.decimal.empty() ? arguments.separator == "semicolon" : arguments.decimal == "comma";
  return {kSeparators.at(arguments.separator), has_comma, true};
}

void write_files(const ReportArguments& arguments, const std::vector<lessons::ReportFile>& files) {
  base::make_folder(arguments.out);
  lessons::write_report_files(arguments.out, files,
                              [](const fs::path& file) { base::print_out("{}\n", file.string()); });
}

int report_class(const ReportArguments& arguments, lessons::History& history) {
  std::vector<lessons::LearnerHistory> all;
  for (const lessons::LearnerRow& row : history.learners()) all.push_back(lessons::read_learner(history, row));
  const std::vector<lessons::Lesson> lessons = lessons::shipped_lessons();
  if (arguments.json) {
    auto json = nlohmann::ordered_json{{"learners", nlohmann::ordered_json::array()}};
    for (const lessons::LearnerHistory& each : all) json["learners"].push_back(lessons::standing_json(each, lessons));
    print_json(json);
    return 0;
  }
  if (arguments.out.empty()) {
    base::print_out("{}", lessons::learner_table(all, lessons));
    return 0;
  }
  std::vector<lessons::ReportFile> files{{kPage, lessons::class_page(all, lessons)}};
  if (arguments.csv) files.push_back({kStandings, lessons::standings_csv(all, lessons, csv_format(arguments))});
  write_files(arguments, files);
  return 0;
}

void check_out(const ReportArguments& arguments, const fs::path& history) {
  if (arguments.out.empty()) return;
  for (const char* name : {kPage, kRuns, kShifts, kErrors, kStandings})
    check_distinct_outputs("--out", "the report and the history", fs::path(arguments.out) / name, history);
}

void write_report(const ReportArguments& arguments, lessons::History& history, const lessons::LearnerRow& learner) {
  const lessons::LearnerHistory all = lessons::read_learner(history, learner);
  std::vector<lessons::ReportFile> files{
      {kPage,
       lessons::report_page(all, lessons::show_shifts(all, history.file().parent_path()), lessons::shipped_lessons())}};
  if (arguments.csv) {
    const base::CsvFormat format = csv_format(arguments);
    files.push_back({kRuns, lessons::runs_csv(all, format)});
    files.push_back({kShifts, lessons::shifts_csv(all, format)});
    files.push_back({kErrors, lessons::errors_csv(all, format)});
  }
  write_files(arguments, files);
}

void rename(const std::string& name, lessons::History& history, lessons::LearnerRow& learner) {
  if (!history.rename_learner(learner.id, name))
    throw std::runtime_error(fmt::format("{} is another learner; add something that tells them apart",
                                         haptics::printable(history.find_learner(name).value_or(learner).name)));
  const std::string before = std::exchange(learner.name, lessons::stored_name(name));
  base::print_out("{} is now called {}\n", haptics::printable(before), haptics::printable(learner.name));
}

// Sets the learner's next lesson. `lesson` is the key of a shipped lesson; if empty, the suggested lesson comes next.
void set_next(const std::string& lesson, lessons::History& history, const lessons::LearnerRow& learner) {
  const std::vector<lessons::Lesson> lessons = lessons::shipped_lessons();
  std::string keys;
  for (const lessons::Lesson& each : lessons) keys += (keys.empty() ? "" : ", ") + each.key;
  const bool is_known =
      std::any_of(lessons.begin(), lessons.end(), [&](const lessons::Lesson& l) { return l.key == lesson; });
  if (!lesson.empty() && !is_known)
    throw std::runtime_error(
        fmt::format("there is no lesson \"{}\"; the shipped lessons are {}", haptics::printable(lesson), keys));
  history.set_next_lesson(learner.id, lesson);
  base::print_out("{}: the next lesson is {}\n", haptics::printable(learner.name),
                  lesson.empty() ? "the suggested one" : haptics::printable(lesson));
}

void apply_instructor_options(const ReportArguments& arguments, lessons::History& history,
                              lessons::LearnerRow& learner) {
  if (!arguments.name.empty()) rename(arguments.name, history, learner);
  if (arguments.comment) {
    const auto& [run, text] = *arguments.comment;
    const std::int64_t number = lessons::comment_on_run(history, learner, run, arguments.by, text);
    base::print_out("comment {} on run {}, by {}: {}\n", number, run, haptics::printable(arguments.by),
                    haptics::printable(text));
  }
  if (arguments.edit) {
    const auto& [number, text] = *arguments.edit;
    lessons::edit_comment(history, learner, number, text);
    base::print_out("comment {} changed to: {}\n", number, haptics::printable(text));
  }
  if (arguments.deleted_comment) {
    lessons::delete_comment(history, learner, *arguments.deleted_comment);
    base::print_out("comment {} deleted\n", *arguments.deleted_comment);
  }
  if (arguments.sets_next) set_next(arguments.next, history, learner);
}

std::string counted(std::size_t number, std::string_view noun) {
  return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
}

// Prints `left`, the reason why deleted rows may still be readable in the history file; empty if none are. Returns the
// exit code.
int report_leftovers(const std::string& left) {
  if (!left.empty()) base::print_message("{}", haptics::printable(left));
  return left.empty() ? 0 : 1;
}

void print_recordings(const lessons::DeletionReport& deletion) {
  for (const std::string& file : deletion.recordings) base::print_out("  {}\n", haptics::printable(file));
  for (const std::string& file : deletion.missing) base::print_out("  not found: {}\n", haptics::printable(file));
  for (const std::string& file : deletion.not_deleted)
    base::print_message("could not be deleted: {}", haptics::printable(file));
}

void confirm(const ReportArguments& arguments, const lessons::LearnerRow& learner) {
  if (arguments.yes) return;
  base::print_to(stderr,
                 fmt::format("This permanently deletes all results and recordings of {}. Type the name to confirm: ",
                             haptics::printable(learner.name)));
  std::string again;
  const bool is_answered = static_cast<bool>(std::getline(std::cin, again));
  if (lessons::stored_name(again) == learner.name) return;
  const bool is_line_open = !is_answered || isatty(STDIN_FILENO) == 0;  // in a terminal, Enter has ended the line
  if (is_line_open) base::print_to(stderr, "\n");
  throw std::runtime_error(fmt::format("{} was not deleted: {}", haptics::printable(learner.name),
                                       is_answered ? "the name does not match" : "no answer given"));
}

// Deletes the learner. If the learner no longer exists, completes an earlier deletion that was interrupted. `first`:
// recordings that are already deleted.
int erase_learner(const ReportArguments& arguments, lessons::History& history, const std::vector<std::string>& first) {
  if (!history.find_learner(arguments.learner) && history.erasure_is_pending()) {
    const std::string left = history.finish_erasure();
    if (left.empty())
      base::print_out("no learner named {}; an earlier, incomplete deletion is now finished\n",
                      haptics::printable(arguments.learner));
    return report_leftovers(left);
  }
  const lessons::LearnerRow learner = known_learner(history, arguments.learner);
  confirm(arguments, learner);
  lessons::DeletionReport deletion = lessons::delete_learner(history, learner);
  std::erase_if(deletion.missing,
                [&](const std::string& file) { return std::find(first.begin(), first.end(), file) != first.end(); });
  base::print_out(
      "deleted {}: {}, {}, {}, {}, {}, {}\n", haptics::printable(learner.name), counted(deletion.sessions, "session"),
      counted(deletion.runs, "run"), counted(deletion.shifts, "shift"), counted(deletion.errors, "driving error"),
      counted(deletion.comments, "comment"), counted(deletion.recordings.size() + first.size(), "recording"));
  print_recordings(deletion);
  const int code = report_leftovers(deletion.remaining_data);
  return deletion.not_deleted.empty() ? code : 1;
}

std::unique_ptr<lessons::History> try_open_history(const fs::path& file) {
  try {
    auto history = std::make_unique<lessons::History>(file);
    if (!history->upgrade_note().empty()) base::print_message("{}", haptics::printable(history->upgrade_note()));
    return history;
  } catch (const lessons::HistoryFull&) {
    return nullptr;
  }
}

// Deletes the learner from the history. If the disk is too full to open the history for writing, deletes the learner's
// recordings first.
int delete_history(ReportArguments arguments, const fs::path& file) {
  std::unique_ptr<lessons::History> history = try_open_history(file);
  std::vector<std::string> first;
  if (!history) {
    lessons::History copy(file, lessons::system_seconds, lessons::kHistoryLockTimeout, lessons::HistoryUse::read);
    const lessons::LearnerRow learner = known_learner(copy, arguments.learner);
    confirm(arguments, learner);
    arguments.yes = true;
    const lessons::DeletionReport deletion = lessons::remove_recordings(copy, learner);
    base::print_out("The disk is full, so {} {} deleted first.\n", counted(deletion.recordings.size(), "recording"),
                    deletion.recordings.size() == 1 ? "was" : "were");
    print_recordings(deletion);
    first = deletion.recordings;
    history = std::make_unique<lessons::History>(file);
  }
  return erase_learner(arguments, *history, first);
}

int report_learner(const ReportArguments& arguments, lessons::History& history) {
  lessons::LearnerRow learner = known_learner(history, arguments.learner);
  apply_instructor_options(arguments, history, learner);
  if (!arguments.out.empty()) write_report(arguments, history, learner);
  if (arguments.json)
    print_json(lessons::history_json(lessons::read_learner(history, learner), lessons::shipped_lessons()));
  else if (arguments.out.empty() && !has_instructor_options(arguments))
    base::print_out("{}", lessons::run_table(lessons::read_learner(history, learner)));
  return 0;
}

int report_any(const ReportArguments& arguments, lessons::History& history) {
  if (arguments.learner.empty()) return report_class(arguments, history);
  return report_learner(arguments, history);
}

int report_file(const ReportArguments& arguments, const fs::path& file) {
  lessons::History history(file, lessons::system_seconds, lessons::kHistoryLockTimeout,
                           has_instructor_options(arguments) ? lessons::HistoryUse::write : lessons::HistoryUse::read);
  if (!history.upgrade_note().empty()) base::print_message("{}", haptics::printable(history.upgrade_note()));
  return report_any(arguments, history);
}

bool writes(const ReportArguments& arguments) {
  return has_instructor_options(arguments) || arguments.deletes_learner;
}

// Reports on several files as on one history. Learners of the same name are one.
int report_files(const ReportArguments& arguments) {
  if (writes(arguments))
    throw CLI::ValidationError("--database", "results can be changed in one history at a time only");
  lessons::Exchange all("several histories", lessons::HistoryUse::memory);
  std::int64_t seat = kFirstFileSeat;
  for (const std::string& file : arguments.databases) {
    if (lessons::is_server_address(file))
      throw CLI::ValidationError("--database", "a server must be the only database");
    check_out(arguments, file);
    if (!fs::exists(file)) throw std::runtime_error(fmt::format("{}: history not found", haptics::printable(file)));
    lessons::copy_learners(file, seat++, all);
  }
  return report_any(arguments, all.history());
}

// Reports on all learners of a school. What an instructor changes is on the server when this returns.
int report_server(const ReportArguments& arguments) {
  const std::atomic<bool> never = false;
  lessons::Connection server(arguments.databases[0], never);
  lessons::Exchange all(lessons::printable_address(arguments.databases[0]), lessons::HistoryUse::memory);
  lessons::fetch_all(server, all);
  if (!writes(arguments)) return report_any(arguments, all.history());
  lessons::greet(server, all);
  all.number_as_in_documents();
  const int code =
      arguments.deletes_learner ? erase_learner(arguments, all.history(), {}) : report_any(arguments, all.history());
  lessons::Exchanged done;
  lessons::exchange(server, all, done);
  return code;
}

// Runs the verb. Never creates a history. Opens the history read-only if possible, so that no write permission is
// needed.
int run_report(const ReportArguments& arguments) {
  if (arguments.databases.size() > 1) return report_files(arguments);
  const std::string database = arguments.databases.empty() ? std::string() : arguments.databases[0];
  if (lessons::is_server_address(database)) return report_server(arguments);
  const HistoryChoice choice = choose_history(database);
  if (!choice.place.problem.empty()) throw std::runtime_error(choice.place.problem);
  const fs::path file = choice.place.file;
  check_out(arguments, file);
  std::error_code error;
  if (!fs::exists(file, error) && !error) {
    if (!database.empty() || !arguments.learner.empty())
      throw std::runtime_error(fmt::format("{}: history not found", haptics::printable(file.string())));
    arguments.json ? print_json({{"learners", nlohmann::ordered_json::array()}})
                   : base::print_out("No lesson has been driven yet.\n");
    return 0;
  }
  const int code = arguments.deletes_learner ? delete_history(arguments, file) : report_file(arguments, file);
  if (!choice.server.empty() && writes(arguments)) {
    lessons::ServerLink server(file, choice.server);
    finish_exchange(server);
  }
  return code;
}

std::string not_empty(const std::string& value) {
  return value.empty() ? "must not be empty" : std::string();
}

std::string check_author_name(const std::string& name) {
  return lessons::user_text_problem(lessons::UserText::name, "an instructor's name", name);
}

void check_comment(const char* option, const std::optional<NumberedText>& comment) {
  const std::string problem =
      comment ? lessons::user_text_problem(lessons::UserText::comment, "a comment", comment->second) : std::string();
  if (!problem.empty()) throw CLI::ValidationError(option, problem);
}

}  // namespace

void add_report_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* verb = app.add_subcommand("report", kReportHelp);
  verb->footer(kReportExamples);
  CLI::Option* learner =
      verb->add_option("--learner", arguments->learner, "learner to report on")->type_name("NAME")->check(not_empty);
  verb->add_option(
          "--database", arguments->databases,
          "history file to use instead of your own, or postgresql:// URL of a school's server; give it several "
          "times to report on several files together")
      ->type_name("FILE")
      ->expected(1)
      ->take_all()
      ->check(not_empty);
  CLI::Option* out =
      verb->add_option("--out", arguments->out, "write the page to this folder")->type_name("FOLDER")->check(not_empty);
  CLI::Option* csv =
      verb->add_flag("--csv", arguments->csv, "also write CSV files: of a learner, runs, shifts and driving errors")
          ->needs(out);
  CLI::Option* json =
      verb->add_flag("--json", arguments->json, "print JSON to stdout instead of a table: of a learner, with all runs")
          ->excludes(out);
  verb->add_option("--separator", arguments->separator, "between the fields of CSV files: comma, semicolon or tab")
      ->type_name("NAME")
      ->check(CLI::IsMember(kSeparators).description(""))
      ->needs(csv);
  verb->add_option("--decimal", arguments->decimal,
                   "decimal sign in CSV files: point or comma (default: comma with --separator semicolon)")
      ->type_name("NAME")
      ->check(CLI::IsMember({"point", "comma"}).description(""))
      ->needs(csv);
  CLI::Option* comment = verb->add_option("--comment", arguments->comment, "add a comment to a run")
                             ->type_name("RUN TEXT")
                             ->needs(learner)
                             ->excludes(json);
  CLI::Option* by = verb->add_option("--by", arguments->by, "comment author")
                        ->type_name("NAME")
                        ->check(check_author_name)
                        ->needs(comment);
  comment->needs(by);
  CLI::Option* edit = verb->add_option("--edit-comment", arguments->edit, "replace the text of a comment")
                          ->type_name("COMMENT TEXT")
                          ->needs(learner)
                          ->excludes(json);
  CLI::Option* deleted_comment =
      verb->add_option("--delete-comment", arguments->deleted_comment, "permanently delete a comment")
          ->type_name("COMMENT")
          ->needs(learner)
          ->excludes(json);
  CLI::Option* next =
      verb->add_option("--next", arguments->next, "set the next lesson; \"\" returns to the suggested lesson")
          ->type_name("LESSON")
          ->needs(learner)
          ->excludes(json);
  CLI::Option* renames =
      verb->add_option("--rename", arguments->name, "give the learner another name")->type_name("NAME")->needs(learner);
  renames->check(validate_learner_name)->excludes(json);
  CLI::Option* erases =
      verb->add_flag("--delete", arguments->deletes_learner, "permanently delete this learner's results and recordings")
          ->needs(learner)
          ->excludes(out)
          ->excludes(json)
          ->excludes(comment)
          ->excludes(edit)
          ->excludes(deleted_comment)
          ->excludes(next)
          ->excludes(renames);
  verb->add_flag("--yes", arguments->yes, "delete without asking for confirmation")->needs(erases);
  verb->callback([=, &action] {
    check_comment("--comment", arguments->comment);
    check_comment("--edit-comment", arguments->edit);
    arguments->sets_next = next->count() > 0;
    action = [arguments] { return run_report(*arguments); };
  });
}

}  // namespace gearshift::verbs
