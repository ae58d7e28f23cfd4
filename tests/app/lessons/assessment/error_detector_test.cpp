// Tests that each driving error is reported once, with its value, in a drive that contains the error, and never in a
// clean drive.
#include "app/lessons/assessment/error_detector.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "app/lessons/assessment/clutch_release.h"
#include "tests/app/lessons/assessment/constructed_shift.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

using Modification = std::function<void(DriveSample&, double)>;

struct DetectorSetup {
  int wanted = kNeutralGear;
  ShiftBand band;
};

std::vector<DrivingError> detected_errors(const ConstructedShift& shift, const DetectorSetup& watched = {}) {
  ShiftMeter meter(shift.car, shift.gate);
  ErrorDetector watch(shift.car, shift.gate, watched.band);
  for (const DriveSample& s : shift.samples()) {
    const auto record = meter.add(s);
    watch.add(s, watched.wanted, meter.is_open());
    if (record) watch.check_shift(*record);
  }
  watch.finish();
  return watch.drain_errors();
}

// The errors detected in the constructed shift after `modify` was applied to its samples.
std::vector<DrivingError> in_shift(Modification modify, const DetectorSetup& watched = {}, double to = 2.0) {
  ConstructedShift shift;
  shift.modify = std::move(modify);
  shift.to = to;
  return detected_errors(shift, watched);
}

// The errors detected in ten seconds of driving in second gear at 12 m/s without a shift, after `modify` was applied to
// the samples.
std::vector<DrivingError> in_second(Modification modify, double to = 10.0) {
  ConstructedShift shift;
  shift.to = to;
  shift.modify = [&shift, &modify](DriveSample& s, double t) {
    shift.place(s, rest_position(shift.gate, 2));
    s.car.gear = 2;
    s.car.pedals.throttle = s.car.pedals.clutch = 0.0;
    s.car.clutch_locked = true;
    s.car.engine_speed = shift.engine(2);
    modify(s, t);
  };
  return detected_errors(shift);
}

bool within(double t, double a, double b) {
  return t >= a - 1e-9 && t <= b + 1e-9;
}

// Checks that exactly one error was reported, and that its kind is `kind`.
DrivingError only(const std::vector<DrivingError>& errors, ErrorKind kind) {
  std::string raised;
  for (const DrivingError& error : errors) raised += std::string(to_string(error.kind)) + " ";
  CAPTURE(raised);
  REQUIRE(errors.size() == 1);
  CHECK(to_string(errors[0].kind) == to_string(kind));
  return errors[0];
}

double rpm(double value) {
  return value * 6.283185307179586 / 60.0;
}

}  // namespace

TEST_CASE("a clean shift and a clean drive have no error, at any sample period") {
  for (const double period : {0.001, 0.0042, 0.011}) {
    ConstructedShift shift;
    shift.period = period;
    CHECK(detected_errors(shift).empty());
  }
  CHECK(in_second([](DriveSample&, double) {}).empty());
}

TEST_CASE("stall: the engine dies with the ignition on; the value is the speed before it fell") {
  const auto dies = [](DriveSample& s, double t) {
    s.car.engine_speed = t < 4.0 ? 90.0 : t < 4.2 ? 90.0 - 450.0 * (t - 4.0) : 0.0;
    s.car.running = s.car.engine_speed > 37.0;
    s.car.road_speed = 0.0;
  };
  const DrivingError stall = only(in_second(dies), ErrorKind::stall);
  CHECK(stall.engine_speed == doctest::Approx(90.0));
  CHECK(stall.severity == Severity::severe);
  CHECK(stall.time == doctest::Approx(104.118).epsilon(1e-4));
  // Switching an engine off is not a stall, and an engine that was never started cannot stall.
  CHECK(in_second([&](DriveSample& s, double t) { dies(s, t), s.car.ignition = t < 4.0; }).empty());
  CHECK(in_second([](DriveSample& s, double) { s.car.running = false, s.car.stalled = true; }).empty());
}

TEST_CASE(
    "an engine that fires under the starter and dies when the key is released has not stalled: it never started") {
  const auto cranks = [](double max_speed) {
    return in_second([=](DriveSample& s, double t) {
      s.car.road_speed = 0.0;
      s.car.engine_speed = t < 1.0 ? 0.0 : t < 1.1 ? max_speed : 0.0;
      s.car.running = s.car.engine_speed > 15.0;
      if (t > 4.0) s.car.engine_speed = 90.0, s.car.running = true;  // the engine starts
      if (t > 5.0) s.car.engine_speed = 0.0, s.car.running = false;  // the engine stalls
      if (t > 6.0 && t < 6.1) s.car.engine_speed = 30.0, s.car.running = true;
    });
  };
  // With a peak of 33 rad/s at 1 s, below the stall speed of 37 rad/s, the engine has not started. So its only stall is
  // at 5 s (recorded as 105 s). With a peak of 60 rad/s the engine has started, so it stalls twice.
  CHECK(only(cranks(33.0), ErrorKind::stall).time == doctest::Approx(105.0).epsilon(1e-4));
  CHECK(cranks(60.0).size() == 2);
}

TEST_CASE("over-rev: one error even if the speed oscillates about the red line, and more severe far above it") {
  const double red = ConstructedShift().car.engine.red_line;
  const DrivingError error = only(in_second([&](DriveSample& s, double t) {
                                    if (within(t, 2.0, 5.0))
                                      s.car.engine_speed = red * (1.005 + 0.01 * std::sin(40.0 * t));
                                  }),
                                  ErrorKind::over_rev);
  CHECK(error.engine_speed == doctest::Approx(1.015 * red).epsilon(1e-4));
  CHECK(error.severity == Severity::severe);
  const auto money = in_second([&](DriveSample& s, double t) { s.car.engine_speed = t > 3.0 ? 1.14 * red : 200.0; });
  CHECK(only(money, ErrorKind::over_rev).severity == Severity::very_severe);
  CHECK(in_second([&](DriveSample& s, double) { s.car.engine_speed = 0.99 * red; }).empty());
}

