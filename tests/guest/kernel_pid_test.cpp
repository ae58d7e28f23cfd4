// Tests the emulated sticks with the Linux kernel's driver for PID sticks (drivers/hid/usbhid/hid-pidff.c). The driver
// is an independent implementation, so its acceptance is evidence that the emulation is right. Runs only in the guest.
#include <fcntl.h>
#include <linux/input.h>
#include <sys/ioctl.h>
#include <sys/klog.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/guest/guest_bench.h"
#include "tests/haptics/device/still_hand.h"
#include "tests/support/stick/stick_profiles.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

int count_in_kernel_log(const std::string& line) {
  constexpr int kReadAll = 3;
  std::string log(1 << 20, '\0');
  const int size = klogctl(kReadAll, log.data(), static_cast<int>(log.size()));
  log.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  int count = 0;
  for (std::size_t at = log.find(line); at != std::string::npos; at = log.find(line, at + 1)) ++count;
  return count;
}

int open_event_device(int vendor, int product) {
  for (int i = 0; i < 32; ++i) {
    const int fd = open(("/dev/input/event" + std::to_string(i)).c_str(), O_RDWR | O_NONBLOCK);
    if (fd < 0) continue;
    input_id id{};
    if (ioctl(fd, EVIOCGID, &id) == 0 && id.vendor == vendor && id.product == product) return fd;
    close(fd);
  }
  return -1;
}

bool reports_bit(int events, int kind, int bit) {
  std::array<std::uint8_t, KEY_MAX / 8 + 1> bits{};
  ioctl(events, EVIOCGBIT(kind, bits.size()), bits.data());
  return (bits[static_cast<std::size_t>(bit / 8)] >> (bit % 8) & 1) != 0;
}

EmulatedStickConfig config_of(StickFamily family) {
  EmulatedStickConfig config;
  config.family = family;
  return config;
}

// A stick operated by the kernel's driver, and its event device.
struct KernelStick {
  explicit KernelStick(const EmulatedStickConfig& config) : plugged(config, hand) {
    const auto ready = [&] {
      if (events < 0) events = open_event_device(plugged.vendor(), plugged.product());
      return events >= 0 && reports_bit(events, 0, EV_FF);
    };
    REQUIRE(becomes_true(ready, 20.0));
  }
  ~KernelStick() { close(events); }

  bool has(int effect_type) const { return reports_bit(events, EV_FF, effect_type); }
  // Returns the effect's ID, or a negative error number.
  int upload(ff_effect& effect) const {
    effect.id = -1;
    return ioctl(events, EVIOCSFF, &effect) < 0 ? -errno : effect.id;
  }
  bool play(int effect, int times) const {
    input_event event{};
    event.type = EV_FF;
    event.code = static_cast<std::uint16_t>(effect);
    event.value = times;
    return write(events, &event, sizeof event) == sizeof event;
  }
  template <class Function>
  auto with_stick_state(Function function) {
    return plugged.with_stick(function);
  }

  StillHand hand;
  PluggedStick plugged;
  int events = -1;
};

ff_effect constant_force(int direction, int milliseconds) {
  ff_effect effect{};
  effect.type = FF_CONSTANT;
  effect.direction = static_cast<std::uint16_t>(direction);
  effect.replay.length = static_cast<std::uint16_t>(milliseconds);
  effect.u.constant.level = 0x4000;
  return effect;
}

}  // namespace

TEST_CASE("hid-pidff accepts each family as a PID device, and knows its effects") {
  for (StickFamily family : kFamilies) {
    CAPTURE(std::string(to_string(family)));
    const int before = count_in_kernel_log("Force feedback for USB HID PID devices");
    KernelStick stick(config_of(family));
    const auto is_logged = [&] { return count_in_kernel_log("Force feedback for USB HID PID devices") == before + 1; };
    CHECK(becomes_true(is_logged, 5.0));
    CHECK(stick.has(FF_CONSTANT));
    CHECK(stick.has(FF_SPRING));
    CHECK(stick.has(FF_DAMPER));
    // If the first block created has index 2, the driver assumes that block 1 is a built-in centring spring, and starts
    // it. This applies to the SideWinder.
    CHECK(stick.has(FF_AUTOCENTER) == (family == StickFamily::sidewinder));
    const int playing = family == StickFamily::sidewinder ? 1 : 0;
    CHECK(becomes_true([&] { return stick.with_stick_state([](EmulatedStick& s) { return s.playing(); }) == playing; },
                       5.0));
  }
}

