// A session's recordings: a person's own, and those that lessons make by themselves.
#include <stdexcept>

#include <fmt/core.h>

#include "app/output_folder.h"
#include "app/train/recording_file.h"
#include "app/train/session.h"
#include "app/trainer/user_folder.h"
#include "haptics/files/place_of.h"

namespace gearshift {

namespace fs = std::filesystem;

void Session::toggle_recording() {
  if (coach_.view().phase == LessonPhase::driving)
    throw std::runtime_error("a lesson is recorded by itself, from its begin to its end, where a learner is named");
  if (recording())
    end_recording();
  else
    start_recording(drive_name("drive"));
}

// Beside the history that names them.
fs::path Session::recordings_folder() const {
  const fs::path data = choice_.history.empty() ? user_data_folder() : absolute_place(choice_.history).parent_path();
  return data / "recordings";
}

void Session::start_recording(const std::string& name) {
  const fs::path folder = recordings_folder();
  make_folder(folder);
  const fs::path file = free_trace(folder, name);
  trainer_->start_recording(file);
  last_recording_ = file;
  records_lesson_ = is_torn_ = false;
  message_ = fmt::format("recording to {}", file.string());
}

bool Session::end_recording() {
  const std::optional<std::string> problem = trainer_->stop_recording();
  message_ = problem ? *problem : fmt::format("recorded: {}", last_recording_.string());
  return !problem;
}

// It is found in the history.
void Session::end_lesson_recording() {
  if (!recording() || !records_lesson_) return;
  const std::optional<std::string> problem = trainer_->stop_recording();
  if (!problem) return;
  is_torn_ = true;
  message_ = *problem;
}

// One that dies is over.
void Session::tell_recording_problem() {
  const std::optional<std::string> problem = trainer_->take_recording_problem();
  if (!problem) return;
  (void)trainer_->stop_recording();
  is_torn_ = records_lesson_;
  message_ = *problem;
}

}  // namespace gearshift
