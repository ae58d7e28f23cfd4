// The shipped lessons in the real car. Each driving error that a lesson checks is injected into the samples of a
// correct drive.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "app/lessons/assessment/lesson_run.h"
#include "app/lessons/assessment/suggest.h"
#include "tests/app/lessons/assessment/constructed_shift.h"
#include "tests/app/lessons/assessment/honest_drives.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift;
using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

const std::string kLessons = GEARSHIFT_ASSETS "/lessons/";

Lesson shipped_lesson(std::string_view key) {
  return read_lesson(kLessons + std::string(key) + ".toml");
}

using SampleChange = std::function<void(DriveSample&)>;

bool has(const LessonResult& result, ErrorKind kind) {
  return std::any_of(result.errors.begin(), result.errors.end(),
                     [&](const DrivingError& f) { return f.kind == kind && f.severity != Severity::note; });
}

// Applies `change` for `seconds` seconds, starting when `when` first returns true.
SampleChange for_a_while(double seconds, const std::function<bool(const DriveSample&)>& when,
                         const std::function<void(DriveSample&, double)>& change) {
  return [=, since = -1.0](DriveSample& s) mutable {
    if (since < 0.0 && s.time() > 100.05 && when(s)) since = s.time();
    if (since >= 0.0 && s.time() - since < seconds) change(s, s.time() - since);
  };
}

bool drives(const DriveSample& s) {
  return s.car.gear > 0 && s.car.pedals.clutch == 0.0 && s.car.road_speed > 1.0;
}

bool moves(const DriveSample& s) {
  return s.car.gear != kNeutralGear && std::abs(s.car.road_speed) > 0.3;
}

bool always(const DriveSample&) {
  return true;
}

