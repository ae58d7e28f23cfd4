// The session's recordings: those that the user starts, and those made automatically for lessons.
#include <stdexcept>

#include <fmt/core.h>

#include "app/base/output_folder.h"
#include "app/base/user_folders.h"
#include "app/session/recording_file.h"
#include "app/session/session.h"
#include "haptics/files/resolve_path.h"

namespace gearshift::session {

namespace fs = std::filesystem;

void Session::toggle_recording() {
  if (coach_.view().phase == lessons::LessonPhase::driving)
    throw std::runtime_error(
        "You cannot start or end a recording during a lesson. Lessons are recorded automatically once you enter a "
        "name.");
  if (recording())
    end_recording();
  else
    start_recording(recording_name("drive"));
}

// Returns the folder for recordings, which is next to the history file, because the history references the recordings.
fs::path Session::recordings_folder() const {
  const fs::path data =
      choice_.history.empty() ? base::user_data_folder() : haptics::make_absolute(choice_.history).parent_path();
  return data / "recordings";
}

void Session::start_recording(const std::string& name) {
  const fs::path folder = recordings_folder();
  base::make_folder(folder);
  const fs::path file = unused_trace_path(folder, name);
  runtime_->start_recording(file);
  last_recording_ = file;
  is_lesson_recording_ = is_recording_incomplete_ = false;
  message_ = fmt::format("recording to {}", file.string());
}

bool Session::end_recording() {
  const std::optional<std::string> problem = runtime_->stop_recording();
  message_ = problem ? *problem : fmt::format("recorded: {}", last_recording_.string());
  return !problem;
}

// Ends the recording of a lesson. Success needs no message, because the history references the recording.
void Session::end_lesson_recording() {
  if (!recording() || !is_lesson_recording_) return;
  const std::optional<std::string> problem = runtime_->stop_recording();
  if (!problem) return;
  is_recording_incomplete_ = true;
  message_ = *problem;
}

// Ends the recording if it has failed, and reports the problem.
void Session::report_recording_problem() {
  const std::optional<std::string> problem = runtime_->poll_recording_problem();
  if (!problem) return;
  (void)runtime_->stop_recording();
  is_recording_incomplete_ = is_lesson_recording_;
  message_ = *problem;
}

}  // namespace gearshift::session
