// The panel's pointer follows the controller that points at the panel. Without a controller, it follows the desktop's
// mouse.
#include "app/session/panel_hand_pointer.h"

#include <doctest/doctest.h>

using namespace gearshift::engine;
using namespace gearshift::session;

namespace {

constexpr glm::ivec2 kPanel{1000, 500};  // [px]

std::optional<LearnerHeadset::Pointer> at(double x, double y, bool selects = false) {
  return LearnerHeadset::Pointer{{{x, y}, 1.0}, selects, {0.0, 0.5}};
}

}  // namespace

TEST_CASE("a controller on the panel has the pointer until the mouse moves; its trigger takes the pointer back") {
  PointingHand pointing;
  WindowInput desk;
  const auto follow = [&](const std::optional<LearnerHeadset::Pointer>& hand, bool desk_leads_lever = false) {
    pointing.follow(desk, desk_leads_lever, hand, kPanel, 0.1);
    return pointing.pointer();
  };
  CHECK_FALSE(follow(std::nullopt));
  const auto came = follow(at(0.5, 0.2));
  REQUIRE(came);
  CHECK(came->at == glm::dvec2(500.0, 100.0));
  CHECK_FALSE(came->down);
  CHECK(came->scroll.y == doctest::Approx(0.6));  // thumbstick half forward for 0.1 s: 0.5 x 12 lines/s x 0.1 s
  desk.mouse_moved = {3.0, 0.0};
  CHECK(follow(at(0.5, 0.2), true));  // while the mouse moves the lever, the controller keeps the pointer
  CHECK_FALSE(follow(at(0.5, 0.2)));
  desk.mouse_moved = {0.0, 0.0};
  CHECK_FALSE(follow(at(0.5, 0.2)));  // only the controller's trigger takes the pointer back from the mouse
  const auto clicks = follow(at(0.5, 0.2, true));
  REQUIRE(clicks);
  CHECK(clicks->down);
  CHECK_FALSE(follow(std::nullopt));
}

TEST_CASE("a trigger pulled before the ray reaches the panel clicks nothing") {
  PointingHand pointing;
  const WindowInput desk;
  for (int i = 0; i < 3; ++i) {
    pointing.follow(desk, false, at(0.1 * i, 0.2, true), kPanel, 0.1);
    REQUIRE(pointing.pointer());
    CHECK_FALSE(pointing.pointer()->down);
  }
  pointing.follow(desk, false, at(0.4, 0.2), kPanel, 0.1);
  pointing.follow(desk, false, at(0.4, 0.2, true), kPanel, 0.1);
  CHECK(pointing.pointer()->down);
}