TEST_CASE("lugging: load for a second at a speed at which the engine cannot carry it") {
  const auto labours = [](double seconds, double load) {
    return in_second([=](DriveSample& s, double t) {
      s.car.engine_speed = 100.0;
      s.car.engine_load = within(t, 2.0, 2.0 + seconds) ? load : 0.2;
    });
  };
  CHECK(only(labours(2.5, 0.9), ErrorKind::lugging).duration == doctest::Approx(2.5).epsilon(0.01));
  CHECK(labours(0.9, 0.9).empty());
  CHECK(labours(2.5, 0.6).empty());
}

TEST_CASE(
    "clutch dump: fast release with much heat; neither a slow release with that heat, nor a fast one without heat") {
  const auto launch = [](double seconds, double power) {
    return in_second([=](DriveSample& s, double t) {
      s.car.road_speed = 0.0;
      s.car.pedals.clutch = ConstructedShift::line(t, 1.0, 1.0, 1.0 + seconds, 0.0);
      s.car.clutch_locked = t > 1.0 + seconds + 0.1;
      s.car.slip_power = within(t, 1.0, 1.0 + seconds + 0.1) ? power : 0.0;
    });
  };
  const DrivingError dump = only(launch(0.1, 20e3), ErrorKind::clutch_dump);
  CHECK(dump.slip_power == doctest::Approx(20e3));
  CHECK(dump.severity == Severity::severe);
  CHECK(only(launch(0.1, 90e3), ErrorKind::clutch_dump).severity == Severity::very_severe);
  CHECK(launch(1.5, 20e3).empty());
  CHECK(launch(0.1, 8e3).empty());
}

// This car weighs 1238.8 kg (1251.2 kg with the inertia of rotating parts). In first gear its engine turns 45.5 rad per
// metre, so at `shift_high` (262 rad/s) its speed is 5.76 m/s.
TEST_CASE(
    "clutch burn: more heat than a launch at shift_high makes, however distributed; not in addition to dump or stall") {
  const auto launch = [](double power, double seconds, bool stalls = false) {
    return in_second([=](DriveSample& s, double t) {
      const ConstructedShift plain;
      plain.place(s, rest_position(plain.gate, 1));
      s.car.gear = 1;
      s.car.road_speed = 1.0;
      s.car.engine_speed = 200.0;
      s.car.pedals.clutch = t < 1.0 ? 1.0 : ConstructedShift::line(t, 1.0, 0.75, 1.0 + seconds, 0.0);
      s.car.clutch_locked = t > 1.0 + seconds;
      s.car.slip_power = within(t, 1.0, 1.0 + seconds) ? power : 0.0;
      s.car.running = !stalls || t < 1.5;
    });
  };
  CHECK(burn_limit(test_car(), 1) == doctest::Approx(0.5 * 1251.2 * 5.76 * 5.76).epsilon(0.005));
  CHECK(burn_limit(test_car(), kReverseGear) > burn_limit(test_car(), 1));
  const double limit = burn_limit(test_car(), 1);
  CHECK(launch(0.95 * limit / 2.0, 2.0).empty());
  const DrivingError burn = only(launch(1.05 * limit / 2.0, 2.0), ErrorKind::clutch_burn);
  // Heat counts only after the pedal has come up by a few hundredths of its travel, so the value is slightly lower.
  CHECK(burn.heat == doctest::Approx(1.05 * limit).epsilon(0.04));
  CHECK(burn.severity == Severity::minor);
  only(launch(1.05 * limit, 1.0), ErrorKind::clutch_burn);
  CHECK(only(launch(2.1 * limit / 3.0, 3.0), ErrorKind::clutch_burn).severity == Severity::severe);
  only(launch(2.0 * limit / 0.1, 0.1), ErrorKind::clutch_dump);
  only(launch(1.05 * limit / 2.0, 2.0, true), ErrorKind::stall);
}

TEST_CASE("clutch burn: one release is one error, also if the clutch begins to smell in it or still slips long after") {
  const double limit = burn_limit(test_car(), 1);
  // From 1 s the clutch slips for `seconds` with this fraction of the limit in 5 s. It smells from `smells` on.
  const auto slip = [&](double fraction, double seconds, double smells) {
    const auto modify = [=](DriveSample& s, double t) {
      const ConstructedShift plain;
      plain.place(s, rest_position(plain.gate, 1));
      s.car.gear = 1;
      s.car.road_speed = 0.0;
      s.car.engine_speed = 200.0;
      s.car.pedals.clutch = t < 1.0 ? 1.0 : t < 1.0 + seconds ? 0.6 : 0.0;
      s.car.clutch_locked = t > 1.0 + seconds;
      s.car.slip_power = within(t, 1.0, 1.0 + seconds) ? fraction * limit / 5.0 : 0.0;
      s.car.slip_energy = 1e6;  // of the whole drive
      s.car.clutch_smells = t >= smells;
    };
    return in_second(modify, 14.0);
  };
  only(slip(1.5, 4.0, 100.0), ErrorKind::clutch_burn);
  // Judged after 5 s, and it smells 3 s later.
  CHECK(only(slip(1.2, 10.0, 9.0), ErrorKind::clutch_burn).heat == doctest::Approx(1.2 * limit).epsilon(0.01));
  // It smells in the release, which is graver when it ends.
  CHECK(only(slip(2.5, 4.9, 3.0), ErrorKind::clutch_burn).time == doctest::Approx(103.0));
  // A hold that makes little heat: only the smell is an error, with the heat of this hold.
  const DrivingError smell = only(slip(0.9, 10.0, 9.0), ErrorKind::clutch_burn);
  CHECK(smell.time == doctest::Approx(109.0));
  CHECK(smell.heat == doctest::Approx(0.9 * limit * 8.0 / 5.0).epsilon(0.01));
  CHECK(smell.severity == Severity::minor);
  CHECK(slip(0.9, 10.0, 100.0).empty());
}

