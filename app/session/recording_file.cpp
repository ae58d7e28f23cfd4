#include "app/session/recording_file.h"

#include <unistd.h>

#include <ctime>

#include <fmt/core.h>

namespace gearshift::session {

std::filesystem::path unused_trace_path(const std::filesystem::path& folder, const std::string& name) {
  std::filesystem::path file = folder / (name + ".trace");
  std::error_code error;
  for (int number = 2; std::filesystem::exists(file, error); ++number)
    file = folder / fmt::format("{}-{}.trace", name, number);
  return file;
}

std::string recording_name(const std::string& prefix) {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  return fmt::format("{}-{:04}{:02}{:02}-{:02}{:02}{:02}-{}", prefix, local.tm_year + 1900, local.tm_mon + 1,
                     local.tm_mday, local.tm_hour, local.tm_min, local.tm_sec, getpid());
}

}  // namespace gearshift::session
