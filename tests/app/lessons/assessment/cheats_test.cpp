// In each drive in this file, the driver skips a lesson's task or does something else instead. No such drive may pass.
// Each of these drives passed an earlier version of the assessment.
#include <algorithm>
#include <initializer_list>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "tests/app/lessons/assessment/honest_drives.h"

using namespace gearshift;
using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

void into_first(ScriptedDrive& d) {
  d.clutch_down();
  d.lever(1);
  d.press(d.feet.pedals.hand_brake, 0.0, 0.3);
}

// Raises the clutch pedal so little that the clutch does not transmit torque yet, and presses the pedal again.
void twitch_of_the_clutch(ScriptedDrive& d) {
  d.press(d.feet.pedals.clutch, 0.78, 0.1);
  d.wait(0.3);
  d.clutch_down();
  d.wait(0.5);
}

void started_and_never_moved(ScriptedDrive& d) {
  d.clutch_down();
  Able{d}.start_engine();
  into_first(d);
  twitch_of_the_clutch(d);
  d.lever(kNeutralGear);
  d.press(d.feet.pedals.hand_brake, 1.0, 0.3);
  d.feet.ignition = false;
}

void moved_off_once(ScriptedDrive& d) {
  into_first(d);
  twitch_of_the_clutch(d);
  Able{d}.launch();
  Able{d}.accelerate_to(14.0);
}

// Moves off with throttle and then presses the clutch, so that the car coasts instead of creeping.
void coasted_instead_of_creeping(ScriptedDrive& d) {
  Able a{d};
  into_first(d);
  for (int i = 0; i < 3; ++i) {
    a.launch();
    a.lift();
    d.clutch_down();
    d.until([&] { return d.km_per_h() < 5.9; });
    d.wait(2.5);
    a.stop();
  }
}

void first_creep_left_out(ScriptedDrive& d) {
  into_first(d);
  twitch_of_the_clutch(d);
  for (int i = 0; i < 2; ++i) {
    d.feet.pedals.brake = 0.0;
    const double bite = d.car.clutch.bite;
    d.press(d.feet.pedals.clutch, bite - 0.10, 1.5);
    d.until([&] { return d.km_per_h() > 3.2; }, 8.0);
    d.press(d.feet.pedals.clutch, bite - 0.07, 0.3);
    d.wait(2.5);
    Able{d}.stop();
  }
}

void never_drove_backwards(ScriptedDrive& d) {
  d.clutch_down();
  d.wait(2.0);
  d.lever(kReverseGear);
  d.press(d.feet.pedals.hand_brake, 0.0, 0.3);
  twitch_of_the_clutch(d);
  d.lever(1);
  Able{d}.launch();
  Able{d}.accelerate_to(14.0);
}

void back_up(ScriptedDrive& d, double throttle) {
  d.clutch_down();
  d.wait(2.0);
  d.lever(kReverseGear);
  d.press(d.feet.pedals.hand_brake, 0.0, 0.3);
  d.press(d.feet.pedals.throttle, throttle, 0.3);
  d.press(d.feet.pedals.clutch, d.car.clutch.bite, 0.3);
  d.press(d.feet.pedals.clutch, 0.0, 2.5);
}

void backed_up_at_full_speed(ScriptedDrive& d) {
  back_up(d, 0.5);
  d.until([&] { return d.km_per_h() < -17.0; });
  Able{d}.stop();
  d.lever(1);
  Able{d}.launch();
  Able{d}.accelerate_to(14.0);
}

void first_while_rolling_back(ScriptedDrive& d) {
  back_up(d, 0.25);
  d.until([&] { return d.now().distance < -5.2; });
  d.clutch_down();
  d.press(d.feet.pedals.throttle, 0.0, 0.1);
  d.press(d.feet.pedals.brake, 0.2, 0.1);
  d.until([&] { return d.km_per_h() > -3.4; });
  d.press(d.feet.pedals.brake, 0.0, 0.05);
  d.lever(1);
  Able{d}.stop();
  Able{d}.launch();
  Able{d}.accelerate_to(14.0);
}

// Shifts down as the car slows, without releasing the clutch between the gears.
void down_with_one_press(ScriptedDrive& d) {
  d.press(d.feet.pedals.brake, 0.2, 0.2);
  d.until([&] { return d.km_per_h() < 54.0; });
  d.clutch_down();
  d.lever(4);
  d.until([&] { return d.km_per_h() < 39.0; });
  d.lever(3);
  d.until([&] { return d.km_per_h() < 24.0; });
  d.lever(2);
  d.until([&] { return d.is_standing(); });
}

