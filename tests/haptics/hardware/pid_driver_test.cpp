// The driver between its two sides: what it sees, what it obeys, and every lie of a stick.
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

using namespace gearshift;

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

std::vector<std::uint8_t> without_pid() {  // X and Y of a joystick, no more
  return {0x05, 0x01, 0x09, 0x04, 0xa1, 0x01, 0x09, 0x30, 0x09, 0x31, 0x15,
          0x00, 0x26, 0xff, 0x03, 0x75, 0x10, 0x95, 0x02, 0x81, 0x02, 0xc0};
}

}  // namespace

TEST_CASE("no stick, no forces, no sense: refused in one sentence") {
  CHECK_THROWS_WITH_AS(PidDriver{without_pid()},
                       "this stick has no force feedback: its descriptor has no reports that push (PID class)",
                       HidError);
  std::vector<std::uint8_t> no_axes = without_pid();
  no_axes[7] = no_axes[9] = 0x36;  // sliders
  CHECK_THROWS_WITH_AS(PidDriver{no_axes}, "this device is no stick: its descriptor has no axes X and Y", HidError);
  CHECK_THROWS_AS(PidDriver{std::vector<std::uint8_t>{0x05}}, HidError);
}

TEST_CASE("what is wished is what pushes, on every family; what is seen is where the lever is") {
  for (const StickFamily family : kStickFamilies) {
    CAPTURE(name_of(family));
    StillHand hand(hand_at({0.020, -0.035}));
    StickBench bench(held(family), hand);
    bench.prepare();
    bench.tick_for(0.5, {});
    CHECK(bench.stick.force() == glm::dvec2(0.0));
    const PidSight still = bench.driver.see();
    CHECK(still.session == 1);
    CHECK(still.time_ns == bench.now_ns);
    CHECK_FALSE(still.actuators);
    // PID 1.0 section 4.2: from 90 degrees pushes left; from 180 degrees, the user's side, pushes away.
    bench.tick_for(0.01, pushing(0.5, 0.25));
    const PidSight pushed = bench.driver.see();
    CHECK(pushed.actuators);
    CHECK(pushed.sent == std::array<double, 2>{0.5, 0.25});
    CHECK(pushed.sequence == still.sequence + 10);
    CHECK(bench.stick.force().x == doctest::Approx(-10.0).epsilon(0.01));
    CHECK(bench.stick.force().y == doctest::Approx(5.0).epsilon(0.01));
    CHECK(bench.problems().empty());
  }
}

TEST_CASE("only what is new wakes the port") {
  StillHand hand;
  StickBench bench(held(StickFamily::vjoy), hand);
  bench.prepare();
  const int fd = bench.driver.stream_config(1'000'000).wake_fd;
  bench.driver.see();
  bench.driver.wish(pushing(0.1, 0.0));
  CHECK(wakes(fd));
  bench.driver.wish(pushing(0.1, 0.0));
  CHECK_FALSE(wakes(fd));
  bench.driver.wish(pushing(0.2, 0.0));
  CHECK(wakes(fd));
  bench.driver.release();
  CHECK(wakes(fd));
  bench.driver.release();
  CHECK(wakes(fd));
}

TEST_CASE("what is no number drives nothing") {
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  std::vector<PidWish> wishes{pushing(nan, 0.0), pushing(0.5, infinite), pushing(0.5, 0.0), pushing(0.5, 0.0)};
  wishes[2].spring[1].centre = nan;
  wishes[3].damper[1] = nan;
  for (const PidWish& wish : wishes) {
    StillHand hand;
    StickBench bench(held(StickFamily::vjoy), hand);
    bench.prepare();
    bench.tick_for(0.05, wish);
    CHECK_FALSE(bench.stick.actuators_on());
    CHECK(bench.stick.playing() == 0);
  }
}

