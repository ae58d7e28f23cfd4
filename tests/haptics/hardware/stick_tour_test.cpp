// Tests of an emulated stick that shifts through a gate: hand, stick, HID reports, driver and loop together.
#include <algorithm>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/loop/shift_script.h"
#include "tests/haptics/device/still_hand.h"
#include "tests/haptics/hardware/stick_loop.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;

namespace {

EmulatedStickConfig touring_stick(StickFamily family) {
  EmulatedStickConfig config;
  config.family = family;
  config.lever.hand = kGripHand;
  return config;
}

struct Tour {
  std::vector<int> engaged, wanted;
  bool inside = true;      // the proxy never left the free space
  double deepest = 0.0;    // [m] largest distance of the lever from its proxy
  double strongest = 0.0;  // [N]
  GuardState guard = GuardState::idle;
  std::vector<std::string> problems;
};

Tour drive(const EmulatedStickConfig& config, const DeviceCalibration& known, const HapticConfig& haptics = {}) {
  const Gate gate = stick_gate("six_speed_r_left_up", config);
  const dvec2 start = rest_position(gate, kNeutralGear);
  ScriptedHandConfig script = touring_hand(start);
  script.effort_limit = 8.0;  // [N] a gentle hand, because the stick has only 20 N
  ScriptedHand hand(script, shift_strokes(gate, start, tour_order(gate)), config.plant_period);
  StickLoop run(config, known, haptics, gate, hand);
  run.stick.logs = false;
  run.loop.arm();
  Tour tour;
  tour.wanted = tour_order(gate);
  while (run.time() < hand.duration()) {
    const HapticSnapshot& now = run.cycle();
    tour.inside = tour.inside && in_free_space(gate, now.proxy, 1e-9);
    tour.deepest = std::max(tour.deepest, glm::distance(now.lever, now.proxy));
    tour.strongest = std::max(tour.strongest, glm::length(run.stick.force()));
  }
  tour.engaged = run.gears();
  tour.guard = run.loop.snapshot().guard;
  tour.problems = run.problems();
  return tour;
}

}  // namespace

TEST_CASE("the six-gear tour with every family: each gear once, in order, and no problems") {
  for (const StickFamily family : kStickFamilies) {
    CAPTURE(name_of(family));
    const EmulatedStickConfig config = touring_stick(family);
    const Tour tour = drive(config, calibration_of(config));
    CHECK(tour.engaged == tour.wanted);
    CHECK(tour.engaged.size() == 7);
    CHECK(tour.inside);
    CHECK(tour.guard == GuardState::running);
    CHECK(tour.problems.empty());
    CHECK(tour.strongest > 5.0);
    MESSAGE(name_of(family), ": deepest ", 1e3 * tour.deepest, " mm, strongest ", tour.strongest, " N");
  }
}

TEST_CASE("the tour with weak springs, with every polarity inverted, at 500 Hz, and 2 ms late") {
  for (const StickFamily family : {StickFamily::openffboard, StickFamily::vjoy}) {
    EmulatedStickConfig config = touring_stick(family);
    DeviceCalibration known = calibration_of(config);
    known.select.spring_sign = known.shift.spring_sign = 0;
    CHECK(drive(config, known).engaged.size() == 7);

    config.constant_sign = config.spring_sign = {-1, -1};
    CHECK(drive(config, calibration_of(config)).engaged.size() == 7);

    config = touring_stick(family);
    config.delay = 0.002;
    CHECK(drive(config, calibration_of(config)).engaged.size() == 7);

    config = touring_stick(family);
    config.plant_period = config.input_interval = 0.002;
    HapticConfig haptics;
    haptics.rate = 500.0;
    CHECK(drive(config, calibration_of(config), haptics).engaged.size() == 7);
  }
}

// If the position changes by one count of 137 um within a millisecond, the loop computes a speed of 0.14 m/s, and its
// wall damping makes the force jump. A device damper avoids these kicks, above all on a stick with delay.
TEST_CASE("with the half-sample hold, a device damper on a late stick: softer kicks from coarse counts, less rebound") {
  struct Felt {
    double damping = 0.0;  // [N s/m] wall damping after the stability limits
    double kicks = 0.0;    // [N] RMS change of the force per millisecond while a hand moves along the wall
    double rebound = 0.0;  // [m] rebound of a hand that hits the wall
  };
  const auto felt = [](double delay, bool damps) {
    EmulatedStickConfig config = touring_stick(StickFamily::sidewinder);
    config.delay = delay;
    DeviceCalibration known = calibration_of(config);
    if (!damps) known.select.damper_sign = known.shift.damper_sign = 0;
    StillHand hand(hand_at({0.012, 0.0}));
    HapticConfig haptics;
    haptics.contact.hold = ContactHold::half_sample;  // the observer hold does not use the device's damper
    StickLoop run(config, known, haptics, stick_gate("six_speed_r_left_up", config), hand);
    run.loop.arm();
    run.cycle_for(1.0);
    Felt result{run.loop.admitted().tuning.wall_damping};
    hand.target = hand_at({0.012, 0.040});
    double deepest = 0.0, back = 0.0;
    for (int ms = 0; ms < 600; ++ms) {
      run.cycle();
      const double y = run.stick.position().y;
      back = y > deepest ? y : std::min(back, y);
      deepest = std::max(deepest, y);
    }
    result.rebound = deepest - back;
    for (int ms = 0; ms < 3000; ++ms) {
      hand.target = hand_at({0.012 + 0.004 * std::sin(0.005 * ms), 0.020});
      const glm::dvec2 before = run.stick.force();
      run.cycle();
      const glm::dvec2 change = run.stick.force() - before;
      if (ms >= 500) result.kicks += glm::dot(change, change) / 2500.0;
    }
    result.kicks = std::sqrt(result.kicks);
    return result;
  };
  for (const double delay : {0.003, 0.005}) {
    const Felt loop = felt(delay, false), device = felt(delay, true);
    MESSAGE("late by ", 1e3 * delay, " ms: damping ", loop.damping, " -> ", device.damping, " N s/m, kicks ",
            loop.kicks, " -> ", device.kicks, " N, rebound ", 1e3 * loop.rebound, " -> ", 1e3 * device.rebound, " mm");
    CHECK(device.damping == 10.0);
    CHECK(device.kicks < 0.85 * loop.kicks);
    CHECK(device.rebound < 0.9 * loop.rebound);
  }
}

// At rest in the middle of the paper's gate there is no force. The effects are started anyway, so that the first force
// needs one report instead of three or four.
TEST_CASE("armed means motors on even without a force; not armed means off") {
  EmulatedStickConfig config = touring_stick(StickFamily::openffboard);  // rests at a whole count, so there is no force
  StillHand hand;
  StickLoop run(config, calibration_of(config), HapticConfig{}, stick_gate("paper", config), hand);
  run.cycle_for(0.1);
  CHECK_FALSE(run.stick.actuators_on());
  run.loop.arm();
  run.cycle_for(0.1);
  CHECK(glm::length(run.loop.snapshot().commanded) == 0.0);
  CHECK(run.stick.actuators_on());
  CHECK(run.stick.playing() >= 2);
  run.inputs.commands.push(LoopCommand::disarm);
  run.cycle_for(0.01);
  CHECK_FALSE(run.stick.actuators_on());
}
