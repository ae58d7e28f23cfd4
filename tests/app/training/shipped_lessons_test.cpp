// The lessons that are shipped: read, and driven in the real car with each fault that they look at put into what they see.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "app/training/lesson_run.h"
#include "app/training/suggest.h"
#include "tests/app/training/constructed_shift.h"
#include "tests/app/training/honest_drives.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift;

namespace {

const std::string kLessons = GEARSHIFT_ASSETS "/lessons/";

Lesson shipped_lesson(std::string_view key) {
  return read_lesson(kLessons + std::string(key) + ".toml");
}

using Misdeed = std::function<void(DriveSample&)>;

bool has(const LessonResult& result, FaultKind kind) {
  return std::any_of(result.faults.begin(), result.faults.end(),
                     [&](const DriveFault& f) { return f.kind == kind && f.severity != Severity::note; });
}

// Shows the first drive in gear for `seconds` from `after` on as `change` makes it.
Misdeed for_a_while(double seconds, const std::function<bool(const DriveSample&)>& when,
                    const std::function<void(DriveSample&, double)>& change) {
  return [=, since = -1.0](DriveSample& s) mutable {
    if (since < 0.0 && s.time() > 100.05 && when(s)) since = s.time();
    if (since >= 0.0 && s.time() - since < seconds) change(s, s.time() - since);
  };
}

bool drives(const DriveSample& s) {
  return s.car.gear > 0 && s.car.clutch == 0.0 && s.car.road_speed > 1.0;
}

bool moves(const DriveSample& s) {
  return s.car.gear != kNeutralGear && std::abs(s.car.road_speed) > 0.3;
}

bool always(const DriveSample&) {
  return true;
}

// What a driver with that fault would have shown. Nothing for a kind that cannot be put into samples from outside.
Misdeed spoil_of(FaultKind kind, const Gate& gate, const CarSpec& car, const Lesson& lesson) {
  const double bite = car.clutch.bite;
  const double red = car.engine.red_line;
  switch (kind) {
    case FaultKind::stall:
      return for_a_while(
          1.0, [](const DriveSample& s) { return s.car.running; },
          [](DriveSample& s, double t) { s.car.running = t < 0.1; });
    case FaultKind::over_rev:
      return for_a_while(0.2, moves, [=](DriveSample& s, double) { s.car.engine_speed = 1.05 * red; });
    case FaultKind::lugging:
      return for_a_while(1.5, drives, [](DriveSample& s, double) {
        s.car.engine_speed = 90.0, s.car.engine_load = 0.9, s.car.clutch_locked = true;
      });
    case FaultKind::clutch_dump:
      return [=](DriveSample& s) {
        const bool up = s.car.gear != kNeutralGear && s.car.clutch < bite && s.car.clutch > 0.0;
        if (up)
          s.car.clutch = 0.0, s.car.clutch_locked = s.car.clutch_locked && s.car.clutch < 0.4, s.car.slip_power = 20e3;
      };
    case FaultKind::clutch_burn:
      return [=](DriveSample& s) {
        if (s.car.gear != kNeutralGear && s.car.clutch < bite && s.car.clutch > 0.0) s.car.slip_power = 40e3;
      };
    case FaultKind::jerk:
      return [=](DriveSample& s) {
        if (s.car.gear != kNeutralGear && s.car.clutch < bite - 0.05 && s.car.brake == 0.0) s.car.acceleration += 12.0;
      };
    case FaultKind::rollback:
      return for_a_while(1.0, always, [base = 0.0](DriveSample& s, double t) mutable {
        if (t == 0.0) base = s.car.distance;
        s.car.road_speed = -0.4, s.car.distance = base - 0.4 * t;
      });
    case FaultKind::grind:
      return for_a_while(0.2, always, [](DriveSample& s, double) { s.car.grinding = true, s.car.grind_power = 100.0; });
    case FaultKind::over_push:
      return for_a_while(0.2, always, [](DriveSample& s, double) { s.lever.f_h = {0.0, 70.0}; });
    case FaultKind::riding_lever:
      return for_a_while(
          40.0, [](const DriveSample& s) { return drives(s) && s.car.road_speed > 4.5; },
          [](DriveSample& s, double) {
            s.lever.f_h = {5.0, 0.0};
          });
    case FaultKind::riding_clutch:
      return for_a_while(
          40.0, [](const DriveSample& s) { return drives(s) && s.car.road_speed > 4.5; },
          [](DriveSample& s, double) { s.car.clutch = std::max(s.car.clutch, 0.3); });
    case FaultKind::wrong_gear:
      return [from = kNeutralGear, before = kNeutralGear, at = -1.0](DriveSample& s) mutable {
        if (s.car.gear != before && s.car.gear != kNeutralGear && at < 0.0 && s.time() > 100.05) at = s.time();
        if (at < 0.0 && s.car.gear != kNeutralGear) from = s.car.gear;
        before = s.car.gear;
        int wrong = 1;
        while (wrong == s.car.gear || wrong == from) ++wrong;
        if (at >= 0.0 && s.time() - at < 0.05) s.car.gear = wrong;
      };
    case FaultKind::wrong_direction:
      return [&gate](DriveSample& s) {
        if (s.lever.slot != kNoSlot && slot_of(gate, s.lever.slot).gear == kReverseGear) s.car.road_speed = 3.0;
      };
    case FaultKind::rev_mismatch:
      return [=](DriveSample& s) {
        if (s.car.clutch >= bite - 0.05) s.car.engine_speed -= 60.0;
      };
    case FaultKind::throttle_in_shift:
      return [=](DriveSample& s) {
        if (s.car.clutch > 0.0) s.car.throttle = 0.3;  // still on it as the clutch goes down
        if (s.car.clutch >= bite && s.car.gear == kNeutralGear) s.car.engine_speed += 200.0;
      };
    case FaultKind::early_shift:  // too slow, by the needle of the engine and by that of the road
      return [=](DriveSample& s) {
        if (s.car.clutch > bite - 0.05) s.car.engine_speed *= 0.5, s.car.road_speed *= 0.7;
      };
    case FaultKind::late_shift:
      return [=, climbs = lesson.band_of_car || lesson.shift_to < 1e8](DriveSample& s) {
        if (s.car.clutch > bite - 0.05) climbs ? s.car.engine_speed *= 2.5 : s.car.road_speed *= 0.4;
      };
    case FaultKind::no_clutch:
      return [](DriveSample& s) {
        s.car.clutch = 0.0, s.car.clutch_locked = true;
        if (s.car.gear == kNeutralGear) s.car.engine_speed += 90.0;
      };
    case FaultKind::clutch_late:
      return [out = 0.0](DriveSample& s) mutable {
        if (s.car.gear != kNeutralGear && s.car.clutch == 0.0) out = 0.0;
        if (s.car.gear == kNeutralGear && out == 0.0) out = s.time();
        if (s.time() - out < 0.1 || out == 0.0) s.car.clutch = 0.0;
      };
    case FaultKind::clutch_early:
      return [&gate, up = false](DriveSample& s) mutable {
        const bool goes_in = s.car.gear == kNeutralGear && std::abs(s.lever.proxy.y) > gate.half_aisle + gate.chamfer;
        if (s.car.clutch == 0.0) up = false;
        up = up || (goes_in && s.time() > 100.05 && s.lever.slot != kNoSlot && s.car.clutch >= 0.99);
        if (up) s.car.clutch = 0.0;
      };
    case FaultKind::step_order:
      return [](DriveSample& s) {
        if (s.car.clutch > 0.0 && s.car.gear != kNeutralGear && s.lever.slot != kNoSlot) s.car.throttle = 0.3;
      };
    case FaultKind::wrong_column:
      return [&gate, at = -1.0, wrong = kNoSlot, gear = 0](DriveSample& s) mutable {
        if (s.car.gear != kNeutralGear) gear = s.car.gear;
        const bool in_aisle = s.car.gear == kNeutralGear && std::abs(s.lever.proxy.y) < 1e-9 && s.car.clutch == 1.0;
        if (at < 0.0 && in_aisle && s.time() > 100.05) at = s.time();
        if (at < 0.0 || s.time() - at > 0.02) return;
        wrong = slot_of_gear(gate, gear == 5 || gear == 4 ? 1 : 5);
        const Slot& slot = slot_of(gate, wrong);
        s.lever.proxy = s.lever.lever = {column_of(gate, slot.column).center,
                                         static_cast<int>(slot.side) * (gate.half_aisle + gate.chamfer + 0.002)};
        s.lever.slot = wrong;
      };
    case FaultKind::blocked:
      return [](DriveSample& s) {
        if (s.car.clutch == 1.0) s.car.sync = SyncPhase::synchronising, s.lever.f_h = {0.0, 10.0};
      };
    case FaultKind::too_slow:
    case FaultKind::slow_step:
      return [](DriveSample&) {};
    case FaultKind::missed_shift:
    case FaultKind::coasting:
    case FaultKind::early_downshift:
      return nullptr;
  }
  return nullptr;
}

bool waits(FaultKind kind) {
  return kind == FaultKind::too_slow || kind == FaultKind::blocked || kind == FaultKind::slow_step;
}

}  // namespace

