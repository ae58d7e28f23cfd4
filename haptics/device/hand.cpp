#include "haptics/device/hand.h"

#include <charconv>
#include <cmath>

namespace gearshift::haptics {
namespace {

// Reads a number from the front of the text and removes it there. The number must be finite and >= 0.
std::optional<double> parse_number(std::string_view& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value) || value < 0.0) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

bool parse_comma(std::string_view& text) {
  if (!text.starts_with(',')) return false;
  text.remove_prefix(1);
  return true;
}

}  // namespace

std::optional<HandImpedance> parse_hand(std::string_view text) {
  for (const auto& [name, hand] : kNamedHands) {
    if (text == name) return hand;
  }
  const std::optional<double> mass = parse_number(text);
  if (!mass || !parse_comma(text)) return std::nullopt;
  const std::optional<double> damping = parse_number(text);
  if (!damping || !parse_comma(text)) return std::nullopt;
  const std::optional<double> stiffness = parse_number(text);
  if (!stiffness || !text.empty()) return std::nullopt;
  return HandImpedance{*mass, *damping, *stiffness};
}

}  // namespace gearshift::haptics
