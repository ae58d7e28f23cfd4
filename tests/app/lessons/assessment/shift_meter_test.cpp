// Tests every number of a shift record, in a shift whose numbers are computed by hand.
#include "app/lessons/assessment/shift_meter.h"

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <doctest/doctest.h>

#include "app/lessons/assessment/gate_path.h"
#include "tests/app/lessons/assessment/constructed_shift.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

ShiftRecord only_record(const ConstructedShift& shift) {
  const std::vector<ShiftRecord> records = shift.records();
  REQUIRE(records.size() == 1);
  return records[0];
}

ShiftRecord modified_shift(std::function<void(DriveSample&, double)> modify) {
  ConstructedShift shift;
  shift.modify = std::move(modify);
  return only_record(shift);
}

bool lies_within(double t, double a, double b) {
  return t >= a - 1e-9 && t <= b + 1e-9;
}

}  // namespace

TEST_CASE("a shift's times are those of its pedal and its lever, at any sample period") {
  for (const double period : {0.001, 0.002, 0.0042, 0.011}) {
    CAPTURE(period);
    ConstructedShift shift;
    shift.period = period;
    const ShiftRecord record = only_record(shift);
    const Slot& two = slot_of(shift.gate, slot_of_gear(shift.gate, 2));
    const double left = 0.2 + 0.1 * (two.rest - two.engage_depth) / two.rest;
    const double in = 0.4 + 0.1 * two.engage_depth / two.rest;
    const auto near = [&](double value) { return doctest::Approx(value).epsilon(1e-9).scale(1e9 * 1.01 * period); };
    CHECK(record.begin == near(100.075));
    CHECK(record.end == near(100.75));
    CHECK(record.clutch_time == near(0.575));
    CHECK(record.lever_time == near(in - left));
    CHECK(record.clutch_lead == near(left - 0.075));
    CHECK(record.clutch_lag == near(0.65 - in));
    CHECK(record.from == 2);
    CHECK(record.to == 3);
    CHECK_FALSE(record.missed);
    CHECK(record.steps_out_of_place == 0);
    CHECK(record.wrong_columns == 0);
  }
}

TEST_CASE("the record is returned once, one filter settling time after the shift's end") {
  ConstructedShift shift;
  ShiftMeter meter(shift.car, shift.gate);
  double came = 0.0;
  for (const DriveSample& s : shift.samples()) {
    if (meter.add(s)) {
      CHECK(came == 0.0);
      came = s.time();
    }
  }
  CHECK(came == doctest::Approx(100.75 + kJerkSettlingTime).epsilon(1e-5));
}

TEST_CASE("lost drive torque counts as torque gap, relative to the torque before the throttle was released") {
  // The drive torque is 400 N m until -0.2 s, 15 N m (3.75 %) from 0.2 s to 0.6 s, and 30 N m (7.5 %) otherwise. The
  // torque gap is the time below 5 %.
  const ShiftRecord record = modified_shift([](DriveSample& s, double t) {
    s.car.drive_torque = t < -0.2 ? 400.0 : lies_within(t, 0.2, 0.6) ? 15.0 : 30.0;
  });
  CHECK(record.torque_gap == doctest::Approx(0.4).epsilon(0.01));
  // If the engine drives the car before the shift and brakes the car afterwards, the torque gap lasts for the whole
  // shift, from 0.075 s to 0.75 s. Without drive torque before the shift there is no gap.
  CHECK(modified_shift([](DriveSample& s, double t) { s.car.drive_torque = t < -0.2 ? 400.0 : -100.0; }).torque_gap ==
        doctest::Approx(0.675).epsilon(0.01));
  CHECK(modified_shift([](DriveSample& s, double) { s.car.drive_torque = 0.0; }).torque_gap == 0.0);
}