TEST_CASE("the shipped lessons are those of the teaching order") {
  std::set<std::string> files, order(kTeachingOrder.begin(), kTeachingOrder.end());
  for (const auto& entry : std::filesystem::directory_iterator(kLessons)) {
    if (entry.path().extension() == ".toml") files.insert(entry.path().stem().string());
  }
  CHECK(files == order);
}

TEST_CASE("each shipped lesson that names no gate has its gears in every gate of five speeds and more") {
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

TEST_CASE("each shipped lesson sees every fault that it looks at, and is failed by those that it catches") {
  std::size_t seen = 0;
  for (const honest::Honest& each : honest::kHonest) {
    const Lesson lesson = shipped_lesson(each.lesson);
    for (int i = 0; i < kFaultKinds; ++i) {
      const auto kind = static_cast<FaultKind>(i);
      if (!looks_at(lesson, kind)) continue;
      ScriptedDrive drive(each.lesson);
      drive.spoil = spoil_of(kind, drive.gate, drive.car, lesson);
      if (!drive.spoil) continue;
      if (seen++ % 3 != 0 && !is_whole_campaign()) continue;
      drive.dawdle = kind == FaultKind::too_slow ? 5.0 : waits(kind) ? 3.0 : 0.0;  // beyond what reading takes
      each.drive(drive);
      const LessonResult& result = drive.finish();
      CAPTURE(std::string(each.lesson));
      CAPTURE(fault_key(kind));
      CAPTURE(faults_of(result));
      CAPTURE(result.why);
      CHECK(has(result, kind));
      CHECK(result.grade < 10.0);
      if (catches(lesson, kind)) CHECK_FALSE(result.passed);
    }
  }
}
