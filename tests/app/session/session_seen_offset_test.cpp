// If the total offset between the felt and the drawn lever is too large, the lever is flagged as past the wall. The
// offset of the headset's seat counts as part of this total.
#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/session/session.h"

using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::session;

TEST_CASE("a seat offset counts towards the 20 mm at which the true hand is shown") {
  SessionChoice choice;
  choice.hand = "grip";
  choice.clock = RuntimeClock::virtual_time;
  choice.sound = SoundOutput::none;
  choice.gate = "paper";
  choice.car = std::string(kNoCar);
  choice.lesson = std::string(kNoLesson);
  Session session(choice);
  HandTarget hand;
  hand.position = {0.0, 0.012};  // against the wall of the cross aisle, where there is no slot
  const auto go = [&](double offset) {
    session.set_visual_offset(offset);
    for (int i = 0; i < 90; ++i) {
      hand.position.x = 0.018;
      session.lever().set_driver(hand, {});
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
