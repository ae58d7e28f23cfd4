#include "haptics/files/range_check.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

using namespace gearshift::haptics;

namespace {

std::string refusal(double value, double low, double high, const char* unit = "") {
  try {
    require_between("delay", value, low, high, unit);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a value inside its range comes back, the ends included") {
  CHECK(require_between("delay", 3.0, 3.0, 8.0) == 3.0);
  CHECK(require_between("delay", 8.0, 3.0, 8.0, "cycles") == 8.0);
  CHECK(require_between("delay", -0.5, -1.0, 1.0) == -0.5);
}

TEST_CASE("any other value is refused with the wording of the file readers") {
  CHECK(refusal(9.0, 0.0, 8.0, "cycles") == "delay = 9: must be between 0 and 8 cycles");
  CHECK(refusal(9.0, 0.0, 8.0) == "delay = 9: must be between 0 and 8");
  CHECK(refusal(-1e-9, 0.0, 1e6) == "delay = -1e-09: must be between 0 and 1000000");
  CHECK(refusal(1.0000000001, 0.0, 1.0) == "delay = 1.0000000001: must be between 0 and 1");
  CHECK(refusal(std::nan(""), 1e-4, 1e9) == "delay = nan: must be between 0.0001 and 1000000000");
  CHECK(refusal(std::numeric_limits<double>::max(), 1e-6, 0.1) ==
        "delay = 1.7976931348623157e+308: must be between 1e-06 and 0.1");
  CHECK(refusal(-std::numeric_limits<double>::infinity(), 0.0, 1.0) == "delay = -inf: must be between 0 and 1");
  CHECK(refusal(999999999999999.875, 0.0, 1.0) == "delay = 999999999999999.9: must be between 0 and 1");
}
