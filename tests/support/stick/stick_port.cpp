#include "tests/support/stick/stick_port.h"

#include <poll.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <thread>

#include "tests/support/stick/stick_family.h"

namespace gearshift::test {
namespace {

constexpr std::int64_t kMaxSilenceNs = 250'000'000;  // [ns] a stick that sends nothing for longer is dead
constexpr std::uint16_t kInput = 0x0100, kOutput = 0x0200, kFeature = 0x0300;

std::int64_t monotonic_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

haptics::HidBytes hid_bytes(std::span<const std::uint8_t> report) {
  haptics::HidBytes bytes;
  bytes.size = std::min(report.size(), haptics::HidBytes::kMaxSize);
  std::copy_n(report.begin(), bytes.size, bytes.bytes.begin());
  return bytes;
}

UsbSetup get_report(std::uint16_t kind, std::uint8_t id, std::size_t size) {
  return {0xA1, 1, static_cast<std::uint16_t>(kind | id), 0, static_cast<std::uint16_t>(size)};
}

bool set_report(EmulatedStick& stick, std::uint16_t kind, const haptics::HidBytes& report) {
  const UsbSetup setup{0x21, 9, static_cast<std::uint16_t>(kind | report.id()), 0,
                       static_cast<std::uint16_t>(report.size)};
  return stick.control(setup, report.view()).has_value();
}

bool has_output_pipe(const EmulatedStick& stick) {
  return stick.configuration_descriptor()[13] == 2;  // bNumEndpoints is 2: the second endpoint is the output
}

void send_output(EmulatedStick& stick, const haptics::HidBytes& report) {
  const bool accepted = has_output_pipe(stick) ? stick.output(report.view()) : set_report(stick, kOutput, report);
  if (!accepted) throw haptics::HidError("The stick does not accept an output");
}

void take_inputs(EmulatedStick& stick, const haptics::StreamConfig& config, haptics::HidStream& stream,
                 std::int64_t now_ns) {
  stick.advance(now_ns);
  while (const auto report = stick.input()) stream.on_input(*report, now_ns);
  const std::int64_t quiet_ns = now_ns - stick.fetched_ns();
  if (quiet_ns < config.silence_ns) return;
  const auto requested = stick.control(get_report(kInput, config.lever_report, haptics::HidBytes::kMaxSize), {});
  if (requested) {
    stream.on_input(*requested, now_ns);
  } else if (quiet_ns >= kMaxSilenceNs) {
    throw haptics::HidError("The stick no longer answers");
  }
}

bool send_next_output(EmulatedStick& stick, haptics::HidStream& stream, std::int64_t now_ns) {
  const haptics::HidBytes output = stream.next_output(now_ns);
  if (output.size == 0) return false;
  send_output(stick, output);
  stream.on_sent(now_ns);
  return true;
}

// Waits until the eventfd `fd` is written to, but at most `ns` nanoseconds. If `fd` is -1, waits for the whole time.
void wait_for(int fd, std::int64_t ns) {
  pollfd poll_request{fd, POLLIN, 0};
  const timespec time{0, static_cast<long>(std::clamp<std::int64_t>(ns, 0, 999'999'999))};
  if (ppoll(&poll_request, 1, &time, nullptr) <= 0) return;
  std::uint64_t count = 0;
  [[maybe_unused]] const ssize_t ignored = read(fd, &count, sizeof count);
}

}  // namespace

void tick_stick(EmulatedStick& stick, const haptics::StreamConfig& config, haptics::HidStream& stream,
                std::int64_t now_ns) {
  take_inputs(stick, config, stream, now_ns);
  send_next_output(stick, stream, now_ns);
}

StickPort::StickPort(EmulatedStick& stick, std::mutex& mutex, const std::atomic<bool>& plugged)
    : stick_(stick), mutex_(mutex), plugged_(plugged) {
  const std::vector<std::uint8_t> device = stick.device_descriptor();
  const auto text = [&](std::uint8_t index) {
    std::string letters;
    const std::vector<std::uint8_t> bytes = index == 0 ? std::vector<std::uint8_t>{} : stick.string_descriptor(index);
    for (std::size_t i = 2; i < bytes.size(); i += 2) letters.push_back(static_cast<char>(bytes[i]));
    return letters;
  };
  identity_.vendor = static_cast<std::uint16_t>(device[8] | device[9] << 8);
  identity_.product = static_cast<std::uint16_t>(device[10] | device[11] << 8);
  identity_.maker = text(device[14]);
  identity_.name = text(device[15]);
  identity_.serial = text(device[16]);
  identity_.place = "emulated";
}

const haptics::HidIdentity& StickPort::identity() const noexcept {
  return identity_;
}

const std::vector<std::uint8_t>& StickPort::report_descriptor() const noexcept {
  return stick_.report_descriptor();
}

// Locks the stick for one control transfer, and simulates the transfer's duration.
std::unique_lock<std::mutex> StickPort::begin_transfer() {
  if (!plugged_) throw haptics::HidDisconnected("The stick was unplugged");
  std::unique_lock lock(mutex_);
  const auto slow = std::chrono::nanoseconds(static_cast<std::int64_t>(stick_.faults.slow * 1e9));
  const std::chrono::nanoseconds longest(kMaxSilenceNs);
  if (slow.count() == 0) return lock;
  lock.unlock();
  std::this_thread::sleep_for(std::min(slow, longest));
  if (!plugged_) throw haptics::HidDisconnected("The stick was unplugged");
  if (slow > longest) throw haptics::HidError("The stick does not answer within 250 ms");
  lock.lock();
  return lock;
}

haptics::HidBytes StickPort::get_feature(std::uint8_t id, std::size_t size) {
  const auto lock = begin_transfer();
  const auto answer = stick_.control(get_report(kFeature, id, size), {});
  if (!answer) throw haptics::HidError("The stick does not answer to feature report " + std::to_string(id));
  return hid_bytes(*answer);
}

void StickPort::set_feature(const haptics::HidBytes& report) {
  const auto lock = begin_transfer();
  if (!set_report(stick_, kFeature, report)) {
    throw haptics::HidError("The stick does not accept feature report " + std::to_string(report.id()));
  }
}

void StickPort::send(const haptics::HidBytes& report) {
  const auto lock = begin_transfer();
  send_output(stick_, report);
}

void StickPort::stream(const haptics::StreamConfig& config, haptics::HidStream& stream) {
  std::int64_t sent_ns = 0;
  while (!stream.should_end()) {
    std::int64_t now_ns = monotonic_ns();
    {
      if (!plugged_) throw haptics::HidDisconnected("The stick was unplugged");
      const std::lock_guard lock(mutex_);
      take_inputs(stick_, config, stream, now_ns);
      if (now_ns - sent_ns >= config.tick_ns && send_next_output(stick_, stream, now_ns)) sent_ns = now_ns;
    }
    const std::int64_t free_ns = sent_ns + config.tick_ns - now_ns;  // time until the output pipe is free
    // If the pipe is busy, wait for it; otherwise wait for a new command.
    if (free_ns > 0) {
      wait_for(-1, free_ns);
    } else {
      wait_for(config.wake_fd, config.tick_ns);
    }
  }
}

}  // namespace gearshift::test
