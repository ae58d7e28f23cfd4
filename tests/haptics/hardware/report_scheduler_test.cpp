// Tests of ReportScheduler: rules that hold for every family of sticks, checked with a small model of a device.
#include "haptics/hardware/report_scheduler.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include "haptics/hardware/pid_driver.h"
#include "tests/haptics/device/still_hand.h"
#include "tests/haptics/hardware/stick_bench.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

constexpr std::int64_t kMs = 1'000'000;  // [ns]
constexpr StickBlocks kBlocks{1, 2, 3, 4};

PidLayout layout_of(StickFamily family) {
  StillHand hand;
  EmulatedStickConfig config;
  config.family = family;
  return PidDriver(EmulatedStick(config, hand).report_descriptor()).layout();
}

// A connection without losses: tick() advances 1 ms and delivers the next report; count() counts the reports of one
// kind.
struct Wire {
  explicit Wire(StickFamily family, bool finite = true) : pid(layout_of(family)), stream(pid) {
    stream.begin(kBlocks, finite, {});
  }
  HidBytes tick(const StickCommand& command) {
    now_ns += kMs;
    stream.set_command(command);
    const HidBytes report = stream.next(now_ns);
    if (report.size > 0) stream.arrived(now_ns);
    return report;
  }
  int count(const StickCommand& command, int ticks, const PidReport& kind) {
    int found = 0;
    for (int i = 0; i < ticks; ++i) {
      const HidBytes report = tick(command);
      if (report.size > 0 && report.id() == kind.id) ++found;
    }
    return found;
  }

  PidLayout pid;
  ReportScheduler stream;
  std::int64_t now_ns = 0;
};

StickCommand everything(double x, double y) {
  StickCommand command = pushing(x, y);
  command.spring = {PidSpring{0.1, 0.2, 0.5, 1.0}, PidSpring{-0.1, 0.2, 0.5, 1.0}};
  command.damper = {0.15, 0.15};
  return command;
}

}  // namespace

TEST_CASE("on: actuators, then each effect's values before its start, then only renewals") {
  Wire wire(StickFamily::vjoy);
  std::vector<int> ids;
  for (int i = 0; i < 5; ++i) ids.push_back(wire.tick(pushing(0.5, 0.0)).id());
  // IDs in order: Device Control, magnitude of X, start of X, start of Y (whose magnitude is already 0), no report.
  CHECK(ids == std::vector<int>{0x1c, 0x15, 0x1a, 0x1a, 0});
  CHECK(wire.stream.force()[0] == 0.5);
  const int renewed = wire.count(pushing(0.5, 0.0), 1000, wire.pid.operate);
  CHECK(renewed == 20);  // two effects, each renewed ten times per second
  CHECK(wire.count(pushing(0.5, 0.0), 1000, wire.pid.set_constant) == 0);
}

// The device's force is the magnitude in the direction that was set last: it must never push the wrong way.
TEST_CASE("signs by direction: no magnitude is negative, and a force is zero while its direction is reversed") {
  for (const StickFamily family : {StickFamily::vjoy, StickFamily::adapt_ffb_joy}) {
    Wire wire(family);
    const std::uint8_t set_constant = wire.pid.set_constant.id, set_effect = wire.pid.set_effect.id;
    wire.stream.set_style({AxisStyle::direction, AxisStyle::bits, SignStyle::direction});
    for (int i = 0; i < 50; ++i) wire.tick({});
    const auto is_x = [](const HidBytes& report) { return report.bytes[1] == 1; };
    const BitField& field = wire.pid.set_constant.magnitude;
    double magnitude = 0.0, direction = 1.0;
    int turned = 0;
    for (int i = 0; i < 2000; ++i) {
      const double wanted = std::sin(0.02 * i);
      const HidBytes report = wire.tick(pushing(wanted, 0.0));
      if (report.size > 0 && report.id() == set_constant && is_x(report))
        magnitude = static_cast<double>(read_bits(report.view(), field)) / static_cast<double>(field.max);
      if (report.size > 0 && report.id() == set_effect && is_x(report)) {
        CHECK(magnitude == 0.0);
        direction = -direction;
        ++turned;
      }
      CHECK(magnitude >= 0.0);
      CHECK(wire.stream.force()[0] == doctest::Approx(direction * magnitude).epsilon(0.02));
      if (i > 20) CHECK(std::abs(direction * magnitude - wanted) < 0.12);
    }
    CHECK(turned == 12);  // the sine's zeros
  }
}