void down_through_neutral(ScriptedDrive& d) {
  d.press(d.feet.pedals.brake, 0.3, 0.2);
  d.clutch_down();
  d.start_towards(kNeutralGear);
  d.until([&] { return d.km_per_h() < 20.0; });
  for (const int gear : {4, 3, 2}) d.lever(gear);
  d.until([&] { return d.is_standing(); });
}

void down_all_at_once(ScriptedDrive& d) {
  for (const int gear : {4, 3, 2}) {
    Able{d}.shift(gear);
    d.wait(0.4);
  }
  Able{d}.stop(0.4);
}

void up_with_one_press(ScriptedDrive& d) {
  Able{d}.accelerate_to(24.0);
  Able{d}.lift();
  d.clutch_down();
  for (int gear = 2; gear <= 5; ++gear) {
    d.until([&] { return d.rpm() < 2150.0; });
    d.lever(gear);
    if (gear == 5) break;
    d.feet.pedals.throttle = 0.5;
    d.until([&] { return d.rpm() > 2210.0; }, 3.0);
    d.feet.pedals.throttle = 0.0;
  }
  d.press(d.feet.pedals.clutch, 0.0, 0.6);
}

void skipped_with_one_press(ScriptedDrive& d) {
  Able{d}.accelerate_to(45.5);
  Able{d}.lift();
  d.clutch_down();
  d.lever(4);
  d.press(d.feet.pedals.brake, 0.2, 0.2);
  d.until([&] { return d.km_per_h() < 27.5; });
  d.press(d.feet.pedals.brake, 0.0, 0.1);
  d.lever(2);
  d.press(d.feet.pedals.clutch, 0.0, 0.8);
}

void one_blip_for_two(ScriptedDrive& d) {
  d.clutch_down();
  d.lever(3);
  d.press(d.feet.pedals.brake, 0.2, 0.2);
  d.until([&] { return d.km_per_h() < 34.5; });
  d.press(d.feet.pedals.brake, 0.0, 0.1);
  Able{d}.shift_with_blip(2);
}

void blips(ScriptedDrive& d, double rpm) {
  for (const int gear : {3, 2}) {
    Able{d}.lift();
    d.clutch_down();
    d.lever(gear);
    d.feet.pedals.throttle = 0.7;
    d.until([&] { return d.rpm() > rpm; }, 3.0);
    d.feet.pedals.throttle = 0.0;
    d.press(d.feet.pedals.clutch, 0.0, 0.6);
    d.wait(0.3);
    if (gear == 3) Able{d}.slow_to(34.0);
  }
}

void wild_blips(ScriptedDrive& d) {
  blips(d, 4200.0);
}

void another_gate_down_with_one_press(ScriptedDrive& d) {
  for (int gear = 2; gear <= 4; ++gear) {
    Able{d}.accelerate_to_rpm(2100.0);
    Able{d}.shift(gear);
  }
  Able{d}.lift();
  d.clutch_down();
  d.press(d.feet.pedals.brake, 0.2, 0.2);
  d.until([&] { return d.km_per_h() < 39.0; });
  d.lever(3);
  d.until([&] { return d.km_per_h() < 24.0; });
  d.press(d.feet.pedals.brake, 0.0, 0.1);
  d.lever(2);
  d.press(d.feet.pedals.clutch, 0.0, 0.8);
}

void stop_with(ScriptedDrive& d, double first, double then) {
  Able{d}.accelerate_to(50.1);
  d.feet.pedals.throttle = 0.0;
  d.wait(0.4);
  d.feet.pedals.brake = first;
  d.wait(0.02);
  d.feet.pedals.brake = then;
  d.until([&] { return d.km_per_h() < 12.0; });
  d.clutch_down();
  d.until([&] { return d.is_standing(); });
  d.wait(0.3);
  d.lever(kNeutralGear);
  d.press(d.feet.pedals.hand_brake, 1.0, 0.3);
}

void tapped_the_brake(ScriptedDrive& d) {
  stop_with(d, 0.81, 0.1);
}

void braked_a_little(ScriptedDrive& d) {
  stop_with(d, 0.2, 0.2);
}

