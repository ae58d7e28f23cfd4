// The loop's defences are for a lever that is broken: no lesson, however it is driven, brings them up.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include <doctest/doctest.h>

#include "app/training/suggest.h"
#include "haptics/gate/gate_feel.h"
#include "tests/app/learner/lessons.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift;

namespace {

constexpr double kLeftAlone = 0.3;  // [s] with less than this of the hand:
constexpr double kNoPull = 2.0;     // [N]

struct Watched {
  int lowered = 0;      // times that a wall was softened
  int unguarded = 0;    // [cycles] in which the guard was not in its normal state
  double creep = 0.0;   // [m] out of a gear's rest, at most, of a lever that the hand has left alone
  double shaken = 0.0;  // [1] by the engine, at most
  double ground = 0.0;  // [s]
  LessonResult result;
};

Watched drive(LessonDriveConfig config) {
  Watched out;
  const Gate gate = driven_gate(config.gate);
  double alone = 0.0;
  config.hear = [&](const HapticEvent& event) { out.lowered += event.kind == EventKind::stiffness_lowered; };
  config.watch = [&](const DriveSample& now) {
    const HapticSnapshot& lever = now.lever;
    if (lever.cycle > 20) out.unguarded += lever.guard != GuardState::running;  // the ramp's
    out.shaken = std::max(out.shaken, now.car.shudder);
    out.ground += now.car.grinding ? 1.0 / config.rate : 0.0;
    alone = std::abs(lever.f_h.y) < kNoPull ? alone + 1.0 / config.rate : 0.0;
    if (alone < kLeftAlone || lever.slot == kNoSlot || now.car.gear == kNeutralGear) return;
    out.creep = std::max(out.creep, slot_of(gate, lever.slot).rest - std::abs(lever.lever.y));
  };
  out.result = drive_lesson(config);
  return out;
}

}  // namespace

TEST_CASE("no lesson softens a wall or trips the guard, nobody's lever creeps in gear: practised and beginners") {
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
  CHECK(shaken == doctest::Approx(1.0).epsilon(0.05));  // the worst that there is was among them
}

TEST_CASE("nor does a fault that is done on purpose, in a sound gearbox and in a worn one that grinds") {
  double ground = 0.0;
  std::size_t drawn = 0;
  for (const std::string_view key : kTeachingOrder) {
    for (std::size_t kind = 0; kind < kFaultKinds; ++kind) {
      if (!is_whole_campaign() && drawn++ % 11 != 0) continue;
      LessonDriveConfig config = shipped_drive(key, 1 + kind % 4);
      config.faults = only(static_cast<FaultKind>(kind));
      if (kind % 2 == 0) config.car.synchro.friction = 0.07;
      const Watched seen = drive(config);
      CAPTURE(key);
      CAPTURE(fault_key(static_cast<FaultKind>(kind)));
      CHECK(seen.lowered == 0);
      CHECK(seen.unguarded == 0);
      ground += seen.ground;
    }
  }
  CHECK(ground > 1.0);
}