TEST_CASE("jerk: from the engaging clutch, not from the brake, nor in addition to the dump or stall that caused it") {
  const auto jerks = [](double brake, double power, bool stalls = false) {
    return in_second([=](DriveSample& s, double t) {
      s.car.road_speed = 2.0;
      s.car.pedals.brake = brake;
      s.car.pedals.clutch = ConstructedShift::line(t, 1.0, 1.0, 1.1, 0.0);
      s.car.clutch_locked = t > 1.3;
      s.car.acceleration = t > 1.3 ? 3.0 : 0.0;
      s.car.running = !stalls || t < 1.25;
      s.car.slip_power = within(t, 1.0, 1.3) ? power : 0.0;
    });
  };
  CHECK(only(jerks(0.0, 0.0), ErrorKind::jerk).jerk == doctest::Approx(3.0 * 42.97).epsilon(0.01));
  CHECK(jerks(0.5, 0.0).empty());
  only(jerks(0.0, 20e3), ErrorKind::clutch_dump);
  only(jerks(0.0, 0.0, true), ErrorKind::stall);
}

// If the acceleration steps by a, the filter's jerk has a peak of w exp(-pi/4) a = 42.97 a, where w is the filter's
// cut-off angular frequency. This car weighs 1238.8 kg and its clutch transmits 240 N m. In first gear its engine turns
// 3.45 * 4 / 0.303 = 45.5 rad per metre, so a clutch that engages at once gives 240 * 45.5 / (1238.8 + 0.006 * 45.5^2)
// = 8.73 m/s^2. In fourth gear it gives about a quarter of that acceleration. Half of the jerk in fourth gear is about
// 50 m/s^3, so the minimum of 110 m/s^3 applies.
TEST_CASE("jerk limit: half of the jerk of a clutch that engages at once in that gear, and at least 110 m/s^3") {
  const auto hold = [](int gear, double step) {
    return in_second([=](DriveSample& s, double t) {
      const ConstructedShift plain;
      plain.place(s, rest_position(plain.gate, gear));
      s.car.gear = gear;
      s.car.road_speed = 2.0;
      s.car.pedals.clutch = ConstructedShift::line(t, 1.0, 1.0, 2.0, 0.0);
      s.car.clutch_locked = t > 1.6;
      s.car.acceleration = t > 1.6 ? step : 0.0;
    });
  };
  CHECK(jerk_limit(test_car(), 1) == doctest::Approx(0.5 * 42.97 * 8.73).epsilon(1e-3));
  CHECK(jerk_limit(test_car(), 4) == 110.0);
  CHECK(hold(1, 4.3).empty());
  CHECK(only(hold(1, 4.5), ErrorKind::jerk).severity == Severity::minor);
  CHECK(only(hold(1, 9.0), ErrorKind::jerk).severity == Severity::severe);
  CHECK(hold(4, 2.5).empty());
  CHECK(only(hold(4, 2.6), ErrorKind::jerk).jerk == doctest::Approx(2.6 * 42.97).epsilon(0.01));
  CHECK(only(hold(4, 5.2), ErrorKind::jerk).severity == Severity::severe);
}

TEST_CASE("clutch early or late: the value is the time, and small times are no error") {
  const auto shift = [](double down, double up) {
    return in_shift([=](DriveSample& s, double t) {
      s.car.pedals.clutch = within(t, down, up) ? 1.0 : 0.0;
      s.car.clutch_locked = t < down || t > up + 0.3;
    });
  };
  const DrivingError late = only(shift(0.30, 0.6), ErrorKind::clutch_late);
  CHECK(late.too_early_by == doctest::Approx(0.30 - 0.2093).epsilon(0.03));
  CHECK(late.shift == 0);
  const DrivingError early = only(shift(0.1, 0.4), ErrorKind::clutch_early);
  CHECK(early.too_early_by == doctest::Approx(0.0907 - 0.001).epsilon(0.03));
  CHECK(error_sentence(early) == "The clutch came up 0.09 s before the gear was in.");
  CHECK(shift(0.24, 0.47).empty());
}

TEST_CASE("no clutch: a gear that went in without it is reported even with matched revs; without errors that follow") {
  const auto shift = [](double rpm_off, bool goes_in) {
    return in_shift(
        [=](DriveSample& s, double t) {
          const ConstructedShift plain;
          s.car.pedals.clutch = 0.0;
          s.car.clutch_locked = true;
          s.car.engine_speed = plain.engine(t < 0.3 ? 2 : 3) + (s.car.gear == 3 || t < 0.3 ? 0.0 : rpm(rpm_off));
          if (within(t, 0.44, 0.48)) s.car.sync = SyncPhase::synchronising;
          if (!goes_in && t > 0.44) s.car.gear = kNeutralGear, s.car.sync = SyncPhase::synchronising;
          if (!goes_in && t > 0.8) s.car.sync = SyncPhase::free, plain.place(s, {0.0, 0.0});
        },
        {}, 4.0);
  };
  const DrivingError matched = only(shift(60.0, true), ErrorKind::no_clutch);
  CHECK(matched.speed_difference == doctest::Approx(rpm(60.0)).epsilon(1e-6));
  CHECK(matched.severity == Severity::minor);
  const DrivingError error = only(shift(400.0, true), ErrorKind::no_clutch);
  CHECK(error.speed_difference == doctest::Approx(rpm(400.0)).epsilon(1e-6));
  only(shift(400.0, false), ErrorKind::no_clutch);
  CHECK(shift(60.0, false).size() == 1);  // only a missed gear: with matched revs, a lever on the dogs is no error
  only(shift(60.0, false), ErrorKind::missed_shift);
}

