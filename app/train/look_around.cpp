#include "app/train/look_around.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include <glm/gtc/quaternion.hpp>

#include "app/stage/stage.h"

namespace gearshift {
namespace {
constexpr double kDegree = std::numbers::pi / 180.0;
}

LookAround::LookAround(std::string_view first, DriveSide side) : side_(side) {
  go_to(first);
}

void LookAround::go_to(std::string_view place) {
  camera(place);  // refuses
  place_ = static_cast<std::size_t>(std::find(kPlaces.begin(), kPlaces.end(), place) - kPlaces.begin());
  recentre();
}

void LookAround::next() {
  place_ = (place_ + 1) % kPlaces.size();
  recentre();
}

bool LookAround::follow_shift(bool replays_shift) {
  if (std::exchange(replays_shift_, replays_shift) == replays_shift) return false;
  const std::string_view away = "lever", from = "driver";
  if (replays_shift) {
    left_driver_ = place() == from;
    if (left_driver_) go_to(away);
    return left_driver_;
  }
  const bool returns = std::exchange(left_driver_, false) && place() == away;
  if (returns) go_to(from);
  return returns;
}

void LookAround::turn(glm::dvec2 moved_px) {
  yaw_ = std::clamp(yaw_ - 0.2 * kDegree * moved_px.x, -80.0 * kDegree, 80.0 * kDegree);
  pitch_ = std::clamp(pitch_ - 0.2 * kDegree * moved_px.y, -60.0 * kDegree, 60.0 * kDegree);
}

void LookAround::recentre() {
  yaw_ = pitch_ = 0.0;
}

double LookAround::field() const {
  return camera_field(kPlaces[place_]);
}

EyePose LookAround::pose() const {
  EyePose eye = camera(kPlaces[place_], side_);
  // Turned about the world's vertical first: the horizon stays level.
  eye.orientation = glm::angleAxis(yaw_, glm::dvec3(0.0, 1.0, 0.0)) * eye.orientation *
                    glm::angleAxis(pitch_, glm::dvec3(1.0, 0.0, 0.0));
  return eye;
}

}  // namespace gearshift
