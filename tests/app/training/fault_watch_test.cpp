// Each fault is raised by the drive that has it, once, with its value; and by no clean one.
#include "app/training/fault_watch.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "app/training/fault_rules.h"
#include "tests/app/training/constructed_shift.h"

using namespace gearshift;

namespace {

using Spoil = std::function<void(DriveSample&, double)>;

struct Watched {
  int wanted = kNeutralGear;
  ShiftBand band;
};

std::vector<DriveFault> faults_of(const ConstructedShift& shift, const Watched& watched = {}) {
  ShiftMeter meter(shift.car, shift.gate);
  FaultWatch watch(shift.car, shift.gate, watched.band);
  for (const DriveSample& s : shift.samples()) {
    const auto record = meter.add(s);
    watch.add(s, watched.wanted, meter.is_open());
    if (record) watch.judge(*record);
  }
  watch.finish();
  return watch.take();
}

// A shift, spoilt.
std::vector<DriveFault> in_shift(Spoil spoil, const Watched& watched = {}, double to = 2.0) {
  ConstructedShift shift;
  shift.spoil = std::move(spoil);
  shift.to = to;
  return faults_of(shift, watched);
}

// A drive of ten seconds in second gear at 12 m/s with no shift in it, spoilt.
std::vector<DriveFault> in_second(Spoil spoil, double to = 10.0) {
  ConstructedShift shift;
  shift.to = to;
  shift.spoil = [&shift, &spoil](DriveSample& s, double t) {
    shift.place(s, rest_position(shift.gate, 2));
    s.car.gear = 2;
    s.car.throttle = s.car.clutch = 0.0;
    s.car.clutch_locked = true;
    s.car.engine_speed = shift.engine(2);
    spoil(s, t);
  };
  return faults_of(shift);
}

bool within(double t, double a, double b) {
  return t >= a - 1e-9 && t <= b + 1e-9;
}

// That fault and no other one.
DriveFault only(const std::vector<DriveFault>& faults, FaultKind kind) {
  std::string raised;
  for (const DriveFault& fault : faults) raised += std::string(fault_key(fault.kind)) + " ";
  CAPTURE(raised);
  REQUIRE(faults.size() == 1);
  CHECK(fault_key(faults[0].kind) == fault_key(kind));
  return faults[0];
}

double rpm(double value) {
  return value * 6.283185307179586 / 60.0;
}

}  // namespace

TEST_CASE("a clean shift and a clean drive have no fault, at any period") {
  for (const double period : {0.001, 0.0042, 0.011}) {
    ConstructedShift shift;
    shift.period = period;
    CHECK(faults_of(shift).empty());
  }
  CHECK(in_second([](DriveSample&, double) {}).empty());
}

TEST_CASE("stall: the engine dies with the ignition on; the speed is that before it fell") {
  const auto dies = [](DriveSample& s, double t) {
    s.car.engine_speed = t < 4.0 ? 90.0 : t < 4.2 ? 90.0 - 450.0 * (t - 4.0) : 0.0;
    s.car.running = s.car.engine_speed > 37.0;
    s.car.road_speed = 0.0;
  };
  const DriveFault stall = only(in_second(dies), FaultKind::stall);
  CHECK(stall.value == doctest::Approx(90.0));
  CHECK(stall.severity == Severity::severe);
  CHECK(stall.time == doctest::Approx(104.118).epsilon(1e-4));
  // Switched off, it does not stall; nor does one that was never started.
  CHECK(in_second([&](DriveSample& s, double t) { dies(s, t), s.car.ignition = t < 4.0; }).empty());
  CHECK(in_second([](DriveSample& s, double) { s.car.running = false, s.car.stalled = true; }).empty());
}

TEST_CASE("over-rev: one deed however it swings about the red line, worse where far above") {
  const double red = ConstructedShift().car.engine.red_line;
  const DriveFault fault = only(in_second([&](DriveSample& s, double t) {
                                  if (within(t, 2.0, 5.0))
                                    s.car.engine_speed = red * (1.005 + 0.01 * std::sin(40.0 * t));
                                }),
                                FaultKind::over_rev);
  CHECK(fault.value == doctest::Approx(1.015 * red).epsilon(1e-4));
  CHECK(fault.severity == Severity::severe);
  const auto money = in_second([&](DriveSample& s, double t) { s.car.engine_speed = t > 3.0 ? 1.14 * red : 200.0; });
  CHECK(only(money, FaultKind::over_rev).severity == Severity::very_severe);
  CHECK(in_second([&](DriveSample& s, double) { s.car.engine_speed = 0.99 * red; }).empty());
}

