// Tests of the calibrator, in virtual time: it must measure the configured values of an emulated stick and refuse
// invalid input.
#include "haptics/hardware/calibrator.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "haptics/files/number_text.h"
#include "tests/haptics/device/still_hand.h"
#include "tests/haptics/hardware/calibrated.h"
#include "tests/haptics/hardware/calibration_bench.h"
#include "tests/haptics/hardware/stick_loop.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;

namespace {

EmulatedStickConfig config_of(StickFamily family) {
  EmulatedStickConfig config;
  config.family = family;
  return config;
}

// A perfect calibration in which timing, polarity, springs and handle are not measured yet.
DeviceCalibration unmeasured_calibration(const EmulatedStickConfig& config) {
  DeviceCalibration known = calibration_of(config);
  known.timing = {};
  for (LeverAxisCalibration* axis : {&known.select, &known.shift}) {
    axis->constant_sign = axis->spring_sign = 0;
    axis->damper_sign = 0;
    axis->spring_stiffness = axis->spring_dead_band = axis->damper_strength = 0.0;
    axis->handle = {};
  }
  return known;
}

std::string refusal(const std::function<void()>& step) {
  try {
    step();
  } catch (const CalibrationRefused& refused) {
    return refused.what();
  }
  return "";
}

// Damping [N s/m] that a damper D, sampled with period T, adds to a lever of mass m and damping b. The damper's force
// is constant within each period, so the speed changes per period by the factor phi - D (1 - phi) / b, with phi =
// exp(-b T / m).
double sampled_damper(const AxisModel& handle, double damper) {
  constexpr double kPeriod = 0.001;  // [s]
  const double phi = std::exp(-handle.damping * kPeriod / handle.mass);
  const double decay = phi - damper * (1.0 - phi) / handle.damping;
  return -handle.mass * std::log(decay) / kPeriod - handle.damping;
}

double counts_of(const LeverAxisCalibration& axis) {
  return std::abs(axis.high - axis.low);
}

}  // namespace

TEST_CASE(
    "an uncalibrated stick is calibrated from the start, for every family and every polarity, and then holds a wall") {
  for (const StickFamily family : kStickFamilies) {
    for (const glm::ivec2 sign : {glm::ivec2(1, 1), glm::ivec2(-1, 1)}) {
      CAPTURE(name_of(family));
      CAPTURE(sign.x);
      EmulatedStickConfig config = config_of(family);
      config.constant_sign = sign;
      config.spring_sign = config.damper_sign = {sign.y, sign.x};
      config.delay = 0.002;
      const DeviceCalibration truth = calibration_of(config);
      CalibrationBench bench(config);
      Calibrator& calibrator = bench.calibrator;

      bench.find_axes();
      bench.measure_all_stops();
      calibrator.set_numbers(dvec2(0.14), dvec2(20.0));
      bench.hands_off();
      bench.strongest = 0.0;
      calibrator.measure_polarity();
      CHECK(bench.strongest <= kCautiousForce * 20.0 * 1.01);
      calibrator.measure_timing();
      calibrator.measure_strength();
      calibrator.measure_handle();
      calibrator.measure_springs();

      // Relative tolerance of the damper's strength. It is larger for the SideWinder, whose position count is 137 um.
      // On the other sticks a count is at most 4 um.
      const double fine = family == StickFamily::sidewinder ? 0.10 : 0.04;
      const DeviceCalibration& found = calibrator.calibration();
      CHECK(missing_steps(found, true, true).empty());
      CHECK(found.select.constant_sign == truth.select.constant_sign);
      CHECK(found.shift.constant_sign == truth.shift.constant_sign);
      CHECK(found.select.spring_sign == truth.select.spring_sign);
      CHECK(found.shift.spring_sign == truth.shift.spring_sign);
      for (const bool select : {true, false}) {
        const LeverAxisCalibration& measured = select ? found.select : found.shift;
        const LeverAxisCalibration& expected = select ? truth.select : truth.shift;
        const double count = 0.01 * counts_of(expected);
        CHECK(measured.usage == expected.usage);
        CHECK(std::abs(measured.low - expected.low) < count);
        CHECK(std::abs(measured.high - expected.high) < count);
        CHECK(std::abs(measured.centre - expected.centre) < count);
        CHECK(measured.handle.mass == doctest::Approx(expected.handle.mass).epsilon(0.05));
        CHECK(measured.handle.damping == doctest::Approx(expected.handle.damping).epsilon(0.05));
        CHECK(std::abs(measured.handle.stiffness - expected.handle.stiffness) < 4.0);
        CHECK(measured.constant_limit == 1.0);
        CHECK(measured.constant_slope == 1.0);
        CHECK(measured.spring_stiffness == doctest::Approx(400.0).epsilon(0.05));
        CHECK(measured.damper_sign == expected.damper_sign);
        CHECK(measured.damper_strength == doctest::Approx(2.0 * sampled_damper(expected.handle, 10.0)).epsilon(fine));
      }
      CHECK(found.timing.input_interval == doctest::Approx(0.001));
      CHECK(found.timing.jitter == doctest::Approx(0.0));
      CHECK(found.timing.output_interval == doctest::Approx(0.001).epsilon(0.02));
      CHECK(std::abs(found.timing.delay - 0.002) < 3e-4);

      // With this calibration, the loop renders the neutral aisle's wall while a hand presses into it.
      EmulatedStickConfig gripped = config;
      gripped.lever.hand = kGripHand;
      StillHand hand;
      StickLoop run(gripped, found, HapticConfig{}, stick_gate("six_speed_r_left_up", gripped), hand);
      run.loop.arm();
      run.cycle_for(0.7);
      hand.target = hand_at({0.012, 0.020});
      run.cycle_for(1.0);
      CHECK(run.loop.snapshot().guard == GuardState::running);
      CHECK(glm::length(run.stick.force()) > 3.0);
      CHECK(glm::distance(run.loop.snapshot().lever, run.loop.snapshot().proxy) < 0.005);
      dvec2 low = run.stick.position(), high = low;
      for (int ms = 0; ms < 100; ++ms) {
        run.cycle();
        low = glm::min(low, run.stick.position());
        high = glm::max(high, run.stick.position());
      }
      CHECK(glm::length(high - low) < 4.2e-4);  // [m] just over three position counts of the SideWinder, 137 um each
    }
  }
}

