// Tests of PidDriver: its state, its commands, and every kind of faulty stick.
#include "haptics/hardware/pid_driver.h"

#include <unistd.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/haptics/device/still_hand.h"
#include "tests/haptics/hardware/stick_bench.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

using Lines = std::vector<std::string>;

EmulatedStickConfig held(StickFamily family) {
  EmulatedStickConfig config;
  config.family = family;
  config.lever.hand = kGripHand;
  return config;
}

bool wakes(int fd) {
  std::uint64_t count = 0;
  return read(fd, &count, sizeof count) == sizeof count;
}

std::vector<std::uint8_t> without_pid() {  // a joystick with X and Y, but without force feedback (PID)
  return {0x05, 0x01, 0x09, 0x04, 0xa1, 0x01, 0x09, 0x30, 0x09, 0x31, 0x15,
          0x00, 0x26, 0xff, 0x03, 0x75, 0x10, 0x95, 0x02, 0x81, 0x02, 0xc0};
}

}  // namespace

TEST_CASE("a stick that refuses durations and ends an endless effect after 65 s is never silent") {
  EmulatedStickConfig config;
  config.finite_refused = true;
  config.habits.ones_are_finite = true;
  config.habits.state_sent = StateSent::never;
  StillHand hand;
  StickBench bench(config, hand);
  bench.prepare();
  CHECK_FALSE(bench.ability.finite);
  bench.stick.logs = false;
  bench.tick_for(1.0, pushing(0.1, 0.0));
  for (int second = 0; second < 140; ++second) {
    bench.tick_for(1.0, pushing(0.1, 0.0));
    if (glm::length(bench.stick.force()) == 0.0) FAIL_CHECK("silent after " << second << " s");
  }
}

TEST_CASE("a device that is no stick, has no forces or no valid descriptor is refused in one sentence") {
  CHECK_THROWS_WITH_AS(PidDriver{without_pid()},
                       "this stick has no force feedback, because its descriptor has no force reports (PID class)",
                       HidError);
  std::vector<std::uint8_t> no_axes = without_pid();
  no_axes[7] = no_axes[9] = 0x36;  // sliders
  CHECK_THROWS_WITH_AS(PidDriver{no_axes}, "this device is not a stick, because its descriptor has no X and Y axes",
                       HidError);
  CHECK_THROWS_AS(PidDriver{std::vector<std::uint8_t>{0x05}}, HidError);
}

TEST_CASE("commanded forces act on the lever of every family, and the state shows the lever's position") {
  for (const StickFamily family : kStickFamilies) {
    CAPTURE(name_of(family));
    StillHand hand(hand_at({0.020, -0.035}));
    StickBench bench(held(family), hand);
    bench.prepare();
    bench.tick_for(0.5, {});
    CHECK(bench.stick.force() == glm::dvec2(0.0));
    const StickState still = bench.driver.state();
    CHECK(still.session == 1);
    CHECK(still.time_ns == bench.now_ns);
    CHECK_FALSE(still.actuators);
    // PID 1.0 section 4.2: a force with direction 90 degrees pushes left. A force with direction 180 degrees comes from
    // the user's side and pushes away.
    bench.tick_for(0.01, pushing(0.5, 0.25));
    const StickState pushed = bench.driver.state();
    CHECK(pushed.actuators);
    CHECK(pushed.sent == std::array<double, 2>{0.5, 0.25});
    CHECK(pushed.sequence == still.sequence + 10);
    CHECK(bench.stick.force().x == doctest::Approx(-10.0).epsilon(0.01));
    CHECK(bench.stick.force().y == doctest::Approx(5.0).epsilon(0.01));
    CHECK(bench.problems().empty());
  }
}

TEST_CASE("only a new command wakes the port") {
  StillHand hand;
  StickBench bench(held(StickFamily::vjoy), hand);
  bench.prepare();
  const int fd = bench.driver.stream_config(1'000'000).wake_fd;
  bench.driver.state();
  bench.driver.command(pushing(0.1, 0.0));
  CHECK(wakes(fd));
  bench.driver.command(pushing(0.1, 0.0));
  CHECK_FALSE(wakes(fd));
  bench.driver.command(pushing(0.2, 0.0));
  CHECK(wakes(fd));
  bench.driver.release();
  CHECK(wakes(fd));
  bench.driver.release();
  CHECK(wakes(fd));
}