TEST_CASE("riding the clutch: a foot that rests on it in gear, but not briefly, while stopping or while creeping") {
  const auto rides = [](double pedal, double seconds, double speed, double brake) {
    return in_second([=](DriveSample& s, double t) {
      s.car.road_speed = speed;
      s.car.pedals.brake = brake;
      s.car.pedals.clutch = within(t, 2.0, 2.0 + seconds) ? pedal : 0.0;
    });
  };
  CHECK(only(rides(0.2, 4.0, 12.0, 0.0), ErrorKind::riding_clutch).duration == doctest::Approx(4.0).epsilon(0.01));
  CHECK(rides(0.2, 1.9, 12.0, 0.0).empty());
  CHECK(rides(0.3, 4.0, 12.0, 0.3).empty());
  CHECK(rides(0.3, 4.0, 3.0, 0.0).empty());
}

TEST_CASE("coasting: rolling in neutral or with the clutch down, but not during a shift or on the way to a stop") {
  // The car rolls from 2 s on. In second gear, a speed of 12 m/s needs 2950 rpm and 4.5 m/s needs 1106 rpm; `lug_below`
  // is 1146 rpm.
  struct Roll {
    double seconds = 5.0, speed = 12.0, brake = 0.0;
    bool neutral = false, running = true;
  };
  const auto rolls = [](const Roll& roll) {
    return in_second(
        [=](DriveSample& s, double t) {
          const bool on = within(t, 2.0, 2.0 + roll.seconds);
          s.car.road_speed = roll.speed;
          s.car.pedals.brake = on ? roll.brake : 0.0;
          s.car.running = roll.running;
          s.car.engine_speed = 200.0;
          if (!on) return;
          s.car.clutch_locked = false;
          s.car.pedals.clutch = roll.neutral && t > 2.3 ? 0.0 : 1.0;
          if (roll.neutral && t > 2.1) s.car.gear = kNeutralGear, ConstructedShift().place(s, {0.0, 0.0});
        },
        20.0);
  };
  const DrivingError down = only(rolls({}), ErrorKind::coasting);
  CHECK(down.duration == doctest::Approx(5.0).epsilon(0.01));
  CHECK(down.time == doctest::Approx(102.0).epsilon(1e-4));
  CHECK(rolls({2.9}).empty());
  CHECK(rolls({5.0, 3.9}).empty());
  CHECK(rolls({5.0, 4.5, 0.1}).empty());   // brakes, and is too slow for second gear
  CHECK(rolls({5.0, 12.0, 0.6}).empty());  // brakes hard, so the car is about to stop
  CHECK(only(rolls({5.0, 4.5}), ErrorKind::coasting).severity == Severity::minor);
  CHECK(only(rolls({5.0, 12.0, 0.1}), ErrorKind::coasting).duration == doctest::Approx(5.0).epsilon(0.01));
  CHECK(rolls({5.0, 12.0, 0.0, false, false}).empty());  // not coasting, because the engine is off
  // In neutral with the clutch up, the shift counts as abandoned after 2 s. The car coasts from then on, and after 6 s
  // of coasting the error is reported.
  const auto errors = rolls({14.0, 12.0, 0.0, true});
  const auto coasting =
      std::find_if(errors.begin(), errors.end(), [](const DrivingError& f) { return f.kind == ErrorKind::coasting; });
  REQUIRE(coasting != errors.end());
  CHECK(coasting->duration == doctest::Approx(6.0).epsilon(0.01));
  CHECK(coasting->time == doctest::Approx(104.28).epsilon(1e-3));
  // A long shift is reported as too slow and not as coasting.
  only(in_shift(
           [](DriveSample& s, double t) {
             s.car.pedals.clutch = within(t, 0.05, 5.0) ? 1.0 : 0.0;
             s.car.clutch_locked = t < 0.05 || t > 5.1;
           },
           {}, 7.0),
       ErrorKind::too_slow);
}

TEST_CASE(
    "early downshift: judged by the engine speed that the lower gear needs, against the lesson's or the car's band") {
  // A rev-matched shift from third to second gear: the constructed shift, played backwards. `asks` [rad/s] is the
  // engine speed that second gear needs.
  const auto lowers = [](double asks, ShiftBand band = {}) {
    ConstructedShift down;
    down.modify = [=](DriveSample& s, double t) {
      const ConstructedShift plain;
      const double second = shaft_per_road(plain.car, 2), third = shaft_per_road(plain.car, 3);
      const DriveSample mirrored = plain.at(0.7 - t, s.car.gear == 0 ? 3 : s.car.gear);
      s.lever.lever = s.lever.proxy = mirrored.lever.proxy;
      s.lever.slot = mirrored.lever.slot;
      s.car.gear = t < 0.25 ? 3 : t < 0.49 ? 0 : 2;
      s.car.road_speed = asks / second;
      s.car.engine_speed = s.car.road_speed * (t < 0.3 ? third : second);
    };
    return detected_errors(down, {0, band});
  };
  const double max_speed = 1.2 * test_car().engine.shift_high;
  const DrivingError early = only(lowers(1.01 * max_speed), ErrorKind::early_downshift);
  CHECK(early.engine_speed == doctest::Approx(1.01 * max_speed));
  CHECK(early.shift == 0);
  CHECK(early.severity == Severity::minor);
  CHECK(error_sentence(early) == "You shifted down too early: the lower gear needs 3032 rpm at that speed.");
  CHECK(lowers(0.99 * max_speed).empty());
  CHECK(only(lowers(1.55 * max_speed), ErrorKind::early_downshift).severity == Severity::severe);
  CHECK(lowers(1.01 * max_speed, {0.0, 1.1 * max_speed}).empty());
  only(lowers(0.99 * max_speed, {0.0, 0.9 * max_speed}), ErrorKind::early_downshift);
}

TEST_CASE("riding the lever: a hand that pushes it for two seconds") {
  const auto leans = [](double force, double seconds) {
    return in_second([=](DriveSample& s, double t) {
      s.lever.f_h = {within(t, 2.0, 2.0 + seconds) ? force : 0.0, 0.0};
    });
  };
  CHECK(only(leans(5.0, 3.0), ErrorKind::riding_lever).duration == doctest::Approx(3.0).epsilon(0.01));
  CHECK(leans(2.5, 3.0).empty());
  CHECK(leans(5.0, 1.5).empty());
}

