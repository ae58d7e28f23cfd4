#include "app/cabin/headset/hanging_panel.h"

#include <cmath>
#include <numbers>

namespace gearshift::cabin {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kDistance = 1.4;    // [m] from the driver's eyes to the panel
constexpr double kWidth = 1.5;       // [m] width of the whole panel
constexpr double kCardWidth = 0.75;  // [m] width of the lesson card

struct Direction {
  double aside, above;  // [rad] positive towards the passenger and up
};
constexpr Direction kPanel{36.0 * kDegree, 2.0 * kDegree};
constexpr Direction kCardFoot{23.0 * kDegree, -6.5 * kDegree};  // direction of the card's lower edge

glm::dvec3 towards(Direction direction, DriveSide side) {
  const double aside = side == DriveSide::left ? direction.aside : -direction.aside;
  return {std::sin(aside) * std::cos(direction.above), std::sin(direction.above),
          -std::cos(aside) * std::cos(direction.above)};
}

// A panel in the direction `along` from the driver's eyes; the -Z of its pose points away from the driver.
HangingPanel panel_at(glm::dvec3 driver_eye, glm::dvec3 along) {
  const glm::dvec3 at = driver_eye + kDistance * along;
  HangingPanel panel;
  panel.pose = engine::look_at(at, at + along);
  return panel;
}

}  // namespace

HangingPanel hang_panel(glm::dvec3 driver_eye, DriveSide side, glm::dvec2 picture) {
  HangingPanel panel = panel_at(driver_eye, towards(kPanel, side));
  panel.size = {kWidth, kWidth * picture.y / picture.x};
  return panel;
}

HangingPanel hang_card(glm::dvec3 driver_eye, DriveSide side, glm::dvec2 picture, glm::dvec2 low, glm::dvec2 high) {
  const glm::dvec2 part = (high - low) * picture;
  const glm::dvec2 size = kCardWidth / part.x * part;
  Direction middle = kCardFoot;
  middle.above += std::atan(0.5 * size.y / kDistance);
  HangingPanel card = panel_at(driver_eye, towards(middle, side));
  card.size = size;
  card.low = low;
  card.high = high;
  return card;
}

std::optional<PanelHit> point_at(const HangingPanel& panel, const engine::EyePose& hand) {
  const engine::EyePose local = engine::inverse(panel.pose) * hand;
  const glm::dvec3 along = local.orientation * glm::dvec3(0.0, 0.0, -1.0);
  if (local.position.z <= 0.0 || along.z >= 0.0) return std::nullopt;
  PanelHit hit;
  hit.distance = local.position.z / -along.z;
  const glm::dvec3 at = local.position + hit.distance * along;
  const glm::dvec2 fraction{0.5 + at.x / panel.size.x, 0.5 - at.y / panel.size.y};
  hit.at = panel.low + fraction * (panel.high - panel.low);
  const bool inside = fraction.x >= 0.0 && fraction.x <= 1.0 && fraction.y >= 0.0 && fraction.y <= 1.0;
  return inside ? std::optional(hit) : std::nullopt;
}

}  // namespace gearshift::cabin
