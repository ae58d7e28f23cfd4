// Writes page and tables into a folder, each file completely or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace gearshift::lessons {

struct ReportFile {
  std::string name, text;
};

// Writes the files in order and calls `written` after each. Throws std::runtime_error. Its message says which file
// could not be written and why, and which files were written and which were not.
void write_report_files(const std::filesystem::path& folder, std::span<const ReportFile> files,
                        const std::function<void(const std::filesystem::path&)>& written);

}  // namespace gearshift::lessons
