#include "app/train/look_around.h"

#include <algorithm>
#include <numbers>

#include <glm/gtc/quaternion.hpp>

#include "app/stage/stage.h"

namespace gearshift {
namespace {
constexpr double kDegree = std::numbers::pi / 180.0;
}

LookAround::LookAround(std::string_view first) {
  camera(first);  // refuses
  place_ = static_cast<std::size_t>(std::find(kPlaces.begin(), kPlaces.end(), first) - kPlaces.begin());
}

void LookAround::next() {
  place_ = (place_ + 1) % kPlaces.size();
  recentre();
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
  EyePose eye = camera(kPlaces[place_]);
  // Turned about the world's vertical first: the horizon stays level.
  eye.orientation = glm::angleAxis(yaw_, glm::dvec3(0.0, 1.0, 0.0)) * eye.orientation *
                    glm::angleAxis(pitch_, glm::dvec3(1.0, 0.0, 0.0));
  return eye;
}

}  // namespace gearshift
