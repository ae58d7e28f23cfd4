#include "app/lessons/report/delete_learner.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "haptics/loop/trace_format.h"

namespace gearshift::lessons {
namespace {

namespace fs = std::filesystem;

bool is_trace(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(file, error))) return false;
  std::ifstream stream(file, std::ios::binary);
  std::array<char, haptics::kTraceMagic.size()> magic{};
  stream.read(magic.data(), magic.size());
  return stream && magic == haptics::kTraceMagic;
}

DeletionReport count(History& history, const LearnerRow& learner) {
  DeletionReport sum;
  std::vector<std::int64_t> sessions;
  for (const RunRow& run : history.runs(learner.id)) {
    sessions.push_back(run.session);
    ++sum.runs;
    sum.shifts += run.result.shifts.size();
    sum.errors += run.result.errors.size();
    sum.comments += run.comments.size();
  }
  std::sort(sessions.begin(), sessions.end());
  sum.sessions = static_cast<std::size_t>(std::unique(sessions.begin(), sessions.end()) - sessions.begin());
  return sum;
}

void remove_recording(const fs::path& file, DeletionReport& report) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(file, error))) {
    report.missing.push_back(file.string());
    return;
  }
  if (!is_trace(file)) {
    report.not_deleted.push_back(file.string() + ": this is not a recording");
    return;
  }
  fs::remove(file, error);
  if (error) {
    report.not_deleted.push_back(file.string() + ": " + error.message());
  } else {
    report.recordings.push_back(file.string());
  }
}

void remove_all(const History& history, const std::vector<std::string>& recordings, DeletionReport& report) {
  for (const std::string& recording : recordings) remove_recording(history.recording_file(recording), report);
}

}  // namespace

DeletionReport remove_recordings(History& history, const LearnerRow& learner) {
  DeletionReport report;
  remove_all(history, history.recordings(learner.id), report);
  return report;
}

DeletionReport delete_learner(History& history, const LearnerRow& learner) {
  DeletionReport report = count(history, learner);
  report.remaining_data = history.erase_learner(
      learner.id, [&](const std::vector<std::string>& recordings) { remove_all(history, recordings, report); });
  return report;
}

}  // namespace gearshift::lessons
