// Recordings are named from the history's folder, so that both can be moved, or copied, together.
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "app/history/history_state.h"
#include "haptics/files/place_of.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;

// Empty: it does not lie below the folder. Both absolute; only their parts are compared.
fs::path way_below(const fs::path& folder, const fs::path& file) {
  const auto [in_folder, in_file] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  const bool ends_with_slash = in_folder != folder.end() && in_folder->empty() && std::next(in_folder) == folder.end();
  if (in_folder != folder.end() && !ends_with_slash) return {};
  fs::path way;
  for (auto part = in_file; part != file.end(); ++part) {
    if (*part == "..") return {};
    way /= *part;
  }
  return way;
}

fs::path without_links(const fs::path& place) {
  std::error_code problem;
  const fs::path real = fs::weakly_canonical(place, problem);
  return problem ? place : real;
}

fs::path folder_of(const fs::path& history) {
  return absolute_place(history).parent_path();
}

}  // namespace

// As it is written first: a link within the folder moves with it. Else where both really are.
std::string History::State::recording_from_here(const std::string& recording) const {
  const fs::path trace(recording), folder = folder_of(file);
  if (!trace.is_absolute()) return recording;
  fs::path way = way_below(folder, trace);
  if (way.empty()) way = way_below(without_links(folder), without_links(trace));
  return way.empty() ? recording : way.string();
}

// Within the transaction that brings it up to date.
void History::State::name_recordings_from_here() {
  SQLite::Statement rows = query("SELECT DISTINCT recording FROM lesson_run WHERE recording LIKE '/%'");
  std::vector<std::string> recordings;
  while (rows.executeStep()) recordings.push_back(rows.getColumn(0).getString());
  SQLite::Statement update = query("UPDATE lesson_run SET recording = ? WHERE recording = ?");
  for (const std::string& recording : recordings) {
    update.bind(1, recording_from_here(recording));
    update.bind(2, recording);
    update.exec();
    update.reset();
  }
}

fs::path History::recording_file(std::string_view recording) const {
  return recording.empty() ? fs::path() : folder_of(file()) / recording;  // an absolute path replaces the folder
}

}  // namespace gearshift