TEST_CASE("the measured delay is the emulation's, within a third of a millisecond") {
  for (const double delay : {0.0, 0.001, 0.003, 0.0055, 0.012}) {
    CAPTURE(delay);
    EmulatedStickConfig config = config_of(StickFamily::sidewinder);  // the coarsest stick
    config.delay = delay;
    config.plant_period = 0.00025;
    DeviceCalibration known = unmeasured_calibration(config);
    known.select.constant_sign = -1;
    known.shift.constant_sign = 1;
    CalibrationBench bench(config, known);
    bench.calibrator.measure_timing();
    CHECK(std::abs(bench.calibrator.calibration().timing.delay - delay) < 3.5e-4);
  }
}

// Friction also holds the lever beside its centre before a push, which the fit does not know; hence 10 %.
TEST_CASE("dry friction does not spoil the measured mass and damping, and is reported") {
  for (const double friction : {0.11, 0.4}) {
    EmulatedStickConfig config = config_of(StickFamily::openffboard);
    config.lever.coulomb_friction = friction;
    DeviceCalibration known = calibration_of(config);
    known.select.handle = known.shift.handle = {};
    CalibrationBench bench(config, known);
    const std::string sentence = bench.calibrator.measure_handle();
    const DeviceCalibration found = bench.calibrator.calibration();
    CAPTURE(sentence);
    CHECK(found.select.handle.mass == doctest::Approx(config.lever.axis_x.mass).epsilon(0.1));
    CHECK(found.select.handle.damping == doctest::Approx(config.lever.axis_x.damping).epsilon(0.1));
    CHECK(found.shift.handle.mass == doctest::Approx(config.lever.axis_y.mass).epsilon(0.1));
    CHECK(found.shift.handle.damping == doctest::Approx(config.lever.axis_y.damping).epsilon(0.1));
    CHECK(sentence.find("N of dry friction") != std::string::npos);
    CHECK(found.select.friction == doctest::Approx(friction).epsilon(0.25));
    CHECK(found.shift.friction == doctest::Approx(friction).epsilon(0.25));
  }
}

