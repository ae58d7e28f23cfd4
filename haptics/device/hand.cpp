#include "haptics/device/hand.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

#include "haptics/files/toml_text.h"

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
  for (const auto& [name, hand] : kNamedHands)
    if (text == name) return hand;
  for (const auto& [name, hand] : kElasticHands)
    if (text == name) return hand;
  std::array<double, 6> values{};
  std::size_t count = 0;
  do {
    const std::optional<double> value = count < values.size() ? parse_number(text) : std::nullopt;
    if (!value) return std::nullopt;
    values[count++] = *value;
  } while (parse_comma(text));
  const HandImpedance hand{values[0], values[1], values[2], values[3], values[4], values[5]};
  const bool is_complete = count == 3 || (count == 6 && hand.is_elastic() && hand.mass >= kMinElasticMass);
  return text.empty() && is_complete ? std::optional(hand) : std::nullopt;
}

std::string hand_text(const HandImpedance& hand) {
  for (const auto& [name, named] : kNamedHands)
    if (named == hand) return std::string(name);
  for (const auto& [name, named] : kElasticHands)
    if (named == hand) return std::string(name);
  std::string text = toml_number(hand.mass) + ',' + toml_number(hand.damping) + ',' + toml_number(hand.stiffness);
  if (hand.is_elastic())
    text += ',' + toml_number(hand.finger_mass) + ',' + toml_number(hand.grip_damping) + ',' +
            toml_number(hand.grip_stiffness);
  return text;
}

}  // namespace gearshift::haptics
