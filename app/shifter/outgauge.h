// OutGauge packets: what a simulator's car shows on its instruments, sent by UDP.
//
// This work is based on:
// Live for Speed, docs/InSim.txt, struct OutGaugePack
// BeamNG, https://documentation.beamng.com/modding/protocols/, which sends the same with a time of 0
//
// Little-endian without padding: 92 bytes, or 96 if the sender adds an ID.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace gearshift::shifter {

inline constexpr std::size_t kPacketSize = 92, kPacketSizeWithId = 96;  // [bytes]

struct OutGaugePacket {
  std::uint32_t time_ms = 0;  // since the sender's start; 0 if the sender has no clock
  int gear = 0;               // kReverseGear, kNeutralGear or a forward gear
  double speed = 0.0;         // [m/s]
  double engine_speed = 0.0;  // [rad/s]
  double throttle = 0.0;      // [1] 0 to 1
  double brake = 0.0;         // [1] 0 to 1
  double clutch = 0.0;        // [1] 0 to 1 = pressed
};

// Returns nothing for a packet of another length, or with values that no car has: a speed beyond 200 m/s, an engine
// beyond 30000 rpm, a pedal beyond its travel, a 19th gear.
std::optional<OutGaugePacket> parse_outgauge(std::span<const std::uint8_t> bytes) noexcept;

}  // namespace gearshift::shifter
