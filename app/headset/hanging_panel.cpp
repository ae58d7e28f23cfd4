#include "app/headset/hanging_panel.h"

#include <cmath>
#include <numbers>

namespace gearshift {
namespace {

constexpr double kDistance = 1.4;                           // [m]
constexpr double kWidth = 1.5;                              // [m]
constexpr double kAside = 36.0 * std::numbers::pi / 180.0;  // [rad] towards the passenger
constexpr double kAbove = 2.0 * std::numbers::pi / 180.0;   // [rad]

}  // namespace

HangingPanel hang_panel(glm::dvec3 driver_eye, DriveSide side, glm::dvec2 picture) {
  const double aside = side == DriveSide::left ? kAside : -kAside;
  const glm::dvec3 towards{std::sin(aside) * std::cos(kAbove), std::sin(kAbove), -std::cos(aside) * std::cos(kAbove)};
  const glm::dvec3 at = driver_eye + kDistance * towards;
  HangingPanel panel;
  panel.pose = look_at(at, at + towards);  // its -Z looks away from the driver
  panel.size = {kWidth, kWidth * picture.y / picture.x};
  return panel;
}

std::optional<PanelHit> point_at(const HangingPanel& panel, const EyePose& hand) {
  const EyePose seen = inverse(panel.pose) * hand;
  const glm::dvec3 along = seen.orientation * glm::dvec3(0.0, 0.0, -1.0);
  if (seen.position.z <= 0.0 || along.z >= 0.0) return std::nullopt;
  PanelHit hit;
  hit.distance = seen.position.z / -along.z;
  const glm::dvec3 at = seen.position + hit.distance * along;
  hit.at = {0.5 + at.x / panel.size.x, 0.5 - at.y / panel.size.y};
  const bool inside = hit.at.x >= 0.0 && hit.at.x <= 1.0 && hit.at.y >= 0.0 && hit.at.y <= 1.0;
  return inside ? std::optional(hit) : std::nullopt;
}

}  // namespace gearshift
