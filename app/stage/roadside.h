// The meshes of the road: a strip of tiles, the land around, and blocks of roadside with trees, posts, houses.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "app/stage/road.h"
#include "engine/model/model.h"

namespace gearshift {

class Roadside {
 public:
  // Adds nodes "RoadStrip", "Land", "Hills" and "RoadBlock0" ... to the model, made of road.glb's things. Which thing
  // stands where is thrown with road_dice(). Throws std::runtime_error where a thing is missing.
  static void add_to(Model& model, const Model& road_model);

  static std::vector<std::string> moving_names();

  explicit Roadside(const Model& model);  // finds what add_to() made

  // Moves the world back by the distance that the car has gone [m], and tilts road and fields about the car by the
  // slope [rad, uphill +]: cabin and hills stay level, the way ahead rises.
  void place(double distance, double slope, std::vector<Node>& pose) const;

 private:
  glm::vec3 place_{0.0f};  // [m] where the car is on it
  int strip_ = kNone, land_ = kNone;
  std::array<int, kBlocks> block_{};
};

}  // namespace gearshift