void braked_by_half(ScriptedDrive& d) {
  stop_with(d, 0.4, 0.4);
}

// Releases the handbrake before the clutch transmits torque, so that the car rolls back.
void let_the_hill_have_it(ScriptedDrive& d) {
  d.clutch_down();
  d.lever(1);
  d.press(d.feet.pedals.throttle, 0.1, 0.3);
  d.press(d.feet.pedals.clutch, 0.8, 0.3);
  d.press(d.feet.pedals.hand_brake, 0.0, 0.3);
  Able{d}.launch();
  Able{d}.accelerate_to(11.0, 0.6);
}

void coasted_in_neutral(ScriptedDrive& d) {
  Able a{d};
  for (int gear = 2; gear <= 5; ++gear) {
    a.accelerate([&] { return d.now().shift_advice > 0; }, 0.6);
    if (gear == 4) {
      for (int i = 0; i < 5; ++i) {
        a.lift();
        d.clutch_down();
        d.start_towards(kNeutralGear);
        d.until([&] { return d.in_aisle(); }, 2.0);
        d.press(d.feet.pedals.clutch, 0.0, 0.4);
        d.wait(6.5);
        d.clutch_down();
        d.lever(3);
        d.press(d.feet.pedals.clutch, 0.0, 0.8);
        a.accelerate([&] { return d.now().shift_advice > 0; }, 0.6);
      }
    }
    a.shift(gear);
  }
  a.accelerate_to(70.5, 0.6);
}

// Shifts down only when the car is so slow that idle speed suffices for the lower gear, so there are no revs to match.
void no_blip_at_idle(ScriptedDrive& d) {
  for (const int gear : {3, 2}) {
    d.clutch_down();
    d.feet.pedals.brake = 0.3;
    d.until([&, low = gear] { return d.rpm_in(low) < 770.0; });
    d.feet.pedals.brake = 0.0;
    d.lever(gear);
    d.press(d.feet.pedals.clutch, 0.0, 0.8);
    Able{d}.accelerate_to_rpm(1400.0);
    Able{d}.lift();
    d.wait(0.5);
  }
}

void gears_at_one_speed(ScriptedDrive& d, std::initializer_list<int> gears) {
  for (const int gear : gears) {
    Able{d}.shift(gear, 1.2);
    d.wait(0.3);
  }
}

void skipped_at_25(ScriptedDrive& d) {
  gears_at_one_speed(d, {4, 2});
}

void another_gate_at_12(ScriptedDrive& d) {
  gears_at_one_speed(d, {2, 3, 4, 3, 2});
}

void six_speed_at_35(ScriptedDrive& d) {
  Able{d}.accelerate_to(35.0);
  gears_at_one_speed(d, {3, 4, 5, 6, 4, 3});
  Able{d}.stop();
  honest::back_up(d, 2.2);
}

void down_at_30(ScriptedDrive& d) {
  Able{d}.slow_to(30.0);
  gears_at_one_speed(d, {4, 3, 2});
  Able{d}.stop();
}

void down_too_fast(ScriptedDrive& d) {
  for (const auto& [gear, km_per_h] : {std::pair{4, 70.0}, {3, 60.0}, {2, 43.0}}) {
    Able{d}.slow_to(km_per_h);
    Able{d}.shift_with_blip(gear);
    d.wait(0.4);
  }
  Able{d}.stop();
}

void up_at_3400_rpm(ScriptedDrive& d) {
  for (int gear = 2; gear <= 5; ++gear) {
    Able{d}.accelerate_to_rpm(3420.0);
    Able{d}.shift(gear);
  }
}

void crept_with_throttle(ScriptedDrive& d) {
  into_first(d);
  for (int i = 0; i < 3; ++i) {
    d.feet.pedals.brake = 0.0;
    d.press(d.feet.pedals.clutch, d.car.clutch.bite, 0.3);
    d.until(
        [&] {
          Able{d}.hold_revs(1650.0);
          d.feet.pedals.clutch -= 0.2e-3;
          return d.km_per_h() > 4.5;
        },
        8.0);
    d.feet.pedals.throttle = 0.0;
    d.feet.pedals.clutch = d.car.clutch.bite - 0.05;
    d.wait(2.6);
    Able{d}.stop();
  }
}