TEST_CASE("lugging: load below the speed that the engine can carry, for a second") {
  const auto labours = [](double seconds, double load) {
    return in_second([=](DriveSample& s, double t) {
      s.car.engine_speed = 100.0;
      s.car.engine_load = within(t, 2.0, 2.0 + seconds) ? load : 0.2;
    });
  };
  CHECK(only(labours(2.5, 0.9), FaultKind::lugging).value == doctest::Approx(2.5).epsilon(0.01));
  CHECK(labours(0.9, 0.9).empty());
  CHECK(labours(2.5, 0.6).empty());
}

TEST_CASE("clutch dump: up at once and much heat; a slow one with the same heat, and a fast one without, are none") {
  const auto launch = [](double seconds, double power) {
    return in_second([=](DriveSample& s, double t) {
      s.car.road_speed = 0.0;
      s.car.clutch = ConstructedShift::line(t, 1.0, 1.0, 1.0 + seconds, 0.0);
      s.car.clutch_locked = t > 1.0 + seconds + 0.1;
      s.car.slip_power = within(t, 1.0, 1.0 + seconds + 0.1) ? power : 0.0;
    });
  };
  const DriveFault dump = only(launch(0.1, 20e3), FaultKind::clutch_dump);
  CHECK(dump.value == doctest::Approx(20e3));
  CHECK(dump.severity == Severity::severe);
  CHECK(only(launch(0.1, 90e3), FaultKind::clutch_dump).severity == Severity::very_severe);
  CHECK(launch(1.5, 20e3).empty());
  CHECK(launch(0.1, 8e3).empty());
}

TEST_CASE("jerk: of a clutch that takes hold, not of the brake, and not beside the dump or the stall that made it") {
  const auto jerks = [](double brake, double power, bool stalls = false) {
    return in_second([=](DriveSample& s, double t) {
      s.car.road_speed = 2.0;
      s.car.brake = brake;
      s.car.clutch = ConstructedShift::line(t, 1.0, 1.0, 1.1, 0.0);
      s.car.clutch_locked = t > 1.3;
      s.car.acceleration = t > 1.3 ? 3.0 : 0.0;
      s.car.running = !stalls || t < 1.25;
      s.car.slip_power = within(t, 1.0, 1.3) ? power : 0.0;
    });
  };
  CHECK(only(jerks(0.0, 0.0), FaultKind::jerk).value == doctest::Approx(3.0 * 42.97).epsilon(0.01));
  CHECK(jerks(0.5, 0.0).empty());
  only(jerks(0.0, 20e3), FaultKind::clutch_dump);
  only(jerks(0.0, 0.0, true), FaultKind::stall);
}

TEST_CASE("clutch early and late: how much, and where small enough, nothing") {
  const auto shift = [](double down, double up) {
    return in_shift([=](DriveSample& s, double t) {
      s.car.clutch = within(t, down, up) ? 1.0 : 0.0;
      s.car.clutch_locked = t < down || t > up + 0.3;
    });
  };
  const DriveFault late = only(shift(0.30, 0.6), FaultKind::clutch_late);
  CHECK(late.value == doctest::Approx(0.30 - 0.2093).epsilon(0.03));
  CHECK(late.shift == 0);
  const DriveFault early = only(shift(0.1, 0.4), FaultKind::clutch_early);
  CHECK(early.value == doctest::Approx(0.0907 - 0.001).epsilon(0.03));
  CHECK(fault_sentence(early) == "The clutch came up 0.09 s before the gear was in.");
  CHECK(shift(0.24, 0.47).empty());
}

TEST_CASE("no clutch: forgiven where the revs match, and else told without what follows from it") {
  const auto shift = [](double rpm_off, bool goes_in) {
    return in_shift(
        [=](DriveSample& s, double t) {
          const ConstructedShift plain;
          s.car.clutch = 0.0;
          s.car.clutch_locked = true;
          s.car.engine_speed = plain.engine(t < 0.3 ? 2 : 3) + (s.car.gear == 3 || t < 0.3 ? 0.0 : rpm(rpm_off));
          if (within(t, 0.44, 0.48)) s.car.sync = SyncPhase::synchronising;
          if (!goes_in && t > 0.44) s.car.gear = kNeutralGear, s.car.sync = SyncPhase::synchronising;
          if (!goes_in && t > 0.8) s.car.sync = SyncPhase::free, plain.place(s, {0.0, 0.0});
        },
        {}, 4.0);
  };
  CHECK(shift(60.0, true).empty() == false);  // the order of steps is not the taught one
  only(shift(60.0, true), FaultKind::step_order);
  const DriveFault fault = only(shift(400.0, true), FaultKind::no_clutch);
  CHECK(fault.value == doctest::Approx(rpm(400.0)).epsilon(1e-6));
  only(shift(400.0, false), FaultKind::no_clutch);
}

