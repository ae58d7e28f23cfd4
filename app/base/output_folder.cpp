#include "app/base/output_folder.h"

#include <stdexcept>
#include <system_error>

#include <fmt/core.h>

namespace gearshift::base {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(fmt::format("{}: cannot be created ({})", folder.string(), error.message()));
}

}  // namespace gearshift::base
