// Where the person looks from: a named place in the cabin, turned by the mouse.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include <glm/vec2.hpp>

#include "app/stage/drive_side.h"
#include "engine/scene/view.h"

namespace gearshift {

class LookAround {
 public:
  // Throws std::invalid_argument for an unknown camera.
  explicit LookAround(std::string_view first, DriveSide side = DriveSide::left);
  void next();
  void go_to(std::string_view place);  // throws as the constructor
  // A shift that is looked at is seen at the lever, where its ways lie, and then again from where it was: but only by the
  // driver, who sees them too small. Once a frame; true where the place is another one now.
  bool follow_shift(bool replays_shift);
  void turn(glm::dvec2 moved_px);  // right +, down +; 0.2 deg a pixel, up to 80 deg to the side and 60 up or down
  void recentre();
  std::string_view place() const { return kPlaces[place_]; }
  EyePose pose() const;
  double field() const;  // [deg] see camera_field()

 private:
  static constexpr std::array<std::string_view, 6> kPlaces{"driver", "ahead", "lever", "gate", "cluster", "gearbox"};
  DriveSide side_;
  std::size_t place_ = 0;
  bool replays_shift_ = false;      // in the frame before
  bool left_driver_ = false;        // for it
  double yaw_ = 0.0, pitch_ = 0.0;  // [rad] left and up +
};

}  // namespace gearshift