TEST_CASE("clutch heat, rev error and flare are measured") {
  // The clutch's heat power is a triangle from 0.65 s to 0.75 s with a peak of 3 kW, which is 150 J. The engine turns
  // 12 rad/s faster than the shaft when the clutch engages, and flares by 20 rad/s at 0.3 s.
  ConstructedShift shift;
  shift.modify = [&](DriveSample& s, double t) {
    const double u = std::clamp((t - 0.65) / 0.1, 0.0, 1.0);
    s.car.slip_energy = 7.0 + 300.0 * (u < 0.5 ? u * u : 0.5 - (1.0 - u) * (1.0 - u));
    s.car.engine_speed = shift.engine(t < 0.45 ? 2 : 3) + (t > 0.45 && t < 0.66 ? 12.0 : 0.0);
    if (lies_within(t, 0.3, 0.31)) s.car.engine_speed += 20.0;
  };
  const ShiftRecord record = only_record(shift);
  CHECK(record.slip_energy == doctest::Approx(150.0).epsilon(1e-6));
  CHECK(record.rev_error == doctest::Approx(12.0).epsilon(1e-9));
  CHECK(record.flare == doctest::Approx(20.0).epsilon(1e-9));
  CHECK(record.engine_speed == doctest::Approx(shift.engine(2)).epsilon(1e-9));
}

TEST_CASE("the jerk of a step, and of a constant acceleration") {
  const ShiftRecord steady = modified_shift([](DriveSample& s, double) { s.car.acceleration = 2.0; });
  CHECK(steady.jerk_peak == doctest::Approx(0.0));
  // [m/s^3] The jerk of a step of 1.5 m/s^2: 1.5 w exp(-pi/4), with the cut-off angular frequency w = 2 pi 15 Hz. The
  // first step comes during the shift. The second comes at the shift's end, so that its jerk peaks afterwards.
  const double peak = 1.5 * 6.283185307179586 * 15.0 * std::exp(-0.785398163397448);
  CHECK(modified_shift([](DriveSample& s, double t) { s.car.acceleration = t > 0.3 ? 1.5 : 0.0; }).jerk_peak ==
        doctest::Approx(peak).epsilon(0.002));
  CHECK(modified_shift([](DriveSample& s, double t) { s.car.acceleration = t > 0.75 ? 1.5 : 0.0; }).jerk_peak ==
        doctest::Approx(peak).epsilon(0.002));
  CHECK(modified_shift([](DriveSample& s, double t) { s.car.acceleration = t < -0.5 ? 1.5 : 0.0; }).jerk_peak < 0.01);
}

TEST_CASE("the hand's force is recorded by its peak and impulse") {
  const ShiftRecord record = modified_shift([](DriveSample& s, double t) {
    if (lies_within(t, 0.2, 0.5)) s.lever.f_h = {6.0, 8.0};
    if (lies_within(t, 1.5, 1.6)) s.lever.f_h = {90.0, 0.0};  // the shift has already ended
  });
  CHECK(record.force_peak == doctest::Approx(10.0));
  CHECK(record.impulse == doctest::Approx(10.0 * 0.301).epsilon(1e-6));  // 301 samples at 1 ms
}

TEST_CASE("the length of the lever's path, and its ratio to the shortest path") {
  ConstructedShift shift;
  const ShiftRecord record = only_record(shift);
  const Slot& slot = slot_of(shift.gate, slot_of_gear(shift.gate, 3));
  const glm::dvec2 two = rest_position(shift.gate, 2);
  const double length = slot.rest + std::abs(two.x) + slot.engage_depth;
  CHECK(record.path_length == doctest::Approx(length).epsilon(0.005));
  CHECK(record.path_efficiency ==
        doctest::Approx(length / shortest_path_length(shift.gate, two, {0.0, slot.engage_depth})).epsilon(0.005));
  CHECK(record.path_efficiency > 1.0);
  // With noise of one encoder count (75 um), the measured path length is still correct within 1 %.
  const ShiftRecord noisy = modified_shift([](DriveSample& s, double t) {
    if (std::lround(1e3 * t) % 2 == 0) s.lever.lever += glm::dvec2{75e-6, 75e-6};
  });
  CHECK(noisy.path_length == doctest::Approx(length).epsilon(0.01));
}

TEST_CASE("ring and dogs: the time blocked, and the time and energy of grinding") {
  const ShiftRecord record = modified_shift([](DriveSample& s, double t) {
    if (lies_within(t, 0.42, 0.499)) s.car.sync = SyncPhase::synchronising;
    s.car.grinding = lies_within(t, 0.45, 0.499);
    s.car.grind_power = s.car.grinding ? 100.0 : 0.0;
  });
  CHECK(record.block_time == doctest::Approx(0.080).epsilon(1e-6));
  CHECK(record.grind_time == doctest::Approx(0.050).epsilon(1e-6));
  CHECK(record.grind_energy == doctest::Approx(5.0).epsilon(1e-6));
}