// hid-pidff of Linux 6.1 and 6.12 needs a start delay in Set Effect and a pool managed by the device; without the negative
// fields of a condition it has no springs (pidff_init_fields).
TEST_CASE("hid-pidff accepts the profiles that have what it needs, with their habits, and only those") {
  for (const StickProfile& profile : stick_profiles()) {
    CAPTURE(std::string(profile.name));
    const StickFamily family = profile.family;
    const bool has_delay = family != StickFamily::arduino && family != StickFamily::arduino_hat &&
                           family != StickFamily::adapt_ffb_joy && family != StickFamily::affbwheel &&
                           family != StickFamily::stm32;
    const bool is_accepted = has_delay && family != StickFamily::saitek && !profile.habits.pool_by_driver_flag;
    const int before = count_in_kernel_log("Force feedback for USB HID PID devices");
    StillHand hand;
    PluggedStick plugged(config_of(profile), hand);
    int events = -1;
    REQUIRE(becomes_true([&] { return (events = open_event_device(plugged.vendor(), plugged.product())) >= 0; }, 20.0));
    const auto is_logged = [&] { return count_in_kernel_log("Force feedback for USB HID PID devices") > before; };
    CHECK(becomes_true(is_logged, is_accepted ? 5.0 : 1.0) == is_accepted);
    // The kernel sets the bits of the effects before it looks at the pool; EV_FF comes last, if forces can be used.
    CHECK(reports_bit(events, 0, EV_FF) == is_accepted);
    const auto has = [&](int effect) { return reports_bit(events, 0, EV_FF) && reports_bit(events, EV_FF, effect); };
    CHECK(has(FF_CONSTANT) == is_accepted);
    CHECK(has(FF_SPRING) == (is_accepted && family != StickFamily::brwheel));
    close(events);
  }
}

TEST_CASE("a constant force from the kernel has the direction of linux/input.h, and ends on time") {
  // Directions in linux/input.h: 0x0000 down (towards the user), 0x4000 left, 0x8000 up, 0xC000 right.
  const std::array<glm::dvec2, 4> pushes{{{0.0, -1.0}, {-1.0, 0.0}, {0.0, 1.0}, {1.0, 0.0}}};
  for (StickFamily family : kFamilies) {
    CAPTURE(std::string(to_string(family)));
    KernelStick stick(config_of(family));
    input_event centring_off{};
    centring_off.type = EV_FF;
    centring_off.code = FF_AUTOCENTER;
    REQUIRE(write(stick.events, &centring_off, sizeof centring_off) == sizeof centring_off);
    REQUIRE(
        becomes_true([&] { return stick.with_stick_state([](EmulatedStick& s) { return s.playing(); }) == 0; }, 5.0));
    for (std::size_t i = 0; i < pushes.size(); ++i) {
      CAPTURE(i);
      stick.with_stick_state([](EmulatedStick& s) {
        s.place({0.0, 0.0});
        return 0;
      });
      ff_effect effect = constant_force(static_cast<int>(i) * 0x4000, 300);
      const int id = stick.upload(effect);
      REQUIRE(id >= 0);
      REQUIRE(stick.play(id, 1));
      const auto along = [&] {
        return stick.with_stick_state([&](EmulatedStick& s) { return glm::dot(s.position(), pushes[i]); });
      };
      const auto across = [&] {
        return stick.with_stick_state(
            [&](EmulatedStick& s) { return s.position().x * pushes[i].y - s.position().y * pushes[i].x; });
      };
      CHECK(becomes_true([&] { return along() > 0.02; }, 5.0));
      CHECK(std::abs(across()) < 2e-3);
      CHECK(
          becomes_true([&] { return stick.with_stick_state([](EmulatedStick& s) { return s.playing(); }) == 0; }, 5.0));
      CHECK(ioctl(stick.events, EVIOCRMFF, id) == 0);
    }
  }
}

