// Tests which driving errors are reported in the real car. The car is driven by scripts that do not use the error
// detector.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "app/lessons/assessment/clutch_release.h"
#include "tests/app/lessons/assessment/scripted_drive.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

// The number of errors of this kind. Notes are counted too, so the number does not depend on which kinds the lesson
// grades.
int count_errors(const LessonResult& result, ErrorKind kind) {
  return static_cast<int>(std::count_if(result.errors.begin(), result.errors.end(),
                                        [kind](const DrivingError& error) { return error.kind == kind; }));
}

std::string all_errors(const LessonResult& result) {
  std::string list;
  for (const DrivingError& error : result.errors) list += error_sentence(error) + " ";
  return list;
}

void out_of_gear(ScriptedDrive& d) {
  d.start_towards(kNeutralGear);
  d.until([&] { return d.in_aisle(); });
}

void blip(ScriptedDrive& d, double rpm) {
  d.feet.pedals.throttle = 0.5;
  d.until([&] { return d.rpm() > rpm; }, 2.0);
  d.feet.pedals.throttle = 0.0;
}

// Shifts from fourth into third at 55 km/h, with the engine at `factor` times the speed that third needs.
LessonResult down_with_blip(double factor) {
  ScriptedDrive d("rev_matching");
  d.clutch_down();
  d.lever(3);
  blip(d, factor * d.rpm_in(3));
  d.press(d.feet.pedals.clutch, 0.0, 0.5);
  d.wait(0.5);
  return d.leave();
}

// Moves off in first gear with a fifth of the throttle. Waits `lead` seconds at that throttle, then moves the clutch
// from the bite point to closed within `zone` seconds.
LessonResult launch(const std::string& car, double lead, double zone) {
  ScriptedDrive d("moving_off", LessonMode::follow_me, car);
  d.clutch_down();
  d.lever(1);
  d.press(d.feet.pedals.hand_brake, 0.0, 0.2);
  d.feet.pedals.throttle = 0.2;
  d.wait(lead);
  d.press(d.feet.pedals.clutch, d.car.clutch.bite, 0.1);
  d.press(d.feet.pedals.clutch, d.car.clutch.closed, zone);
  d.press(d.feet.pedals.clutch, 0.0, 0.1);
  d.wait(1.0);
  return d.leave();
}

}  // namespace

TEST_CASE(
    "a starter released too early leaves the engine stopped, without an error; held until it runs, the engine runs") {
  bool ran = false;
  for (int ms = 10; ms <= 1500; ms += ms < 200 ? 10 : 100) {
    CAPTURE(ms);
    ScriptedDrive d("start_and_stop");
    d.clutch_down();
    d.feet.ignition = d.feet.starter = true;
    d.wait(1e-3 * ms);
    d.feet.starter = false;
    d.wait(2.0);
    CHECK(d.now().running == (d.now().engine_speed > 0.5 * d.car.engine.idle));
    if (!d.now().running) CHECK(d.now().engine_speed == 0.0);
    // If the engine starts after some time of cranking, it must also start after any longer time.
    CHECK_FALSE(std::exchange(ran, d.now().running) > d.now().running);
    CHECK(count_errors(d.leave(), ErrorKind::stall) == 0);
  }
  CHECK(ran);
}

TEST_CASE("a blip into a lower gear is in order; a blip that overshoots is only a rev error") {
  const LessonResult right = down_with_blip(1.0);
  CAPTURE(all_errors(right));
  REQUIRE(right.shifts.size() == 1);
  CHECK(right.shifts[0].steps_out_of_place == 0);
  CHECK(right.errors.empty());
  const LessonResult over = down_with_blip(1.7);
  CAPTURE(all_errors(over));
  CHECK(count_errors(over, ErrorKind::rev_mismatch) == 1);
  CHECK(count_errors(over, ErrorKind::throttle_in_shift) == 0);
  CHECK(count_errors(over, ErrorKind::step_order) == 0);
}

