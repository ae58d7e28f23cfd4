// gearshift report: what is remembered of learners, as a table, a page, CSV; comments, the next lesson, deletion.
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/coach/shipped_lessons.h"
#include "app/history/history.h"
#include "app/output_folder.h"
#include "app/print_out.h"
#include "app/report/delete_learner.h"
#include "app/report/instructor.h"
#include "app/report/learner_table.h"
#include "app/report/report_csv.h"
#include "app/report/report_files.h"
#include "app/report/report_page.h"
#include "app/trainer/user_folder.h"
#include "app/verbs/two_files.h"
#include "app/verbs/verbs.h"
#include "haptics/files/printable.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReportHelp =
    "What is remembered of learners: a table; of one learner a page with curves, weaknesses, shifts and runs, and CSV.";
constexpr const char* kReportExamples =
    "\nExamples:\n"
    "  gearshift report                                      all learners\n"
    "  gearshift report --learner Ada                        Ada's runs\n"
    "  gearshift report --learner Ada --out ada --csv        ada/index.html, runs.csv, shifts.csv, faults.csv\n"
    "  gearshift report --learner Ada --comment 12 \"Much calmer.\" --by Bo\n"
    "  gearshift report --learner Ada --edit-comment 3 \"Calmer.\"   by the number that the table of runs shows\n"
    "  gearshift report --learner Ada --delete-comment 3\n"
    "  gearshift report --learner Ada --next hill_start      instead of what the grades suggest; \"\" gives it back\n"
    "  gearshift report --learner Ada --delete               for good, with the recordings\n";

constexpr const char *kPage = "index.html", *kRuns = "runs.csv", *kShifts = "shifts.csv", *kFaults = "faults.csv";

using NumberedText = std::pair<std::int64_t, std::string>;

struct ReportArguments {
  std::string learner, database, out, by, next;
  std::optional<NumberedText> comment, edit;  // by the number of the run, of the comment
  std::optional<std::int64_t> taken_back;     // a comment's number
  bool csv = false, sets_next = false, deletes = false, yes = false;
};

bool instructs(const ReportArguments& arguments) {
  return arguments.comment || arguments.edit || arguments.taken_back || arguments.sets_next;
}

fs::path history_file(const ReportArguments& arguments) {
  const HistoryPlace place = history_place(arguments.database);
  if (!place.problem.empty()) throw std::runtime_error(place.problem);
  return place.file;
}

std::string known_names(History& history) {
  std::string names;
  for (const LearnerRow& row : history.learners()) names += (names.empty() ? "" : ", ") + printable(row.name);
  return names.empty() ? "nobody yet" : names;
}

LearnerRow known_learner(History& history, const std::string& name) {
  if (std::optional<LearnerRow> row = history.find_learner(name)) return *row;
  throw std::runtime_error(
      fmt::format("\"{}\" is no learner of this history; known: {}", printable(name), known_names(history)));
}

int list_learners(History& history) {
  std::vector<LearnerHistory> all;
  for (const LearnerRow& row : history.learners()) all.push_back(read_learner(history, row));
  print_out("{}", learner_table(all, shipped_lessons()));
  return 0;
}

void check_out(const ReportArguments& arguments, const fs::path& history) {
  if (arguments.out.empty()) return;
  for (const char* name : {kPage, kRuns, kShifts, kFaults})
    check_two_files("--out", "the report and the history", fs::path(arguments.out) / name, history);
}

void write_report(const ReportArguments& arguments, History& history, const LearnerRow& learner) {
  const LearnerHistory all = read_learner(history, learner);
  std::vector<ReportFile> files{
      {kPage, report_page(all, show_shifts(all, history.file().parent_path()), shipped_lessons())}};
  if (arguments.csv) {
    files.push_back({kRuns, runs_csv(all)});
    files.push_back({kShifts, shifts_csv(all)});
    files.push_back({kFaults, faults_csv(all)});
  }
  make_folder(arguments.out);
  write_report_files(arguments.out, files, [](const fs::path& file) { print_out("{}\n", file.string()); });
}