void howled_up_the_hill(ScriptedDrive& d) {
  const auto hold = [&] { Able{d}.hold_revs(4500.0); };
  d.clutch_down();
  d.lever(1);
  d.until([&] { return hold(), d.rpm() > 4000.0; }, 5.0);
  d.press(d.feet.pedals.clutch, d.car.clutch.bite, 0.3);
  d.until([&] { return hold(), d.feet.pedals.clutch -= 0.15e-3, d.now().clutch_torque > 60.0; }, 5.0);
  d.feet.pedals.hand_brake = 0.0;
  d.until(
      [&] {
        hold();
        d.feet.pedals.clutch = std::max(0.0, d.feet.pedals.clutch - 0.05e-3);
        return d.now().clutch_locked && d.feet.pedals.clutch < 0.2;
      },
      10.0);
  d.press(d.feet.pedals.clutch, 0.0, 0.3);
  Able{d}.accelerate_to(12.0);
}

void hill_start_by_the_hand_brake(ScriptedDrive& d) {
  honest::hill_start(d);
}

void rolled_down_in_neutral(ScriptedDrive& d) {
  honest::foot_for_hand_brake(d);
  d.press(d.feet.pedals.brake, 0.0, 0.3);
  d.wait(15.0);
}

void rode_the_brake(ScriptedDrive& d) {
  Able{d}.slow_to(29.0);
  Able{d}.shift_with_blip(2);
  d.press(d.feet.pedals.brake, 0.12, 0.3);
  d.wait(12.0);
}

void through_the_bend_in_fourth(ScriptedDrive& d) {
  Able{d}.slow_to(44.0);
  d.press(d.feet.pedals.throttle, 0.2, 0.3);
  d.wait(20.0);
}

void through_the_bend_on_the_clutch(ScriptedDrive& d) {
  Able{d}.lift();
  d.clutch_down();
  d.lever(3);
  d.wait(20.0);
}

void hesitated_in_the_gap(ScriptedDrive& d) {
  d.pause = 4.0;
  honest::away_in_time(d);
}

void took_a_breath_after_the_stall(ScriptedDrive& d) {
  d.pause = 3.0;
  honest::stalled_in_a_junction(d);
}

void changed_feet_before_the_bite(ScriptedDrive& d) {
  d.clutch_down();
  d.lever(1);
  d.press(d.feet.pedals.brake, 0.6, 0.2);
  d.press(d.feet.pedals.brake, 0.0, 0.2);
  d.wait(1.6);
  Able{d}.launch();
  Able{d}.accelerate_to(11.0, 0.6);
}

void rolled_forward_before_reversing(ScriptedDrive& d) {
  d.clutch_down();
  d.wait(2.0);
  d.lever(kReverseGear);
  d.press(d.feet.pedals.hand_brake, 0.0, 0.3);
  d.wait(4.0);
}

void let_it_run_backwards(ScriptedDrive& d) {
  d.clutch_down();
  d.wait(2.0);
  d.lever(kReverseGear);
  honest::foot_for_hand_brake(d);
  d.press(d.feet.pedals.brake, 0.0, 0.3);
  d.wait(8.0);
}

void parked_in_neutral(ScriptedDrive& d) {
  d.press(d.feet.pedals.brake, 0.6, 0.3);
  d.feet.ignition = false;
  d.wait(1.0);
  d.press(d.feet.pedals.brake, 0.0, 1.0);
  d.wait(5.0);
}

void bumped_with_the_starter(ScriptedDrive& d) {
  d.clutch_down();
  Able{d}.start_engine();
}

struct Cheat {
  const char* lesson;
  void (*drive)(ScriptedDrive&);
  LessonEnd end;  // how the run ends; `left` if a step could not be completed
  const char* name;
};