TEST_CASE("throttle in a shift: a flare; a blip that the lower gear needs is no error") {
  const auto flares = [](double rise) {
    return in_shift([=](DriveSample& s, double t) {
      if (within(t, 0.3, 0.6)) s.car.engine_speed = ConstructedShift().engine(2) + rise;
    });
  };
  CHECK(only(flares(60.0), ErrorKind::throttle_in_shift).rev_rise == doctest::Approx(60.0));
  CHECK(flares(30.0).empty());

  ConstructedShift down;  // the constructed shift, played backwards: from third to second gear
  down.modify = [](DriveSample& s, double t) {
    const ConstructedShift plain;
    DriveSample mirrored = plain.at(0.7 - t, s.car.gear == 0 ? 3 : s.car.gear);
    s.lever.lever = s.lever.proxy = mirrored.lever.proxy;
    s.lever.slot = mirrored.lever.slot;
    s.car.gear = t < 0.25 ? 3 : t < 0.49 ? 0 : 2;
    s.car.engine_speed = plain.engine(t < 0.3 ? 3 : 2);  // the revs match
  };
  CHECK(detected_errors(down).empty());

  // A blip that overshoots is a rev-matching error. If the driver never released the throttle before the blip, a
  // throttle error is reported too.
  const auto overshoots = [&](bool lifted) {
    ConstructedShift blip = down;
    blip.modify = [=, modify = down.modify](DriveSample& s, double t) {
      modify(s, t);
      const bool blips = within(t, 0.3, 0.67);
      if (blips) s.car.engine_speed += 180.0;
      s.car.pedals.throttle = lifted ? (within(t, 0.3, 0.5) ? 0.7 : 0.0) : (t < 0.5 ? 0.7 : 0.0);
    };
    return detected_errors(blip);
  };
  CHECK(only(overshoots(true), ErrorKind::rev_mismatch).speed_difference == doctest::Approx(180.0));
  std::vector<ErrorKind> kinds;
  for (const DrivingError& error : overshoots(false)) kinds.push_back(error.kind);
  CHECK(kinds == std::vector<ErrorKind>{ErrorKind::throttle_in_shift, ErrorKind::rev_mismatch});
}

TEST_CASE("rev mismatch: reported only above idle, and in addition to a flare, which is a different error") {
  const auto off = [](double by) {
    return in_shift([=](DriveSample& s, double t) {
      if (within(t, 0.55, 0.7)) s.car.engine_speed = ConstructedShift().engine(3) - by;
    });
  };
  CHECK(only(off(rpm(500.0)), ErrorKind::rev_mismatch).speed_difference == doctest::Approx(rpm(500.0)).epsilon(1e-6));
  CHECK(off(rpm(250.0)).empty());
  const auto howls = in_shift([](DriveSample& s, double t) {
    if (within(t, 0.3, 0.66)) s.car.engine_speed = ConstructedShift().engine(2) + 60.0;
  });
  REQUIRE(howls.size() == 2);
  CHECK(howls[0].kind == ErrorKind::throttle_in_shift);
  CHECK(howls[1].kind == ErrorKind::rev_mismatch);
}

TEST_CASE("grind: one error with its energy, even with gaps; a very short grind is no error") {
  const auto grinds = [](double power) {
    return in_shift([=](DriveSample& s, double t) {
      s.car.grinding = within(t, 0.42, 0.48) && std::lround(1e3 * t) % 4 != 0;
      s.car.grind_power = s.car.grinding ? power : 0.0;
    });
  };
  const DrivingError error = only(grinds(200.0), ErrorKind::grind);
  CHECK(error.heat == doctest::Approx(200.0 * 0.045).epsilon(0.02));
  CHECK(only(grinds(2000.0), ErrorKind::grind).severity == Severity::severe);
  CHECK(grinds(5.0).empty());
}

TEST_CASE("blocked: the lever pushes the ring for longer than synchronising needs, with the clutch down") {
  const auto pushes = [](double seconds, double force) {
    return in_shift(
        [=](DriveSample& s, double t) {
          const ConstructedShift plain;
          const double in = 0.44 + seconds;
          if (t > 0.44) plain.place(s, {0.0, t < in ? 0.020 : rest_position(plain.gate, 3).y});
          s.car.gear = t < 0.24 ? 2 : t < in ? kNeutralGear : 3;
          s.car.sync = within(t, 0.44, in) ? SyncPhase::synchronising : SyncPhase::free;
          s.lever.f_h = {0.0, within(t, 0.44, in) ? force : 0.0};
          s.car.pedals.clutch = within(t, 0.05, in + 0.1) ? 1.0 : 0.0;
          s.car.clutch_locked = t < 0.05 || t > in + 0.2;
          s.car.engine_speed = plain.engine(s.car.gear == 2 ? 2 : 3);
        },
        {}, 4.0);
  };
  CHECK(only(pushes(1.5, 20.0), ErrorKind::blocked).duration == doctest::Approx(1.5).epsilon(0.01));
  CHECK(pushes(0.8, 20.0).empty());
  CHECK(pushes(1.5, 1.0).empty());
}

TEST_CASE("missed shift: the value is the gear to which the lever was pushed; an intended neutral is no error") {
  const auto gives_up = [](double depth) {
    return in_shift(
        [=](DriveSample& s, double t) {
          if (t > 0.4) ConstructedShift().place(s, {0.0, within(t, 0.45, 0.55) ? depth : 0.0});
          if (t > 0.4) s.car.gear = kNeutralGear;
        },
        {}, 5.0);
  };
  CHECK(only(gives_up(0.025), ErrorKind::missed_shift).gear == 3);
  CHECK(error_sentence(only(gives_up(0.025), ErrorKind::missed_shift)) == "You missed third.");
  CHECK(gives_up(0.0).empty());
}