TEST_CASE("a command with NaN or infinity drives nothing") {
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  std::vector<StickCommand> commands{pushing(nan, 0.0), pushing(0.5, infinite), pushing(0.5, 0.0), pushing(0.5, 0.0)};
  commands[2].spring[1].centre = nan;
  commands[3].damper[1] = nan;
  for (const StickCommand& command : commands) {
    StillHand hand;
    StickBench bench(held(StickFamily::vjoy), hand);
    bench.prepare();
    bench.tick_for(0.05, command);
    CHECK_FALSE(bench.stick.actuators_on());
    CHECK(bench.stick.playing() == 0);
  }
}

TEST_CASE("a release is never lost, however soon a command comes after it") {
  StillHand hand;
  StickBench bench(held(StickFamily::sidewinder), hand);
  bench.prepare();
  bench.tick_for(0.05, pushing(0.9, 0.0));
  bench.stick.log.clear();
  bench.driver.release();
  bench.tick(pushing(0.2, 0.0));
  CHECK(bench.lines() == Lines{"out 0c 02"});  // actuators off
  CHECK(bench.stick.force() == glm::dvec2(0.0));
  bench.tick_for(0.03, pushing(0.2, 0.0));
  CHECK(bench.stick.force().x == doctest::Approx(-4.0));
}

TEST_CASE("after an unplug, commands of the old session drive nothing, even if the haptic side keeps sending them") {
  for (const StickFamily family : kStickFamilies) {
    StillHand hand;
    StickBench bench(held(family), hand);
    bench.prepare();
    bench.tick_for(0.1, pushing(0.8, 0.8));
    bench.stick.unplug();
    bench.driver.command(pushing(0.8, 0.8));  // streaming
    bench.prepare();
    bench.driver.command(pushing(0.8, 0.8));  // computed from a state that was read before the reconnect
    for (int i = 0; i < 50; ++i) {
      bench.tick();
      bench.driver.command(pushing(0.8, 0.8));
      CHECK(bench.stick.force() == glm::dvec2(0.0));
      CHECK_FALSE(bench.stick.actuators_on());
    }
    bench.tick_for(0.02, pushing(0.1, 0.0));  // tick_for() reads the new session's state before it commands
    CHECK(bench.stick.force().x == doctest::Approx(-2.0).epsilon(0.02));
  }
}

TEST_CASE("if the haptic side stops sending commands, the motors are off after 100 ms and the session ends") {
  for (const StickFamily family : kStickFamilies) {
    StillHand hand;
    StickBench bench(held(family), hand);
    bench.prepare();
    bench.tick_for(0.1, pushing(0.8, 0.0));
    for (int i = 0; i < 99; ++i) bench.tick();
    CHECK(glm::length(bench.stick.force()) > 15.0);
    for (int i = 0; i < 3; ++i) bench.tick();
    CHECK(bench.stick.force() == glm::dvec2(0.0));
    CHECK(bench.problems() ==
          Lines{"no force was commanded for 100 ms; the motors are off until you turn them on again"});
    bench.driver.command(pushing(0.8, 0.0));  // sent without first reading the new session's state
    for (int i = 0; i < 50; ++i) bench.tick();
    CHECK(bench.stick.force() == glm::dvec2(0.0));
    CHECK(bench.driver.state().session == 2);
  }
}

TEST_CASE("if the program dies, the device's forces end by themselves within 300 ms, walls included") {
  for (const StickFamily family : kStickFamilies) {
    CAPTURE(name_of(family));
    StillHand hand(hand_at({0.03, 0.0}));
    StickBench bench(held(family), hand);
    bench.prepare();
    StickCommand command = pushing(0.5, 0.0);
    command.spring[0] = {0.0, 0.1, 1.0, 1.0};
    for (int phase = 0; phase < 5; ++phase) {  // the program dies at different times after a renewal of the effects
      bench.tick_for(0.5 + 0.021 * phase, command);
      REQUIRE(glm::length(bench.stick.force()) > 5.0);
      const std::int64_t died = bench.now_ns;
      while (bench.stick.force() != glm::dvec2(0.0)) bench.stick.advance(bench.now_ns += 1'000'000);
      CHECK(bench.now_ns - died <= 301'000'000);
      bench.stick.advance(bench.now_ns = died + 301'000'000);
      CHECK(bench.stick.playing() == 0);
    }
  }
}

