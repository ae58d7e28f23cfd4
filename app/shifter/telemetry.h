// Telemetry of another simulator: which packets count, and what the car does now.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/shifter/outgauge.h"

namespace gearshift::shifter {

struct Telemetry {
  bool is_live = false;  // false: nothing is known
  OutGaugePacket car;
};

// Each kind of problem is reported once. Packets that do not count have no other effect.
class TelemetryFilter {
 public:
  static constexpr double kSilence = 0.5;             // [s] after this time without a packet, nothing is known
  static constexpr std::uint32_t kMaxLateMs = 10000;  // a time that goes back further is that of a new start

  // `sender`: identifies the address that sent the packet. `now`: [s] on any clock.
  void receive(std::span<const std::uint8_t> bytes, std::uint64_t sender, double now);
  Telemetry at(double now);
  std::optional<std::string> take_message();  // the next message, one sentence

 private:
  enum Kind : unsigned { kMalformed = 1, kForeign = 2, kLate = 4, kBegan = 8, kStopped = 16, kResumed = 32 };
  void report(Kind kind, std::string message);

  Telemetry newest_;
  std::uint64_t sender_ = 0;
  double received_at_ = 0.0;  // [s]
  unsigned reported_ = 0;
  std::vector<std::string> messages_;
};

// A UDP port of this machine.
class TelemetryPort {
 public:
  // `address`: "HOST:PORT", for example 127.0.0.1:4444. Throws std::runtime_error with one sentence.
  explicit TelemetryPort(const std::string& address);
  ~TelemetryPort();
  TelemetryPort(const TelemetryPort&) = delete;
  TelemetryPort& operator=(const TelemetryPort&) = delete;

  void read_into(TelemetryFilter& filter, double now);  // all packets that have arrived; does not wait

 private:
  int socket_;
};

}  // namespace gearshift::shifter