// The old gear disengages before the lever reaches the release depth, as in a real gearbox.
TEST_CASE("missed shift: the value is never the old gear or a gear that was engaged") {
  const auto goes = [](const std::function<void(DriveSample&, double, const ConstructedShift&)>& on_the_way,
                       int wanted) {
    return in_shift(
        [=](DriveSample& s, double t) {
          const ConstructedShift plain;
          const double two = rest_position(plain.gate, 2).x, rest = rest_position(plain.gate, 2).y;
          if (t > 0.2) plain.place(s, {two, ConstructedShift::line(t, 0.2, rest, 0.3, 0.0)});
          s.car.gear = t < 0.202 ? 2 : kNeutralGear;
          on_the_way(s, t, plain);
          if (t > 0.6) plain.place(s, {two, ConstructedShift::line(t, 0.6, 0.0, 0.7, rest)});
          if (t > 0.698) s.car.gear = 2;
          s.car.pedals.clutch = within(t, 0.1, 0.9) ? 1.0 : 0.0;
          s.car.clutch_locked = t < 0.1 || t > 1.0;
          s.car.engine_speed = plain.engine(2);
        },
        {wanted, {}}, 3.0);
  };
  const auto nothing = [](DriveSample&, double, const ConstructedShift&) {};
  const auto third = [](double depth, bool in) {
    return [=](DriveSample& s, double t, const ConstructedShift& plain) {
      if (within(t, 0.4, 0.5)) plain.place(s, {0.0, depth});
      if (in && within(t, 0.42, 0.48)) s.car.gear = 3;
    };
  };
  const double rest = rest_position(known_gate(), 3).y;
  CHECK(goes(nothing, kNeutralGear).empty());                        // no gear was requested; second engages again
  CHECK(only(goes(nothing, 4), ErrorKind::missed_shift).gear == 4);  // the requested gear
  // The value is 3, because the lever entered the slot of third gear.
  CHECK(only(goes(third(0.025, false), 4), ErrorKind::missed_shift).gear == 3);
  // Third was engaged, so the lever neither missed a gear nor entered a wrong slot.
  CHECK(goes(third(rest, true), kNeutralGear).empty());
}

TEST_CASE("wrong gear: a gear that was not requested is reported as soon as it is engaged") {
  const DrivingError error = only(in_shift([](DriveSample&, double) {}, {4, {}}), ErrorKind::wrong_gear);
  CHECK(error.gear == 3);
  CHECK(error.wanted_gear == 4);
  CHECK(error_sentence(error) == "You engaged third instead of fourth.");
  CHECK(in_shift([](DriveSample&, double) {}, {3, {}}).empty());
}

TEST_CASE("wrong column: the number of mouths that the lever entered off its path") {
  ConstructedShift shift;
  const double depth = shift.gate.half_aisle + shift.gate.chamfer + 0.002;
  const auto errors = in_shift([&](DriveSample& s, double t) {
    if (within(t, 0.34, 0.4)) shift.place(s, {0.0, within(t, 0.35, 0.36) || within(t, 0.37, 0.38) ? -depth : 0.0});
  });
  CHECK(only(errors, ErrorKind::wrong_column).wrong_slots == 2);
}

TEST_CASE("over-push: above the paper's 60 N, once until the push is below 50 N, with its maximum") {
  const auto pushes = [](double max_force) {
    return in_shift([=](DriveSample& s, double t) {
      s.lever.f_h = {0.0, within(t, 0.3, 0.6) ? max_force - 8.0 * (std::lround(50.0 * t) % 2 == 0 ? 1.0 : 0.0) : 0.0};
    });
  };
  const DrivingError error = only(pushes(65.0), ErrorKind::over_push);
  CHECK(error.force == doctest::Approx(65.0));
  CHECK(error.severity == Severity::minor);
  CHECK(only(pushes(120.0), ErrorKind::over_push).severity == Severity::severe);
  CHECK(pushes(59.0).empty());
}

TEST_CASE("step order: the throttle is released long after the clutch is down") {
  const DrivingError late = only(
      in_shift([](DriveSample& s, double t) { s.car.pedals.throttle = t < 0.29 ? 0.3 : 0.0; }), ErrorKind::step_order);
  CHECK(late.steps_out_of_place == 2);
  CHECK(error_sentence(late) == "You released the throttle only after the clutch was down.");
  // The clutch passes the bite point at 0.075 s, and the throttle is released at 0.17 s. Pedals that move within 0.2 s
  // count as simultaneous, so the order is correct.
  CHECK(in_shift([](DriveSample& s, double t) { s.car.pedals.throttle = t < 0.17 ? 0.3 : 0.0; }).empty());
}

TEST_CASE("known mistakes in the order of the steps are described in words, others by the number of misplaced steps") {
  DrivingError error = make_driving_error(ErrorKind::step_order, Severity::minor, 0.0, 2.0);
  std::set<std::string> sentences;
  for (int i = 0; i <= static_cast<int>(last_value(OrderMistake())); ++i) {
    error.mistake = static_cast<OrderMistake>(i);
    sentences.insert(error_sentence(error));
  }
  CHECK(sentences.size() == 6);
  CHECK(sentences.count("You did the steps of the shift in the wrong order (2 out of place).") == 1);
}

TEST_CASE("the sentence for a single wrong slot is in the singular") {
  CHECK(error_sentence(make_driving_error(ErrorKind::wrong_column, Severity::minor, 0.0, 1.0)) ==
        "The lever entered the wrong slot.");
  CHECK(error_sentence(make_driving_error(ErrorKind::wrong_column, Severity::minor, 0.0, 2.0)) ==
        "The lever entered 2 wrong slots.");
}