// A change of the samples that makes a correct drive look like a drive with this error. Empty if no such change exists.
SampleChange modification_for(ErrorKind kind, const Gate& gate, const CarSpec& car, const Lesson& lesson) {
  const double bite = car.clutch.bite;
  const double red = car.engine.red_line;
  switch (kind) {
    case ErrorKind::stall:
      return for_a_while(
          1.0, [](const DriveSample& s) { return s.car.running; },
          [](DriveSample& s, double t) { s.car.running = t < 0.1; });
    case ErrorKind::over_rev:
      return for_a_while(0.2, moves, [=](DriveSample& s, double) { s.car.engine_speed = 1.05 * red; });
    case ErrorKind::lugging:
      return for_a_while(1.5, drives, [](DriveSample& s, double) {
        s.car.engine_speed = 90.0, s.car.engine_load = 0.9, s.car.clutch_locked = true;
      });
    case ErrorKind::clutch_dump:
      return [=](DriveSample& s) {
        const bool up = s.car.gear != kNeutralGear && s.car.pedals.clutch < bite && s.car.pedals.clutch > 0.0;
        if (up)
          s.car.pedals.clutch = 0.0, s.car.clutch_locked = s.car.clutch_locked && s.car.pedals.clutch < 0.4,
          s.car.slip_power = 20e3;
      };
    case ErrorKind::clutch_burn:
      return [=](DriveSample& s) {
        if (s.car.gear != kNeutralGear && s.car.pedals.clutch < bite && s.car.pedals.clutch > 0.0)
          s.car.slip_power = 40e3;
      };
    case ErrorKind::jerk:
      return [=](DriveSample& s) {
        if (s.car.gear != kNeutralGear && s.car.pedals.clutch < bite - 0.05 && s.car.pedals.brake == 0.0)
          s.car.acceleration += 12.0;
      };
    case ErrorKind::rollback:
      return for_a_while(1.0, always, [base = 0.0](DriveSample& s, double t) mutable {
        if (t == 0.0) base = s.car.distance;
        s.car.road_speed = -0.4, s.car.distance = base - 0.4 * t;
      });
    case ErrorKind::grind:
      return for_a_while(0.2, always, [](DriveSample& s, double) { s.car.grinding = true, s.car.grind_power = 100.0; });
    case ErrorKind::over_push:
      return for_a_while(0.2, always, [](DriveSample& s, double) { s.lever.f_h = {0.0, 70.0}; });
    case ErrorKind::riding_lever:
      return for_a_while(
          40.0, [](const DriveSample& s) { return drives(s) && s.car.road_speed > 4.5; },
          [](DriveSample& s, double) {
            s.lever.f_h = {5.0, 0.0};
          });
    case ErrorKind::riding_clutch:
      return for_a_while(
          40.0, [](const DriveSample& s) { return drives(s) && s.car.road_speed > 4.5; },
          [](DriveSample& s, double) { s.car.pedals.clutch = std::max(s.car.pedals.clutch, 0.3); });
    case ErrorKind::wrong_gear:
      return [from = kNeutralGear, before = kNeutralGear, at = -1.0](DriveSample& s) mutable {
        if (s.car.gear != before && s.car.gear != kNeutralGear && at < 0.0 && s.time() > 100.05) at = s.time();
        if (at < 0.0 && s.car.gear != kNeutralGear) from = s.car.gear;
        before = s.car.gear;
        int wrong = 1;
        while (wrong == s.car.gear || wrong == from) ++wrong;
        if (at >= 0.0 && s.time() - at < 0.05) s.car.gear = wrong;
      };
    case ErrorKind::wrong_direction:
      return [&gate](DriveSample& s) {
        if (s.lever.slot != kNoSlot && slot_of(gate, s.lever.slot).gear == kReverseGear) s.car.road_speed = 3.0;
      };
    case ErrorKind::rev_mismatch:
      return [=](DriveSample& s) {
        if (s.car.pedals.clutch >= bite - 0.05) s.car.engine_speed -= 60.0;
      };
    case ErrorKind::throttle_in_shift:
      return [=](DriveSample& s) {
        if (s.car.pedals.clutch > 0.0) s.car.pedals.throttle = 0.3;  // the throttle is pressed as long as the clutch is
        if (s.car.pedals.clutch >= bite && s.car.gear == kNeutralGear) s.car.engine_speed += 200.0;
      };
    case ErrorKind::early_shift:  // too slow by both rev counter and speedometer
      return [=](DriveSample& s) {
        if (s.car.pedals.clutch > bite - 0.05) s.car.engine_speed *= 0.5, s.car.road_speed *= 0.7;
      };
    case ErrorKind::late_shift:
      return [=, climbs = lesson.band_of_car || lesson.shift_to < 1e8](DriveSample& s) {
        if (s.car.pedals.clutch > bite - 0.05) climbs ? s.car.engine_speed *= 2.5 : s.car.road_speed *= 0.4;
      };
    case ErrorKind::no_clutch:
      return [](DriveSample& s) {
        s.car.pedals.clutch = 0.0, s.car.clutch_locked = true;
        if (s.car.gear == kNeutralGear) s.car.engine_speed += 90.0;
      };
    case ErrorKind::clutch_late:
      return [out = 0.0](DriveSample& s) mutable {
        if (s.car.gear != kNeutralGear && s.car.pedals.clutch == 0.0) out = 0.0;
        if (s.car.gear == kNeutralGear && out == 0.0) out = s.time();
        if (s.time() - out < 0.1 || out == 0.0) s.car.pedals.clutch = 0.0;
      };
    case ErrorKind::clutch_early:
      return [&gate, up = false](DriveSample& s) mutable {
        const bool goes_in = s.car.gear == kNeutralGear && std::abs(s.lever.proxy.y) > gate.half_aisle + gate.chamfer;
        if (s.car.pedals.clutch == 0.0) up = false;
        up = up || (goes_in && s.time() > 100.05 && s.lever.slot != kNoSlot && s.car.pedals.clutch >= 0.99);
        if (up) s.car.pedals.clutch = 0.0;
      };
    case ErrorKind::step_order:
      return [](DriveSample& s) {
        if (s.car.pedals.clutch > 0.0 && s.car.gear != kNeutralGear && s.lever.slot != kNoSlot)
          s.car.pedals.throttle = 0.3;
      };
    case ErrorKind::wrong_column:
      return [&gate, at = -1.0, wrong = kNoSlot, gear = 0](DriveSample& s) mutable {
        if (s.car.gear != kNeutralGear) gear = s.car.gear;
        const bool in_aisle =
            s.car.gear == kNeutralGear && std::abs(s.lever.proxy.y) < 1e-9 && s.car.pedals.clutch == 1.0;
        if (at < 0.0 && in_aisle && s.time() > 100.05) at = s.time();
        if (at < 0.0 || s.time() - at > 0.02) return;
        wrong = slot_of_gear(gate, gear == 5 || gear == 4 ? 1 : 5);
        const Slot& slot = slot_of(gate, wrong);
        s.lever.proxy = s.lever.lever = {column_of(gate, slot.column).center,
                                         static_cast<int>(slot.side) * (gate.half_aisle + gate.chamfer + 0.002)};
        s.lever.slot = wrong;
      };
    case ErrorKind::blocked:
      return [](DriveSample& s) {
        if (s.car.pedals.clutch == 1.0) s.car.sync = SyncPhase::synchronising, s.lever.f_h = {0.0, 10.0};
      };
    case ErrorKind::too_slow:
    case ErrorKind::slow_step:
      return [](DriveSample&) {};
    case ErrorKind::missed_shift:
    case ErrorKind::coasting:
    case ErrorKind::early_downshift:
      return nullptr;
  }
  return nullptr;
}