TEST_CASE("a release is never lost, however soon a wish comes after it") {
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

TEST_CASE("unplugged and back: nothing of what was wished before drives it, though the haptic side goes on wishing") {
  for (const StickFamily family : kStickFamilies) {
    StillHand hand;
    StickBench bench(held(family), hand);
    bench.prepare();
    bench.tick_for(0.1, pushing(0.8, 0.8));
    bench.stick.unplug();
    bench.driver.wish(pushing(0.8, 0.8));  // under way
    bench.prepare();
    bench.driver.wish(pushing(0.8, 0.8));  // it has not seen that the stick is another one
    for (int i = 0; i < 50; ++i) {
      bench.tick();
      bench.driver.wish(pushing(0.8, 0.8));
      CHECK(bench.stick.force() == glm::dvec2(0.0));
      CHECK_FALSE(bench.stick.actuators_on());
    }
    bench.tick_for(0.02, pushing(0.1, 0.0));  // it has, now
    CHECK(bench.stick.force().x == doctest::Approx(-2.0).epsilon(0.02));
  }
}

TEST_CASE("the haptic side falls silent while it drives: off after 100 ms, and nothing of that session counts again") {
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
          Lines{"no force was commanded for 100 ms: the motors are off until they are armed again"});
    bench.driver.wish(pushing(0.8, 0.0));  // without having seen
    for (int i = 0; i < 50; ++i) bench.tick();
    CHECK(bench.stick.force() == glm::dvec2(0.0));
    CHECK(bench.driver.see().session == 2);
  }
}

