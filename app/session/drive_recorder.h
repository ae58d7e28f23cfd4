// Records drives: those that the user records, and one of every lesson that is saved.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/runtime/runtime.h"

namespace gearshift::session {

class DriveRecorder {
 public:
  // The folder of the recordings is next to the history file, because the history refers to them. `history`: empty: in
  // the user's data folder.
  explicit DriveRecorder(const std::filesystem::path& history) : history_(history) {}

  // Starts a recording whose name begins with `prefix`. Throws FileError or std::runtime_error with a one-sentence
  // message.
  void start(runtime::Runtime& runtime, const std::string& prefix);
  // Ends the user's recording. Returns the problem if it is incomplete.
  std::optional<std::string> end(runtime::Runtime& runtime);

  // Starts a lesson's recording and returns its absolute path. Throws like start().
  std::filesystem::path start_lesson(runtime::Runtime& runtime, const std::string& lesson);
  // Ends a lesson's recording, if one runs. Returns the problem if it is incomplete; success needs no message, because
  // the history refers to the recording.
  std::optional<std::string> end_lesson(runtime::Runtime& runtime);
  // Ends the recording if it has failed, and returns the problem.
  std::optional<std::string> poll_problem(runtime::Runtime& runtime);

  const std::filesystem::path& last() const { return last_; }  // the newest recording; empty: none yet
  // The last recording belonged to a lesson and failed, and no other lesson was offered since.
  bool is_lesson_incomplete() const { return is_incomplete_; }
  void keep_incomplete() { is_incomplete_ = false; }

  // Deletes those of the files that are recordings of this session's lessons. Returns true if any was deleted.
  bool delete_lessons(const std::vector<std::string>& files);
  void delete_last();

 private:
  std::filesystem::path history_, last_;
  std::set<std::string> lessons_;  // recordings of lessons, absolute paths
  bool is_lesson_ = false;         // the running recording belongs to a lesson
  bool is_incomplete_ = false;     // see is_lesson_incomplete()
};

}  // namespace gearshift::session
