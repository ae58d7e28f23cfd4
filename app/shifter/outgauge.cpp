#include "app/shifter/outgauge.h"

#include <algorithm>
#include <bit>
#include <numbers>

#include "haptics/gate/gate.h"

namespace gearshift::shifter {
namespace {

// Offsets in the packet [bytes].
constexpr std::size_t kTime = 0, kGear = 10, kSpeed = 12, kRpm = 16, kThrottle = 48, kBrake = 52, kClutch = 56;

constexpr double kMaxSpeed = 200.0;       // [m/s]
constexpr double kMaxRpm = 30000.0;       // [rpm]
constexpr double kPedalTolerance = 0.01;  // [1]

std::uint32_t read_word(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i-- > 0;) word = word << 8 | bytes[at + i];
  return word;
}

double read_float(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
  return static_cast<double>(std::bit_cast<float>(read_word(bytes, at)));
}

bool is_within(double value, double low, double high) noexcept {  // false for NaN
  return value >= low && value <= high;
}

bool is_pedal(double value) noexcept {
  return is_within(value, -kPedalTolerance, 1.0 + kPedalTolerance);
}

}  // namespace

std::optional<OutGaugePacket> parse_outgauge(std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() != kPacketSize && bytes.size() != kPacketSizeWithId) return std::nullopt;
  OutGaugePacket packet;
  packet.time_ms = read_word(bytes, kTime);
  packet.gear = static_cast<int>(bytes[kGear]) - 1;  // reverse 0, neutral 1, first 2
  packet.speed = read_float(bytes, kSpeed);
  const double rpm = read_float(bytes, kRpm), throttle = read_float(bytes, kThrottle);
  const double brake = read_float(bytes, kBrake), clutch = read_float(bytes, kClutch);
  if (packet.gear > haptics::kMaxGateGear || !is_within(packet.speed, -kMaxSpeed, kMaxSpeed) ||
      !is_within(rpm, -kMaxRpm, kMaxRpm) || !is_pedal(throttle) || !is_pedal(brake) || !is_pedal(clutch))
    return std::nullopt;
  packet.engine_speed = rpm * std::numbers::pi / 30.0;
  packet.throttle = std::clamp(throttle, 0.0, 1.0);
  packet.brake = std::clamp(brake, 0.0, 1.0);
  packet.clutch = std::clamp(clutch, 0.0, 1.0);
  return packet;
}

}  // namespace gearshift::shifter