TEST_CASE("riding the clutch: a resting foot, an open clutch in gear; not for a moment, not to stop, not to creep") {
  const auto rides = [](double pedal, double seconds, double speed, double brake) {
    return in_second([=](DriveSample& s, double t) {
      s.car.road_speed = speed;
      s.car.brake = brake;
      s.car.clutch = within(t, 2.0, 2.0 + seconds) ? pedal : 0.0;
    });
  };
  CHECK(only(rides(0.2, 4.0, 12.0, 0.0), FaultKind::riding_clutch).value == doctest::Approx(4.0).epsilon(0.01));
  CHECK(only(rides(1.0, 4.0, 12.0, 0.0), FaultKind::riding_clutch).value == doctest::Approx(4.0).epsilon(0.01));
  CHECK(rides(0.2, 1.9, 12.0, 0.0).empty());
  CHECK(rides(1.0, 4.0, 12.0, 0.3).empty());
  CHECK(rides(1.0, 4.0, 3.0, 0.0).empty());
}

TEST_CASE("riding the lever: a hand that leans on it for two seconds") {
  const auto leans = [](double force, double seconds) {
    return in_second([=](DriveSample& s, double t) {
      s.lever.f_h = {within(t, 2.0, 2.0 + seconds) ? force : 0.0, 0.0};
    });
  };
  CHECK(only(leans(5.0, 3.0), FaultKind::riding_lever).value == doctest::Approx(3.0).epsilon(0.01));
  CHECK(leans(2.5, 3.0).empty());
  CHECK(leans(5.0, 1.5).empty());
}

TEST_CASE("throttle in a shift: a flare; the blip that a lower gear asks for is none") {
  const auto flares = [](double rise) {
    return in_shift([=](DriveSample& s, double t) {
      if (within(t, 0.3, 0.6)) s.car.engine_speed = ConstructedShift().engine(2) + rise;
    });
  };
  CHECK(only(flares(60.0), FaultKind::throttle_in_shift).value == doctest::Approx(60.0));
  CHECK(flares(30.0).empty());

  ConstructedShift down;  // 3 to 2: the same, run backwards
  down.spoil = [](DriveSample& s, double t) {
    const ConstructedShift plain;
    DriveSample mirrored = plain.at(0.7 - t, s.car.gear == 0 ? 3 : s.car.gear);
    s.lever.lever = s.lever.proxy = mirrored.lever.proxy;
    s.lever.slot = mirrored.lever.slot;
    s.car.gear = t < 0.25 ? 3 : t < 0.49 ? 0 : 2;
    s.car.engine_speed = plain.engine(t < 0.3 ? 3 : 2);  // rev-matched
  };
  CHECK(faults_of(down).empty());
}

TEST_CASE("rev mismatch: above idle only, and not beside a flare") {
  const auto off = [](double by) {
    return in_shift([=](DriveSample& s, double t) {
      if (within(t, 0.55, 0.7)) s.car.engine_speed = ConstructedShift().engine(3) - by;
    });
  };
  CHECK(only(off(rpm(500.0)), FaultKind::rev_mismatch).value == doctest::Approx(rpm(500.0)).epsilon(1e-6));
  CHECK(off(rpm(250.0)).empty());
}

TEST_CASE("grind: one deed with its energy, gaps and all; a tick of it is none") {
  const auto grinds = [](double power) {
    return in_shift([=](DriveSample& s, double t) {
      s.car.grinding = within(t, 0.42, 0.48) && std::lround(1e3 * t) % 4 != 0;
      s.car.grind_power = s.car.grinding ? power : 0.0;
    });
  };
  const DriveFault fault = only(grinds(200.0), FaultKind::grind);
  CHECK(fault.value == doctest::Approx(200.0 * 0.045).epsilon(0.02));
  CHECK(only(grinds(2000.0), FaultKind::grind).severity == Severity::severe);
  CHECK(grinds(5.0).empty());
}