namespace {

// Result of a run in which a faulty stick renders a varying force: the reported problems, and the largest excess over
// the commanded maximum.
struct FaultResult {
  Lines problems;
  double beyond = 0.0;  // [N]
  std::uint64_t readings = 0;
};

FaultResult run_with_fault(StickFamily family, double seconds, const std::function<void(EmulatedFaults&)>& fault) {
  StillHand hand;
  StickBench bench(held(family), hand);
  bench.prepare();
  bench.tick_for(0.2, pushing(0.1, 0.1));
  fault(bench.stick.faults);
  const std::uint64_t before = bench.driver.state().sequence;
  FaultResult result;
  while (bench.time() < 0.2 + seconds) {
    const double wished = 0.4 * std::sin(20.0 * bench.time());
    bench.tick(pushing(wished, wished));
    result.beyond = std::max(result.beyond, glm::length(bench.stick.force()) - 0.4 * std::sqrt(2.0) * 20.0);
  }
  result.problems = bench.problems();
  result.readings = bench.driver.state().sequence - before;
  return result;
}

}  // namespace

TEST_CASE("a faulty stick: one sentence per fault, and no force beyond the command") {
  for (const StickFamily family : kStickFamilies) {
    CAPTURE(name_of(family));
    const FaultResult jumps = run_with_fault(family, 1.0, [](EmulatedFaults& faults) { faults.jump = true; });
    CHECK(jumps.problems.size() == 1);
    CHECK(jumps.problems.front().find("the stick's position jumped by ") == 0);

    const FaultResult lengths = run_with_fault(family, 0.2, [](EmulatedFaults& faults) { faults.wrong_length = true; });
    CHECK(lengths.readings == 0);
    REQUIRE(lengths.problems.size() == 1);
    const std::string size = std::to_string(family == StickFamily::sidewinder    ? 13
                                            : family == StickFamily::openffboard ? 25
                                                                                 : 97);
    CHECK(lengths.problems.front().find("bytes, but its descriptor declares " + size + "; the report is ignored") !=
          std::string::npos);

    const FaultResult stuck = run_with_fault(family, 3.0, [](EmulatedFaults& faults) { faults.stuck = true; });
    CHECK(stuck.readings > 1900);  // two seconds
    CHECK(stuck.readings < 2300);
    CHECK(stuck.problems ==
          Lines{"the stick's position has not changed for 2 s while the force changed; its readings are ignored "
                "until the position changes; if you felt no force, check the stick's power supply and its safety "
                "switch"});
    for (const FaultResult* result : {&jumps, &lengths, &stuck}) CHECK(result->beyond < 0.1);
  }
}

TEST_CASE("readings of a stuck sensor are accepted again once it moves") {
  StillHand hand;
  StickBench bench(held(StickFamily::openffboard), hand);
  bench.prepare();
  bench.stick.faults.stuck = true;
  for (int i = 0; i < 2500; ++i) bench.tick(pushing(0.4 * std::sin(0.02 * i), 0.0));
  const std::uint64_t stuck = bench.driver.state().sequence;
  bench.tick_for(0.1, pushing(0.1, 0.0));
  CHECK(bench.driver.state().sequence == stuck);
  bench.stick.faults.stuck = false;
  bench.tick_for(0.1, pushing(0.1, 0.0));
  CHECK(bench.driver.state().sequence >= stuck + 99);
}

TEST_CASE("a lever at rest under an almost constant force is not reported as stuck") {
  StillHand hand;
  StickBench bench(held(StickFamily::sidewinder), hand);
  bench.prepare();
  bench.stick.faults.stuck = true;
  double late = 0.0;  // [N] largest force during the last second
  const std::uint64_t session = bench.driver.state().session;
  for (int i = 0; i < 6000; ++i) {
    // After the fault these commands still belong to the old session, so the driver ignores them.
    bench.driver.command(pushing(0.14 * std::sin(0.02 * i), 0.0));
    bench.tick();
    if (i >= 5000) late = std::max(late, glm::length(bench.stick.force()));
  }
  CHECK(bench.problems() ==
        Lines{"the stick's position has not changed for 3 s under force; the motors are off until you "
              "turn them on again; if you felt no force, check the stick's power supply and its safety switch"});
  CHECK(bench.driver.state().sequence == 6000);  // readings are accepted
  CHECK(bench.driver.state().session == session + 1);
  CHECK(late == 0.0);
}

