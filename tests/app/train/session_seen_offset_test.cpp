// The clamp's bound is of all that lies between the felt and the seen lever: what a headset's seat takes of it, the clamp
// has no more.
#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/train/session.h"

using namespace gearshift;

TEST_CASE("an offset of the seat counts towards the 20 mm at which the true hand is shown") {
  SessionChoice choice;
  choice.hand = "grip";
  choice.clock = TrainerClock::virtual_time;
  choice.sound = SoundOutput::none;
  choice.gate = "paper";
  choice.car = std::string(kNoCar);
  choice.lesson = std::string(kNoLesson);
  Session session(choice);
  HandTarget hand;
  hand.position = {0.0, 0.012};  // into the wall of the cross aisle, beside a slot
  const auto go = [&](double offset) {
    session.set_seen_offset(offset);
    for (int i = 0; i < 90; ++i) {
      hand.position.x = 0.018;
      session.lead(hand, {});
      session.advance(1.0 / 60.0);
    }
    return (session.shown().flags & kFlagGhost) != 0;
  };
  CHECK_FALSE(go(0.0));
  const double clamped = glm::distance(session.shown().lever, session.shown().proxy);
  REQUIRE(clamped > 1e-4);
  REQUIRE(clamped < 0.010);
  CHECK_FALSE(go(0.020 - 2.0 * clamped));
  CHECK(go(0.020 - 0.5 * clamped));
  CHECK_FALSE(go(0.0));
}
