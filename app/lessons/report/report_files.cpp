#include "app/lessons/report/report_files.h"

#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "haptics/files/atomic_file.h"
#include "haptics/files/file_error.h"
#include "haptics/files/printable.h"

namespace gearshift::lessons {
namespace {

namespace fs = std::filesystem;

std::string names_of(std::span<const ReportFile> files) {
  std::string names;
  for (const ReportFile& file : files) names += (names.empty() ? "" : ", ") + file.name;
  return names.empty() ? "nothing" : names;
}

// True if the folder's disk has less than `bytes` free. Needed because a failed stream does not report why it failed.
bool has_no_room(const fs::path& folder, std::size_t bytes) {
  std::error_code unknown;
  const fs::space_info room = fs::space(folder, unknown);
  return !unknown && room.available < bytes;
}

}  // namespace

void write_report_files(const fs::path& folder, std::span<const ReportFile> files,
                        const std::function<void(const fs::path&)>& written) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    try {
      haptics::write_text_file(folder / files[i].name, files[i].text);
    } catch (const haptics::FileError& problem) {
      const char* why = has_no_room(folder, files[i].text.size()) ? "; the disk is full" : "";
      throw std::runtime_error(fmt::format("{}{}; written: {}; not written: {}", problem.what(), why,
                                           names_of(files.first(i)), names_of(files.subspan(i))));
    }
    written(folder / files[i].name);
  }
}

}  // namespace gearshift::lessons