TEST_CASE("a style that is taken back before it was sent whole leaves nothing of it on the stick") {
  const StickStyle first{}, second{AxisStyle::direction, AxisStyle::bits, SignStyle::direction};
  for (int sent = 0; sent < 10; ++sent) {
    CAPTURE(sent);
    Wire wire(StickFamily::vjoy);
    std::map<std::vector<std::uint8_t>, std::vector<std::uint8_t>> settings;  // newest, by report and effect
    const auto tick = [&] {
      const HidBytes report = wire.tick({});
      const std::span<const std::uint8_t> bytes = report.view();
      const bool is_setting =
          report.size > 1 && (report.id() == wire.pid.set_effect.id || report.id() == wire.pid.set_condition.id);
      if (is_setting) settings[{bytes[0], bytes[1]}] = {bytes.begin(), bytes.end()};
    };
    const auto send = [&](StickStyle style, int ticks) {
      wire.stream.set_style(style);
      for (int i = 0; i < ticks; ++i) tick();
    };
    send(second, 50);
    send(first, 50);
    const auto whole = settings;
    send(second, sent);
    send(first, 50);
    CHECK(settings == whole);
  }
}

// Found with SunFFB's state reports: while the guard's ramp raised the walls in every cycle, the springs did not start,
// and the constant forces ran out because starts come before renewals.
TEST_CASE("a value that changes in every cycle does not delay the start of its effect") {
  Wire wire(StickFamily::openffboard);
  StickCommand command = everything(0.5, 0.5);
  for (int i = 0; i < 20; ++i) {
    for (PidSpring& spring : command.spring) spring.coefficient += 0.001;
    for (double& damper : command.damper) damper += 0.001;
    wire.tick(command);
  }
  CHECK(wire.stream.spring()[0].coefficient > 0.5);
  CHECK(wire.count(command, 100, wire.pid.operate) == 4);  // all four effects play, and are renewed once
}

TEST_CASE("a force too small to be encoded sends nothing") {
  Wire wire(StickFamily::vjoy);
  for (int i = 0; i < 10; ++i) wire.tick(pushing(1e-17, 0.0));
  CHECK(wire.count(pushing(0.0, 0.0), 10, wire.pid.set_constant) == 0);
  CHECK(wire.stream.force()[0] == 0.0);
}

TEST_CASE("off: nothing is sent while disabled") {
  for (const StickFamily family : kStickFamilies) {
    Wire wire(family);
    for (int i = 0; i < 100; ++i) CHECK(wire.tick({}).size == 0);
  }
}

TEST_CASE("endless effects are not renewed") {
  Wire wire(StickFamily::vjoy, false);
  wire.count(pushing(0.5, 0.1), 10, wire.pid.operate);
  CHECK(wire.count(pushing(0.5, 0.1), 1000, wire.pid.operate) == 0);
  CHECK(wire.stream.force()[0] == 0.5);
}

TEST_CASE("two axes that change all the time both get their turns, however different their changes are") {
  for (const double small : {1.0, 0.2, 0.02}) {
    CAPTURE(small);
    Wire wire(StickFamily::openffboard);
    for (int i = 0; i < 10; ++i) wire.tick(pushing(0.0, 0.0));
    std::vector<int> gap(2, 0), longest(2, 0);
    for (int i = 0; i < 2000; ++i) {
      const double sign = i % 2 == 0 ? 1.0 : -1.0;
      const std::array<double, 2> before = wire.stream.force();
      wire.tick(pushing(0.5 * sign + 1e-4 * (i % 7), 0.5 * small * sign + 1e-4 * (i % 5)));
      for (std::size_t axis = 0; axis < 2; ++axis) {
        gap[axis] = wire.stream.force()[axis] != before[axis] ? 0 : gap[axis] + 1;
        longest[axis] = std::max(longest[axis], gap[axis]);
      }
    }
    CHECK(longest[0] <= 5);
    CHECK(longest[1] <= std::lround(2.0 / small) + 5);  // the axis with the smaller change waits longer
  }
}

