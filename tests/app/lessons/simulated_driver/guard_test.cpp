// The guards are for a broken lever: no lesson, however it is driven, trips them.
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

constexpr double kReleaseTime = 0.3;  // [s] of a push weaker than this:
constexpr double kNoPull = 2.0;       // [N]

struct Watched {
  int lowered = 0;      // how often a wall was softened
  int unguarded = 0;    // [cycles] in which the guard was not running normally
  double creep = 0.0;   // [m] largest distance from a gear's rest while the hand left the lever alone
  double shaken = 0.0;  // [1] largest vibration from the engine
  double ground = 0.0;  // [s] of gear grinding
  LessonResult result;
};

Watched drive(LessonDriveConfig config) {
  Watched out;
  const Gate gate = driven_gate(config.gate);
  double alone = 0.0;
  config.on_event = [&](const HapticEvent& event) { out.lowered += event.kind == EventKind::stiffness_lowered; };
  config.on_cycle = [&](const DriveSample& now) {
    const HapticSnapshot& lever = now.lever;
    if (lever.cycle > 20) out.unguarded += lever.guard != GuardState::running;  // skips the ramp at the start
    out.shaken = std::max(out.shaken, now.car.shudder);
    out.ground += now.car.grinding ? 1.0 / config.rate : 0.0;
    alone = std::abs(lever.f_h.y) < kNoPull ? alone + 1.0 / config.rate : 0.0;
    if (alone < kReleaseTime || lever.slot == kNoSlot || now.car.gear == kNeutralGear) return;
    out.creep = std::max(out.creep, slot_of(gate, lever.slot).rest - std::abs(lever.lever.y));
  };
  out.result = drive_lesson(config);
  return out;
}

}  // namespace

TEST_CASE(
    "no lesson softens a wall or trips the guard, and no released lever creeps in gear: practised and beginners") {
  double shaken = 0.0;
  const std::uint64_t seeds = is_whole_campaign() ? 4 : 1;
  std::size_t counted = 0;
  for (const std::string_view key : kTeachingOrder) {
    for (const double error : {0.0, 0.6, 0.8, 1.0}) {
      if (!is_whole_campaign() && counted++ % 3 != 0) continue;  // each error with every third lesson
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        LessonDriveConfig config = shipped_drive(key, seed);
        config.skill = skill_of(error);
        const Watched seen = drive(config);
        CAPTURE(key);
        CAPTURE(error);
        CAPTURE(seed);
        CHECK(seen.lowered == 0);
        CHECK(seen.unguarded == 0);
        CHECK(seen.creep < 0.0015);
        CHECK(seen.result.had_forces);
        shaken = std::max(shaken, seen.shaken);
      }
    }
  }
  CHECK(shaken == doctest::Approx(1.0).epsilon(0.05));  // the drives include the strongest vibration possible
}

TEST_CASE("nor does a deliberate error, in a sound gearbox and in a worn one that grinds") {
  double ground = 0.0;
  std::size_t drawn = 0;
  for (const std::string_view key : kTeachingOrder) {
    for (std::size_t kind = 0; kind < kErrorKindCount; ++kind) {
      if (!is_whole_campaign() && drawn++ % 11 != 0) continue;
      LessonDriveConfig config = shipped_drive(key, 1 + kind % 4);
      config.errors = deliberate_error(static_cast<ErrorKind>(kind));
      if (kind % 2 == 0) config.car.synchro.friction = 0.07;
      const Watched seen = drive(config);
      CAPTURE(key);
      CAPTURE(error_key(static_cast<ErrorKind>(kind)));
      CHECK(seen.lowered == 0);
      CHECK(seen.unguarded == 0);
      ground += seen.ground;
    }
  }
  CHECK(ground > 1.0);
}