TEST_CASE("a stuck sensor under a constant force: the force fades out, and the fault is detected") {
  for (const StickFamily family : kStickFamilies) {
    CAPTURE(name_of(family));
    StillHand hand;
    StickBench bench(held(family), hand);
    bench.prepare();
    bench.stick.faults.stuck = true;
    bench.tick_for(1.99, pushing(0.5, -0.1));
    CHECK(std::abs(bench.stick.force().x) == doctest::Approx(10.0).epsilon(0.01));
    bench.tick_for(0.5, pushing(0.5, -0.1));
    // Halfway through the fade, half of the 10 N remains.
    CHECK(std::abs(bench.stick.force().x) == doctest::Approx(5.0).epsilon(0.05));
    bench.tick_for(0.6, pushing(0.5, -0.1));
    CHECK(bench.stick.force() == glm::dvec2(0.0));
    CHECK(bench.problems() ==
          Lines{"the stick's position has not changed for 2 s while the force changed; its readings are ignored "
                "until the position changes; if you felt no force, check the stick's power supply and its safety "
                "switch"});
    CHECK(bench.time() - 1e-9 * static_cast<double>(bench.driver.state().time_ns) > 0.3);  // readings are dropped

    bench.stick.faults.stuck = false;  // the sensor works from now on
    bench.tick_for(0.2, pushing(0.5, -0.1));
    CHECK(std::abs(bench.stick.force().x) == doctest::Approx(10.0).epsilon(0.01));
  }
}

