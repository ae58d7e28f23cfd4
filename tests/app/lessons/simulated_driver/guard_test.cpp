// The guards react only to a broken lever. No lesson trips them, whether it is driven well or badly.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include <doctest/doctest.h>

#include "app/lessons/assessment/suggest.h"
#include "haptics/gate/gate_feel.h"
#include "tests/app/lessons/simulated_driver/lessons.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

constexpr double kReleaseTime = 0.3;  // [s] after this time with less force than kNoPull, the lever counts as released
constexpr double kNoPull = 2.0;       // [N]

struct Watched {
  int lowered = 0;      // number of times a wall was softened
  int unguarded = 0;    // [cycles] number of cycles in which the guard was not running
  double creep = 0.0;   // [m] largest distance of a released lever from the gear's rest position
  double shaken = 0.0;  // [1] largest vibration that the engine caused
  double ground = 0.0;  // [s] time with grinding gears
  LessonResult result;
};

Watched drive(LessonDriveConfig config) {
  Watched out;
  const Gate gate = driven_gate(config.gate);
  double unloaded_time = 0.0;
  config.on_event = [&](const HapticEvent& event) { out.lowered += event.kind == EventKind::stiffness_lowered; };
  config.on_cycle = [&](const DriveSample& now) {
    const HapticSnapshot& lever = now.lever;
    // The first 20 cycles, in which the guard ramps up, do not count.
    if (lever.cycle > 20) out.unguarded += lever.guard != GuardState::running;
    out.shaken = std::max(out.shaken, now.car.shudder);
    out.ground += now.car.grinding ? 1.0 / config.rate : 0.0;
    unloaded_time = std::abs(lever.f_h.y) < kNoPull ? unloaded_time + 1.0 / config.rate : 0.0;
    if (unloaded_time < kReleaseTime || lever.slot == kNoSlot || now.car.gear == kNeutralGear) return;
    out.creep = std::max(out.creep, slot_of(gate, lever.slot).rest - std::abs(lever.lever.y));
  };
  out.result = drive_lesson(config);
  return out;
}

}  // namespace

TEST_CASE(
    "no lesson softens a wall or trips the guard, and no released lever creeps in gear: practised and beginners") {
  double shaken = 0.0;
  const std::uint64_t seeds = is_full_campaign() ? 4 : 1;
  std::size_t counted = 0;
  for (const std::string_view key : kTeachingOrder) {
    for (const double error : {0.0, 0.6, 0.8, 1.0}) {
      // The short run tests every third combination of lesson and `error`. It still covers each value of `error`.
      if (!is_full_campaign() && counted++ % 3 != 0) continue;
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        LessonDriveConfig config = shipped_drive(key, seed);
        config.skill = skill_of(error);
        const Watched watched = drive(config);
        CAPTURE(key);
        CAPTURE(error);
        CAPTURE(seed);
        CHECK(watched.lowered == 0);
        CHECK(watched.unguarded == 0);
        CHECK(watched.creep < 0.0015);
        CHECK(watched.result.had_forces);
        shaken = std::max(shaken, watched.shaken);
      }
    }
  }
  CHECK(shaken > 0.5);  // in some drive the engine laboured hard
}

TEST_CASE("no deliberate error softens a wall or trips the guard, in a sound gearbox and in a worn one that grinds") {
  double ground = 0.0;
  std::size_t drawn = 0;
  for (const std::string_view key : kTeachingOrder) {
    for (std::size_t kind = 0; kind < kErrorKindCount; ++kind) {
      if (!is_full_campaign() && drawn++ % 11 != 0) continue;
      LessonDriveConfig config = shipped_drive(key, 1 + kind % 4);
      config.errors = deliberate_error(static_cast<ErrorKind>(kind));
      if (kind % 2 == 0) config.car.synchro.friction = 0.07;
      const Watched watched = drive(config);
      CAPTURE(key);
      CAPTURE(to_string(static_cast<ErrorKind>(kind)));
      CHECK(watched.lowered == 0);
      CHECK(watched.unguarded == 0);
      ground += watched.ground;
    }
  }
  CHECK(ground > 1.0);
}