// A shift from second to third gear at a constant speed of 12 m/s. The shift is early if the step's speed is above 12.9
// m/s (12 m/s is more than 7 % lower). It is late if the step's speed is below 8.7 m/s (12 m/s is more than 12 km/h =
// 3.3 m/s higher).
TEST_CASE("a gear is early if it engages at a speed 7 % below the step's, and late if 12 km/h above") {
  struct At {
    double at;  // [m/s] shift speed that the lesson's step states
    std::optional<ErrorKind> kind;
  };
  for (const At& meant :
       {At{12.0, {}}, {12.8, {}}, {13.0, ErrorKind::early_shift}, {9.0, {}}, {8.0, ErrorKind::late_shift}}) {
    ConstructedShift shift;
    ShiftMeter meter(shift.car, shift.gate);
    ErrorDetector watch(shift.car, shift.gate);
    for (const DriveSample& s : shift.samples()) {
      const auto record = meter.add(s);
      watch.add(s, 3, meter.is_open(), meant.at);
      if (record) watch.check_shift(*record);
    }
    watch.finish();
    const std::vector<DrivingError> errors = watch.drain_errors();
    CAPTURE(meant.at);
    REQUIRE(errors.size() == (meant.kind ? 1 : 0));
    if (!meant.kind) continue;
    CHECK(to_string(errors[0].kind) == to_string(*meant.kind));
    CHECK(errors[0].target_speed == meant.at);
    CHECK(error_sentence(errors[0]).find("km/h.") != std::string::npos);
  }
}

TEST_CASE("the speed of a stopped engine causes no error of the shift: no flare when it restarts, no early shift") {
  const auto restarts = [](bool dead) {
    return in_shift(
        [dead](DriveSample& s, double t) {
          const double factor = t < 0.5 ? 0.1 : 1.5;
          if (dead) s.car.running = t < -0.5 || t > 0.5;
          if (t > -0.5 && t < 0.6) s.car.engine_speed *= factor;
        },
        {kNeutralGear, {200.0, 400.0}});
  };
  CHECK(restarts(false).size() >= 2);
  const auto dead = restarts(true);
  CHECK(only(dead, ErrorKind::stall).engine_speed > 0.0);
}

TEST_CASE("after a stall, every gear from first up to the requested one is accepted; otherwise it is wrong") {
  for (const bool stalls : {false, true}) {
    const auto errors = in_shift(
        [stalls](DriveSample& s, double t) {
          if (stalls) s.car.running = t < -0.5 || t > -0.2;
        },
        {5, {}});
    std::string raised;
    for (const DrivingError& error : errors) raised += std::string(to_string(error.kind)) + " ";
    CHECK(raised == (stalls ? "stall " : "wrong_gear "));
  }
}

TEST_CASE("the time for reading prompts within a shift does not count as part of the shift") {
  const auto held = [](double until, double reading) {
    ConstructedShift shift;
    shift.to = until + 2.0;
    shift.modify = [until](DriveSample& s, double t) {
      if (t > 0.35) s.car.pedals.clutch = t < until ? 1.0 : 0.0;
      s.car.clutch_locked = t < 0.075 || t > until;
    };
    ShiftMeter meter(shift.car, shift.gate);
    ErrorDetector watch(shift.car, shift.gate, {}, reading);
    int slow = 0;
    for (const DriveSample& s : shift.samples()) {
      const auto record = meter.add(s);
      watch.add(s, kNeutralGear, meter.is_open());
      if (record) watch.check_shift(*record);
      for (const DrivingError& error : watch.drain_errors()) slow += error.kind == ErrorKind::too_slow ? 1 : 0;
    }
    return slow;
  };
  CHECK(held(2.9, 0.0) == 1);
  CHECK(held(2.9, 1.0) == 0);
  CHECK(held(3.9, 1.0) == 1);
}

TEST_CASE("holding the clutch down long before the lever moves is a slow shift, and not also coasting") {
  ConstructedShift shift;
  shift.from = -6.0;
  shift.modify = [](DriveSample& s, double t) {
    if (t > -4.5 && t < 0.3)
      s.car.pedals.clutch = 1.0, s.car.pedals.throttle = 0.0, s.car.clutch_locked = false, s.car.clutch_torque = 0.0;
    if (t < -4.6) s.car.pedals.throttle = 0.3;
    if (t > -4.6 && t < 0.0) s.car.pedals.throttle = 0.0;
  };
  std::string raised;
  for (const DrivingError& error : detected_errors(shift)) raised += std::string(to_string(error.kind)) + " ";
  CHECK(raised == "too_slow ");
}

TEST_CASE("rollback: the value is the distance; not in reverse, and not for a few centimetres") {
  const auto rolls = [](int gear, double metres) {
    return in_second([=](DriveSample& s, double t) {
      const double u = std::clamp(t - 3.0, 0.0, 1.0);
      s.car.road_speed = u > 0.0 && u < 1.0 ? -metres : 0.0;
      s.car.distance = 50.0 - metres * u;
      s.car.gear = gear;
      ConstructedShift().place(s, rest_position(ConstructedShift().gate, gear));
    });
  };
  const DrivingError error = only(rolls(1, 0.3), ErrorKind::rollback);
  CHECK(error.distance == doctest::Approx(0.3).epsilon(0.01));
  CHECK(error.severity == Severity::minor);
  CHECK(only(rolls(kNeutralGear, 0.8), ErrorKind::rollback).severity == Severity::severe);
  CHECK(rolls(kReverseGear, 3.0).empty());
  CHECK(rolls(1, 0.05).empty());
}

TEST_CASE("a rollback that lasts until the lesson ends is still reported") {
  const auto errors = in_second(
      [](DriveSample& s, double t) {
        s.car.road_speed = t > 3.0 ? -1.0 : 0.0;
        s.car.distance = 50.0 - std::max(0.0, t - 3.0);
        s.car.gear = kNeutralGear;
        ConstructedShift().place(s, {0.0, 0.0});
      },
      4.0);
  CHECK(only(errors, ErrorKind::rollback).distance == doctest::Approx(1.0).epsilon(0.01));
}

