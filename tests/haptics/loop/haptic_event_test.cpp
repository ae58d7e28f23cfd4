// Events from cycles made by hand, without a loop.
#include "haptics/loop/haptic_event.h"

#include <vector>

#include <doctest/doctest.h>

using namespace gearshift::haptics;

namespace {

// Cycles of 1 ms, beginning at an arbitrary time. Each call of see() adds one cycle.
struct Cycles {
  EventDetector detector;
  std::vector<HapticEvent> events;
  TraceSample cycle;

  Cycles() {
    cycle.out.time_ns = 77'000'000;
    cycle.tuning.wall_stiffness = cycle.out.wall_stiffness = 4000.0;
  }
  std::vector<EventKind> see() {
    events.clear();
    detector.update(cycle, events);
    for (const HapticEvent& event : events) CHECK(event.cycle == cycle.out.cycle);
    ++cycle.out.cycle;
    cycle.out.time_ns += 1'000'000;
    std::vector<EventKind> kinds;
    for (const HapticEvent& event : events) kinds.push_back(event.kind);
    return kinds;
  }
  std::vector<EventKind> see_for(int cycles) {
    std::vector<EventKind> kinds;
    for (int i = 0; i < cycles; ++i)
      for (const EventKind kind : see()) kinds.push_back(kind);
    return kinds;
  }
  void set(std::uint32_t flag, bool on) { cycle.out.flags = on ? cycle.out.flags | flag : cycle.out.flags & ~flag; }
};

using Kinds = std::vector<EventKind>;

}  // namespace

TEST_CASE("a lever at rest in neutral, with forces off, causes no event") {
  Cycles cycles;
  CHECK(cycles.see_for(100).empty());
}

TEST_CASE("a change of gear leaves the old one, then engages the new one; neutral is no gear") {
  Cycles cycles;
  cycles.cycle.out.gear = 2;
  CHECK(cycles.see() == Kinds{EventKind::gear_engaged});
  CHECK(cycles.events[0].value == 2.0);
  CHECK(cycles.see().empty());
  cycles.cycle.out.gear = kReverseGear;
  CHECK(cycles.see() == Kinds{EventKind::gear_left, EventKind::gear_engaged});
  CHECK(cycles.events[0].value == 2.0);
  CHECK(cycles.events[1].value == kReverseGear);
  cycles.cycle.out.gear = kNeutralGear;
  CHECK(cycles.see() == Kinds{EventKind::gear_left});
}

TEST_CASE("over-push and saturation begin and end once each, with the push and the wanted force") {
  Cycles cycles;
  (void)cycles.see();
  cycles.set(kFlagOverPush, true);
  cycles.cycle.out.f_h = {-36.0, 48.0};
  CHECK(cycles.see() == Kinds{EventKind::over_push_begin});
  CHECK(cycles.events[0].value == 60.0);
  CHECK(cycles.see_for(20).empty());
  cycles.set(kFlagSaturated, true);
  cycles.cycle.out.wall_force = {30.0, 0.0};
  cycles.cycle.out.feel_force = {0.0, 20.0};
  cycles.cycle.out.load_force = {0.0, 20.0};
  CHECK(cycles.see() == Kinds{EventKind::saturation_begin});
  CHECK(cycles.events[0].value == 50.0);
  cycles.set(kFlagOverPush, false);
  cycles.set(kFlagSaturated, false);
  CHECK(cycles.see() == Kinds{EventKind::over_push_end, EventKind::saturation_end});
}

TEST_CASE("a wall contact is an impact only after more than 30 ms away from the wall; its value is the speed into it") {
  Cycles cycles;
  cycles.cycle.out.lever = {0.01, 0.02};
  cycles.cycle.out.proxy = {0.01, 0.01};
  cycles.cycle.out.velocity = {0.5, 0.2};
  cycles.set(kFlagContact, true);
  CHECK(cycles.see() == Kinds{EventKind::wall_contact});
  CHECK(cycles.events[0].value == doctest::Approx(0.2).epsilon(1e-12));
  CHECK(cycles.see_for(200).empty());
  for (const auto& [away, impacts] : {std::pair{29, 0}, {31, 1}}) {
    cycles.set(kFlagContact, false);
    (void)cycles.see_for(away);
    cycles.set(kFlagContact, true);
    CHECK(static_cast<int>(cycles.see().size()) == impacts);
  }
}

TEST_CASE("a softened wall is reported with its new stiffness, a wall that is tuned softer is not") {
  Cycles cycles;
  (void)cycles.see();
  cycles.cycle.out.wall_stiffness = 3000.0;
  CHECK(cycles.see() == Kinds{EventKind::stiffness_lowered});
  CHECK(cycles.events[0].value == 3000.0);
  cycles.cycle.tuning.wall_stiffness = cycles.cycle.out.wall_stiffness = 1000.0;  // tuning restores the full stiffness
  CHECK(cycles.see().empty());
  cycles.cycle.out.wall_stiffness = 750.0;
  CHECK(cycles.see() == Kinds{EventKind::stiffness_lowered});
}

TEST_CASE("each change of the guard is reported, also at a loop's first cycle") {
  Cycles cycles;
  cycles.cycle.out.guard = GuardState::ramping;
  CHECK(cycles.see() == Kinds{EventKind::guard_changed});
  CHECK(cycles.see().empty());
  cycles.cycle.out.guard = GuardState::running;
  CHECK(cycles.see() == Kinds{EventKind::guard_changed});
  CHECK(cycles.events[0].value == static_cast<double>(GuardState::running));
}

TEST_CASE("after lost cycles a lasting change is still found; a new loop reports its gear again without leaving it") {
  Cycles cycles;
  cycles.cycle.out.gear = 1;
  (void)cycles.see();
  cycles.cycle.out.cycle += 500;
  cycles.cycle.out.gear = 3;
  CHECK(cycles.see() == Kinds{EventKind::gear_left, EventKind::gear_engaged});
  cycles.cycle.out.cycle = 0;
  CHECK(cycles.see() == Kinds{EventKind::gear_engaged});
}
