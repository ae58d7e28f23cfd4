// Who leads the panel's mouse: the hand that points at it, or the one on the desk.
#include "app/train/pointing_hand.h"

#include <doctest/doctest.h>

#include "app/train/ui_scale.h"

using namespace gearshift;

namespace {

constexpr glm::ivec2 kPanel{1000, 500};  // [px]

std::optional<WornHeadset::Pointer> at(double x, double y, bool selects = false) {
  return WornHeadset::Pointer{{{x, y}, 1.0}, selects, {0.0, 0.5}};
}

}  // namespace

TEST_CASE("a hand that comes to the panel leads, until the desk's mouse moves; its trigger takes it back") {
  PointingHand pointing;
  WindowInput desk;
  desk.mouse = {7.0, 9.0};
  pointing.follow(desk, std::nullopt, kPanel);
  CHECK_FALSE(pointing.leads());
  CHECK(pointing.input().mouse == glm::dvec2(7.0, 9.0));
  pointing.follow(desk, at(0.5, 0.2), kPanel);
  CHECK(pointing.leads());
  CHECK(pointing.input().mouse == glm::dvec2(500.0, 100.0));
  CHECK_FALSE(pointing.input().mouse_down[0]);
  CHECK(pointing.input().scroll.y > 0.0);
  desk.mouse_moved = {3.0, 0.0};
  pointing.follow(desk, at(0.5, 0.2), kPanel);
  CHECK_FALSE(pointing.leads());
  CHECK(pointing.input().mouse == glm::dvec2(7.0, 9.0));
  desk.mouse_moved = {0.0, 0.0};
  pointing.follow(desk, at(0.5, 0.2), kPanel);  // it has not come anew
  CHECK_FALSE(pointing.leads());
  pointing.follow(desk, at(0.5, 0.2, true), kPanel);
  CHECK(pointing.leads());
  CHECK(pointing.input().mouse_down[0]);
  pointing.follow(desk, std::nullopt, kPanel);
  CHECK_FALSE(pointing.leads());
  CHECK_FALSE(pointing.input().mouse_down[0]);
}

TEST_CASE("in a headset a part of more pixels, which hangs as wide as ever, has larger text") {
  CHECK(UiScale::in_headset(1.0f, 640.0) == 1.0f);   // between the columns of 1280 px
  CHECK(UiScale::in_headset(1.0f, 1280.0) == 2.0f);  // without them
  CHECK(UiScale::in_headset(2.0f, 960.0) == 2.0f);   // a display's own scale
}