TEST_CASE("lag is negative if the clutch comes up before the gear is in, lead if it goes down after the lever moved") {
  ConstructedShift shift;
  shift.modify = [](DriveSample& s, double t) {
    s.car.pedals.clutch = t < 0.3 ? ConstructedShift::line(t, 0.24, 0.0, 0.25, 1.0) : t > 0.4 ? 0.0 : 1.0;
  };
  const ShiftRecord record = only_record(shift);
  const Slot& slot = slot_of(shift.gate, slot_of_gear(shift.gate, 2));
  const double left = 0.2 + 0.1 * (slot.rest - slot.engage_depth) / slot.rest;
  const double in = 0.4 + 0.1 * slot.engage_depth / slot.rest;
  CHECK(record.clutch_lead == doctest::Approx(left - 0.2475).epsilon(0.02));
  CHECK(record.clutch_lag == doctest::Approx(0.4 - in).epsilon(0.02));
  CHECK(record.clutch_lead < 0.0);
  CHECK(record.clutch_lag < 0.0);
}

TEST_CASE("a clutch that comes up while the ring blocks is early, even if pressed again before the gear engages") {
  for (const SyncPhase phase : {SyncPhase::synchronising, SyncPhase::passing, SyncPhase::clashing, SyncPhase::free}) {
    ConstructedShift shift;
    shift.modify = [&](DriveSample& s, double t) {
      if (lies_within(t, 0.42, 0.47)) s.car.sync = phase;
      if (lies_within(t, 0.43, 0.45))
        s.car.pedals.clutch =
            ConstructedShift::line(t, 0.43, 1.0, 0.44, 0.5);  // the pedal passes the bite point at 0.435 s
    };
    const ShiftRecord record = only_record(shift);
    const Slot& slot = slot_of(shift.gate, slot_of_gear(shift.gate, 2));
    const double in = 0.4 + 0.1 * slot.engage_depth / slot.rest;
    const double up = phase == SyncPhase::free ? 0.65 : 0.435;
    CHECK(record.clutch_lag == doctest::Approx(up - in).epsilon(1e-9).scale(1e9 * 1.01e-3));
  }
}

TEST_CASE("steps are recorded as they happen and compared with the taught order") {
  CHECK(only_record(ConstructedShift()).steps == std::vector<ShiftStep>{ShiftStep::throttle_off, ShiftStep::clutch_down,
                                                                        ShiftStep::neutral, ShiftStep::gear,
                                                                        ShiftStep::clutch_up});
  // The throttle is released only after the clutch is down, so two steps are out of place.
  const ShiftRecord late =
      modified_shift([](DriveSample& s, double t) { s.car.pedals.throttle = t < 0.29 ? 0.3 : 0.0; });
  CHECK(late.steps.front() == ShiftStep::clutch_down);
  CHECK(late.steps_out_of_place == 2);
  // A blip between clutch and gear adds two steps, which are wrong for a shift into a higher gear. For a shift into a
  // lower gear they are correct (see step_order_test.cpp).
  CHECK(modified_shift([](DriveSample& s, double t) {
          s.car.pedals.throttle = lies_within(t, 0.3, 0.35) ? 0.5 : 0.0;
        }).steps_out_of_place == 2);
}

// The clutch pedal passes the bite point at 0.075 s on the way down. Released slowly, from 0.6 s to 1.4 s, it passes
// the bite point again at 0.8 s.
TEST_CASE("pedal movements that are simultaneous within 0.2 s are in order") {
  const auto lifted_at = [](double t0) {
    return modified_shift([t0](DriveSample& s, double t) { s.car.pedals.throttle = t < t0 ? 0.3 : 0.0; })
        .steps_out_of_place;
  };
  CHECK(lifted_at(0.17) == 0);
  CHECK(lifted_at(0.29) == 2);
  const auto throttle_at = [](double t0) {
    return modified_shift([t0](DriveSample& s, double t) {
             if (t > 0.5) s.car.pedals.clutch = ConstructedShift::line(t, 0.6, 1.0, 1.4, 0.0);
             s.car.clutch_locked = t < 0.075 || t > 1.2;
             if (t > t0) s.car.pedals.throttle = 0.3;
           })
        .steps_out_of_place;
  };
  CHECK(throttle_at(0.65) == 0);
  CHECK(throttle_at(0.55) > 0);
}