TEST_CASE("under full load every effect is renewed long before it ends, and its values keep coming") {
  Wire wire(StickFamily::sidewinder);
  std::array<std::int64_t, 5> started{};
  std::int64_t oldest = 0;
  int values = 0;
  for (int i = 0; i < 5000; ++i) {
    const double phase = 0.05 * i;
    StickCommand command = everything(std::sin(phase), std::cos(phase));
    command.spring[0].centre = 0.3 * std::sin(0.3 * phase);
    const HidBytes report = wire.tick(command);
    if (report.id() == wire.pid.operate.id) started[report.bytes[1]] = wire.now_ns;
    if (report.id() == wire.pid.set_constant.id || report.id() == wire.pid.set_condition.id) ++values;
    if (i < 20) continue;
    for (int block = 1; block <= 4; ++block)
      oldest = std::max(oldest, wire.now_ns - started[static_cast<std::size_t>(block)]);
  }
  CHECK(oldest <= 104 * kMs);  // 100 ms until renewal is due, 3 ms for other renewals, 1 ms of margin
  CHECK(values >= 4700);       // of 5000 reports, 200 renew effects (40 per second); 100 are margin
}

TEST_CASE("a release comes before anything else, and nothing drives until the old forces are gone") {
  for (const StickFamily family : kStickFamilies) {
    CAPTURE(name_of(family));
    Wire wire(family);
    for (int i = 0; i < 50; ++i) wire.tick(everything(0.9, -0.9));
    wire.stream.release();
    const StickCommand again = pushing(0.0, 0.25);
    CHECK(wire.tick(again) == encode_control(wire.pid, PidControl::disable_actuators));
    CHECK_FALSE(wire.stream.drives());
    for (int i = 0; i < 40; ++i) {
      wire.tick(again);
      CHECK(wire.stream.force()[0] == 0.0);  // the effect does not start with its old force of 0.9
      const bool expected = wire.stream.force()[1] == 0.0 || wire.stream.force()[1] == 0.25;
      CHECK(expected);
    }
    CHECK(wire.stream.force()[1] == 0.25);
  }
}

TEST_CASE("a device without a motor switch: each effect is stopped, constant forces first") {
  for (const bool has_stop : {true, false}) {
    Wire wire(StickFamily::vjoy);
    for (std::size_t i = 0; i < kPidControls; ++i) {
      wire.pid.device_control.control.supported[i] = has_stop && i == static_cast<std::size_t>(PidControl::stop_all);
    }
    wire.stream.begin(kBlocks, true, {});
    for (int i = 0; i < 20; ++i) wire.tick(everything(0.9, -0.9));
    CHECK(wire.stream.drives());
    const HidBytes first = wire.tick({});
    CHECK(first == encode_operation(wire.pid, 1, PidOperation::stop, 1));
    CHECK(wire.tick({}) == encode_operation(wire.pid, 2, PidOperation::stop, 1));
    for (int i = 0; i < 20; ++i) wire.tick({});
    CHECK(wire.tick({}).size == 0);
    CHECK_FALSE(wire.stream.drives());
  }
}

TEST_CASE("a report that does not arrive is sent again") {
  Wire wire(StickFamily::vjoy);
  for (int i = 0; i < 10; ++i) wire.tick(pushing(0.0, 0.0));
  wire.stream.set_command(pushing(0.7, 0.0));
  const HidBytes dropped = wire.stream.next(wire.now_ns + kMs);
  CHECK(dropped == encode_constant(wire.pid, 1, 0.7));
  CHECK(wire.stream.next(wire.now_ns + 2 * kMs) == dropped);
  CHECK(wire.stream.force()[0] == 0.0);
  wire.stream.arrived(wire.now_ns + 2 * kMs);
  CHECK(wire.stream.force()[0] == 0.7);
}