bool waits(ErrorKind kind) {
  return kind == ErrorKind::too_slow || kind == ErrorKind::blocked || kind == ErrorKind::slow_step;
}

}  // namespace

TEST_CASE("the shipped lesson files are those in the teaching order") {
  std::set<std::string> files, order(kTeachingOrder.begin(), kTeachingOrder.end());
  for (const auto& entry : std::filesystem::directory_iterator(kLessons)) {
    if (entry.path().extension() == ".toml") files.insert(entry.path().stem().string());
  }
  CHECK(files == order);
}

TEST_CASE("each shipped lesson without its own gate can be driven in every gate with five gears and reverse") {
  for (const std::string_view key : kTeachingOrder) {
    const Lesson lesson = shipped_lesson(key);
    for (const std::string& name : shipped_names()) {
      const Gate gate = shipped_gate(name);
      if (lesson.gate.empty() && slot_of_gear(gate, 5) != kNoSlot && slot_of_gear(gate, kReverseGear) != kNoSlot) {
        CHECK_NOTHROW(LessonRun(lesson, test_car(), gate, {}));
      }
    }
  }
}

TEST_CASE("each shipped lesson detects every error that it checks, and is failed by those on which it fails") {
  std::size_t checked = 0;
  for (const honest::Honest& each : honest::kHonest) {
    const Lesson lesson = shipped_lesson(each.lesson);
    for (int i = 0; i < kErrorKindCount; ++i) {
      const auto kind = static_cast<ErrorKind>(i);
      if (!assesses(lesson, kind)) continue;
      ScriptedDrive drive(each.lesson);
      drive.modify = modification_for(kind, drive.gate, drive.car, lesson);
      if (!drive.modify) continue;
      if (checked++ % 3 != 0 && !is_full_campaign()) continue;
      // [s] longer than it takes to read a prompt
      drive.pause = kind == ErrorKind::too_slow ? 5.0 : waits(kind) ? 3.0 : 0.0;
      each.drive(drive);
      const LessonResult& result = drive.finish();
      CAPTURE(std::string(each.lesson));
      CAPTURE(to_string(kind));
      CAPTURE(errors_text(result));
      CAPTURE(result.why);
      CHECK(has(result, kind));
      CHECK(result.grade < 10.0);
      if (fails_on(lesson, kind)) CHECK_FALSE(result.passed);
    }
  }
}