TEST_CASE("double declutching with a blip is in order") {
  ScriptedDrive d("rev_matching");
  d.clutch_down();
  out_of_gear(d);
  d.press(d.feet.pedals.clutch, 0.0, 0.15);
  blip(d, d.rpm_in(3));
  d.clutch_down();
  d.lever(3);
  d.press(d.feet.pedals.clutch, 0.0, 0.5);
  d.wait(0.5);
  const LessonResult result = d.leave();
  CAPTURE(all_errors(result));
  REQUIRE(result.shifts.size() == 1);
  CHECK(result.shifts[0].steps_out_of_place == 0);
  CHECK(count_errors(result, ErrorKind::step_order) == 0);
  CHECK(count_errors(result, ErrorKind::throttle_in_shift) == 0);
}

TEST_CASE("a gear that was left and engaged again is not named as a missed gear") {
  ScriptedDrive d("down_through_the_gears");
  d.clutch_down();
  out_of_gear(d);
  d.wait(0.1);
  d.lever(5);
  d.press(d.feet.pedals.clutch, 0.0, 0.5);
  d.wait(0.5);
  const LessonResult result = d.leave();
  REQUIRE(result.shifts.size() == 1);
  CHECK(result.shifts[0].missed);
  CHECK(all_errors(result).find("Gear 5") == std::string::npos);
}

TEST_CASE("with the lever left in a mouth and the clutch up, the shift ends after 2 s, and the car then coasts") {
  ScriptedDrive d("rev_matching");
  d.clutch_down();
  out_of_gear(d);
  d.start_towards(3);
  d.until([&] { return !d.in_aisle(); });
  // in_aisle() becomes false 1 mm from the centre line, so after this wait the lever is 1 mm past the mouth.
  d.wait((d.gate.half_aisle + d.gate.chamfer) / d.speed);
  d.speed = 0.0;
  d.press(d.feet.pedals.clutch, 0.0, 0.3);
  d.wait(8.0);
  const LessonResult result = d.leave();
  REQUIRE(result.shifts.size() == 1);
  CHECK(result.shifts[0].from == 4);
  CHECK(result.shifts[0].to == kNeutralGear);
  CHECK(result.shifts[0].end - result.shifts[0].begin < 3.5);
  CHECK(count_errors(result, ErrorKind::coasting) == 1);
}

TEST_CASE(
    "shifting down through all gears at 75 km/h is too early, once per gear; at each gear's own speed it is not") {
  const auto down = [](double factor) {
    ScriptedDrive d("down_through_the_gears");
    for (const auto& [gear, km_per_h] : {std::pair{4, 55.0}, {3, 40.0}, {2, 25.0}}) {
      const double at = factor > 0.0 ? factor * km_per_h : 75.0;
      d.feet.pedals.brake = 0.2;
      d.until([&] { return d.km_per_h() < at; });
      d.feet.pedals.brake = 0.0;
      d.clutch_down();
      d.lever(gear);
      d.press(d.feet.pedals.clutch, 0.0, 0.8);
      d.wait(0.3);
    }
    return d.leave();
  };
  const LessonResult early = down(0.0), fit = down(1.0);
  CAPTURE(all_errors(early));
  CAPTURE(all_errors(fit));
  CHECK(count_errors(early, ErrorKind::early_downshift) == 3);  // one error for each of the three shifts
  CHECK(count_errors(fit, ErrorKind::early_downshift) == 0);
  CHECK(count_errors(fit, ErrorKind::coasting) == 0);
}

TEST_CASE(
    "shifting down through the gears on one clutch press is a slow shift; preselecting a gear for the stop is not") {
  ScriptedDrive d("down_through_the_gears");
  d.feet.pedals.brake = 0.2;
  d.until([&] { return d.km_per_h() < 54.0; });
  d.clutch_down();
  for (const auto& [gear, until_km_per_h] : {std::pair{4, 39.0}, {3, 24.0}, {2, 0.05}}) {
    d.lever(gear);
    d.until([&, below = until_km_per_h] { return d.km_per_h() < below; });
  }
  const LessonResult cheat = d.leave();
  CAPTURE(all_errors(cheat));
  CHECK(count_errors(cheat, ErrorKind::too_slow) == 1);

  ScriptedDrive ready("down_through_the_gears");
  ready.feet.pedals.brake = 0.3;
  ready.until([&] { return ready.km_per_h() < 32.0; });
  ready.clutch_down();
  ready.lever(1);
  ready.until([&] { return ready.is_standing(); });
  ready.wait(5.0);
  const LessonResult waits = ready.leave();
  CAPTURE(all_errors(waits));
  CHECK(count_errors(waits, ErrorKind::too_slow) + count_errors(waits, ErrorKind::coasting) == 0);
}

