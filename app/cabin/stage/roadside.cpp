#include "app/cabin/stage/roadside.h"

#include <cmath>
#include <iterator>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "app/cabin/stage/mesh_parts.h"
#include "engine/model/assemble.h"

namespace gearshift::cabin {
namespace {

// [m] Position of the road relative to the car, which is in the middle of the lane with its tyres on the road
// (assets/models/README.md).
constexpr glm::vec3 kRoadPlace{0.335f, -0.53f, 0.0f};
constexpr int kTilesAhead = 36, kTilesBehind = 11;
constexpr double kLeftEdge = -5.7, kRightEdge = 2.2;  // [m] edges of the asphalt, relative to the middle of the lane

// A copy of an object from road.glb. x [m]: to the right of the lane's middle; ahead [m]: from the block's near end;
// yaw [rad].
struct RoadsideObject {
  const char* name;
  double x, ahead;
  double yaw = 0.0, size = 1.0;
};

// [m] Height of the ground at x. The ground continues the verge of the road tile.
double ground(double x) {
  constexpr double kProfile[][2] = {{0.0, 0.0},   {0.6, -0.05}, {1.6, -0.28},  {2.4, -0.30},
                                    {3.6, -0.06}, {8.0, 0.02},  {16.0, -0.05}, {30.0, -0.45}};
  const double off = x > 0.0 ? x - kRightEdge : kLeftEdge - x;
  if (off <= 0.0) return 0.0;
  for (std::size_t i = 1; i < std::size(kProfile); ++i) {
    const auto& a = kProfile[i - 1];
    const auto& b = kProfile[i];
    if (off <= b[0]) return a[1] + (b[1] - a[1]) * (off - a[0]) / (b[0] - a[0]);
  }
  return kProfile[std::size(kProfile) - 1][1];
}

// The sequence of random numbers of one block.
class Dice {
 public:
  explicit Dice(int block) : block_(block) {}
  double between(double low, double high) { return low + (high - low) * road_dice(block_, next_++); }
  double side(double near, double far) {  // x at a random distance from the asphalt
    const double off = between(near, far);
    return between(0.0, 1.0) < 0.5 ? kLeftEdge - off : kRightEdge + off;
  }

