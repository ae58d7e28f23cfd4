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

namespace gearshift {
namespace {

constexpr std::int64_t kDeadNs = 250'000'000;  // [ns] without an answer
constexpr std::uint16_t kInput = 0x0100, kOutput = 0x0200, kFeature = 0x0300;

std::int64_t monotonic_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

HidBytes hid_bytes(std::span<const std::uint8_t> report) {
  HidBytes bytes;
  bytes.size = std::min(report.size(), HidBytes::kMost);
  std::copy_n(report.begin(), bytes.size, bytes.bytes.begin());
  return bytes;
}

UsbSetup get_report(std::uint16_t kind, std::uint8_t id, std::size_t size) {
  return {0xA1, 1, static_cast<std::uint16_t>(kind | id), 0, static_cast<std::uint16_t>(size)};
}

bool set_report(EmulatedStick& stick, std::uint16_t kind, const HidBytes& report) {
  const UsbSetup setup{0x21, 9, static_cast<std::uint16_t>(kind | report.id()), 0,
                       static_cast<std::uint16_t>(report.size)};
  return stick.control(setup, report.view()).has_value();
}

bool has_output_pipe(const EmulatedStick& stick) {
  return stick.configuration_descriptor()[13] == 2;  // bNumEndpoints of the interface: the second is the output
}

void give(EmulatedStick& stick, const HidBytes& report) {
  const bool taken = has_output_pipe(stick) ? stick.output(report.view()) : set_report(stick, kOutput, report);
  if (!taken) throw HidError("The stick does not take an output");
}

void take_inputs(EmulatedStick& stick, const StreamConfig& config, HidStream& stream, std::int64_t now_ns) {
  stick.advance(now_ns);
  while (const auto report = stick.input()) stream.on_input(*report, now_ns);
  const std::int64_t quiet_ns = now_ns - stick.told_ns();
  if (quiet_ns < config.silence_ns) return;
  const auto asked = stick.control(get_report(kInput, config.lever_report, HidBytes::kMost), {});
  if (asked) {
    stream.on_input(*asked, now_ns);
  } else if (quiet_ns >= kDeadNs) {
    throw HidError("The stick does not answer any more");
  }
}

bool give_output(EmulatedStick& stick, HidStream& stream, std::int64_t now_ns) {
  const HidBytes output = stream.next_output(now_ns);
  if (output.size == 0) return false;
  give(stick, output);
  stream.on_sent(now_ns);
  return true;
}

// Until that is written to, or so long.
void wait_for(int fd, std::int64_t ns) {
  pollfd wanted{fd, POLLIN, 0};
  const timespec time{0, static_cast<long>(std::clamp<std::int64_t>(ns, 0, 999'999'999))};
  if (ppoll(&wanted, 1, &time, nullptr) <= 0) return;
  std::uint64_t count = 0;
  [[maybe_unused]] const ssize_t taken = read(fd, &count, sizeof count);
}

}  // namespace

void tick_stick(EmulatedStick& stick, const StreamConfig& config, HidStream& stream, std::int64_t now_ns) {
  take_inputs(stick, config, stream, now_ns);
  give_output(stick, stream, now_ns);
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

const HidIdentity& StickPort::identity() const noexcept {
  return identity_;
}

const std::vector<std::uint8_t>& StickPort::report_descriptor() const noexcept {
  return stick_.report_descriptor();
}

// The stick, for one transfer over the control pipe.
std::unique_lock<std::mutex> StickPort::begin_transfer() {
  if (!plugged_) throw HidGone("The stick was unplugged");
  std::unique_lock lock(mutex_);
  const auto slow = std::chrono::nanoseconds(static_cast<std::int64_t>(stick_.faults.slow * 1e9));
  const std::chrono::nanoseconds longest(kDeadNs);
  if (slow.count() == 0) return lock;
  lock.unlock();
  std::this_thread::sleep_for(std::min(slow, longest));
  if (!plugged_) throw HidGone("The stick was unplugged");
  if (slow > longest) throw HidError("The stick does not answer within 250 ms");
  lock.lock();
  return lock;
}

HidBytes StickPort::get_feature(std::uint8_t id, std::size_t size) {
  const auto lock = begin_transfer();
  const auto answer = stick_.control(get_report(kFeature, id, size), {});
  if (!answer) throw HidError("The stick does not answer to feature report " + std::to_string(id));
  return hid_bytes(*answer);
}

void StickPort::set_feature(const HidBytes& report) {
  const auto lock = begin_transfer();
  if (!set_report(stick_, kFeature, report)) {
    throw HidError("The stick does not take feature report " + std::to_string(report.id()));
  }
}

void StickPort::send(const HidBytes& report) {
  const auto lock = begin_transfer();
  give(stick_, report);
}

void StickPort::stream(const StreamConfig& config, HidStream& stream) {
  std::int64_t sent_ns = 0;
  while (!stream.should_end()) {
    std::int64_t now_ns = monotonic_ns();
    {
      if (!plugged_) throw HidGone("The stick was unplugged");
      const std::lock_guard lock(mutex_);
      take_inputs(stick_, config, stream, now_ns);
      if (now_ns - sent_ns >= config.tick_ns && give_output(stick_, stream, now_ns)) sent_ns = now_ns;
    }
    const std::int64_t free_ns = sent_ns + config.tick_ns - now_ns;  // when the pipe is
    // A wish that cannot be sent yet waits for the pipe; without one, for the wish.
    if (free_ns > 0) {
      wait_for(-1, free_ns);
    } else {
      wait_for(config.wake_fd, config.tick_ns);
    }
  }
}

}  // namespace gearshift