// By its key, as the coach knows it.
void set_next(const std::string& lesson, History& history, const LearnerRow& learner) {
  const std::vector<Lesson> lessons = shipped_lessons();
  std::string keys;
  for (const Lesson& each : lessons) keys += (keys.empty() ? "" : ", ") + each.key;
  const bool is_known = std::any_of(lessons.begin(), lessons.end(), [&](const Lesson& l) { return l.key == lesson; });
  if (!lesson.empty() && !is_known)
    throw std::runtime_error(fmt::format("\"{}\" is none of the shipped lessons: {}", printable(lesson), keys));
  history.set_next_lesson(learner.id, lesson);
  print_out("{}: next lesson {}\n", printable(learner.name), lesson.empty() ? "as suggested" : printable(lesson));
}

void obey_instructor(const ReportArguments& arguments, History& history, const LearnerRow& learner) {
  if (arguments.comment) {
    const auto& [run, text] = *arguments.comment;
    const std::int64_t number = comment_on_run(history, learner, run, arguments.by, text);
    print_out("run {}, comment {}: {}, {}\n", run, number, printable(text), printable(arguments.by));
  }
  if (arguments.edit) {
    const auto& [number, text] = *arguments.edit;
    edit_comment(history, learner, number, text);
    print_out("comment {}: {}\n", number, printable(text));
  }
  if (arguments.taken_back) {
    delete_comment(history, learner, *arguments.taken_back);
    print_out("comment {} is gone\n", *arguments.taken_back);
  }
  if (arguments.sets_next) set_next(arguments.next, history, learner);
}

std::string counted(std::size_t number, std::string_view what) {
  return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

// What keeps deleted rows in the file, where anything does.
int tell_left(const std::string& left) {
  if (!left.empty()) print_problem("{}", printable(left));
  return left.empty() ? 0 : 1;
}

void tell_recordings(const Deleted& gone) {
  for (const std::string& file : gone.recordings) print_out("  {}\n", printable(file));
  for (const std::string& file : gone.missing) print_out("  not found: {}\n", printable(file));
  for (const std::string& kept : gone.kept) print_problem("not removed: {}", printable(kept));
}

void confirm(const ReportArguments& arguments, const LearnerRow& learner) {
  if (arguments.yes) return;
  print_to(stderr, fmt::format("All that is remembered of {} goes, recordings too, for good. The name again: ",
                               printable(learner.name)));
  std::string again;
  const bool is_answered = static_cast<bool>(std::getline(std::cin, again));
  if (again == learner.name) return;
  const bool is_line_open = !is_answered || isatty(STDIN_FILENO) == 0;  // a person's Enter ends the question's line
  if (is_line_open) print_to(stderr, "\n");
  throw std::runtime_error(fmt::format("{} was not deleted: {}", printable(learner.name),
                                       is_answered ? "that is another name" : "nobody has answered"));
}

// Of a learner who is not there (any more), what an earlier deletion could not do. `first`: recordings that have gone
// already.
int erase(const ReportArguments& arguments, History& history, const std::vector<std::string>& first) {
  if (!history.find_learner(arguments.learner) && history.erasure_is_pending()) {
    const std::string left = history.finish_erasure();
    if (left.empty())
      print_out("nobody here is called {}; what an earlier deletion had left is gone\n", printable(arguments.learner));
    return tell_left(left);
  }
  const LearnerRow learner = known_learner(history, arguments.learner);
  confirm(arguments, learner);
  Deleted gone = delete_learner(history, learner);
  std::erase_if(gone.missing,
                [&](const std::string& file) { return std::find(first.begin(), first.end(), file) != first.end(); });
  print_out("{} is gone: {}, {}, {}, {}, {}, {}\n", printable(learner.name), counted(gone.sessions, "session"),
            counted(gone.runs, "run"), counted(gone.shifts, "shift"), counted(gone.faults, "fault"),
            counted(gone.comments, "comment"), counted(gone.recordings.size() + first.size(), "recording"));
  tell_recordings(gone);
  const int code = tell_left(gone.left);
  return gone.kept.empty() ? code : 1;
}

std::unique_ptr<History> open_where_there_is_room(const fs::path& file) {
  try {
    return std::make_unique<History>(file);
  } catch (const HistoryFull&) {
    return nullptr;
  }
}

// A disk so full that the history cannot even be opened to be written: the recordings go first and leave it room.
int delete_for_good(ReportArguments arguments, const fs::path& file) {
  std::unique_ptr<History> history = open_where_there_is_room(file);
  std::vector<std::string> first;
  if (!history) {
    History copy(file, system_seconds, kHistoryPatience, HistoryUse::read);
    const LearnerRow learner = known_learner(copy, arguments.learner);
    confirm(arguments, learner);
    arguments.yes = true;
    const Deleted gone = remove_recordings(copy, learner);
    print_out("The disk is full: {} recordings are gone first\n", gone.recordings.size());
    tell_recordings(gone);
    first = gone.recordings;
    history = std::make_unique<History>(file);
  }
  return erase(arguments, *history, first);
}

// Of one learner.
int report_learner(const ReportArguments& arguments, History& history) {
  const LearnerRow learner = known_learner(history, arguments.learner);
  obey_instructor(arguments, history, learner);
  if (!arguments.out.empty()) write_report(arguments, history, learner);
  if (arguments.out.empty() && !instructs(arguments)) print_out("{}", run_table(read_learner(history, learner)));
  return 0;
}

// A report makes no history: where there is none, that is said. What only reads needs no right to write.
int run_report(const ReportArguments& arguments) {
  const fs::path file = history_file(arguments);
  check_out(arguments, file);
  std::error_code error;
  if (!fs::exists(file, error) && !error) {
    if (!arguments.database.empty() || !arguments.learner.empty())
      throw std::runtime_error(fmt::format("{}: there is no such history", printable(file.string())));
    print_out("Nobody has driven a lesson yet.\n");
    return 0;
  }
  if (arguments.deletes) return delete_for_good(arguments, file);
  const bool writes = instructs(arguments);
  History history(file, system_seconds, kHistoryPatience, writes ? HistoryUse::write : HistoryUse::read);
  if (arguments.learner.empty()) return list_learners(history);
  return report_learner(arguments, history);
}

std::string not_empty(const std::string& value) {
  return value.empty() ? "must not be empty" : std::string();
}

std::string author_name(const std::string& name) {
  return typed_text_problem(TypedText::name, "an instructor's name", name);
}

void check_comment(const char* option, const std::optional<NumberedText>& said) {
  const std::string problem = said ? typed_text_problem(TypedText::comment, "a comment", said->second) : std::string();
  if (!problem.empty()) throw CLI::ValidationError(option, problem);
}

}  // namespace