TEST_CASE("entering a mouth that is off the path counts as a wrong column") {
  // From the middle of the aisle, the lever enters the mouth of fourth gear, which is opposite the mouth of third, and
  // returns.
  ConstructedShift shift;
  shift.to = 3.0;
  const double depth = shift.gate.half_aisle + shift.gate.chamfer + 0.002;
  shift.modify = [&](DriveSample& s, double t) {
    if (lies_within(t, 0.35, 0.4)) shift.place(s, {0.0, lies_within(t, 0.37, 0.38) ? -depth : 0.0});
  };
  CHECK(only_record(shift).wrong_columns == 1);
  CHECK(only_record(ConstructedShift()).wrong_columns == 0);
  // If fourth gear engages on the way, the visit counts as a gear and not as a wrong column.
  shift.modify = [&](DriveSample& s, double t) {
    const double rest = rest_position(shift.gate, 4).y;
    if (lies_within(t, 0.35, 0.4)) shift.place(s, {0.0, lies_within(t, 0.36, 0.39) ? rest : 0.0});
    if (lies_within(t, 0.37, 0.38)) s.car.gear = 4;
  };
  CHECK(only_record(shift).wrong_columns == 0);
}

TEST_CASE("leaving the lever in a mouth ends the shift, once, and moving on begins the next shift") {
  // From 0.45 s on the lever is out of second gear and 1 mm past the mouth of third. The clutch comes up at 0.65 s. At
  // 6 s the clutch is pressed again, and third engages.
  ConstructedShift shift;
  shift.to = 8.0;
  const double mouth = shift.gate.half_aisle + shift.gate.chamfer + 0.001;
  shift.modify = [&](DriveSample& s, double t) {
    if (t < 0.45) return;
    const double rest = rest_position(shift.gate, 3).y;
    shift.place(s, {0.0, ConstructedShift::line(t, 6.2, mouth, 6.4, rest)});
    s.car.gear = s.lever.proxy.y > 0.9 * rest ? 3 : kNeutralGear;
    s.car.pedals.clutch = t < 6.0 ? s.car.pedals.clutch : t < 6.6 ? 1.0 : 0.0;
    s.car.clutch_locked = t > 6.7;
  };
  const std::vector<ShiftRecord> records = shift.records();
  REQUIRE(records.size() == 2);
  CHECK(records[0].from == 2);
  CHECK(records[0].to == kNeutralGear);
  CHECK_FALSE(records[0].missed);  // a lever in the mouth has not tried to engage the gear
  CHECK(records[0].end == doctest::Approx(100.66 + 2.0).epsilon(1e-4));
  CHECK(records[1].from == kNeutralGear);
  CHECK(records[1].to == 3);
  CHECK(records[1].begin == doctest::Approx(106.0).epsilon(1e-5));
  CHECK(records[1].lever_time < 0.4);
}

TEST_CASE("a lever that is off its rest position in an engaged gear leaves no shift open") {
  ConstructedShift shift;
  shift.to = 8.0;
  shift.modify = [&](DriveSample& s, double) {
    const Slot& two = slot_of(shift.gate, slot_of_gear(shift.gate, 2));
    shift.place(s, {rest_position(shift.gate, 2).x, 0.001 - two.engage_depth});
    s.car.gear = 2;
    s.car.pedals.clutch = 0.0;
    s.car.clutch_locked = true;
  };
  ShiftMeter meter(shift.car, shift.gate);
  for (const DriveSample& s : shift.samples()) CHECK_FALSE(meter.add(s).has_value());
  CHECK_FALSE(meter.is_open());
  CHECK_FALSE(meter.finish().has_value());
}

TEST_CASE("a shift is not given up while the lever still pushes against the ring, even with the clutch up") {
  ConstructedShift shift;
  shift.to = 6.0;
  shift.modify = [&](DriveSample& s, double t) {
    if (t < 0.45) return;
    shift.place(s, {0.0, 0.020});
    s.car.gear = kNeutralGear;
    s.car.sync = SyncPhase::synchronising;
    s.lever.f_h = {0.0, t < 3.0 ? 10.0 : 1.0};
  };
  const ShiftRecord record = only_record(shift);
  CHECK(record.missed);
  CHECK(record.end == doctest::Approx(103.0 + 2.0).epsilon(1e-4));
}