// adapt-ffb-joy 0.4: 102 of 255 give 25 of 127, 128 give 31, but 153 give 102, and 255 give 127.
TEST_CASE("forces that do not grow evenly are used up to where they do, and the handle's mass is right all the same") {
  EmulatedStickConfig config = config_of(StickFamily::adapt_ffb_joy);
  const auto calibrated = [&] {
    DeviceCalibration known = calibration_of(config);
    known.select.constant_limit = known.shift.constant_limit = 0.0;
    known.select.handle = known.shift.handle = {};
    known.select.low = known.shift.high = -512.0;
    known.select.high = known.shift.low = 511.0;
    known.select.centre = known.shift.centre = -0.5;
    CalibrationBench bench(config, known);
    const std::string sentence = bench.calibrator.measure_strength();
    bench.calibrator.measure_handle();
    return std::pair{sentence, bench.calibrator.calibration()};
  };
  config.habits.jumps_at_half = true;
  const auto [sentence, found] = calibrated();
  CHECK(sentence.find("in select, magnitudes of 5, 20, 60 and 100 % give 2, ") == 0);
  CHECK(
      sentence.find("and 100 % of the full force, so only magnitudes up to 50 % are used, and no force exceeds 24 % of "
                    "the full one") != std::string::npos);
  for (const LeverAxisCalibration& axis : {found.select, found.shift}) {
    CHECK(axis.constant_limit == 0.5);
    CHECK(axis.constant_slope == doctest::Approx(12.0 / 127.0 / 0.2).epsilon(0.05));
  }
  CHECK(found.select.handle.mass == doctest::Approx(config.lever.axis_x.mass).epsilon(0.08));
  CHECK(found.shift.handle.mass == doctest::Approx(config.lever.axis_y.mass).epsilon(0.08));
  CHECK(spec_of(found, 0.001).max_force.x == doctest::Approx(20.0 * 31.0 / 127.0).epsilon(0.05));

  config.habits.jumps_at_half = false;  // the same stick with even forces
  const auto [even, whole] = calibrated();
  CHECK(even.find("so only") == std::string::npos);
  CHECK(whole.select.constant_limit == 1.0);
  CHECK(spec_of(whole, 0.001).max_force == dvec2(20.0));
}

// A busy machine stops the calibration's thread for 25 ms during the first two pushes of full force. The port's thread,
// which has a real-time priority, goes on. Full force for 25 ms would move this lever by 65 mm.
TEST_CASE("when the calibration is late, a push of full force still ends in time") {
  for (const StickFamily family : kStickFamilies) {
    CAPTURE(name_of(family));
    DeviceCalibration known = calibration_of(config_of(family));
    known.select.constant_limit = known.shift.constant_limit = 0.0;
    CalibrationBench bench(config_of(family), known);
    int strong = 0, longest = 0;  // [ms] with full force
    int stops = 0;
    const auto go_on = [&] {
      strong = glm::length(bench.stick.force()) > 19.0 ? strong + 1 : 0;
      longest = std::max(longest, strong);
    };
    bench.every_tick = [&] {
      go_on();
      if (strong != 1 || ++stops > 2) return;
      for (int i = 0; i < 25; ++i) {
        bench.tick();
        go_on();
      }
    };
    CHECK(refusal([&] { bench.calibrator.measure_strength(); }) == "");
    CHECK(longest > 5);
    CHECK(longest < 20);  // there and back: twice 8 ms
    CHECK(bench.calibrator.calibration().select.constant_limit == 1.0);
  }
}

TEST_CASE("too few readings of a push are a refusal, not the program's end") {
  DeviceCalibration known = calibration_of(config_of(StickFamily::sidewinder));
  known.select.constant_limit = known.shift.constant_limit = 0.0;
  CalibrationBench bench(config_of(StickFamily::sidewinder), known);
  bench.every_tick = [&] {  // only once pushes of 20 % begin
    for (int i = 0; bench.strongest > 3.9 && i < 40; ++i) bench.tick();
  };
  CHECK(refusal([&] { bench.calibrator.measure_strength(); }) ==
        "select cannot be measured, because too few readings to identify the lever's motion");
}

TEST_CASE("cross-talk of each family of effects and the number of effects that act at once are measured") {
  EmulatedStickConfig config = config_of(StickFamily::openffboard);
  config.habits.cross_talk = {0.04, 0.06, 0.08};
  const auto calibrated = [&] {
    CalibrationBench bench(config, unmeasured_calibration(config));
    for (const auto step : {&Calibrator::measure_polarity, &Calibrator::measure_timing, &Calibrator::measure_handle,
                            &Calibrator::measure_springs})
      std::invoke(step, bench.calibrator);
    return bench.calibrator.calibration();
  };
  const DeviceCalibration found = calibrated();
  for (const LeverAxisCalibration& axis : {found.select, found.shift}) {
    CHECK(std::abs(axis.constant_cross_talk - 0.04) < 0.02);
    CHECK(std::abs(axis.spring_cross_talk - 0.06) < 0.02);
    CHECK(std::abs(axis.damper_cross_talk - 0.08) < 0.03);
  }
  CHECK(found.effects_at_once == 4);

  config.habits.cross_talk = {0.0, 0.3, 0.0};
  CHECK(calibrated().springs_refused.find("a spring along select also acts along shift, with ") == 0);
  config.habits.cross_talk = {0.0, 0.0, 0.3};
  CHECK(calibrated().dampers_refused.find("a damper along select also acts along shift, with ") == 0);
  config.habits.cross_talk = {0.8, 0.0, 0.0};
  CHECK_THROWS_AS(calibrated(), CalibrationRefused);

  config.habits.cross_talk = {};
  for (const int limit : {1, 2, 3}) {
    config.habits.effects_at_once = limit;
    CAPTURE(limit);
    CHECK(calibrated().effects_at_once == limit);
  }
}

