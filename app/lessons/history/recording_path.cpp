// Recordings are stored relative to the history's folder, so that the folder can be moved or copied with its
// recordings.
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "app/lessons/history/history_state.h"
#include "haptics/files/resolve_path.h"

namespace gearshift::lessons {
namespace {

namespace fs = std::filesystem;

// Relative path of the file, or empty if the file is not below the folder. Both paths must be absolute; only their
// components are compared.
fs::path path_below(const fs::path& folder, const fs::path& file) {
  const auto [in_folder, in_file] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  const bool ends_with_slash = in_folder != folder.end() && in_folder->empty() && std::next(in_folder) == folder.end();
  if (in_folder != folder.end() && !ends_with_slash) return {};
  fs::path relative;
  for (auto part = in_file; part != file.end(); ++part) {
    if (*part == "..") return {};
    relative /= *part;
  }
  return relative;
}

fs::path without_links(const fs::path& path) {
  std::error_code problem;
  const fs::path real = fs::weakly_canonical(path, problem);
  return problem ? path : real;
}

}  // namespace

fs::path history_folder(const fs::path& history) {
  return haptics::make_absolute(history).parent_path();
}

// Compares the paths first as given, and only then with links resolved, so that a link inside the history's folder can
// move with the folder.
std::string History::State::relative_recording(const std::string& recording) const {
  const fs::path trace(recording), folder = history_folder(file);
  if (!trace.is_absolute()) return recording;
  fs::path relative = path_below(folder, trace);
  if (relative.empty()) relative = path_below(without_links(folder), without_links(trace));
  return relative.empty() ? recording : relative.string();
}

fs::path History::recording_file(std::string_view recording) const {
  // If `recording` is an absolute path, operator/ ignores the folder.
  return recording.empty() ? fs::path() : history_folder(file()) / recording;
}

}  // namespace gearshift::lessons