TEST_CASE(
    "if the drive ends during a shift, a gear left or tried is reported, a pedal movement without the lever is not") {
  const auto cut = [](double at) {
    ConstructedShift shift;
    shift.to = at;
    ShiftMeter meter(shift.car, shift.gate);
    for (const DriveSample& s : shift.samples()) CHECK_FALSE(meter.add(s).has_value());
    std::optional<ShiftRecord> record = meter.finish();
    CHECK_FALSE(meter.is_open());
    CHECK_FALSE(meter.finish().has_value());
    return record;
  };
  CHECK_FALSE(cut(0.15).has_value());  // the drive ends before the lever moves
  const auto out = cut(0.35);          // the drive ends with the lever in the aisle
  REQUIRE(out.has_value());
  CHECK(out->from == 2);
  CHECK(out->to == kNeutralGear);
  CHECK_FALSE(out->missed);
  CHECK(out->clutch_time == doctest::Approx(0.35 - 0.075).epsilon(0.01));
  const auto in = cut(0.55);  // third is engaged, but the clutch is still down
  REQUIRE(in.has_value());
  CHECK(in->to == 3);
  CHECK(in->end == doctest::Approx(100.55));
  CHECK(in->clutch_lag > 0.0);  // the clutch is still down, so it did not come up early
  CHECK(in->steps_out_of_place == 0);
  const auto settles = cut(0.80);  // the shift is over, but the jerk filter has not settled
  REQUIRE(settles.has_value());
  CHECK(settles->end == doctest::Approx(100.75).epsilon(1e-4));
}

TEST_CASE("neither a pedal pressed and released in gear, nor a lever that moves and returns in gear, is a shift") {
  ConstructedShift pedal;
  pedal.modify = [&](DriveSample& s, double) {
    pedal.place(s, rest_position(pedal.gate, 2));
    s.car.gear = 2;
  };
  CHECK(pedal.records().empty());
  ConstructedShift lever;
  lever.modify = [&](DriveSample& s, double t) {
    const Slot& two = slot_of(lever.gate, slot_of_gear(lever.gate, 2));
    const double back = lies_within(t, 0.2, 0.4) ? two.engage_depth - 0.001 : two.rest;
    lever.place(s, {rest_position(lever.gate, 2).x, -back});
    s.car.gear = 2;
    s.car.pedals.clutch = 0.0;
    s.car.clutch_locked = true;
  };
  CHECK(lever.records().empty());
}

TEST_CASE("giving up, or returning to the old gear, is a missed shift; choosing neutral is not") {
  const auto stops_at = [](double depth_fraction) {
    ConstructedShift shift;
    shift.to = 5.0;
    shift.modify = [shift, depth_fraction](DriveSample& s, double t) {
      const Slot& three = slot_of(shift.gate, slot_of_gear(shift.gate, 3));
      const double depth = lies_within(t, 0.45, 0.55) ? depth_fraction * three.release_depth : 0.0;
      if (t > 0.4) shift.place(s, {0.0, depth});
      if (t > 0.4) s.car.gear = kNeutralGear;
    };
    return only_record(shift);
  };
  const ShiftRecord missed = stops_at(1.01);
  CHECK(missed.missed);
  CHECK(missed.to == kNeutralGear);
  CHECK(missed.end == doctest::Approx(100.66 + 2.0).epsilon(1e-4));
  CHECK(missed.lever_time == 0.0);
  CHECK_FALSE(stops_at(0.0).missed);

  ConstructedShift back;
  back.modify = [&](DriveSample& s, double t) {
    const double y =
        t < 0.35 ? ConstructedShift::line(t, 0.2, -1.0, 0.3, 0.0) : ConstructedShift::line(t, 0.4, 0.0, 0.5, -1.0);
    back.place(s, {rest_position(back.gate, 2).x, -y * rest_position(back.gate, 2).y});
    s.car.gear = lies_within(t, 0.25, 0.48) ? kNeutralGear : 2;
  };
  const ShiftRecord returned = only_record(back);
  CHECK(returned.missed);
  CHECK(returned.from == 2);
  CHECK(returned.to == 2);
}

