#include "app/draw/lockout_words.h"

#include <fmt/format.h>

#include "haptics/files/number_text.h"

namespace gearshift {

std::string lockout_words(const Lockout& lockout) {
  switch (lockout.kind) {
    case LockoutKind::push_down:
      return "open while the knob is pushed down";
    case LockoutKind::lift:
      return "open while the ring is lifted";
    case LockoutKind::speed:
      return fmt::format("shut above {}, open below {} km/h", number_text(lockout.close_above * kKmhPerMps, 3),
                         number_text(lockout.open_below * kKmhPerMps, 3));
    case LockoutKind::after_gear:
      return fmt::format("shut after {} until the column is left", gear_name(lockout.after_gear));
  }
  return "?";
}

}  // namespace gearshift
