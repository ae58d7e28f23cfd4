// The meshes of road and roadside: a strip of tiles, the surrounding land, and blocks with trees, posts and houses.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "app/cabin/stage/road.h"
#include "engine/model/model.h"

namespace gearshift::cabin {

class Roadside {
 public:
  // Adds nodes "RoadStrip", "Land", "Hills" and "RoadBlock0" ... to the model. They consist of objects of road_model
  // (road.glb), placed with road_dice(). Throws std::runtime_error if an object is missing.
  static void add_to(engine::Model& model, const engine::Model& road_model);

  static std::vector<std::string> moving_names();

  explicit Roadside(const engine::Model& model);  // finds the nodes that add_to() has added

  // Moves the road back by the distance [m] that the car has driven, and tilts road and fields about the car by the
  // slope [rad], positive uphill; cabin and hills stay level.
  void place(double distance, double slope, std::vector<engine::Node>& pose) const;

 private:
  glm::vec3 place_{0.0f};  // [m] position of the road relative to the car
  int strip_ = engine::kNone, land_ = engine::kNone;
  std::array<int, kBlocks> block_{};
};

}  // namespace gearshift::cabin