TEST_CASE("without the clutch the rev error is that just before the dogs engaged") {
  ConstructedShift shift;
  shift.modify = [&](DriveSample& s, double t) {
    s.car.pedals.clutch = 0.0;
    s.car.clutch_locked = true;
    s.car.engine_speed = shift.engine(3) + (s.car.gear == 3 ? 0.0 : 5.0);
    if (t < 0.2) s.car.engine_speed = shift.engine(2);
  };
  const ShiftRecord record = only_record(shift);
  CHECK(record.clutch_time == 0.0);
  CHECK(record.clutch_lead == 0.0);
  CHECK(record.clutch_lag == 0.0);
  CHECK(record.rev_error == doctest::Approx(5.0).epsilon(1e-9));
  CHECK(record.steps_out_of_place == 2);  // clutch down and clutch up are missing
}

TEST_CASE("guidance at any time during a shift makes it a guided shift") {
  CHECK_FALSE(only_record(ConstructedShift()).guided);
  CHECK(modified_shift([](DriveSample& s, double t) {
          s.controls.guidance = lies_within(t, 0.3, 0.301) ? 0.2 : 0.0;
        }).guided);
  // After guidance is switched off, its force fades for half a second. The shift begins at 0.075 s, so it is guided if
  // guidance was on after -0.425 s.
  CHECK(modified_shift([](DriveSample& s, double t) { s.controls.guidance = t < -0.4 ? 0.2 : 0.0; }).guided);
  CHECK_FALSE(modified_shift([](DriveSample& s, double t) { s.controls.guidance = t < -0.45 ? 0.2 : 0.0; }).guided);
}

TEST_CASE("a new shift before the clutch locks ends the previous one") {
  ConstructedShift shift;
  shift.modify = [](DriveSample& s, double t) {
    s.car.clutch_locked = t < 0.075;
    if (t > 0.9) s.car.pedals.clutch = 1.0;
  };
  ShiftMeter meter(shift.car, shift.gate);
  std::vector<ShiftRecord> records;
  for (const DriveSample& s : shift.samples()) {
    if (const auto record = meter.add(s)) records.push_back(*record);
  }
  REQUIRE(records.size() == 1);
  CHECK(records[0].to == 3);
  CHECK(records[0].end == doctest::Approx(100.9).epsilon(1e-4));
  CHECK(meter.is_open());
}

TEST_CASE("shifts are numbered in order, and a noisy pedal gives one shift") {
  ConstructedShift shift;
  shift.to = 3.0;
  shift.modify = [](DriveSample& s, double t) {
    s.car.pedals.clutch += 0.005 * (std::lround(1e3 * t) % 2 == 0 ? 1.0 : -1.0);
  };
  const ShiftRecord record = only_record(shift);
  CHECK(record.number == 0);
  CHECK(record.steps.size() == 5);
}

TEST_CASE("non-finite samples affect only the values that depend on them") {
  ConstructedShift shift;
  shift.modify = [](DriveSample& s, double t) {
    if (lies_within(t, 0.3, 0.31)) s.lever.f_h.x = std::numeric_limits<double>::quiet_NaN();
  };
  const ShiftRecord record = only_record(shift);
  CHECK(record.to == 3);
  CHECK(std::isfinite(record.lever_time));
  // The filters skip invalid samples, so an invalid sample before the shift must not affect its record.
  const auto drives = [](double none) {
    return modified_shift([none](DriveSample& s, double t) {
      s.car.acceleration = t > 0.3 ? 1.5 : 0.0;
      s.car.drive_torque = t < -0.2 ? 400.0 : 0.0;
      if (lies_within(t, -0.5, -0.499)) s.car.acceleration = s.car.drive_torque = none;
    });
  };
  const ShiftRecord clean = drives(0.0), spoilt_before = drives(std::numeric_limits<double>::quiet_NaN());
  CHECK(spoilt_before.jerk_peak == doctest::Approx(clean.jerk_peak).epsilon(1e-9));
  CHECK(spoilt_before.torque_gap == clean.torque_gap);
  CHECK(clean.jerk_peak > 10.0);
  CHECK(clean.torque_gap > 0.1);
}