void add_report_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* verb = app.add_subcommand("report", kReportHelp);
  verb->footer(kReportExamples);
  CLI::Option* learner =
      verb->add_option("--learner", arguments->learner, "whose history")->type_name("NAME")->check(not_empty);
  verb->add_option("--database", arguments->database, "another file than the user's own")
      ->type_name("FILE")
      ->check(not_empty);
  CLI::Option* out = verb->add_option("--out", arguments->out, "write the page into this folder")
                         ->type_name("FOLDER")
                         ->check(not_empty)
                         ->needs(learner);
  verb->add_flag("--csv", arguments->csv, "and runs, shifts and faults as CSV")->needs(out);
  CLI::Option* comment = verb->add_option("--comment", arguments->comment, "stands beside the run's grade from now on")
                             ->type_name("RUN TEXT")
                             ->needs(learner);
  CLI::Option* by =
      verb->add_option("--by", arguments->by, "who says so")->type_name("NAME")->check(author_name)->needs(comment);
  comment->needs(by);
  CLI::Option* edit = verb->add_option("--edit-comment", arguments->edit, "another text in the place of that comment's")
                          ->type_name("COMMENT TEXT")
                          ->needs(learner);
  CLI::Option* taken_back = verb->add_option("--delete-comment", arguments->taken_back, "that comment goes, for good")
                                ->type_name("COMMENT")
                                ->needs(learner);
  CLI::Option* next = verb->add_option("--next", arguments->next, "the next lesson; empty: as the grades suggest")
                          ->type_name("LESSON")
                          ->needs(learner);
  CLI::Option* erases = verb->add_flag("--delete", arguments->deletes, "all of it, recordings too, for good")
                            ->needs(learner)
                            ->excludes(out)
                            ->excludes(comment)
                            ->excludes(edit)
                            ->excludes(taken_back)
                            ->excludes(next);
  verb->add_flag("--yes", arguments->yes, "delete without the name being asked for again")->needs(erases);
  verb->callback([=, &action] {
    check_comment("--comment", arguments->comment);
    check_comment("--edit-comment", arguments->edit);
    arguments->sets_next = next->count() > 0;
    action = [arguments] { return run_report(*arguments); };
  });
}

}  // namespace gearshift
