// Fuzzes telemetry: a sequence of UDP packets. Each begins with its length and its sender; what is missing at the end of
// the input is cut off.
#include <cmath>
#include <cstring>
#include <span>

#include "app/shifter/telemetry.h"
#include "haptics/gate/gate.h"
#include "tests/fuzz/fuzz_checks.h"

using namespace gearshift::shifter;
using namespace gearshift::test;

namespace {

template <class T>
T at(std::span<const std::uint8_t> packet, std::size_t offset) {
  T value;
  std::memcpy(&value, packet.data() + offset, sizeof value);
  return value;
}

void check_packet(std::span<const std::uint8_t> bytes) {
  const auto packet = parse_outgauge(bytes);
  if (!packet) return;
  check_invariant(bytes.size() == 92 || bytes.size() == 96, "only OutGauge packets are read");
  check_invariant(packet->time_ms == at<std::uint32_t>(bytes, 0), "time");
  check_invariant(packet->gear == bytes[10] - 1 && packet->gear <= gearshift::haptics::kMaxGateGear, "gear");
  check_invariant(packet->speed == static_cast<double>(at<float>(bytes, 12)) && std::abs(packet->speed) <= 200.0,
                  "speed");
  check_invariant(std::abs(packet->engine_speed) <= 3142.0, "engine speed");
  check_invariant(packet->throttle >= 0.0 && packet->throttle <= 1.0, "throttle");
  check_invariant(packet->brake >= 0.0 && packet->brake <= 1.0, "brake");
  check_invariant(packet->clutch >= 0.0 && packet->clutch <= 1.0, "clutch");
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer requires this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  TelemetryFilter filter;
  std::span<const std::uint8_t> rest(data, size);
  int messages = 0;
  for (double now = 0.0; rest.size() >= 2; now += 0.1) {
    const std::size_t length = std::min<std::size_t>(rest[0], rest.size() - 2);
    const std::span<const std::uint8_t> packet = rest.subspan(2, length);
    check_packet(packet);
    const Telemetry before = filter.at(now);
    filter.receive(packet, rest[1] % 4u, now);
    const Telemetry after = filter.at(now);
    accepted_inputs += parse_outgauge(packet) ? 1 : 0;
    if (!parse_outgauge(packet)) check_invariant(after.is_live == before.is_live, "a refused packet changes nothing");
    check_invariant(std::isfinite(after.car.speed) && std::isfinite(after.car.engine_speed), "telemetry is finite");
    now += 0.001 * rest[1];
    rest = rest.subspan(2 + length);
    while (filter.take_message()) ++messages;
  }
  check_invariant(messages <= 6, "each kind of message is told once");
  return 0;
}