// First case: one axis moves all the time, and the sensor of the other axis is dead. Second case: the lever was at rest
// for a long time before the first force, and must not be reported as frozen too soon.
TEST_CASE("one dead sensor of two; and a sensor that was only at rest") {
  StillHand hand;
  StickBench bench(held(StickFamily::openffboard), hand);
  LeverReport report = bench.driver.lever_report();
  InputWatch watch(report, {0, 1});
  LeverCounts counts;
  double min_fraction = 1.0;
  for (int ms = 0; ms < 2900; ++ms) {
    counts.axis[0] = ms % 2;
    watch.update(counts, {0.5, 0.2}, {}, std::int64_t{1'000'000} * ms);
    min_fraction = std::min(min_fraction, watch.force_fraction(0));
  }
  CHECK(min_fraction == 1.0);
  CHECK(watch.force_fraction(1) == doctest::Approx(0.1).epsilon(0.05));
  CHECK_FALSE(watch.is_frozen());

  InputWatch resting(report, {0, 1});
  for (int ms = 0; ms < 12'000; ++ms) {
    const double force = std::clamp(0.01 * (ms - 10'000), 0.0, 0.5);
    resting.update(counts, {force, 0.0}, {}, std::int64_t{1'000'000} * ms);
    if (resting.is_frozen()) CHECK(ms >= 11'990);
  }
}

// A stopped program reads nothing. The reports that wait on the bus meanwhile get time stamps that are later than their
// measurements.
TEST_CASE("a pause of the program is not a dead sensor, and the lever's motion during it is not a jump") {
  StillHand hand;
  StickBench bench(held(StickFamily::openffboard), hand);
  const LeverReport report = bench.driver.lever_report();
  const auto far = static_cast<std::int64_t>(0.7 * static_cast<double>(report.axes[0].field.max));
  InputWatch watch(report, {0, 1});
  LeverCounts counts;
  const auto report_at = [&](std::int64_t ms) { watch.update(counts, {0.5, 0.5}, {}, 1'000'000 * ms); };
  for (std::int64_t ms = 0; ms < 500; ++ms) report_at(ms);
  report_at(3500);
  report_at(3500);  // the second of two reports that waited on the bus
  CHECK(watch.force_fraction(0) == 1.0);
  counts.axis[0] = far;
  report_at(3501);
  CHECK(watch.jump() == 0.0);
  for (std::int64_t ms = 3502; ms < 4000; ++ms) report_at(ms);
  counts.axis[0] = -far;
  report_at(4000);
  CHECK(watch.jump() == doctest::Approx(0.7).epsilon(0.01));  // largest step as a fraction of the axis's range
}

TEST_CASE("a device wall fades out under a dead sensor as well, however strong its springs are") {
  StillHand hand;
  StickBench bench(held(StickFamily::vjoy), hand);
  bench.prepare();
  StickCommand command = pushing(0.0, 0.0);
  command.spring[0] = {0.5, 0.1, 1.0, 1.0};  // the lever, at 0, is outside the dead band around 0.5
  bench.tick_for(0.1, command);
  bench.stick.faults.stuck = true;
  CHECK(glm::length(bench.stick.force()) > 5.0);
  bench.tick_for(3.1, command);
  CHECK(glm::length(bench.stick.force()) < 1e-9);
  CHECK(bench.problems().size() == 1);
}

// The driver averages the delay over half a second, because a single late output proves nothing.
TEST_CASE("a stick that is slower than its calibration is no longer driven") {
  StillHand hand;
  StickBench bench(held(StickFamily::vjoy), hand);
  bench.prepare();
  const auto drive = [&bench](std::int64_t transfer_ms) {
    bench.driver.state();
    for (int output = 0; output < 1000 / transfer_ms; ++output) {
      bench.driver.command(pushing(0.3 + 0.1 * (output % 2), 0.0));
      if (bench.driver.next_output(bench.now_ns).size == 0) continue;
      bench.now_ns += 1'000'000 * transfer_ms;
      bench.driver.on_sent(bench.now_ns);
    }
    return bench.driver.state().session;
  };
  const std::uint64_t session = drive(50);  // 50 ms per output is accepted, because no answer time is set yet
  bench.driver.expect_answer(0.004);
  CHECK(drive(8) == session);
  bench.now_ns += 1'000'000'000;  // one second without outputs, then one late output
  CHECK(drive(900) == session);
  CHECK(drive(8) == session);
  CHECK(drive(50) == session + 1);
  CHECK(bench.problems() == Lines{"the stick takes 50 ms per output, but responded after 4 ms when it was calibrated; "
                                  "the motors are off until you turn them on again"});
}

TEST_CASE("silence or blocked outputs: the port reports an error, and the device's forces end") {
  for (const StickFamily family : kStickFamilies) {
    StillHand hand;
    StickBench bench(held(family), hand);
    bench.prepare();
    bench.tick_for(0.2, pushing(0.5, 0.0));
    bench.stick.faults.silent = true;
    CHECK_THROWS_AS(bench.tick_for(0.4, pushing(0.5, 0.0)), HidError);
    bench.stick.faults = {};
    bench.stick.faults.stalls_outputs = true;
    CHECK_THROWS_AS(bench.tick_for(0.2, pushing(0.6, 0.0)), HidError);
    bench.stick.advance(bench.now_ns += 301'000'000);
    CHECK(bench.stick.force() == glm::dvec2(0.0));
  }
}

TEST_CASE("a port that never confirms an output is reported") {
  StillHand hand;
  StickBench bench(held(StickFamily::vjoy), hand);
  bench.prepare();
  bench.driver.state();
  for (std::int64_t ms = 0; ms < 200; ++ms) {
    bench.driver.command(pushing(0.5, 0.0));
    bench.driver.next_output(ms * 1'000'000);
  }
  CHECK(bench.problems() == Lines{"the stick accepts no output; its last force ends by itself"});
}

TEST_CASE("reports that the descriptor does not define are ignored, and reported once") {
  StillHand hand;
  StickBench bench(held(StickFamily::sidewinder), hand);
  bench.prepare();
  const std::vector<std::uint8_t> unknown{0x77, 1, 2, 3}, empty;
  for (int i = 0; i < 10; ++i) {
    bench.driver.on_input(unknown, 1);
    bench.driver.on_input(empty, 2);
  }
  CHECK(bench.problems() ==
        Lines{"the stick sends report 119, which its descriptor does not define; the report is ignored"});
  CHECK(bench.driver.state().sequence == 0);
  bench.driver.on_input(unknown, 3);
  CHECK(bench.problems().empty());
}

TEST_CASE("motors that switch themselves off stay off until a new session commands, and it is reported") {
  for (const StickFamily family : {StickFamily::sidewinder, StickFamily::openffboard}) {
    StillHand hand;
    StickBench bench(held(family), hand);
    bench.prepare();
    bench.tick_for(0.2, pushing(0.5, 0.0));
    // Switches the motors off, as another program could. The value 2 has this meaning on both devices: command number 2
    // on the SideWinder, bit 1 on the OpenFFBoard.
    bench.stick.output(std::vector<std::uint8_t>{0x0c, 0x02});
    CHECK(bench.stick.force() == glm::dvec2(0.0));
    const std::uint64_t session = bench.driver.state().session;
    for (int ms = 0; ms < 100; ++ms) {  // the state is not read, so the commands belong to the old session
      bench.driver.command(pushing(0.5, 0.0));
      bench.tick();
      CHECK(bench.stick.force() == glm::dvec2(0.0));
    }
    CHECK(bench.driver.state().session == session + 1);
    CHECK(bench.problems() ==
          Lines{"the stick switched its motors off by itself; they stay off until you turn them on again"});
    bench.tick_for(0.1, pushing(0.5, 0.0));
    CHECK(bench.stick.force().x == doctest::Approx(-10.0).epsilon(0.01));
  }
}

TEST_CASE("an effect that the device stopped is started again, and it is reported") {
  StillHand hand;
  StickBench bench(held(StickFamily::sidewinder), hand);
  bench.prepare();
  bench.tick_for(0.185, pushing(0.5, 0.0));
  bench.stick.output(std::vector<std::uint8_t>{0x0a, 0x02, 0x03, 0x00});  // stops block 2, the constant force on X
  CHECK(bench.stick.force() == glm::dvec2(0.0));
  bench.tick_for(0.005, pushing(0.5, 0.0));
  CHECK(bench.stick.force().x == doctest::Approx(-10.0).epsilon(0.01));
  CHECK(bench.problems() == Lines{"the stick stopped an effect by itself; the effect was started again"});
}

TEST_CASE("a stick that reports only changes is not dead while it stands still") {
  for (const StickFamily family : kStickFamilies) {
    StillHand hand;
    EmulatedStickConfig config = held(family);
    config.reports_only_changes = true;
    StickBench bench(config, hand);
    bench.prepare();
    const std::uint64_t before = bench.driver.state().sequence;
    bench.tick_for(1.0, {});
    CHECK(bench.driver.state().sequence - before > 100);  // the driver requests the position every 8 ms
    CHECK(bench.now_ns - bench.driver.state().time_ns < 10'000'000);
  }
}

TEST_CASE("finish() switches the motors off, and later commands drive nothing") {
  for (const StickFamily family : kStickFamilies) {
    StillHand hand;
    StickBench bench(held(family), hand);
    bench.prepare();
    bench.tick_for(0.2, pushing(0.5, 0.0));
    bench.driver.finish(bench.port);
    CHECK(bench.stick.force() == glm::dvec2(0.0));
    CHECK_FALSE(bench.driver.state().actuators);
    bench.stick.log.clear();
    bench.tick_for(0.1, pushing(0.5, 0.0));
    CHECK(bench.lines().empty());
  }
}

TEST_CASE("a stick that reports its state confirms a change of style; another does not") {
  std::string table = "family, state | confirmed after ms\n";
  for (const StickFamily family : kStickFamilies) {
    for (const StateSent sent : {StateSent::at_changes, StateSent::at_setting, StateSent::never}) {
      CAPTURE(name_of(family));
      StillHand hand;
      EmulatedStickConfig config = held(family);
      config.habits.state_sent = sent;
      StickBench bench(config, hand);
      bench.prepare();
      bench.tick_for(0.1, {});
      const StickStyle style{AxisStyle::both, AxisStyle::direction};
      const auto is_confirmed = [&] {
        const StickState state = bench.driver.state();
        return state.style == style && state.off_ns > state.style_ns;
      };
      CHECK_FALSE(is_confirmed());
      bench.driver.set_style(style);
      const double begin = bench.time();
      while (!is_confirmed() && bench.time() < begin + 0.25) bench.tick({});
      const double passed = bench.time() - begin;
      table += name_of(family) + ", " + std::to_string(static_cast<int>(sent)) + " | " +
               std::to_string(std::lround(1e3 * passed)) + '\n';
      if (sent == StateSent::never) CHECK(passed >= 0.25);
      if (sent == StateSent::at_changes && family == StickFamily::sidewinder) CHECK(passed < 0.05);
    }
  }
  MESSAGE(table);
}