// A motor of 20 N that also pushes the other axis with a fraction c leaves 20 (1 - c) N in the worst direction.
TEST_CASE("cross-talk of forces is cancelled, and what remains is small") {
  std::string table = "cross-talk | remains | largest force N | not cancelled: rms N | cancelled: rms N\n";
  for (const double cross_talk : {0.15, 0.3, 0.5}) {
    CAPTURE(cross_talk);
    EmulatedStickConfig config = config_of(StickFamily::openffboard);
    config.habits.cross_talk.constant = cross_talk;
    CalibrationBench bench(config, unmeasured_calibration(config));
    CHECK(bench.calibrator.measure_polarity().find("which is cancelled") != std::string::npos);
    bench.calibrator.measure_timing();
    bench.calibrator.measure_handle();
    const DeviceCalibration& found = bench.calibrator.calibration();
    const glm::dmat2 coupling = force_coupling(found);
    CHECK(coupling[0][1] == doctest::Approx(-cross_talk).epsilon(0.06));  // the stick's Y is the lever's back
    CHECK(coupling[1][0] == doctest::Approx(-cross_talk).epsilon(0.06));
    CHECK(std::max(found.select.constant_cross_talk, found.shift.constant_cross_talk) < 0.1);
    CHECK(spec_of(found, 0.001).max_force.x == doctest::Approx(20.0 * (1.0 - cross_talk)).epsilon(0.05));
    const auto rms = [&](const DeviceCalibration& known) {
      EmulatedStickConfig gripped = config;
      gripped.lever.hand = kGripHand;
      StillHand hand;
      StickLoop run(gripped, known, HapticConfig{}, stick_gate("six_speed_r_left_up", gripped), hand);
      run.loop.arm();
      run.cycle_for(0.7);
      double sum = 0.0;
      for (int ms = 0; ms < 2000; ++ms) {
        hand.target = hand_at({0.02 * std::sin(0.003 * ms), 0.012 * std::sin(0.005 * ms)});
        const dvec2 error = -run.cycle().f_a - run.stick.force();
        sum += glm::dot(error, error) / 2000.0;
      }
      CHECK(run.problems().empty());
      return std::sqrt(sum);
    };
    DeviceCalibration coupled = found;
    coupled.select.constant_coupling = coupled.shift.constant_coupling = 0.0;
    const double before = rms(coupled), after = rms(found);
    CHECK(before > 2.0 * after);
    CHECK(after < 0.5);
    table += number_text(cross_talk, 2) + " | " + number_text(found.select.constant_cross_talk, 3) + ", " +
             number_text(found.shift.constant_cross_talk, 3) + " | " +
             number_text(spec_of(found, 0.001).max_force.x, 1) + " | " + number_text(before, 2) + " | " +
             number_text(after, 2) + '\n';
  }
  MESSAGE(table);
}

TEST_CASE("where springs are refused, dampers are still measured and used, if those of both axes act together") {
  EmulatedStickConfig config = config_of(StickFamily::openffboard);
  config.habits.dead_band = DeadBandLaw::ignored;
  const auto calibrated = [&] {
    CalibrationBench bench(config, unmeasured_calibration(config));
    for (const auto step : {&Calibrator::measure_polarity, &Calibrator::measure_timing, &Calibrator::measure_handle})
      std::invoke(step, bench.calibrator);
    const std::string sentence = bench.calibrator.measure_springs();
    return std::pair{sentence, bench.calibrator.calibration()};
  };
  const auto [sentence, found] = calibrated();
  CHECK(found.springs_refused == "the stick's springs push inside their dead band");
  CHECK(sentence.find("so springs are not used") != std::string::npos);
  CHECK(sentence.find("; dampers of up to 2") != std::string::npos);
  CHECK(found.dampers_refused.empty());
  CHECK(found.effects_at_once == 3);
  for (const LeverAxisCalibration& axis : {found.select, found.shift}) {
    CHECK(axis.damper_sign == 1);
    CHECK(axis.damper_strength == doctest::Approx(2.0 * sampled_damper(axis.handle, 10.0)).epsilon(0.06));
  }
  CHECK(usable_wall_stiffness(spec_of(found, 0.001)) == 0.0);
  CHECK(usable_wall_damping(spec_of(found, 0.001)) > 15.0);

  // On a late stick, where the loop itself damps little.
  EmulatedStickConfig gripped = config;
  gripped.lever.hand = kGripHand;
  gripped.delay = 0.005;
  DeviceCalibration late = found;
  late.timing.delay = 0.005;
  StillHand hand(hand_at({0.012, 0.0}));
  HapticConfig haptics;
  haptics.contact.hold = ContactHold::half_sample;  // the observer hold does not use the device's damper
  StickLoop run(gripped, late, haptics, stick_gate("six_speed_r_left_up", gripped), hand);
  run.loop.arm();
  run.cycle_for(0.7);
  CHECK(run.driver.state().damper[1] == 0.0);
  hand.target = hand_at({0.012, 0.020});
  run.cycle_for(0.5);
  CHECK(run.driver.state().damper[1] > 0.2);
  CHECK(run.loop.admitted().tuning.wall_damping == 10.0);
  CHECK(run.problems().empty());

  config.habits.effects_at_once = 2;
  CHECK(calibrated().second.dampers_refused.find("the stick renders only two effects at a time") == 0);
  config.habits.effects_at_once = 0;
  config.habits.condition = ConditionLaw::last_set;
  CHECK(calibrated().second.dampers_refused == "the stick does not render the dampers of both axes at the same time");
}