TEST_CASE("blocked: pushed against the ring for longer than it needs, with the clutch down") {
  const auto pushes = [](double seconds, double force) {
    return in_shift(
        [=](DriveSample& s, double t) {
          const ConstructedShift plain;
          const double in = 0.44 + seconds;
          if (t > 0.44) plain.place(s, {0.0, t < in ? 0.020 : rest_position(plain.gate, 3).y});
          s.car.gear = t < 0.24 ? 2 : t < in ? kNeutralGear : 3;
          s.car.sync = within(t, 0.44, in) ? SyncPhase::synchronising : SyncPhase::free;
          s.lever.f_h = {0.0, within(t, 0.44, in) ? force : 0.0};
          s.car.clutch = within(t, 0.05, in + 0.1) ? 1.0 : 0.0;
          s.car.clutch_locked = t < 0.05 || t > in + 0.2;
          s.car.engine_speed = plain.engine(s.car.gear == 2 ? 2 : 3);
        },
        {}, 4.0);
  };
  CHECK(only(pushes(1.5, 20.0), FaultKind::blocked).value == doctest::Approx(1.5).epsilon(0.01));
  CHECK(pushes(0.8, 20.0).empty());
  CHECK(pushes(1.5, 1.0).empty());
}

TEST_CASE("missed shift: the gear that the lever was pushed to; neutral by intent is none") {
  const auto gives_up = [](double depth) {
    return in_shift(
        [=](DriveSample& s, double t) {
          if (t > 0.4) ConstructedShift().place(s, {0.0, within(t, 0.45, 0.55) ? depth : 0.0});
          if (t > 0.4) s.car.gear = kNeutralGear;
        },
        {}, 5.0);
  };
  CHECK(only(gives_up(0.025), FaultKind::missed_shift).value == 3.0);
  CHECK(fault_sentence(only(gives_up(0.025), FaultKind::missed_shift)) == "Gear 3 was not reached.");
  CHECK(gives_up(0.0).empty());
}

TEST_CASE("wrong gear: what was not asked for, as soon as it is in") {
  CHECK(only(in_shift([](DriveSample&, double) {}, {4, {}}), FaultKind::wrong_gear).value == 3.0);
  CHECK(in_shift([](DriveSample&, double) {}, {3, {}}).empty());
}

TEST_CASE("wrong column: mouths off the way, counted") {
  ConstructedShift shift;
  const double depth = shift.gate.half_aisle + shift.gate.chamfer + 0.002;
  const auto faults = in_shift([&](DriveSample& s, double t) {
    if (within(t, 0.34, 0.4)) shift.place(s, {0.0, within(t, 0.35, 0.36) || within(t, 0.37, 0.38) ? -depth : 0.0});
  });
  CHECK(only(faults, FaultKind::wrong_column).value == 2.0);
}

TEST_CASE("over-push: the paper's 60 N, once until it is below 50 N, with the most of it") {
  const auto pushes = [](double most) {
    return in_shift([=](DriveSample& s, double t) {
      s.lever.f_h = {0.0, within(t, 0.3, 0.6) ? most - 8.0 * (std::lround(50.0 * t) % 2 == 0 ? 1.0 : 0.0) : 0.0};
    });
  };
  const DriveFault fault = only(pushes(65.0), FaultKind::over_push);
  CHECK(fault.value == doctest::Approx(65.0));
  CHECK(fault.severity == Severity::minor);
  CHECK(only(pushes(120.0), FaultKind::over_push).severity == Severity::severe);
  CHECK(pushes(59.0).empty());
}

TEST_CASE("step order: the throttle after the clutch") {
  CHECK(only(in_shift([](DriveSample& s, double t) { s.car.throttle = t < 0.15 ? 0.3 : 0.0; }), FaultKind::step_order)
            .value == 2.0);
}

TEST_CASE("rollback: how far, not in reverse, and not for a hand's breadth") {
  const auto rolls = [](int gear, double metres) {
    return in_second([=](DriveSample& s, double t) {
      const double u = std::clamp(t - 3.0, 0.0, 1.0);
      s.car.road_speed = u > 0.0 && u < 1.0 ? -metres : 0.0;
      s.car.distance = 50.0 - metres * u;
      s.car.gear = gear;
      ConstructedShift().place(s, rest_position(ConstructedShift().gate, gear));
    });
  };
  const DriveFault fault = only(rolls(1, 0.3), FaultKind::rollback);
  CHECK(fault.value == doctest::Approx(0.3).epsilon(0.01));
  CHECK(fault.severity == Severity::minor);
  CHECK(only(rolls(kNeutralGear, 0.8), FaultKind::rollback).severity == Severity::severe);
  CHECK(rolls(kReverseGear, 3.0).empty());
  CHECK(rolls(1, 0.05).empty());
}