TEST_CASE("an effect that has run out starts again with its new force, not with its old one") {
  Wire wire(StickFamily::vjoy);
  for (int i = 0; i < 10; ++i) wire.tick(pushing(0.9, 0.0));
  wire.now_ns += 400 * kMs;  // longer than an effect lasts (300 ms)
  CHECK(wire.tick(pushing(0.1, 0.0)) == encode_constant(wire.pid, 1, 0.1));
  CHECK(wire.tick(pushing(0.1, 0.0)) == encode_operation(wire.pid, 1, PidOperation::start, 1));
}

TEST_CASE("a device that reports its motors off, or an effect stopped, is corrected") {
  Wire wire(StickFamily::sidewinder);
  for (int i = 0; i < 80; ++i) wire.tick(pushing(0.5, 0.5));
  PidStatus status;
  status.actuators_enabled = status.playing = true;
  status.block = 1;
  CHECK(wire.stream.on_report(status, wire.now_ns) == StickFault::none);
  status.playing = false;
  CHECK(wire.stream.on_report(status, wire.now_ns) == StickFault::effect_stopped);
  CHECK(wire.tick(pushing(0.5, 0.5)) == encode_operation(wire.pid, 1, PidOperation::start, 1));
  CHECK(wire.stream.on_report(status, wire.now_ns) == StickFault::none);  // this report may predate the start command
  status = {};
  CHECK(wire.stream.on_report(status, wire.now_ns) == StickFault::switched_off);
  CHECK_FALSE(wire.stream.drives());
  CHECK(wire.tick(pushing(0.5, 0.5)) == encode_control(wire.pid, PidControl::enable_actuators));
  CHECK(wire.stream.on_report(status, wire.now_ns) == StickFault::none);
  status.actuators_enabled = true;
  status.actuator_power = false;
  CHECK(wire.stream.on_report(status, wire.now_ns) == StickFault::no_power);
  status.actuator_power = true;
  status.safety_switch = false;
  CHECK(wire.stream.on_report(status, wire.now_ns) == StickFault::safety_switch);
  wire.tick({});
  CHECK_FALSE(wire.stream.drives());
  status = {};
  CHECK(wire.stream.on_report(status, wire.now_ns + 1000 * kMs) == StickFault::none);  // off as commanded
}

TEST_CASE("an effect that ran out without renewal was not stopped by the device") {
  Wire wire(StickFamily::sidewinder);
  for (int i = 0; i < 80; ++i) wire.tick(pushing(0.5, 0.5));
  PidStatus status;
  status.actuators_enabled = true;
  status.block = 1;
  CHECK(wire.stream.on_report(status, wire.now_ns + 400 * kMs) == StickFault::none);
}

// Sends random commands, with lost reports and pauses, to an emulated firmware.
TEST_CASE("after any losses and 20 ms without further ones, the device does what is commanded") {
  constexpr double kHalfStep = 0.5 * 20.0 / 255.0 + 1e-9;  // [N] half of the coarsest force step, the SideWinder's
  for (const StickFamily family : kStickFamilies) {
    CAPTURE(name_of(family));
    EmulatedStickConfig config;
    config.family = family;
    config.lever.hand = {5.0, 100.0, 1e5};  // held firmly
    StillHand hand;
    StickBench bench(config, hand);
    bench.prepare();
    std::mt19937 chance(7);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int round = 0; round < 150; ++round) {
      const StickCommand command = pushing(any(chance), any(chance));
      const int kind = static_cast<int>(chance() % 4);
      if (kind == 0) bench.driver.release();
      if (kind == 1) bench.tick_for(0.05, {});
      for (int lost = static_cast<int>(chance() % 4); lost > 0; --lost) bench.driver.next_output(bench.now_ns);
      if (kind == 2) bench.now_ns += 350 * kMs;
      bench.tick_for(0.020, command);
      CHECK(std::abs(bench.stick.force().x + 20.0 * command.constant[0]) < kHalfStep);
      CHECK(std::abs(bench.stick.force().y - 20.0 * command.constant[1]) < kHalfStep);
    }
  }
}
