#include "app/hold_words.h"

namespace gearshift {

const char* hold_name(ContactHold hold) noexcept {
  static constexpr const char* kNames[] = {"automatic", "zero_order", "half_sample", "observer"};
  return kNames[static_cast<int>(hold)];
}

const char* hold_words(ContactHold hold) noexcept {
  static constexpr const char* kWords[] = {"automatic hold", "zero-order hold", "half-sample hold", "observed hold"};
  return kWords[static_cast<int>(hold)];
}

}  // namespace gearshift
