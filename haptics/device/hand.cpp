#include "haptics/device/hand.h"

#include <charconv>
#include <cmath>

namespace gearshift {
namespace {

// Takes one number off the front of the text: finite and >= 0.
std::optional<double> take_number(std::string_view& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value) || value < 0.0) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

bool take_comma(std::string_view& text) {
  if (!text.starts_with(',')) return false;
  text.remove_prefix(1);
  return true;
}

}  // namespace

std::optional<HandImpedance> hand_from_text(std::string_view text) {
  for (const auto& [name, hand] : kNamedHands) {
    if (text == name) return hand;
  }
  const std::optional<double> mass = take_number(text);
  if (!mass || !take_comma(text)) return std::nullopt;
  const std::optional<double> damping = take_number(text);
  if (!damping || !take_comma(text)) return std::nullopt;
  const std::optional<double> stiffness = take_number(text);
  if (!stiffness || !text.empty()) return std::nullopt;
  return HandImpedance{*mass, *damping, *stiffness};
}

}  // namespace gearshift
