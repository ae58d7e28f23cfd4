// Tests of the panel that hangs in the cabin, seen in a headset: its place, the legibility of its text, and a hand that
// points at it.
#include "app/cabin/headset/hanging_panel.h"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace gearshift::cabin;
using namespace gearshift::engine;
using glm::dvec3;

namespace {

constexpr dvec3 kEye{0.0, 0.635, 0.05};
constexpr double kDegree = std::numbers::pi / 180.0;

// The pose of a hand at `hand` that points at `at`, a position in the panel's picture (0 to 1 in each direction).
EyePose pointing(const HangingPanel& panel, dvec3 hand, glm::dvec2 at) {
  const dvec3 target = panel.pose * dvec3((at.x - 0.5) * panel.size.x, (0.5 - at.y) * panel.size.y, 0.0);
  return look_at(hand, target);
}

}  // namespace

TEST_CASE("the panel is 1 to 3 m away, faces the driver, and hangs upright on the passenger's side") {
  for (const DriveSide side : {DriveSide::left, DriveSide::right}) {
    const dvec3 eye = on_side(side, kEye);
    const HangingPanel panel = hang_panel(eye, side, {1280, 720});
    const double distance = glm::distance(panel.pose.position, eye);
    CHECK(distance >= 1.0);
    CHECK(distance <= 3.0);
    CHECK(glm::dot(panel.pose.orientation * dvec3(0, 0, 1), (eye - panel.pose.position) / distance) > 0.9999);
    CHECK((panel.pose.orientation * dvec3(1, 0, 0)).y == doctest::Approx(0.0));
    CHECK((panel.pose.position.x - eye.x) * (side == DriveSide::left ? 1.0 : -1.0) > 0.3);
    CHECK(panel.size.x / panel.size.y == doctest::Approx(1280.0 / 720.0));
  }
}

// ISO 9241-303: letters are legible if they are at least 16 minutes of arc high, and comfortable to read if they are 20
// to 22 minutes of arc high. The font is DejaVu Sans, whose capitals are 0.729 em and whose lines are 1.164 em high. At
// scale 1, lines are 13 px high in the panel's small font and 15 px in its body font (engine/ui/ui_style.cpp). In a
// headset, the scale is the width of the panel's picture divided by 1280 (UiScale).
TEST_CASE("capitals of the panel's fonts are at least 20 minutes of arc high") {
  const HangingPanel panel = hang_panel(kEye, DriveSide::left, {1280, 720});
  const double px = panel.size.x / 1280.0, distance = glm::distance(panel.pose.position, kEye);
  for (const double font : {13.0, 15.0}) {
    const double minutes = 60.0 / kDegree * std::atan(0.729 / 1.164 * font * px / distance);
    CAPTURE(font);
    CHECK(minutes >= 20.0);
  }
}

TEST_CASE("a hand hits the point of the panel at which it points, and nothing from behind or outside the panel") {
  const HangingPanel panel = hang_panel(kEye, DriveSide::left, {1280, 720});
  const dvec3 hand{0.2, 0.3, -0.2};
  for (const glm::dvec2 at : {glm::dvec2(0.5, 0.5), glm::dvec2(0.02, 0.97), glm::dvec2(0.9, 0.1)}) {
    const auto hit = point_at(panel, pointing(panel, hand, at));
    REQUIRE(hit);
    CHECK(glm::distance(hit->at, at) < 1e-9);
    const dvec3 met = hand + hit->distance * (pointing(panel, hand, at).orientation * dvec3(0, 0, -1));
    CHECK(std::abs((inverse(panel.pose) * met).z) < 1e-9);
  }
  CHECK_FALSE(point_at(panel, pointing(panel, hand, {1.01, 0.5})));
  CHECK_FALSE(point_at(panel, pointing(panel, hand, {0.5, -0.01})));
  const dvec3 behind = panel.pose * dvec3(0.0, 0.0, -0.5);
  CHECK_FALSE(point_at(panel, look_at(behind, panel.pose.position)));
  EyePose away = pointing(panel, hand, {0.5, 0.5});
  away.orientation = away.orientation * glm::angleAxis(std::numbers::pi, dvec3(0, 1, 0));
  CHECK_FALSE(point_at(panel, away));
}

TEST_CASE("a learner's card hangs next to the view ahead, with pixels as large as the panel's, and can be pointed at") {
  const glm::dvec2 low{0.25, 0.0}, high{0.75, 0.9};
  for (const DriveSide side : {DriveSide::left, DriveSide::right}) {
    const dvec3 eye = on_side(side, kEye);
    const HangingPanel panel = hang_panel(eye, side, {1280, 720}), card = hang_card(eye, side, {1280, 720}, low, high);
    // The card covers half of the picture's width and 0.9 of its height, and its pixels are as large as the panel's.
    CHECK(card.size.x == doctest::Approx(0.5 * panel.size.x));
    CHECK(card.size.y == doctest::Approx(0.9 * panel.size.y));
    // Without the panel, the card fills the picture.
    const HangingPanel without_panel = hang_card(eye, side, {1280, 720}, {0.0, 0.0}, {1.0, 1.0});
    CHECK(without_panel.size.x == doctest::Approx(card.size.x));
    CHECK(glm::distance(card.pose.position, eye) == doctest::Approx(glm::distance(panel.pose.position, eye)));
    // Seen from the eye, the card's inner edge is more than 5 degrees to the side, and its lower edge is about 6.5
    // degrees below the horizon.
    const double inner = side == DriveSide::left ? -0.5 : 0.5;
    const dvec3 edge = card.pose * dvec3(inner * card.size.x, 0.0, 0.0) - eye;
    CHECK(std::abs(std::atan2(edge.x, -edge.z)) > 5.0 * kDegree);
    const dvec3 foot = card.pose * dvec3(0.0, -0.5 * card.size.y, 0.0) - eye;
    CHECK(std::asin(foot.y / glm::length(foot)) == doctest::Approx(-6.5 * kDegree).epsilon(0.05));
    const dvec3 target = card.pose * dvec3(0.1, -0.2, 0.0);
    const auto hit = point_at(card, look_at({0.3, 0.2, -0.1}, target));
    REQUIRE(hit);
    CHECK(hit->at.x == doctest::Approx(0.5 + 0.1 / card.size.x * 0.5));
    CHECK(hit->at.y == doctest::Approx(0.45 + 0.2 / card.size.y * 0.9));
  }
}
