#include "app/panel/stick_words.h"

#include <fmt/format.h>

namespace gearshift {

std::string stick_words(const StickView& stick) {
  if (!stick.plugged_in) return "unplugged";
  return stick.delay > 0.0 ? fmt::format("plugged in, answers after {:.1f} ms", 1e3 * stick.delay) : "plugged in";
}

std::string stick_request(const PanelInput& input) {
  if (!input.stick) return {};
  if (!input.stick->plugged_in) return "The stick is unplugged: plug it in, then press Enter.";
  const GuardState guard = input.now.guard;
  const bool has_forces = guard == GuardState::running || guard == GuardState::ramping || guard == GuardState::armed;
  return has_forces ? "" : "The stick's motors are off: hold it, then press Enter.";
}

}  // namespace gearshift
