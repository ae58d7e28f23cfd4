// The desktop camera: a named place in the cabin, turned by the mouse.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include <glm/vec2.hpp>

#include "app/cabin/stage/drive_side.h"
#include "engine/scene/view.h"

namespace gearshift::session {

class CabinCamera {
 public:
  // Throws std::invalid_argument for an unknown camera.
  explicit CabinCamera(std::string_view first, cabin::DriveSide side = cabin::DriveSide::left);
  void next();
  void go_to(std::string_view place);  // same errors as the constructor
  // Moves the camera from "driver" to "lever" while a single shift is replayed, and back afterwards, because the
  // lever's paths are too small to see from the driver's seat. Other cameras are not moved. Call once per frame;
  // returns true when the camera has changed.
  bool follow_shift(bool is_replaying_shift);
  void turn(glm::dvec2 moved_px);  // positive right, down; 0.2 deg/px, at most 80 deg sideways, 60 deg up or down
  void recentre();
  std::string_view place() const { return kPlaces[place_]; }
  engine::EyePose pose() const;
  double field() const;  // [deg] field of view, see camera_field()

 private:
  static constexpr std::array<std::string_view, 6> kPlaces{"driver", "ahead", "lever", "gate", "cluster", "gearbox"};
  cabin::DriveSide side_;
  std::size_t place_ = 0;
  bool was_replaying_shift_ = false;
  bool left_driver_ = false;        // true if the camera was moved from "driver" to show the shift
  double yaw_ = 0.0, pitch_ = 0.0;  // [rad] positive left, up
};

}  // namespace gearshift::session