 private:
  int block_;
  int next_ = 0;
};

// Adds `count` copies of an object along the block, the first one at `first` [m] and the others `step` [m] apart.
void add_row(const char* name, double x, double first, double step, int count, std::vector<RoadsideObject>& objects) {
  for (int i = 0; i < count; ++i) objects.push_back({name, x, first + step * i});
}

void add_furniture(int block, std::vector<RoadsideObject>& objects) {
  add_row("Post", kRightEdge + 0.5, 6.0, 24.0, 5, objects);
  add_row("Post", kLeftEdge - 0.5, 18.0, 24.0, 5, objects);
  add_row("Pole", kLeftEdge - 6.5, 20.0, 40.0, 3, objects);
  if (block % 3 == 0) add_row("Sign", kRightEdge + 1.0, 57.0, 0.0, 1, objects);
  if (block % 3 == 1) add_row("GuardRail", kRightEdge + 0.9, 40.0, 4.0, 11, objects);
}

void add_landmarks(int block, std::vector<RoadsideObject>& objects) {
  if (block == 2) objects.push_back({"House", kRightEdge + 17.0, 60.0});
  if (block == 5) objects.push_back({"Barn", kRightEdge + 21.0, 75.0});
  if (block == 4) {
    for (int i = 0; i < 4; ++i) objects.push_back({"Bale", kRightEdge + 12.0 + 3.7 * (i % 2), 30.0 + 9.0 * i, 0.4 * i});
  }
}

std::vector<RoadsideObject> place_objects(int block) {
  std::vector<RoadsideObject> objects;
  add_furniture(block, objects);
  add_landmarks(block, objects);
  Dice dice(block);
  const bool has_house = block == 2 || block == 5;
  for (int i = 0; i < 5; ++i) {
    const char* tree = dice.between(0.0, 1.0) < 0.6 ? "TreeBroad" : "TreeSpruce";
    const double x = has_house ? kLeftEdge - dice.between(9.0, 24.0) : dice.side(9.0, 24.0);
    const double ahead = (i + dice.between(0.1, 0.9)) * kBlockLength / 5.0;
    objects.push_back({tree, x, ahead, dice.between(0.0, 2.0 * std::numbers::pi), dice.between(0.8, 1.35)});
  }
  for (int i = 0; i < 5; ++i) {
    const double x = dice.side(3.8, 7.0), ahead = dice.between(0.0, kBlockLength);
    objects.push_back({"Bush", x, ahead, dice.between(0.0, 2.0 * std::numbers::pi), dice.between(0.7, 1.4)});
  }
  return objects;
}

void stamp(const engine::Model& road, const char* name, const glm::mat4& placed, std::vector<MeshPart>& parts) {
  for (MeshPart& part : transformed_parts(road, required_node(road, name), placed)) parts.push_back(std::move(part));
}

glm::mat4 transform_of(const RoadsideObject& object) {
  const glm::vec3 at(glm::dvec3(object.x, ground(object.x), -object.ahead));
  const glm::mat4 turned =
      glm::rotate(glm::translate(glm::mat4(1.0f), at), static_cast<float>(object.yaw), {0.0f, 1.0f, 0.0f});
  return glm::scale(turned, glm::vec3(static_cast<float>(object.size)));
}

std::vector<MeshPart> strip_of_tiles(const engine::Model& road) {
  std::vector<MeshPart> strip;
  for (int i = -kTilesBehind; i <= kTilesAhead; ++i) {
    const float back = static_cast<float>(-kTileLength * i);
    stamp(road, "Road", glm::translate(glm::mat4(1.0f), {0.0f, 0.0f, back}), strip);
  }
  return strip;
}

// Adds a node. first_material: index in `model` of the material that has index 0 in the parts.
void add_node(engine::Model& model, std::string name, std::vector<MeshPart> parts, int first_material) {
  for (MeshPart& part : parts) part.material += first_material;
  engine::Node node;
  node.name = std::move(name);
  node.translation = kRoadPlace;
  model.nodes.push_back(std::move(node));
  set_parts(model, static_cast<int>(model.nodes.size()) - 1, parts);
}

// Extends the hills downwards so far that no gap opens when the fields tilt while the hills stay level.
void sink_feet(std::vector<MeshPart>& hills) {
  constexpr float kBelowFields = -1.0f, kFoot = -100.0f;  // [m]
  for (MeshPart& part : hills) {
    for (engine::Vertex& vertex : part.mesh_data.vertices) {
      if (vertex.position.y < kBelowFields) vertex.position.y = kFoot;
    }
  }
}

std::string block_name(int block) {
  return "RoadBlock" + std::to_string(block);
}

}  // namespace

void Roadside::add_to(engine::Model& model, const engine::Model& road_model) {
  const auto first_material = static_cast<int>(model.materials.size());
  engine::Model paints;  // has only materials and textures, no meshes
  paints.materials = road_model.materials;
  paints.textures = road_model.textures;
  engine::append_model(model, paints);
  add_node(model, "RoadStrip", strip_of_tiles(road_model), first_material);
  std::vector<MeshPart> land;
  stamp(road_model, "Fields", glm::mat4(1.0f), land);
  add_node(model, "Land", std::move(land), first_material);
  std::vector<MeshPart> hills;
  stamp(road_model, "Hills", glm::mat4(1.0f), hills);
  sink_feet(hills);
  add_node(model, "Hills", std::move(hills), first_material);
  // Leaves and opaque objects share a texture, so both can use the leaves' masked material and need only one draw.
  const int masked = required_material(road_model, "Leaves"), opaque = required_material(road_model, "Roadside");
  for (int block = 0; block < kBlocks; ++block) {
    std::vector<MeshPart> parts;
    for (const RoadsideObject& object : place_objects(block))
      stamp(road_model, object.name, transform_of(object), parts);
    for (MeshPart& part : parts) {
      if (part.material == opaque) part.material = masked;
    }
    add_node(model, block_name(block), std::move(parts), first_material);
  }
}

std::vector<std::string> Roadside::moving_names() {
  std::vector<std::string> names{"RoadStrip", "Land", "Hills"};  // moving nodes are not merged with the cabin
  for (int block = 0; block < kBlocks; ++block) names.push_back(block_name(block));
  return names;
}

Roadside::Roadside(const engine::Model& model)
    : strip_(required_node(model, "RoadStrip")), land_(required_node(model, "Land")) {
  place_ = model.nodes[static_cast<std::size_t>(strip_)].translation;
  for (int block = 0; block < kBlocks; ++block) {
    block_[static_cast<std::size_t>(block)] = required_node(model, block_name(block));
  }
}

void Roadside::place(double distance, double slope, std::vector<engine::Node>& pose) const {
  const glm::quat tilt = glm::angleAxis(static_cast<float>(slope), glm::vec3(1.0f, 0.0f, 0.0f));
  const auto put = [&](int node, glm::dvec3 from_car) {
    pose[static_cast<std::size_t>(node)].rotation = tilt;
    pose[static_cast<std::size_t>(node)].translation = place_ + tilt * glm::vec3(from_car);
  };
  put(land_, glm::dvec3(0.0));
  put(strip_, {0.0, 0.0, tile_shift(distance)});
  for (int block = 0; block < kBlocks; ++block) {
    const BlockPlace at = block_place(block, distance);
    put(block_[static_cast<std::size_t>(block)], {0.0, at.height, -at.ahead});
  }
}

}  // namespace gearshift::cabin
