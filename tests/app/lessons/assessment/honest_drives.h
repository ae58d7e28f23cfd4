// The shipped lessons, driven by scripts that do exactly what each goal asks for, as a competent driver would.
//
// The scripts use the goal and not the prompts, except for a prompt that is a signal to react to.
#pragma once

#include <utility>
#include <vector>

#include "tests/app/lessons/assessment/scripted_drive.h"

namespace gearshift::test::honest {

inline void into_first(ScriptedDrive& d) {
  d.clutch_down();
  d.lever(1);
  d.press(d.feet.pedals.hand_brake, 0.0, 0.3);
}

inline void start_and_stop(ScriptedDrive& d) {
  Able a{d};
  d.clutch_down();
  a.start_engine();
  into_first(d);
  const double from = d.now().distance;
  a.launch(1200.0);
  a.lift();
  d.until([&] { return d.now().distance - from > 6.0; });
  a.stop();
  d.lever(haptics::kNeutralGear);
  d.press(d.feet.pedals.hand_brake, 1.0, 0.3);
  d.feet.ignition = false;
}

// Drives at idle speed or below, stops in neutral, and finally applies the handbrake.
inline void start_and_stop_gently(ScriptedDrive& d) {
  d.clutch_down();
  Able{d}.start_engine();
  into_first(d);
  d.press(d.feet.pedals.clutch, d.car.clutch.bite, 0.3);
  d.press(d.feet.pedals.clutch, 0.55, 2.0);
  d.wait(2.0);
  d.press(d.feet.pedals.clutch, 0.0, 2.5);
  d.wait(4.0);
  d.clutch_down();
  d.lever(haptics::kNeutralGear);
  d.press(d.feet.pedals.clutch, 0.0, 0.4);
  d.press(d.feet.pedals.brake, 0.3, 0.3);
  d.until([&] { return d.is_standing(); });
  d.wait(0.3);
  d.feet.ignition = false;
  d.wait(0.3);
  d.press(d.feet.pedals.hand_brake, 1.0, 0.3);
}

inline void bite_point(ScriptedDrive& d) {
  into_first(d);
  for (int i = 0; i < 3; ++i) {
    d.feet.pedals.brake = 0.0;
    const double bite = d.car.clutch.bite;
    d.press(d.feet.pedals.clutch, bite, 0.4);
    d.press(d.feet.pedals.clutch, bite - 0.10, 1.5);
    d.until([&] { return d.km_per_h() > 3.2; }, 8.0);
    d.press(d.feet.pedals.clutch, bite - 0.07, 0.3);
    d.wait(2.5);
    Able{d}.stop();
  }
}

inline void moving_off(ScriptedDrive& d) {
  Able a{d};
  into_first(d);
  for (int i = 0; i < 2; ++i) {
    a.launch();
    a.accelerate_to(13.0);
    a.stop();
  }
}

inline void up_through_the_gears(ScriptedDrive& d) {
  Able a{d};
  for (int gear = 2; gear <= 5; ++gear) {
    a.accelerate_to_rpm(2200.0);
    a.shift(gear);
  }
}

inline void down_through_the_gears(ScriptedDrive& d) {
  Able a{d};
  for (const auto& [gear, speed] : std::vector<std::pair<int, double>>{{4, 54.0}, {3, 39.0}, {2, 24.0}}) {
    a.slow_to(speed);
    a.shift_with_blip(gear);
    d.wait(0.5);
  }
  a.stop();
}

// Releases the clutch slowly, and shifts into each gear a little before the car reaches that gear's stated speed.
inline void down_without_a_blip(ScriptedDrive& d) {
  Able a{d};
  for (const auto& [gear, speed] : std::vector<std::pair<int, double>>{{4, 57.0}, {3, 41.5}, {2, 26.0}}) {
    a.slow_to(speed);
    a.shift(gear, 1.0);
    d.wait(0.5);
  }
  a.stop();
}

inline void back_up(ScriptedDrive& d, double metres) {
  d.wait(3.0);
  d.lever(haptics::kReverseGear);
  d.press(d.feet.pedals.hand_brake, 0.0, 0.3);
  const double from = d.now().distance;
  d.feet.pedals.brake = 0.0;
  const double bite = d.car.clutch.bite;
  d.press(d.feet.pedals.clutch, bite, 0.4);
  d.press(d.feet.pedals.clutch, bite - 0.12, 1.5);
  d.until([&] { return from - d.now().distance > metres; });
  d.clutch_down();
  d.press(d.feet.pedals.brake, 0.3, 0.3);
  d.until([&] { return d.is_standing(); });
  d.wait(0.3);
}

inline void reverse(ScriptedDrive& d) {
  Able a{d};
  d.clutch_down();
  back_up(d, 5.2);
  d.lever(1);
  a.launch();
  a.accelerate_to(11.0);
}

// [N m] The clutch torque that keeps the car from rolling down the slope in this gear.
inline double hill_torque(const ScriptedDrive& d, int gear = 1) {
  const double weight = 9.81 * d.car.body.mass * std::sin(d.lesson.start.slope);
  return std::abs(weight / (vehicle::shaft_per_road(d.car, gear) * d.car.gearbox.efficiency));
}

// Releases the clutch until it holds the car.
inline void clutch_to_hold(ScriptedDrive& d) {
  d.press(d.feet.pedals.clutch, d.car.clutch.bite, 0.4);
  d.until(
      [&] {
        d.feet.pedals.clutch -= 0.1e-3;
        return d.now().clutch_torque > 1.05 * hill_torque(d);
      },
      5.0);
}

// Releases the clutch until it transmits enough torque, and only then releases the handbrake.
inline void hill_start(ScriptedDrive& d) {
  Able a{d};
  d.clutch_down();
  d.lever(1);
  d.press(d.feet.pedals.throttle, 0.1, 0.3);
  d.press(d.feet.pedals.clutch, d.car.clutch.bite, 0.4);
  d.until(
      [&] {
        a.hold_revs(1600.0);
        d.feet.pedals.clutch -= 0.1e-3;
        return d.now().clutch_torque > 1.05 * hill_torque(d);
      },
      5.0);
  const double begun = d.time();
  d.until([&] {
    a.hold_revs(1600.0);
    d.feet.pedals.hand_brake = std::max(0.0, 1.0 - (d.time() - begun) / 0.3);
    return d.feet.pedals.hand_brake == 0.0;
  });
  a.launch_from_bite();
  a.accelerate_to(11.0, 0.6);
}

// Holds the car with the foot brake instead of the handbrake, so the foot must move to the throttle quickly.
inline void hill_start_with_the_foot_brake(ScriptedDrive& d) {
  Able a{d};
  d.clutch_down();
  d.lever(1);
  d.press(d.feet.pedals.brake, 0.4, 0.2);
  d.press(d.feet.pedals.hand_brake, 0.0, 0.3);
  clutch_to_hold(d);
  d.feet.pedals.brake = 0.0;
  a.launch_from_bite();
  a.accelerate_to(11.0, 0.6);
}

inline void stop_and_go(ScriptedDrive& d) {
  into_first(d);
  for (int i = 0; i < 3; ++i) {
    Able{d}.launch();
    Able{d}.accelerate_to(9.0);
    Able{d}.stop();
  }
}

// Changes from the foot brake to the throttle only when the clutch holds the car.
inline void hill_start_on_the_foot_brake(ScriptedDrive& d) {
  Able a{d};
  d.press(d.feet.pedals.brake, 0.6, 0.2);
  d.clutch_down();
  d.lever(1);
  clutch_to_hold(d);
  d.press(d.feet.pedals.brake, 0.0, 0.15);
  a.launch_from_bite();
  a.accelerate_to(11.0, 0.6);
}

// Holds the car still for four seconds, and corrects with the clutch.
inline void hold_on_the_clutch(ScriptedDrive& d) {
  Able a{d};
  d.clutch_down();
  d.lever(1);
  d.press(d.feet.pedals.clutch, d.car.clutch.bite, 0.4);
  const auto slip = [&](double rate) {
    a.hold_revs(1500.0);
    d.feet.pedals.clutch += rate * 1e-3;
  };
  d.until([&] { return slip(-0.1), d.now().clutch_torque > hill_torque(d); }, 5.0);
  const double begun = d.time();
  d.until([&] {
    slip(0.0);
    d.feet.pedals.hand_brake = std::max(0.0, 1.0 - (d.time() - begun) / 0.3);
    return d.feet.pedals.hand_brake == 0.0;
  });
  d.until([&] { return slip(d.km_per_h() > 0.05 ? 0.05 : d.km_per_h() < -0.05 ? -0.1 : 0.0), d.time() - begun > 4.3; });
  a.launch_from_bite();
  a.accelerate_to(11.0, 0.6);
}

inline void foot_for_hand_brake(ScriptedDrive& d) {
  d.press(d.feet.pedals.brake, 0.4, 0.3);
  d.press(d.feet.pedals.hand_brake, 0.0, 0.3);
}

inline void stop_with_hand_brake(ScriptedDrive& d) {
  Able{d}.stop();
  d.press(d.feet.pedals.hand_brake, 1.0, 0.3);
}

inline void downhill_start(ScriptedDrive& d) {
  d.clutch_down();
  d.lever(1);
  foot_for_hand_brake(d);
  d.press(d.feet.pedals.brake, 0.0, 0.3);
  d.until([&] { return d.km_per_h() > 4.0; });
  d.press(d.feet.pedals.clutch, d.car.clutch.bite, 0.3);
  d.press(d.feet.pedals.clutch, 0.0, 1.5);
  d.until([&] { return d.km_per_h() > 9.2; });
  d.wait(1.2);
  stop_with_hand_brake(d);
}

inline void engine_braking(ScriptedDrive& d) {
  Able{d}.slow_to(29.0);
  Able{d}.shift_with_blip(2);
  d.wait(9.0);
  Able{d}.stop();
}

inline void down_before_a_bend(ScriptedDrive& d) {
  Able a{d};
  a.slow_to(44.0);
  a.shift_with_blip(3);
  d.press(d.feet.pedals.throttle, 0.15, 0.3);
  d.until([&] { return d.now().distance > 285.0; });
  a.accelerate_to(61.0);
}

inline void on_call(ScriptedDrive& d) {
  d.until([&] { return d.run.view().prompt.starts_with("Go!"); });
  d.wait(0.8 + d.pause);
}

inline void away_in_time(ScriptedDrive& d) {
  into_first(d);
  for (int i = 0; i < 2; ++i) {
    on_call(d);
    Able{d}.launch(1800.0);
    Able{d}.accelerate_to(15.5, 0.6);
    Able{d}.stop();
  }
}

inline void stalled_in_a_junction(ScriptedDrive& d) {
  d.wait(0.8 + 3.0 * d.pause);
  d.clutch_down();
  Able{d}.start_engine();
  Able{d}.launch();
  Able{d}.accelerate_to(12.5);
}

// At walking pace, with the clutch at the bite point.
inline void reverse_uphill(ScriptedDrive& d) {
  Able a{d};
  d.clutch_down();
  d.wait(3.0);
  d.lever(haptics::kReverseGear);
  d.press(d.feet.pedals.clutch, d.car.clutch.bite, 0.4);
  const auto creep = [&](double rate) {
    a.hold_revs(1500.0);
    d.feet.pedals.clutch += rate * 1e-3;
  };
  d.until([&] { return creep(-0.1), d.now().clutch_torque > 1.05 * hill_torque(d, haptics::kReverseGear); }, 5.0);
  const double begun = d.time(), from = d.now().distance;
  d.until([&] {
    creep(0.0);
    d.feet.pedals.hand_brake = std::max(0.0, 1.0 - (d.time() - begun) / 0.3);
    return d.feet.pedals.hand_brake == 0.0;
  });
  d.until([&] { return creep(d.km_per_h() > -4.0 ? -0.06 : 0.12), from - d.now().distance > 5.2; });
  d.feet.pedals.throttle = 0.0;
  stop_with_hand_brake(d);
}

inline void reverse_downhill(ScriptedDrive& d) {
  d.clutch_down();
  d.wait(3.0);
  d.lever(haptics::kReverseGear);
  foot_for_hand_brake(d);
  const double from = d.now().distance;
  d.until([&] {
    d.feet.pedals.brake = std::clamp(0.09 - 0.04 * (d.km_per_h() + 4.0), 0.0, 0.4);
    return from - d.now().distance > 5.2;
  });
  stop_with_hand_brake(d);
}

inline void parking_in_gear(ScriptedDrive& d) {
  d.press(d.feet.pedals.brake, 0.6, 0.3);
  d.feet.ignition = false;
  d.clutch_down();
  d.wait(1.0);
  d.lever(haptics::kReverseGear);
  d.press(d.feet.pedals.clutch, 0.0, 0.6);
  d.press(d.feet.pedals.brake, 0.0, 1.0);
  d.wait(2.5);
  d.press(d.feet.pedals.hand_brake, 1.0, 0.3);
}

inline void bump_start(ScriptedDrive& d) {
  d.feet.ignition = true;
  d.clutch_down();
  d.lever(2);
  d.press(d.feet.pedals.hand_brake, 0.0, 0.3);
  d.until([&] { return d.km_per_h() > 12.5; });
  d.press(d.feet.pedals.clutch, 0.0, 0.7);
  d.until([&] { return d.now().running && d.km_per_h() > 20.5; });
  stop_with_hand_brake(d);
}

// Releases the throttle 0.9 s after the signal and brakes after 1.0 s, the reaction time that driving schools assume.
// Presses the brake pedal within 0.2 s. `d.pause` delays both.
inline void emergency_stop(ScriptedDrive& d) {
  Able{d}.accelerate_to(50.05);
  d.wait(0.9 + d.pause);
  d.feet.pedals.throttle = 0.0;
  d.wait(0.1);
  d.press(d.feet.pedals.brake, 1.0, 0.2);
  d.until([&] { return d.km_per_h() < 18.0; });
  d.clutch_down();
  d.until([&] { return d.is_standing(); });
  d.wait(0.5);
  d.lever(haptics::kNeutralGear);
  d.press(d.feet.pedals.hand_brake, 1.0, 0.3);
}

inline void skip_shifts(ScriptedDrive& d) {
  Able a{d};
  a.accelerate_to(45.5);
  a.shift(4);
  d.wait(0.5);
  a.slow_to(31.5);
  a.shift_with_blip(2);
}

// Shifts up when the shift light asks for it, after a reaction time of 0.4 s.
inline void eco_driving(ScriptedDrive& d) {
  Able a{d};
  for (int gear = 2; gear <= 5; ++gear) {
    a.accelerate([&] { return d.now().shift_advice > 0; }, 0.5);
    d.wait(0.4);
    a.shift(gear);
  }
  a.accelerate_to(70.5, 0.5);
}

inline void rev_matching(ScriptedDrive& d) {
  Able a{d};
  a.shift_with_blip(3);
  d.wait(0.3);
  a.slow_to(35.0);
  a.shift_with_blip(2);
}

inline void heel_and_toe(ScriptedDrive& d) {
  Able a{d};
  d.press(d.feet.pedals.throttle, 0.0, 0.15);
  d.press(d.feet.pedals.brake, 0.15, 0.3);
  d.until([&] { return d.km_per_h() < 58.0; });
  a.shift_with_blip(3);
  d.until([&] { return d.km_per_h() < 38.0; });
  a.shift_with_blip(2);
  d.wait(0.4);
}

inline void another_gate(ScriptedDrive& d) {
  Able a{d};
  for (int gear = 2; gear <= 4; ++gear) {
    a.accelerate_to_rpm(2200.0);
    a.shift(gear);
  }
  d.wait(0.5);
  a.slow_to(39.0);
  a.shift_with_blip(3);
  d.wait(0.5);
  a.slow_to(24.0);
  a.shift_with_blip(2);
}

inline void six_speed(ScriptedDrive& d) {
  Able a{d};
  for (int gear = 3; gear <= 6; ++gear) {
    a.accelerate_to_rpm(2000.0);
    a.shift(gear);
  }
  d.wait(0.5);
  a.slow_to(69.0);
  a.shift_with_blip(4);
  d.wait(0.5);
  a.slow_to(49.0);
  a.shift_with_blip(3);
  d.wait(0.5);
  a.stop();
  back_up(d, 2.2);
}

// The drives below are correct but differ from the prompts. They must pass too.

// Shifts up at lower speeds than the prompts state, and does not press the clutch pedal to the floor.
inline void up_in_another_way(ScriptedDrive& d) {
  Able a{d};
  for (int gear = 2; gear <= 5; ++gear) {
    a.accelerate_to_rpm(2200.0);
    a.lift();
    d.press(d.feet.pedals.clutch, 0.79, 0.2);
    d.lever(gear);
    d.press(d.feet.pedals.clutch, 0.0, 0.8);
  }
}

// Releases the handbrake first, lets the clutch bite, and presses it again before moving off.
inline void moving_off_at_the_second_try(ScriptedDrive& d) {
  d.press(d.feet.pedals.hand_brake, 0.0, 0.3);
  d.press(d.feet.pedals.clutch, 0.79, 0.2);
  d.lever(1);
  d.press(d.feet.pedals.clutch, d.car.clutch.bite - 0.05, 0.5);
  d.wait(0.3);
  d.clutch_down();
  d.feet.pedals.brake = 0.3;
  d.wait(1.0);
  Able a{d};
  for (int i = 0; i < 2; ++i) {
    a.launch();
    a.accelerate_to(13.0);
    a.stop();
  }
}

// Stops three times, each time in neutral with the clutch up.
inline void bite_point_and_neutral(ScriptedDrive& d) {
  into_first(d);
  for (int i = 0; i < 3; ++i) {
    const double bite = d.car.clutch.bite;
    d.clutch_down();
    d.lever(1);
    d.feet.pedals.brake = 0.0;
    d.press(d.feet.pedals.clutch, bite - 0.10, 1.5);
    d.until([&] { return d.km_per_h() > 3.2; }, 8.0);
    d.press(d.feet.pedals.clutch, bite - 0.07, 0.3);
    d.wait(2.5);
    d.clutch_down();
    d.lever(haptics::kNeutralGear);
    d.press(d.feet.pedals.clutch, 0.0, 0.3);
    d.press(d.feet.pedals.brake, 0.3, 0.3);
    d.until([&] { return d.is_standing(); });
    d.wait(0.3);
  }
}

// Moves both pedals at the same time, within `seconds` seconds, to the positions `throttle` and `clutch`.
inline void both_feet(ScriptedDrive& d, double throttle, double clutch, double seconds) {
  const double from = d.time(), old_throttle = d.feet.pedals.throttle, old_clutch = d.feet.pedals.clutch;
  d.until([&] {
    const double fraction = std::min(1.0, (d.time() - from) / seconds);
    d.feet.pedals.throttle = old_throttle + fraction * (throttle - old_throttle);
    d.feet.pedals.clutch = old_clutch + fraction * (clutch - old_clutch);
    return fraction == 1.0;
  });
}

inline void shift_with_both_feet(ScriptedDrive& d, int gear) {
  both_feet(d, 0.0, 1.0, 0.2);
  d.lever(gear);
  both_feet(d, 0.25, 0.0, 0.6);
}

inline void up_with_both_feet(ScriptedDrive& d) {
  for (int gear = 2; gear <= 5; ++gear) {
    Able{d}.accelerate_to_rpm(2200.0);
    shift_with_both_feet(d, gear);
  }
}

inline void eco_with_both_feet(ScriptedDrive& d) {
  for (int gear = 2; gear <= 5; ++gear) {
    Able{d}.accelerate([&] { return d.now().shift_advice > 0; });
    d.wait(0.4);
    shift_with_both_feet(d, gear);
  }
  Able{d}.accelerate_to(70.5, 0.5);
}

// Shifts up when the shift light asks for it, after a human reaction time of 1.05 s (Green 2000), and uses a third of
// the throttle, as the lesson's hint says.
inline void eco_with_a_persons_reaction(ScriptedDrive& d) {
  for (int gear = 2; gear <= 5; ++gear) {
    Able{d}.accelerate([&] { return d.now().shift_advice > 0; }, 1.0 / 3.0);
    d.wait(1.05);
    Able{d}.shift(gear);
  }
  Able{d}.accelerate_to(70.5, 0.5);
}

// Applies the handbrake while the foot brake still holds the car, then releases the foot brake, then shifts to neutral.
inline void emergency_stop_by_the_hand_brake(ScriptedDrive& d) {
  Able{d}.accelerate_to(50.05);
  d.wait(1.0);
  d.feet.pedals.throttle = 0.0;
  d.press(d.feet.pedals.brake, 1.0, 0.2);
  d.until([&] { return d.km_per_h() < 18.0; });
  d.clutch_down();
  d.until([&] { return d.is_standing(); });
  d.wait(0.3);
  d.press(d.feet.pedals.hand_brake, 1.0, 0.3);
  d.press(d.feet.pedals.brake, 0.0, 0.2);
  d.lever(haptics::kNeutralGear);
}

struct Honest {
  const char* lesson;
  void (*drive)(ScriptedDrive&);
};

inline constexpr Honest kHonest[] = {
    {"start_and_stop", start_and_stop},
    {"start_and_stop", start_and_stop_gently},
    {"bite_point", bite_point},
    {"moving_off", moving_off},
    {"stop_and_go", stop_and_go},
    {"up_through_the_gears", up_through_the_gears},
    {"down_through_the_gears", down_through_the_gears},
    {"down_through_the_gears", down_without_a_blip},
    {"reverse", reverse},
    {"hill_start", hill_start},
    {"hill_start", hill_start_with_the_foot_brake},
    {"hill_start_with_foot_brake", hill_start_on_the_foot_brake},
    {"hold_on_the_clutch", hold_on_the_clutch},
    {"downhill_start", downhill_start},
    {"engine_braking", engine_braking},
    {"down_before_a_bend", down_before_a_bend},
    {"emergency_stop", emergency_stop},
    {"away_in_time", away_in_time},
    {"stalled_in_a_junction", stalled_in_a_junction},
    {"reverse_uphill", reverse_uphill},
    {"reverse_downhill", reverse_downhill},
    {"parking_in_gear", parking_in_gear},
    {"bump_start", bump_start},
    {"skip_shifts", skip_shifts},
    {"eco_driving", eco_driving},
    {"rev_matching", rev_matching},
    {"heel_and_toe", heel_and_toe},
    {"another_gate", another_gate},
    {"six_speed", six_speed},
};

inline constexpr Honest kAlternativeDrives[] = {
    {"up_through_the_gears", up_in_another_way},
    {"moving_off", moving_off_at_the_second_try},
    {"bite_point", bite_point_and_neutral},
    {"up_through_the_gears", up_with_both_feet},
    {"eco_driving", eco_with_both_feet},
    {"eco_driving", eco_with_a_persons_reaction},
    {"emergency_stop", emergency_stop_by_the_hand_brake},
};

}  // namespace gearshift::test::honest