TEST_CASE("motors of different strength: with the force of each axis, masses, springs and dampers are right") {
  EmulatedStickConfig config = config_of(StickFamily::openffboard);
  for (const double said : {15.0, 20.0}) {
    DeviceCalibration known = unmeasured_calibration(config);
    CalibrationBench bench(config, known);
    bench.stick.faults.constants.y = bench.stick.faults.conditions.y = 0.75;
    bench.calibrator.set_numbers(dvec2(0.14), {20.0, said});
    for (const auto step : {&Calibrator::measure_polarity, &Calibrator::measure_timing, &Calibrator::measure_handle,
                            &Calibrator::measure_springs})
      std::invoke(step, bench.calibrator);
    const LeverAxisCalibration& shift = bench.calibrator.calibration().shift;
    const double error = said / 15.0;  // negative control
    CHECK(bench.calibrator.calibration().select.full_force == 20.0);
    CHECK(shift.full_force == said);
    CHECK(shift.handle.mass == doctest::Approx(error * config.lever.axis_y.mass).epsilon(0.05));
    CHECK(shift.spring_stiffness == doctest::Approx(error * 300.0).epsilon(0.05));
    CHECK(shift.damper_strength ==
          doctest::Approx(error * 2.0 * sampled_damper(config.lever.axis_y, 7.5)).epsilon(0.05));
  }
}

TEST_CASE("a stick that centres itself unless a spring plays gets one without a force, and its handle is right") {
  EmulatedStickConfig config = config_of(StickFamily::openffboard);
  config.habits.auto_centre = AutoCentre::until_spring;
  CalibrationBench bench(config, unmeasured_calibration(config));
  bench.calibrator.measure_polarity();
  CHECK(bench.calibrator.measure_handle().find("a spring without a force plays") != std::string::npos);
  CHECK(bench.calibrator.calibration().holds_spring);
  CHECK(std::abs(bench.calibrator.calibration().select.handle.stiffness - config.lever.axis_x.stiffness) < 4.0);
}

TEST_CASE("a stick that keeps the sign of a force that plays is driven by directions; one that keeps all is refused") {
  EmulatedStickConfig config = config_of(StickFamily::adapt_ffb_joy);
  config.habits.constant_update = ConstantUpdate::strength;
  CalibrationBench bench(config, unmeasured_calibration(config));
  bench.calibrator.measure_polarity();
  CHECK(bench.calibrator.calibration().style.signs == SignStyle::direction);
  CHECK(bench.strongest <= kCautiousForce * 20.0 * 1.01);

  config.habits.constant_update = ConstantUpdate::nothing;
  CalibrationBench fixed(config, unmeasured_calibration(config));
  CHECK(refusal([&] { fixed.calibrator.measure_polarity(); }) ==
        "the stick does not change a force while it acts, and a lever needs forces that change");
  CHECK(fixed.strongest <= kCautiousForce * 20.0 * 1.01);
}

TEST_CASE("the measured intervals are those of the stick and its ticks") {
  for (const double interval : {0.002, 0.004, 0.008}) {
    EmulatedStickConfig config = config_of(StickFamily::vjoy);
    config.input_interval = interval;
    DeviceCalibration known = unmeasured_calibration(config);
    known.select.constant_sign = -1;
    known.shift.constant_sign = 1;
    CalibrationBench bench(config, known);
    bench.period_ns = 2'000'000;
    bench.stream.tick_ns = 2'000'000;
    bench.calibrator.measure_timing();
    CHECK(bench.calibrator.calibration().timing.input_interval == doctest::Approx(interval).epsilon(0.01));
    CHECK(bench.calibrator.calibration().timing.output_interval == doctest::Approx(0.002).epsilon(0.03));
  }
}