constexpr Cheat kCheats[] = {
    {"start_and_stop", started_and_never_moved, LessonEnd::left, "started and never moved"},
    {"bite_point", coasted_instead_of_creeping, LessonEnd::aborted, "coasted instead of creeping"},
    {"bite_point", first_creep_left_out, LessonEnd::left, "first creep left out"},
    {"moving_off", moved_off_once, LessonEnd::left, "moved off once instead of twice"},
    {"stop_and_go", moved_off_once, LessonEnd::left, "moved off once instead of three times"},
    {"hill_start_with_foot_brake", changed_feet_before_the_bite, LessonEnd::aborted, "feet changed before the bite"},
    {"hold_on_the_clutch", hill_start_by_the_hand_brake, LessonEnd::left, "drove off without a hold"},
    {"downhill_start", rolled_down_in_neutral, LessonEnd::aborted, "rolled down in neutral"},
    {"engine_braking", rode_the_brake, LessonEnd::left, "rode the brake"},
    {"down_before_a_bend", through_the_bend_in_fourth, LessonEnd::aborted, "through the bend in fourth"},
    {"down_before_a_bend", through_the_bend_on_the_clutch, LessonEnd::aborted, "through the bend with the clutch down"},
    {"away_in_time", hesitated_in_the_gap, LessonEnd::done, "hesitated in the gap"},
    {"stalled_in_a_junction", took_a_breath_after_the_stall, LessonEnd::done, "took a breath after the stall"},
    {"reverse_uphill", rolled_forward_before_reversing, LessonEnd::aborted, "rolled forward before reversing"},
    {"reverse_downhill", let_it_run_backwards, LessonEnd::aborted, "let it run backwards"},
    {"parking_in_gear", parked_in_neutral, LessonEnd::aborted, "parked in neutral"},
    {"bump_start", bumped_with_the_starter, LessonEnd::aborted, "bumped with the starter"},
    {"up_through_the_gears", up_with_one_press, LessonEnd::left, "up with one press of the clutch"},
    {"down_through_the_gears", down_with_one_press, LessonEnd::left, "down with one press of the clutch"},
    {"down_through_the_gears", down_through_neutral, LessonEnd::left, "down through neutral"},
    {"down_through_the_gears", down_all_at_once, LessonEnd::done, "down to second at once, at 75 km/h"},
    {"reverse", never_drove_backwards, LessonEnd::left, "never drove backwards"},
    {"reverse", backed_up_at_full_speed, LessonEnd::aborted, "backed up at full speed"},
    {"reverse", first_while_rolling_back, LessonEnd::aborted, "first while rolling back"},
    {"hill_start", let_the_hill_have_it, LessonEnd::aborted, "let the hill have it"},
    {"emergency_stop", tapped_the_brake, LessonEnd::done, "tapped the brake and rolled out"},
    {"emergency_stop", braked_a_little, LessonEnd::done, "braked a little"},
    {"emergency_stop", braked_by_half, LessonEnd::done, "braked by two fifths"},
    {"skip_shifts", skipped_with_one_press, LessonEnd::left, "2 to 4 to 2 with one press of the clutch"},
    {"eco_driving", coasted_in_neutral, LessonEnd::done, "coasted in neutral for most of the way"},
    {"rev_matching", one_blip_for_two, LessonEnd::left, "one blip for two shifts"},
    {"heel_and_toe", honest::rev_matching, LessonEnd::aborted, "no brake"},
    {"rev_matching", wild_blips, LessonEnd::done, "blips to 4200 rpm"},
    {"rev_matching", no_blip_at_idle, LessonEnd::done, "no blip, at 15 km/h"},
    {"skip_shifts", skipped_at_25, LessonEnd::done, "2 to 4 to 2 at 25 km/h"},
    {"another_gate", another_gate_at_12, LessonEnd::done, "every gear at 12 km/h"},
    {"six_speed", six_speed_at_35, LessonEnd::done, "every gear at 35 km/h"},
    {"down_through_the_gears", down_at_30, LessonEnd::done, "every gear at 30 km/h"},
    {"down_through_the_gears", down_too_fast, LessonEnd::done, "at 70, 60 and 43 km/h"},
    {"up_through_the_gears", up_at_3400_rpm, LessonEnd::done, "at 3400 rpm"},
    {"bite_point", crept_with_throttle, LessonEnd::aborted, "crept with throttle"},
    {"hill_start", howled_up_the_hill, LessonEnd::done, "howled up the hill"},
    {"another_gate", another_gate_down_with_one_press, LessonEnd::left, "down with one press of the clutch"},
};

}  // namespace

TEST_CASE("a lesson that was not driven as its goal says is not passed") {
  for (const Cheat& cheat : kCheats) {
    ScriptedDrive drive(cheat.lesson);
    cheat.drive(drive);
    const LessonResult& result = drive.finish();
    CAPTURE(std::string(cheat.lesson));
    CAPTURE(std::string(cheat.name));
    CAPTURE(result.grade);
    CAPTURE(errors_text(result));
    CAPTURE(result.why);
    CHECK(result.end == cheat.end);
    CHECK_FALSE(result.passed);
  }
}
