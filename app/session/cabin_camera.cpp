#include "app/session/cabin_camera.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include <glm/gtc/quaternion.hpp>

#include "app/cabin/stage/stage.h"

namespace gearshift::session {
namespace {
constexpr double kDegree = std::numbers::pi / 180.0;
}

CabinCamera::CabinCamera(std::string_view first, cabin::DriveSide side) : side_(side) {
  go_to(first);
}

void CabinCamera::go_to(std::string_view place) {
  cabin::camera(place);  // throws for an unknown place
  place_ = static_cast<std::size_t>(std::find(kPlaces.begin(), kPlaces.end(), place) - kPlaces.begin());
  recentre();
}

void CabinCamera::next() {
  place_ = (place_ + 1) % kPlaces.size();
  recentre();
}

bool CabinCamera::follow_shift(bool is_replaying_shift) {
  if (std::exchange(was_replaying_shift_, is_replaying_shift) == is_replaying_shift) return false;
  const std::string_view away = "lever", from = "driver";
  if (is_replaying_shift) {
    left_driver_ = place() == from;
    if (left_driver_) go_to(away);
    return left_driver_;
  }
  const bool returns = std::exchange(left_driver_, false) && place() == away;
  if (returns) go_to(from);
  return returns;
}

void CabinCamera::turn(glm::dvec2 moved_px) {
  yaw_ = std::clamp(yaw_ - 0.2 * kDegree * moved_px.x, -80.0 * kDegree, 80.0 * kDegree);
  pitch_ = std::clamp(pitch_ - 0.2 * kDegree * moved_px.y, -60.0 * kDegree, 60.0 * kDegree);
}

void CabinCamera::recentre() {
  yaw_ = pitch_ = 0.0;
}

double CabinCamera::field() const {
  return cabin::camera_field(kPlaces[place_]);
}

engine::EyePose CabinCamera::pose() const {
  engine::EyePose eye = cabin::camera(kPlaces[place_], side_);
  // Turns the view by the yaw about the vertical of the cabin, not of the camera, so that the horizon stays level.
  eye.orientation = glm::angleAxis(yaw_, glm::dvec3(0.0, 1.0, 0.0)) * eye.orientation *
                    glm::angleAxis(pitch_, glm::dvec3(1.0, 0.0, 0.0));
  return eye;
}

}  // namespace gearshift::session