TEST_CASE("missing steps are listed in order, and finished steps are not listed") {
  using enum CalibrationStep;
  DeviceCalibration known;
  CHECK(missing_steps(known, true, true) == std::vector{range, numbers, polarity, timing, strength, handle, springs});
  CHECK(missing_steps(known, false, false) == std::vector{range, numbers, polarity, timing, strength, handle});
  known = calibration_of(config_of(StickFamily::vjoy));
  CHECK(missing_steps(known, true, true).empty());
  known.timing = {};
  known.shift.spring_dead_band = 0.0;
  CHECK(missing_steps(known, true, true) == std::vector{timing, springs});
  known = unmeasured_calibration(config_of(StickFamily::vjoy));
  CHECK(missing_steps(known, true, true) == std::vector{polarity, timing, handle, springs});
}

// The hand adds 1.6 times the handle's mass and over thirty times its stiffness. Walls tuned for handle and hand
// together would vibrate when the hand lets go.
TEST_CASE("the handle is not measured while a hand holds the lever") {
  EmulatedStickConfig config = config_of(StickFamily::openffboard);
  DeviceCalibration known = calibration_of(config);
  known.select.handle = known.shift.handle = {};
  config.lever.hand = kGripHand;
  CalibrationBench bench(config, known);
  CHECK(refusal([&] { bench.calibrator.measure_handle(); }).find("too stiff for the motors. Take your hands off") !=
        std::string::npos);
  CHECK_FALSE(bench.calibrator.calibration().has_handle());
}

// The nudge: for 50 ms during a pulse, a hand pulls with 400 N/m towards a point 8 mm away. A single fit to all four
// pulses would give 1.68, 1.36 and 1.76 times the true damping for three of the nudge times below, and would be refused
// for the other times.
TEST_CASE("a nudge during one of the pulses is outvoted by the other pulses") {
  const EmulatedStickConfig config = config_of(StickFamily::openffboard);
  const DeviceCalibration truth = calibration_of(config);
  const double damper = 2.0 * sampled_damper(truth.select.handle, 10.0);
  const auto nudged = [&](double from, const std::function<void(Calibrator&)>& measure) {
    DeviceCalibration known = truth;
    known.select.damper_strength = known.shift.damper_strength = 0.0;
    CalibrationBench bench(config, known);
    bench.every_tick = [&bench, from] {
      const bool now = bench.time() > from && bench.time() < from + 0.05;
      bench.person.target_position = now ? std::function<dvec2()>([] { return dvec2(0.008); }) : nullptr;
    };
    CHECK(refusal([&] { measure(bench.calibrator); }) == "");
    CHECK(bench.time() > from);
    return bench.calibrator.calibration();
  };
  for (const double from : {9.8, 11.4, 13.2, 14.9, 18.8, 21.7}) {
    CAPTURE(from);
    const DeviceCalibration found = nudged(from, [](Calibrator& calibrator) { calibrator.measure_springs(); });
    CHECK(found.select.damper_strength == doctest::Approx(damper).epsilon(0.1));
    CHECK(found.shift.damper_strength == doctest::Approx(damper).epsilon(0.1));
  }
  for (double from = 0.2; from < 6.0; from += 0.7) {
    CAPTURE(from);
    const DeviceCalibration found = nudged(from, [](Calibrator& calibrator) { calibrator.measure_handle(); });
    CHECK(found.select.handle.mass == doctest::Approx(truth.select.handle.mass).epsilon(0.1));
    CHECK(found.shift.handle.mass == doctest::Approx(truth.shift.handle.mass).epsilon(0.1));
  }
}

TEST_CASE("resumed: the remaining steps need only what is in the file") {
  const EmulatedStickConfig config = config_of(StickFamily::openffboard);
  CalibrationBench bench(config, unmeasured_calibration(config));
  bench.calibrator.measure_polarity();
  const DeviceCalibration half = bench.calibrator.calibration();
  CalibrationBench again(config, half);
  again.calibrator.measure_timing();
  again.calibrator.measure_springs();
  CHECK(missing_steps(again.calibrator.calibration(), true, true) == std::vector{CalibrationStep::handle});
}