TEST_CASE("a dead program: the device falls silent within 300 ms by itself, walls too") {
  for (const StickFamily family : kStickFamilies) {
    CAPTURE(name_of(family));
    StillHand hand(hand_at({0.03, 0.0}));
    StickBench bench(held(family), hand);
    bench.prepare();
    PidWish wish = pushing(0.5, 0.0);
    wish.spring[0] = {0.0, 0.1, 1.0, 1.0};
    for (int phase = 0; phase < 5; ++phase) {  // whatever was renewed last
      bench.tick_for(0.5 + 0.021 * phase, wish);
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

// One second under a force that changes, with that fault: what was said, and the greatest force beyond what was wished.
struct Lied {
  Lines problems;
  double beyond = 0.0;  // [N]
  std::uint64_t readings = 0;
};

Lied lie(StickFamily family, double seconds, const std::function<void(StickFaults&)>& fault) {
  StillHand hand;
  StickBench bench(held(family), hand);
  bench.prepare();
  bench.tick_for(0.2, pushing(0.1, 0.1));
  fault(bench.stick.faults);
  const std::uint64_t before = bench.driver.see().sequence;
  Lied lied;
  while (bench.time() < 0.2 + seconds) {
    const double wished = 0.4 * std::sin(20.0 * bench.time());
    bench.tick(pushing(wished, wished));
    lied.beyond = std::max(lied.beyond, glm::length(bench.stick.force()) - 0.4 * std::sqrt(2.0) * 20.0);
  }
  lied.problems = bench.problems();
  lied.readings = bench.driver.see().sequence - before;
  return lied;
}

}  // namespace

TEST_CASE("a stick that lies: one sentence for each lie, and no force beyond what was wished") {
  for (const StickFamily family : kStickFamilies) {
    CAPTURE(name_of(family));
    const Lied jumps = lie(family, 1.0, [](StickFaults& faults) { faults.jump = true; });
    CHECK(jumps.problems.size() == 1);
    CHECK(jumps.problems.front().find("the stick's position jumps by ") == 0);

    const Lied lengths = lie(family, 0.2, [](StickFaults& faults) { faults.wrong_length = true; });
    CHECK(lengths.readings == 0);
    REQUIRE(lengths.problems.size() == 1);
    const std::string size = std::to_string(family == StickFamily::sidewinder    ? 13
                                            : family == StickFamily::openffboard ? 25
                                                                                 : 97);
    CHECK(lengths.problems.front().find("bytes where its descriptor says " + size + ": it is not used") !=
          std::string::npos);

    const Lied stuck = lie(family, 3.0, [](StickFaults& faults) { faults.stuck = true; });
    CHECK(stuck.readings > 1900);  // two seconds
    CHECK(stuck.readings < 2300);
    CHECK(stuck.problems ==
          Lines{"the stick has said one place for 2 s while its force changed: its sensor is taken for "
                "dead until it moves"});
    for (const Lied* lied : {&jumps, &lengths, &stuck}) CHECK(lied->beyond < 0.1);
  }
}

TEST_CASE("a stuck sensor that moves again is believed again") {
  StillHand hand;
  StickBench bench(held(StickFamily::openffboard), hand);
  bench.prepare();
  bench.stick.faults.stuck = true;
  for (int i = 0; i < 2500; ++i) bench.tick(pushing(0.4 * std::sin(0.02 * i), 0.0));
  const std::uint64_t stuck = bench.driver.see().sequence;
  bench.tick_for(0.1, pushing(0.1, 0.0));
  CHECK(bench.driver.see().sequence == stuck);
  bench.stick.faults.stuck = false;
  bench.tick_for(0.1, pushing(0.1, 0.0));
  CHECK(bench.driver.see().sequence >= stuck + 99);
}

TEST_CASE("a lever that stands still under a force that hardly changes is not stuck") {
  StillHand hand;
  StickBench bench(held(StickFamily::sidewinder), hand);
  bench.prepare();
  bench.stick.faults.stuck = true;
  double late = 0.0;  // [N] the most in the last second
  const std::uint64_t session = bench.driver.see().session;
  for (int i = 0; i < 6000; ++i) {
    bench.driver.wish(pushing(0.14 * std::sin(0.02 * i), 0.0));  // by one who does not look
    bench.tick();
    if (i >= 5000) late = std::max(late, glm::length(bench.stick.force()));
  }
  CHECK(bench.problems() == Lines{"the stick has said one place for 3 s under its force: the motors are off until they "
                                  "are armed again"});
  CHECK(bench.driver.see().sequence == 6000);  // its readings count
  CHECK(bench.driver.see().session == session + 1);
  CHECK(late == 0.0);
}

TEST_CASE("a stuck sensor under a force that does not change: the force yields, and the sensor is found out") {
  for (const StickFamily family : kStickFamilies) {
    CAPTURE(name_of(family));
    StillHand hand;
    StickBench bench(held(family), hand);
    bench.prepare();
    bench.stick.faults.stuck = true;
    bench.tick_for(1.99, pushing(0.5, -0.1));
    CHECK(std::abs(bench.stick.force().x) == doctest::Approx(10.0).epsilon(0.01));
    bench.tick_for(0.5, pushing(0.5, -0.1));
    CHECK(std::abs(bench.stick.force().x) == doctest::Approx(5.0).epsilon(0.05));  // half of it, after half the time
    bench.tick_for(0.6, pushing(0.5, -0.1));
    CHECK(bench.stick.force() == glm::dvec2(0.0));
    CHECK(bench.problems() == Lines{"the stick has said one place for 2 s while its force changed: its sensor is taken "
                                    "for dead until it moves"});
    CHECK(bench.time() - 1e-9 * static_cast<double>(bench.driver.see().time_ns) > 0.3);  // its readings do not count

    bench.stick.faults.stuck = false;  // a place at last
    bench.tick_for(0.2, pushing(0.5, -0.1));
    CHECK(std::abs(bench.stick.force().x) == doctest::Approx(10.0).epsilon(0.01));
  }
}

// The axis that lives moves all the time; nor is a lever dead that stood for long before there was a force.
TEST_CASE("one sensor of two is dead; and one that has only rested") {
  StillHand hand;
  StickBench bench(held(StickFamily::openffboard), hand);
  LeverReport report = bench.driver.lever_report();
  InputWatch watch(report, {0, 1});
  LeverCounts counts;
  double least = 1.0;
  for (int ms = 0; ms < 2900; ++ms) {
    counts.axis[0] = ms % 2;
    watch.see(counts, {0.5, 0.2}, {}, std::int64_t{1'000'000} * ms);
    least = std::min(least, watch.force_share(0));
  }
  CHECK(least == 1.0);
  CHECK(watch.force_share(1) == doctest::Approx(0.1).epsilon(0.05));
  CHECK_FALSE(watch.is_frozen());

  InputWatch resting(report, {0, 1});
  for (int ms = 0; ms < 12'000; ++ms) {
    const double force = std::clamp(0.01 * (ms - 10'000), 0.0, 0.5);
    resting.see(counts, {force, 0.0}, {}, std::int64_t{1'000'000} * ms);
    if (resting.is_frozen()) CHECK(ms >= 11'990);
  }
}

// While the program stood still nobody looked, and what waits on the bus then is of before, whatever it is stamped with.
TEST_CASE("a pause of the program is no dead sensor, and where the lever has gone meanwhile no jump") {
  StillHand hand;
  StickBench bench(held(StickFamily::openffboard), hand);
  const LeverReport report = bench.driver.lever_report();
  const auto far = static_cast<std::int64_t>(0.7 * static_cast<double>(report.axes[0].field.max));
  InputWatch watch(report, {0, 1});
  LeverCounts counts;
  const auto see = [&](std::int64_t ms) { watch.see(counts, {0.5, 0.5}, {}, 1'000'000 * ms); };
  for (std::int64_t ms = 0; ms < 500; ++ms) see(ms);
  see(3500);
  see(3500);  // two that had waited
  CHECK(watch.force_share(0) == 1.0);
  counts.axis[0] = far;
  see(3501);
  CHECK(watch.jump() == 0.0);
  for (std::int64_t ms = 3502; ms < 4000; ++ms) see(ms);
  counts.axis[0] = -far;
  see(4000);
  CHECK(watch.jump() == doctest::Approx(0.7).epsilon(0.01));  // of the range, between neighbours
}

TEST_CASE("a wall that the device keeps yields under a dead sensor, too, however strong its springs are") {
  StillHand hand;
  StickBench bench(held(StickFamily::vjoy), hand);
  bench.prepare();
  PidWish wish = pushing(0.0, 0.0);
  wish.spring[0] = {0.5, 0.1, 1.0, 1.0};  // the lever at 0 is beyond it
  bench.tick_for(0.1, wish);
  bench.stick.faults.stuck = true;
  CHECK(glm::length(bench.stick.force()) > 5.0);
  bench.tick_for(3.1, wish);
  CHECK(glm::length(bench.stick.force()) < 1e-9);
  CHECK(bench.problems().size() == 1);
}

// Judged over half a second; a single late one says nothing.
TEST_CASE("a stick that is slower than it was calibrated is driven no longer") {
  StillHand hand;
  StickBench bench(held(StickFamily::vjoy), hand);
  bench.prepare();
  const auto drive = [&bench](std::int64_t takes_ms) {
    bench.driver.see();
    for (int output = 0; output < 1000 / takes_ms; ++output) {
      bench.driver.wish(pushing(0.3 + 0.1 * (output % 2), 0.0));
      if (bench.driver.next_output(bench.now_ns).size == 0) continue;
      bench.now_ns += 1'000'000 * takes_ms;
      bench.driver.on_sent(bench.now_ns);
    }
    return bench.driver.see().session;
  };
  const std::uint64_t session = drive(50);  // nobody said how fast it was
  bench.driver.expect_answer(0.004);
  CHECK(drive(8) == session);
  bench.now_ns += 1'000'000'000;  // nothing to be told for a while, and then one that is late
  CHECK(drive(900) == session);
  CHECK(drive(8) == session);
  CHECK(drive(50) == session + 1);
  CHECK(bench.problems() ==
        Lines{"the stick takes 50 ms for an output, and answered after 4 ms when it was calibrated: "
              "the motors are off until they are armed again"});
}

TEST_CASE("silent, and outputs that are not taken: the port says so, and the device goes silent") {
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

TEST_CASE("a port that never says that an output arrived is told of") {
  StillHand hand;
  StickBench bench(held(StickFamily::vjoy), hand);
  bench.prepare();
  bench.driver.see();
  for (std::int64_t ms = 0; ms < 200; ++ms) {
    bench.driver.wish(pushing(0.5, 0.0));
    bench.driver.next_output(ms * 1'000'000);
  }
  CHECK(bench.problems() == Lines{"the stick takes no outputs: its force ends by itself"});
}

TEST_CASE("reports that no descriptor knows are not used, and told once") {
  StillHand hand;
  StickBench bench(held(StickFamily::sidewinder), hand);
  bench.prepare();
  const std::vector<std::uint8_t> unknown{0x77, 1, 2, 3}, empty;
  for (int i = 0; i < 10; ++i) {
    bench.driver.on_input(unknown, 1);
    bench.driver.on_input(empty, 2);
  }
  CHECK(bench.problems() == Lines{"the stick sends report 119, which its descriptor does not know: it is not used"});
  CHECK(bench.driver.see().sequence == 0);
  bench.driver.on_input(unknown, 3);
  CHECK(bench.problems().empty());
}

TEST_CASE("motors that switch themselves off stay off until somebody wishes anew, and it is said") {
  for (const StickFamily family : {StickFamily::sidewinder, StickFamily::openffboard}) {
    StillHand hand;
    StickBench bench(held(family), hand);
    bench.prepare();
    bench.tick_for(0.2, pushing(0.5, 0.0));
    // As if somebody else had told it so: off is number 2 for the one, bit 1 for the other.
    bench.stick.output(std::vector<std::uint8_t>{0x0c, 0x02});
    CHECK(bench.stick.force() == glm::dvec2(0.0));
    const std::uint64_t session = bench.driver.see().session;
    for (int ms = 0; ms < 100; ++ms) {  // what was wished before is wished on, by one who has not looked
      bench.driver.wish(pushing(0.5, 0.0));
      bench.tick();
      CHECK(bench.stick.force() == glm::dvec2(0.0));
    }
    CHECK(bench.driver.see().session == session + 1);
    CHECK(bench.problems() ==
          Lines{"the stick switched its motors off by itself: they stay off until they are armed again"});
    bench.tick_for(0.1, pushing(0.5, 0.0));
    CHECK(bench.stick.force().x == doctest::Approx(-10.0).epsilon(0.01));
  }
}

TEST_CASE("an effect that ends by itself is started again, and it is said") {
  StillHand hand;
  StickBench bench(held(StickFamily::sidewinder), hand);
  bench.prepare();
  bench.tick_for(0.185, pushing(0.5, 0.0));
  bench.stick.output(std::vector<std::uint8_t>{0x0a, 0x02, 0x03, 0x00});  // stop block 2: constant X
  CHECK(bench.stick.force() == glm::dvec2(0.0));
  bench.tick_for(0.005, pushing(0.5, 0.0));
  CHECK(bench.stick.force().x == doctest::Approx(-10.0).epsilon(0.01));
  CHECK(bench.problems() == Lines{"the stick stopped an effect by itself: it was started again"});
}

TEST_CASE("a stick that tells changes alone is not dead while it stands still") {
  for (const StickFamily family : kStickFamilies) {
    StillHand hand;
    EmulatedStickConfig config = held(family);
    config.reports_changes_alone = true;
    StickBench bench(config, hand);
    bench.prepare();
    const std::uint64_t before = bench.driver.see().sequence;
    bench.tick_for(1.0, {});
    CHECK(bench.driver.see().sequence - before > 100);  // it is asked every 8 ms
    CHECK(bench.now_ns - bench.driver.see().time_ns < 10'000'000);
  }
}

TEST_CASE("finish: off, and a wish drives nothing after it") {
  for (const StickFamily family : kStickFamilies) {
    StillHand hand;
    StickBench bench(held(family), hand);
    bench.prepare();
    bench.tick_for(0.2, pushing(0.5, 0.0));
    bench.driver.finish(bench.port);
    CHECK(bench.stick.force() == glm::dvec2(0.0));
    CHECK_FALSE(bench.driver.see().actuators);
    bench.stick.log.clear();
    bench.tick_for(0.1, pushing(0.5, 0.0));
    CHECK(bench.lines().empty());
  }
}
