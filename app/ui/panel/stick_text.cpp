#include "app/ui/panel/stick_text.h"

#include <fmt/format.h>

namespace gearshift::ui {

std::string format_stick_state(const StickView& stick) {
  if (!stick.plugged_in) return "unplugged";
  return stick.delay > 0.0 ? fmt::format("plugged in, responds after {:.1f} ms", 1e3 * stick.delay) : "plugged in";
}

std::string_view stick_request(const PanelInput& input) {
  if (!input.stick) return input.controls.request;
  if (!input.stick->plugged_in) return "The stick is unplugged. Plug it in, then press Enter.";
  const haptics::GuardState guard = input.now.guard;
  const bool has_forces = guard == haptics::GuardState::running || guard == haptics::GuardState::ramping ||
                          guard == haptics::GuardState::armed;
  return has_forces ? "" : "The stick's forces are off. Hold the stick, then press Enter.";
}

}  // namespace gearshift::ui
