#include "app/session/drive_recorder.h"

#include <system_error>

#include "app/base/output_folder.h"
#include "app/base/user_folders.h"
#include "app/session/recording_file.h"
#include "haptics/files/resolve_path.h"

namespace gearshift::session {

namespace fs = std::filesystem;

void DriveRecorder::start(runtime::Runtime& runtime, const std::string& prefix) {
  const fs::path data = history_.empty() ? base::user_data_folder() : haptics::make_absolute(history_).parent_path();
  const fs::path folder = data / "recordings";
  base::make_folder(folder);
  const fs::path file = unused_trace_path(folder, recording_name(prefix));
  runtime.start_recording(file);
  last_ = file;
  is_lesson_ = is_incomplete_ = false;
}

std::optional<std::string> DriveRecorder::end(runtime::Runtime& runtime) {
  return runtime.stop_recording();
}

fs::path DriveRecorder::start_lesson(runtime::Runtime& runtime, const std::string& lesson) {
  start(runtime, lesson);
  is_lesson_ = true;
  fs::path file = haptics::make_absolute(last_);
  lessons_.insert(file.string());
  return file;
}

std::optional<std::string> DriveRecorder::end_lesson(runtime::Runtime& runtime) {
  if (!is_lesson_ || !runtime.is_recording()) return std::nullopt;
  std::optional<std::string> problem = runtime.stop_recording();
  if (problem) is_incomplete_ = true;
  return problem;
}

std::optional<std::string> DriveRecorder::poll_problem(runtime::Runtime& runtime) {
  std::optional<std::string> problem = runtime.poll_recording_problem();
  if (!problem) return std::nullopt;
  (void)runtime.stop_recording();
  is_incomplete_ = is_lesson_;
  return problem;
}

bool DriveRecorder::delete_lessons(const std::vector<std::string>& files) {
  bool any = false;
  std::error_code ignored;
  for (const std::string& file : files) any = (lessons_.contains(file) && fs::remove(file, ignored)) || any;
  return any;
}

void DriveRecorder::delete_last() {
  std::error_code ignored;
  fs::remove(last_, ignored);
}

}  // namespace gearshift::session
