#include "haptics/gate/plain_aisle.h"

namespace gearshift::haptics {

Gate plain_aisle(double half_length, double half_width) noexcept {
  Gate gate;
  gate.half_aisle = half_width;
  gate.select_min = -half_length;
  gate.select_max = half_length;
  gate.column_count = 1;
  gate.column[0].back = -half_width;
  gate.column[0].forward = half_width;
  return gate;
}

}  // namespace gearshift::haptics
