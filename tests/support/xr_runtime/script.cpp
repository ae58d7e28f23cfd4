#include "tests/support/xr_runtime/script.h"

#include <stdexcept>

namespace gearshift::xr_test {

Script read_script(const std::filesystem::path&) {
  throw std::runtime_error("not yet");
}

}  // namespace gearshift::xr_test