TEST_CASE("invalid input while a person moves the lever is refused and changes nothing") {
  const EmulatedStickConfig config = config_of(StickFamily::openffboard);
  CalibrationBench bench(config);
  Calibrator& calibrator = bench.calibrator;
  CHECK(refusal([&] { calibrator.measure_range(2.0); }) == "the lever's axes are not known yet. Find the axes first");

  bench.move_along([](double t) { return dvec2(t < 0.6 ? 0.0 : 0.020, 0.0); });
  CHECK(refusal([&] { calibrator.find_axis(true, 2.0); }).find("no axis moved by more than 1") == 0);
  bench.move_along([](double t) { return dvec2(t < 0.6 ? 0.0 : 0.060); });
  CHECK(refusal([&] { calibrator.find_axis(true, 2.0); }) == "two axes moved together. Push the lever straight");
  bench.move_along([](double t) { return dvec2(t < 0.6 ? 0.0 : 0.060, 0.0); });
  CHECK(calibrator.find_axis(true, 2.0) == "pushing right moves axis 1 of the stick up");
  bench.move_along([](double t) { return dvec2(t < 0.6 ? 0.0 : 0.060, 0.0); });
  CHECK(refusal([&] { calibrator.find_axis(false, 2.0); }) ==
        "the same axis moved as when you pushed to the right. Push the lever forward");
  bench.move_along([](double t) { return dvec2(0.0, t < 0.6 ? 0.0 : 0.060); });
  CHECK(calibrator.find_axis(false, 2.0) == "pushing forward moves axis 2 of the stick down");

  const auto lets_go_after = [&](double seconds) {
    bench.every_tick = [&, seconds, begin = bench.time()] {
      if (bench.time() - begin > seconds) bench.hands_off();
    };
  };
  bench.move_along([](double t) { return 0.010 * dvec2(std::cos(3.0 * t), std::sin(3.0 * t)); });
  lets_go_after(4.0);
  CHECK(refusal([&] { calibrator.measure_range(5.0); }).find("of its range. Move the lever to all its stops") !=
        std::string::npos);
  bench.move_along([](double t) { return dvec2(0.06 * std::sin(3.0 * t)); });
  lets_go_after(4.0);
  CHECK(refusal([&] { calibrator.measure_range(5.0); }).find("the two axes moved together") == 0);
  // After 3 s the user holds the lever on the right, so it does not return to its rest position.
  bench.move_along(
      [](double t) { return t < 3.0 ? 0.09 * dvec2(std::cos(3.0 * t), std::sin(3.0 * t)) : dvec2(0.055, 0.0); });
  bench.every_tick = nullptr;
  CHECK(refusal([&] { calibrator.measure_range(5.0); }).find("select rests at 8") == 0);
  // The hand never releases the lever.
  bench.move_along([](double t) { return 0.09 * dvec2(std::cos(3.0 * t), std::sin(3.0 * t)); });
  CHECK(refusal([&] { calibrator.measure_range(5.0); }) ==
        "the lever does not come to rest. Take your hands off the lever");
  CHECK_FALSE(calibrator.calibration().has_stops());

  CHECK(refusal([&] {
          calibrator.set_numbers({0.01, 0.1}, dvec2(20.0));
        }) == "a travel of 0.01 m is not possible; it must be between 0.02 and 0.5 m");
  CHECK(refusal([&] {
          calibrator.set_numbers(dvec2(0.1), {20.0, 500.0});
        }) == "a full force of 500 N is not possible; it must be between 0.5 and 100 N");
  CHECK(refusal([&] { calibrator.set_numbers({0.1, std::nan("")}, dvec2(20.0)); }).find("a travel of nan m") == 0);
  CHECK_FALSE(calibrator.calibration().has_force());
}

TEST_CASE("a range is measured despite readings that jump") {
  CalibrationBench bench(config_of(StickFamily::vjoy));
  bench.find_axes();
  bench.stick.faults.jump = true;
  // The user moves the lever in a circle that does not reach the stops.
  bench.move_along([](double t) { return 0.050 * dvec2(std::cos(3.0 * t), std::sin(3.0 * t)); });
  bench.every_tick = [&, begin = bench.time()] {
    if (bench.time() - begin > 4.0) bench.hands_off();
    if (bench.time() - begin > 3.9) bench.stick.faults.jump = false;
  };
  bench.calibrator.measure_range(5.0);
  // The hand's circle has a radius of 50 mm. The lever's spring pulls inwards, so the lever's circle has about 48 mm.
  // The stop is at 70 mm; a jump would add 42 mm.
  CHECK(counts_of(bench.calibrator.calibration().select) == doctest::Approx(32767.0 * 0.048 / 0.07).epsilon(0.03));
}

