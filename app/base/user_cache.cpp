#include "app/base/user_cache.h"

#include <cstdlib>
#include <system_error>

namespace gearshift::base {

std::filesystem::path user_cache_file(std::string_view name) {
  std::filesystem::path base;
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache == '/') {
    base = cache;
  } else if (const char* home = std::getenv("HOME"); home && *home == '/') {
    base = std::filesystem::path(home) / ".cache";
  } else {
    return {};
  }
  std::error_code error;
  std::filesystem::create_directories(base / "gearshift", error);
  return error ? std::filesystem::path{} : base / "gearshift" / name;
}

}  // namespace gearshift::base
