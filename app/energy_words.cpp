#include "app/energy_words.h"

namespace gearshift {

const char* energy_words(EnergyControl control) noexcept {
  static constexpr const char* kWords[] = {"none", "energy bounding", "passivity controller"};
  return kWords[static_cast<int>(control)];
}

}  // namespace gearshift