TEST_CASE("a clutch dumped just before the lesson ends is still reported") {
  const auto errors = in_second(
      [](DriveSample& s, double t) {
        s.car.road_speed = 0.0;
        s.car.pedals.clutch = ConstructedShift::line(t, 1.0, 1.0, 1.1, 0.0);
        s.car.clutch_locked = false;
        s.car.slip_power = t > 1.0 ? 20e3 : 0.0;
      },
      1.15);
  CHECK(only(errors, ErrorKind::clutch_dump).slip_power == doctest::Approx(20e3));
}

TEST_CASE("early and late shift: an upshift outside the lesson's band") {
  const double engine = ConstructedShift().engine(2);
  const auto plain = [](DriveSample&, double) {};
  CHECK(only(in_shift(plain, {0, {engine + 10.0, 1e9}}), ErrorKind::early_shift).engine_speed ==
        doctest::Approx(engine));
  CHECK(only(in_shift(plain, {0, {0.0, engine - 10.0}}), ErrorKind::late_shift).engine_speed ==
        doctest::Approx(engine));
  CHECK(in_shift(plain, {0, {engine - 10.0, engine + 10.0}}).empty());
}

TEST_CASE("too slow: a shift that takes longer than 2.5 s") {
  const auto held = [](double until) {
    return in_shift(
        [=](DriveSample& s, double t) {
          s.car.pedals.clutch = within(t, 0.05, until) ? 1.0 : 0.0;
          s.car.clutch_locked = t < 0.05 || t > until + 0.1;
        },
        {}, 5.0);
  };
  CHECK(only(held(3.2), ErrorKind::too_slow).duration == doctest::Approx(3.15).epsilon(0.01));
  CHECK(held(2.0).empty());
}

// The road speed falls from 12 m/s to zero. The clutch is down from 0.05 s on, and the lever reaches third at the time
// `in` [s].
TEST_CASE("too slow: while the car is braked to a stop with the clutch down, only the lever's own time counts") {
  const auto stops = [](double in, double brake) {
    ConstructedShift shift;
    shift.to = 9.0;
    shift.modify = [=](DriveSample& s, double t) {
      const ConstructedShift plain;
      const double late = std::max(0.0, t - in + 0.5);
      if (t > 0.4) plain.place(s, plain.at(t < in - 0.1 ? 0.4 : late, 0).lever.proxy);
      s.car.gear = t < 0.24 ? 2 : t < in ? kNeutralGear : 3;
      s.car.pedals.clutch = within(t, 0.05, 7.9) ? 1.0 : 0.0;
      s.car.clutch_locked = t < 0.05 || t > 7.95;
      s.car.pedals.brake = t > 0.0 ? brake : 0.0;
      s.car.road_speed = std::max(0.0, 12.0 - 2.2 * std::max(0.0, t));  // [m/s] slower than 4 m/s from about 3.6 s on
      s.car.engine_speed = 90.0;
    };
    std::vector<DrivingError> errors = detected_errors(shift);
    std::erase_if(errors, [](const DrivingError& f) { return f.kind != ErrorKind::too_slow; });
    return errors;
  };
  CHECK(stops(0.5, 0.2).empty());
  CHECK(only(stops(3.4, 0.2), ErrorKind::too_slow).duration == doctest::Approx(3.4 - 0.24).epsilon(0.01));
  // Without braking, the error's value is the time with the clutch down until the car is slower than 4 m/s.
  CHECK(only(stops(0.5, 0.0), ErrorKind::too_slow).duration == doctest::Approx(3.6 - 0.05).epsilon(0.02));
}

TEST_CASE("wrong direction: reverse tried at forward speed, once per visit to its slot") {
  const auto reverse = [](double speed) {
    ConstructedShift shift;
    shift.to = 4.0;
    shift.modify = [shift, speed](DriveSample& s, double t) {
      s.car.road_speed = speed;
      s.car.engine_speed = 90.0;
      if (t > 0.4) {
        s.car.gear = kNeutralGear;
        shift.place(s, {0.030, within(t, 0.5, 1.0) ? -0.030 : 0.0});
      }
    };
    std::vector<DrivingError> errors = detected_errors(shift);
    std::erase_if(errors, [](const DrivingError& f) { return f.kind == ErrorKind::missed_shift; });
    return errors;
  };
  CHECK(only(reverse(3.0), ErrorKind::wrong_direction).road_speed == doctest::Approx(3.0));
  CHECK(only(reverse(8.0), ErrorKind::wrong_direction).severity == Severity::very_severe);
  CHECK(reverse(0.5).empty());
}

TEST_CASE("every kind of error has a row in the table, a sentence, and its own advice") {
  std::set<std::string> sentences;
  for (int i = 0; i < kErrorKindCount; ++i) {
    const auto kind = static_cast<ErrorKind>(i);
    CHECK(error_kind_of(to_string(kind)) == kind);
    CHECK(error_rule(kind).clear <= std::max(0.0, error_rule(kind).raise));
    CHECK(error_sentence(make_driving_error(kind, Severity::minor, 0.0, 1.0)).find('{') == std::string::npos);
    const std::string advice(error_advice(kind));
    CAPTURE(advice);
    CHECK(advice.ends_with("."));
    CHECK(advice.find('{') == std::string::npos);
    CHECK(advice.size() < 90);
    CHECK(sentences.insert(advice).second);  // each kind has its own advice
  }
  CHECK_FALSE(error_kind_of("tyre_blown").has_value());
  CHECK(error_severity(ErrorKind::rollback, 0.2) == Severity::minor);
  CHECK(error_severity(ErrorKind::rollback, 0.6) == Severity::severe);
}

TEST_CASE("non-finite samples cause no errors") {
  CHECK(in_shift([](DriveSample& s, double t) {
          if (within(t, 0.3, 0.6)) s.lever.f_h.x = std::numeric_limits<double>::quiet_NaN();
          if (within(t, 0.3, 0.305)) s.car.distance = s.car.acceleration = std::numeric_limits<double>::quiet_NaN();
          if (within(t, 0.3, 0.4)) s.car.grind_power = std::numeric_limits<double>::quiet_NaN();
        }).empty());
}
