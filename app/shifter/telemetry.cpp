#include "app/shifter/telemetry.h"

#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace gearshift::shifter {
namespace {

struct Addresses {
  addrinfo* first = nullptr;
  ~Addresses() {
    if (first != nullptr) freeaddrinfo(first);
  }
};

[[noreturn]] void fail(const std::string& address, const char* reason) {
  throw std::runtime_error(fmt::format("telemetry cannot be received at {}: {}", address, reason));
}

}  // namespace

void TelemetryFilter::receive(std::span<const std::uint8_t> bytes, std::uint64_t sender, double now) {
  const std::optional<OutGaugePacket> packet = parse_outgauge(bytes);
  if (!packet) {
    const bool fits = bytes.size() == kPacketSize || bytes.size() == kPacketSizeWithId;
    return report(kMalformed, fits ? "a telemetry packet with impossible values was ignored"
                                   : fmt::format("a packet of {} bytes was ignored; OutGauge packets have {} or {}",
                                                 bytes.size(), kPacketSize, kPacketSizeWithId));
  }
  const bool continues = at(now).is_live;
  if (continues && sender != sender_)
    return report(kForeign, "telemetry of a second sender was ignored; only one program may send it");
  const std::uint32_t late = newest_.car.time_ms - packet->time_ms;  // wraps like the sender's clock
  if (continues && packet->time_ms != 0 && late != 0 && late < kMaxLateMs)
    return report(kLate, "a telemetry packet that arrived late was ignored");
  if (!continues) {
    if ((reported_ & kBegan) == 0)
      report(kBegan, "telemetry arrives");
    else
      report(kResumed, "telemetry arrives again");
  }
  newest_ = {true, *packet};
  sender_ = sender;
  received_at_ = now;
}

Telemetry TelemetryFilter::at(double now) {
  if (newest_.is_live && now - received_at_ > kSilence) {
    newest_.is_live = false;
    report(kStopped, "the telemetry stopped; the gate continues without it");
  }
  return newest_.is_live ? newest_ : Telemetry{};
}

void TelemetryFilter::report(Kind kind, std::string message) {
  if ((std::exchange(reported_, reported_ | kind) & kind) == 0) messages_.push_back(std::move(message));
}

std::optional<std::string> TelemetryFilter::take_message() {
  if (messages_.empty()) return std::nullopt;
  std::string first = std::move(messages_.front());
  messages_.erase(messages_.begin());
  return first;
}

TelemetryPort::TelemetryPort(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  if (colon == std::string::npos) fail(address, "it must be HOST:PORT, for example 127.0.0.1:4444");
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_DGRAM;
  hints.ai_flags = AI_NUMERICSERV;
  Addresses found;
  const int error =
      getaddrinfo(address.substr(0, colon).c_str(), address.substr(colon + 1).c_str(), &hints, &found.first);
  if (error != 0) fail(address, gai_strerror(error));
  socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ >= 0 && bind(socket_, found.first->ai_addr, found.first->ai_addrlen) == 0) return;
  const int reason = errno;
  if (socket_ >= 0) close(socket_);
  fail(address, std::strerror(reason));
}

TelemetryPort::~TelemetryPort() {
  close(socket_);
}

void TelemetryPort::read_into(TelemetryFilter& filter, double now) {
  constexpr int kMaxPackets = 1000;  // per call, so that a flood does not hold up the buttons
  std::array<std::uint8_t, 2048> bytes;
  for (int i = 0; i < kMaxPackets; ++i) {
    sockaddr_in from{};
    socklen_t length = sizeof from;
    const ssize_t count = recvfrom(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*>(&from), &length);
    if (count < 0) return;
    const std::uint64_t sender = std::uint64_t{from.sin_addr.s_addr} << 16 | from.sin_port;
    filter.receive({bytes.data(), static_cast<std::size_t>(count)}, sender, now);
  }
}

}  // namespace gearshift::shifter