TEST_CASE("rolling back when the lesson is over is told all the same") {
  const auto faults = in_second(
      [](DriveSample& s, double t) {
        s.car.road_speed = t > 3.0 ? -1.0 : 0.0;
        s.car.distance = 50.0 - std::max(0.0, t - 3.0);
        s.car.gear = kNeutralGear;
        ConstructedShift().place(s, {0.0, 0.0});
      },
      4.0);
  CHECK(only(faults, FaultKind::rollback).value == doctest::Approx(1.0).epsilon(0.01));
}

TEST_CASE("a clutch dumped as the lesson ends is told all the same") {
  const auto faults = in_second(
      [](DriveSample& s, double t) {
        s.car.road_speed = 0.0;
        s.car.clutch = ConstructedShift::line(t, 1.0, 1.0, 1.1, 0.0);
        s.car.clutch_locked = false;
        s.car.slip_power = t > 1.0 ? 20e3 : 0.0;
      },
      1.15);
  CHECK(only(faults, FaultKind::clutch_dump).value == doctest::Approx(20e3));
}

TEST_CASE("early and late shift: an upshift outside the lesson's band") {
  const double engine = ConstructedShift().engine(2);
  const auto plain = [](DriveSample&, double) {};
  CHECK(only(in_shift(plain, {0, {engine + 10.0, 1e9}}), FaultKind::early_shift).value == doctest::Approx(engine));
  CHECK(only(in_shift(plain, {0, {0.0, engine - 10.0}}), FaultKind::late_shift).value == doctest::Approx(engine));
  CHECK(in_shift(plain, {0, {engine - 10.0, engine + 10.0}}).empty());
}

TEST_CASE("too slow: a shift that takes longer than 2.5 s") {
  const auto held = [](double until) {
    return in_shift(
        [=](DriveSample& s, double t) {
          s.car.clutch = within(t, 0.05, until) ? 1.0 : 0.0;
          s.car.clutch_locked = t < 0.05 || t > until + 0.1;
        },
        {}, 5.0);
  };
  CHECK(only(held(3.2), FaultKind::too_slow).value == doctest::Approx(3.15).epsilon(0.01));
  CHECK(held(2.0).empty());
}

TEST_CASE("wrong direction: reverse at forward speed, once per visit to its slot") {
  const auto reverse = [](double speed) {
    ConstructedShift shift;
    shift.to = 4.0;
    shift.spoil = [shift, speed](DriveSample& s, double t) {
      s.car.road_speed = speed;
      s.car.engine_speed = 90.0;
      if (t > 0.4) {
        s.car.gear = kNeutralGear;
        shift.place(s, {0.030, within(t, 0.5, 1.0) ? -0.030 : 0.0});
      }
    };
    std::vector<DriveFault> faults = faults_of(shift);
    std::erase_if(faults, [](const DriveFault& f) { return f.kind == FaultKind::missed_shift; });
    return faults;
  };
  CHECK(only(reverse(3.0), FaultKind::wrong_direction).value == doctest::Approx(3.0));
  CHECK(only(reverse(8.0), FaultKind::wrong_direction).severity == Severity::very_severe);
  CHECK(reverse(0.5).empty());
}

TEST_CASE("every kind of fault has its place in the table and in words") {
  for (int i = 0; i < kFaultKinds; ++i) {
    const auto kind = static_cast<FaultKind>(i);
    CHECK(fault_rule(kind).kind == kind);
    CHECK(fault_of(fault_key(kind)) == kind);
    CHECK(fault_rule(kind).clear <= std::max(0.0, fault_rule(kind).raise));
    CHECK(fault_sentence({kind, Severity::minor, 0.0, 1.0}).find('{') == std::string::npos);
  }
  CHECK_FALSE(fault_of("tyre_blown").has_value());
  CHECK(fault_severity(FaultKind::rollback, 0.2) == Severity::minor);
  CHECK(fault_severity(FaultKind::rollback, 0.6) == Severity::severe);
}

TEST_CASE("samples that are not finite raise nothing") {
  CHECK(in_shift([](DriveSample& s, double t) {
          if (within(t, 0.3, 0.6)) s.lever.f_h.x = std::numeric_limits<double>::quiet_NaN();
          if (within(t, 0.3, 0.305)) s.car.distance = s.car.acceleration = std::numeric_limits<double>::quiet_NaN();
          if (within(t, 0.3, 0.4)) s.car.grind_power = std::numeric_limits<double>::quiet_NaN();
        }).empty());
}