TEST_CASE("an ordinary launch does not jerk, a launch in 0.3 s does: a fifth of the throttle, up to 2200 rpm") {
  struct Launch {
    std::string car;
    double lead;
  };
  for (const Launch& of : {Launch{"hatchback", 1.0}, {"hatchback", 1.5}, {"diesel", 1.0}}) {
    CAPTURE(of.car);
    CAPTURE(of.lead);
    for (const double zone : {1.2, 1.6, 2.0}) {
      const LessonResult result = launch(of.car, of.lead, zone);
      CAPTURE(all_errors(result));
      CHECK(count_errors(result, ErrorKind::jerk) + count_errors(result, ErrorKind::stall) == 0);
    }
    const LessonResult result = launch(of.car, of.lead, 0.3);
    CAPTURE(all_errors(result));
    CHECK(count_errors(result, ErrorKind::jerk) + count_errors(result, ErrorKind::stall) == 1);
  }
}

// If the engine's speed is constant, half of its work becomes heat in the clutch, and half becomes kinetic energy of
// the car. The heat therefore grows with the square of the engine's speed. At `shift_high` the heat is burn_limit().
TEST_CASE("a launch in the real car makes the heat of the closed form, and is clutch burn above shift_high") {
  const auto held = [](double rpm) {
    ScriptedDrive d("moving_off");
    d.clutch_down();
    d.lever(1);
    d.press(d.feet.pedals.hand_brake, 0.0, 0.2);
    const auto hold = [&] { d.feet.pedals.throttle = std::clamp(0.1 + 0.01 * (rpm - d.rpm()), 0.0, 1.0); };
    d.until([&] { return hold(), d.rpm() > 0.97 * rpm; });
    d.feet.pedals.clutch = d.car.clutch.bite;
    d.until([&] {
      hold();
      d.feet.pedals.clutch = std::max(0.0, d.feet.pedals.clutch - 0.15e-3);
      return d.now().clutch_locked;
    });
    d.press(d.feet.pedals.clutch, 0.0, 0.3);
    d.wait(0.5);
    return d.leave();
  };
  const CarSpec car = ScriptedDrive("moving_off").car;
  const double high = car.engine.shift_high / 0.1047197551;  // [rpm]
  for (const double factor : {0.7, 0.85, 1.15, 1.3}) {
    const LessonResult result = held(factor * high);
    CAPTURE(factor);
    CAPTURE(all_errors(result));
    CHECK(count_errors(result, ErrorKind::clutch_burn) == (factor > 1.0 ? 1 : 0));
    CHECK(result.slip_energy == doctest::Approx(factor * factor * burn_limit(car, 1)).epsilon(0.1));
  }
}

// On a slope a slipping clutch transmits an additional torque against the car's weight. The additional heat is that
// torque times the slip, integrated over time. The limit allows for 3 s of launch, in which the slip is half of
// `shift_high` on average, and for 1.05 s on the handbrake at `shift_high`. That equals 1.5 s + 1.05 s = 2.55 s at
// `shift_high`.
TEST_CASE("uphill a launch may make additional heat for the slope; downhill and in reverse it may not") {
  for (const char* name : {"hatchback", "diesel"}) {
    const CarSpec car = ScriptedDrive("hill_start", LessonMode::follow_me, name).car;
    const double flat = burn_limit(car, 1), slope = std::atan(0.1);
    const double torque = 9.81 * car.body.mass * std::sin(slope) / (shaft_per_road(car, 1) * car.gearbox.efficiency);
    CHECK(burn_limit(car, 1, slope) == doctest::Approx(flat + torque * car.engine.shift_high * 2.55));
    CHECK(burn_limit(car, 1, -slope) == flat);
    CHECK(burn_limit(car, kReverseGear, slope) == burn_limit(car, kReverseGear));
  }
}
