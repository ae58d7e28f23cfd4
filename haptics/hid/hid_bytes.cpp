#include "haptics/hid/hid_bytes.h"

#include <algorithm>

namespace gearshift::haptics {

bool HidBytes::operator==(const HidBytes& other) const noexcept {
  return std::ranges::equal(view(), other.view());
}

}  // namespace gearshift::haptics
