// Page and tables into a folder, each whole or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace gearshift {

struct ReportFile {
  std::string name, text;
};

// In order; `written` hears of each. Throws std::runtime_error: in one sentence the file that could not be written,
// why, and which of them are there now and which are not.
void write_report_files(const std::filesystem::path& folder, std::span<const ReportFile> files,
                        const std::function<void(const std::filesystem::path&)>& written);

}  // namespace gearshift
