#include "haptics/device/checked.h"

#include <sstream>
#include <stdexcept>

namespace gearshift {

void require_between(const std::string& name, double value, double low, double high,
                     const std::string& unit) {
  if (value >= low && value <= high) return;  // false for not-a-number
  std::ostringstream message;
  message.precision(9);
  message << name << " is " << value << ": allowed is " << low << " to " << high;
  if (!unit.empty()) message << ' ' << unit;
  throw std::invalid_argument(message.str() + '.');
}

}  // namespace gearshift