TEST_CASE(
    "polarity: refused where nothing moves, where a hand holds it, where it is moved by a hand, before the range") {
  const EmulatedStickConfig config = config_of(StickFamily::vjoy);
  CalibrationBench unknown(config);
  CHECK(refusal([&] { unknown.calibrator.measure_polarity(); }) ==
        "the lever's stops are not known yet. Measure the range first");

  EmulatedStickConfig stiff = config;
  stiff.lever.coulomb_friction = 3.0;  // [N] more than 10 % of the full force of 20 N
  CalibrationBench stuck(stiff, unmeasured_calibration(stiff));
  CHECK(refusal([&] {
          stuck.calibrator.measure_polarity();
        }).find("the lever does not move with 10 % of the full force") == 0);
  CHECK(stuck.strongest <= 2.0 + 1e-9);

  EmulatedStickConfig in_hand = config;
  in_hand.lever.hand = kArmHand;
  in_hand.lever.hand.stiffness = 5000.0;
  CalibrationBench held(in_hand, unmeasured_calibration(in_hand));
  CHECK(refusal([&] { held.calibrator.measure_polarity(); }).find("the lever does not move") == 0);

  CalibrationBench pushed(config, unmeasured_calibration(config));
  pushed.every_tick = [&] {  // a hand pushes to the right whenever the motors push
    if (glm::length(pushed.stick.force()) > 0.1)
      pushed.person.target_position = [] { return dvec2(0.03, 0.0); };
    else
      pushed.hands_off();
  };
  CHECK(refusal([&] { pushed.calibrator.measure_polarity(); }) ==
        "select did not move in both directions. Take your hands off the lever");

  CalibrationBench shaken(config, unmeasured_calibration(config));
  shaken.move_along([](double t) { return 0.02 * dvec2(std::sin(9.0 * t), 0.0); });
  CHECK(refusal([&] { shaken.calibrator.measure_polarity(); }) ==
        "the lever does not come to rest. Take your hands off the lever");
  for (CalibrationBench* bench : {&stuck, &held, &pushed, &shaken}) {
    CHECK_FALSE(bench->calibrator.calibration().has_polarity());
    bench->tick();
    bench->tick();
    CHECK(bench->stick.force() == dvec2(0.0));
  }
}

TEST_CASE("a wrong axis, a wrong polarity, or a disconnected stick is refused") {
  const EmulatedStickConfig config = config_of(StickFamily::sidewinder);
  DeviceCalibration known = unmeasured_calibration(config);
  known.select.usage = 0x32;
  CalibrationBench other(config, known);
  CHECK_FALSE(refusal([&] { other.calibrator.measure_polarity(); }).empty());

  known = unmeasured_calibration(config);
  known.select.constant_sign = 1;  // correct is -1
  known.shift.constant_sign = 1;
  CalibrationBench wrong(config, known);
  CHECK(refusal([&] { wrong.calibrator.measure_timing(); }) ==
        "select moves against the measured force direction. Measure the force direction again");

  CalibrationBench disconnected(config, unmeasured_calibration(config));
  disconnected.every_tick = [&] {
    if (disconnected.now_ns == 700'000'000) disconnected.prepare();  // unplugged and reconnected
  };
  CHECK(refusal([&] { disconnected.calibrator.measure_polarity(); }) ==
        "the stick was disconnected during the measurement");

  CalibrationBench silent(config, unmeasured_calibration(config));
  silent.every_tick = [&] { silent.stick.faults.silent = silent.time() > 0.1; };
  CHECK_THROWS(silent.calibrator.measure_polarity());
}

TEST_CASE("buttons: the pressed one counts, not a held one, and none is assigned twice") {
  CalibrationBench bench(config_of(StickFamily::sidewinder));
  const auto press = [&](std::uint64_t before, std::uint64_t after) {
    bench.stick.held_buttons = before;
    bench.tick();
    bench.every_tick = [&bench, after, begin = bench.time()] {
      if (bench.time() - begin > 0.5) bench.stick.held_buttons = after;
    };
  };
  press(0b00001, 0b01001);
  CHECK(bench.calibrator.find_button(LeverButton::stop, 2.0) == "button 4");
  CHECK(bench.calibrator.calibration().buttons.stop == 4);
  press(0, 0b1000);
  CHECK(refusal([&] { bench.calibrator.find_button(LeverButton::lift, 2.0); }) == "button 4 is already assigned");
  press(0, 0b11000);
  CHECK(refusal([&] { bench.calibrator.find_button(LeverButton::lift, 2.0); }) ==
        "more than one button was pressed at once");
  press(0b1, 0b1);
  CHECK(refusal([&] { bench.calibrator.find_button(LeverButton::lift, 2.0); }) == "no button was pressed");
  press(0, 0b1000);
  CHECK(bench.calibrator.find_button(LeverButton::stop, 2.0) == "button 4");
}