TEST_CASE("the event device reports the lever's position: right is X +, away from the user Y -") {
  for (StickFamily family : kFamilies) {
    CAPTURE(std::string(to_string(family)));
    EmulatedStickConfig config = config_of(family);
    config.lever.hand = kGripHand;
    KernelStick stick(config);
    stick.with_stick_state([&](EmulatedStick&) { return stick.hand.target.position = {0.04, 0.04}; });
    const auto fraction = [&](unsigned axis) {
      input_absinfo info{};
      ioctl(stick.events, EVIOCGABS(axis), &info);
      return (info.value - info.minimum) / static_cast<double>(info.maximum - info.minimum);
    };
    CHECK(becomes_true([&] { return fraction(ABS_X) > 0.6 && fraction(ABS_Y) < 0.4; }, 5.0));
  }
}

TEST_CASE("a spring from the kernel yields to a push by x = F / K") {
  for (StickFamily family : kFamilies) {
    CAPTURE(std::string(to_string(family)));
    EmulatedStickConfig config = config_of(family);
    config.lever.axis_x.stiffness = config.lever.axis_y.stiffness = 0.0;
    KernelStick stick(config);
    input_event centring_off{};
    centring_off.type = EV_FF;
    centring_off.code = FF_AUTOCENTER;
    REQUIRE(write(stick.events, &centring_off, sizeof centring_off) == sizeof centring_off);
    ff_effect effect{};
    effect.type = FF_SPRING;
    for (ff_condition_effect& axis : effect.u.condition) {
      axis.right_coeff = axis.left_coeff = 0x7fff;
      axis.right_saturation = axis.left_saturation = 0xffff;
    }
    const int id = stick.upload(effect);
    REQUIRE(id >= 0);
    REQUIRE(stick.play(id, 1));
    stick.with_stick_state([&](EmulatedStick&) {
      stick.hand.target.push = {6.0, -4.0};
      return 0;
    });
    const glm::dvec2 expected{6.0 / 400.0, -4.0 / 400.0};
    const auto error = [&] {
      return stick.with_stick_state([&](EmulatedStick& s) { return glm::length(s.position() - expected); });
    };
    CHECK(becomes_true([&] { return error() < 1e-4; }, 10.0));
  }
}

TEST_CASE("a full pool rejects a further effect, and accepts it after one was removed") {
  for (StickFamily family : kFamilies) {
    CAPTURE(std::string(to_string(family)));
    EmulatedStickConfig config = config_of(family);
    config.blocks = 4;
    KernelStick stick(config);
    int last = -1;
    for (int i = 0; i < 4; ++i) {
      ff_effect effect = constant_force(0, 100);
      last = stick.upload(effect);
      CHECK(last >= 0);
    }
    ff_effect more = constant_force(0, 100);
    CHECK(stick.upload(more) == -ENOSPC);
    CHECK(ioctl(stick.events, EVIOCRMFF, last) == 0);
    // The kernel frees a block through the output pipe and creates one through the control pipe. The creation may
    // overtake the freeing, so the first attempts may fail.
    CHECK(becomes_true([&] { return stick.upload(more) >= 0; }, 5.0));
  }
}

TEST_CASE("unplugging a stick while it pushes does no harm to the kernel") {
  for (StickFamily family : kFamilies) {
    CAPTURE(std::string(to_string(family)));
    EmulatedStickConfig config = config_of(family);
    int events = -1;
    {
      KernelStick stick(config);
      ff_effect effect = constant_force(0, 0);
      const int id = stick.upload(effect);
      REQUIRE(stick.play(id, 1));
      events = dup(stick.events);
    }
    input_id id{};
    CHECK(becomes_true([&] { return ioctl(events, EVIOCGID, &id) < 0 && errno == ENODEV; }, 5.0));
    close(events);
  }
  CHECK(count_in_kernel_log("BUG:") + count_in_kernel_log("Oops") + count_in_kernel_log("WARNING:") == 0);
}
