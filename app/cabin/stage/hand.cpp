#include "app/cabin/stage/hand.h"

#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtx/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "app/cabin/stage/mesh_parts.h"
#include "engine/model/assemble.h"

namespace gearshift::cabin {
namespace {

constexpr glm::dvec3 kElbow{-0.085, 0.055, 0.325};  // [m] from the upright lever's knob (assets/models/README.md)

glm::dquat turn_of(const glm::mat4& world) {
  return glm::normalize(glm::dquat(glm::quat_cast(glm::mat3(world))));
}

// Merges adjacent primitives with the same material, which reduces the number of draws. (The functions of mesh_parts.h
// do not support skinned meshes.)
void join_neighbours(engine::Mesh& mesh) {
  std::vector<engine::Primitive> joined;
  for (const engine::Primitive& next : mesh.primitives) {
    if (joined.empty() || joined.back().material != next.material ||
        joined.back().first_index + joined.back().index_count != next.first_index) {
      joined.push_back(next);
      continue;
    }
    joined.back().index_count += next.index_count;
    joined.back().low = glm::min(joined.back().low, next.low);
    joined.back().high = glm::max(joined.back().high, next.high);
  }
  mesh.primitives = std::move(joined);
}

}  // namespace

void Hand::add_to(engine::Model& model, const engine::Model& hand_model, glm::vec3 knob) {
  engine::Node root;
  root.name = "HandRoot";
  root.translation = knob;
  model.nodes.push_back(root);
  engine::append_model(model, hand_model, static_cast<int>(model.nodes.size()) - 1);
  const int skin = required_node(model, "HandMesh");
  join_neighbours(model.meshes[static_cast<std::size_t>(model.nodes[static_cast<std::size_t>(skin)].mesh)]);
  const int ghost = add_twin(model, skin, "GhostHand", engine::kNone);
  // The ghost hand needs no skin: it uses the hand's vertices after skinning.
  model.nodes[static_cast<std::size_t>(ghost)].skin = engine::kNone;
}

Hand::Hand(const engine::Model& model, DriveSide side)
    : root_(required_node(model, "HandRoot")),
      skin_(required_node(model, "HandMesh")),
      ghost_(required_node(model, "GhostHand")),
      wrist_(model.nodes[static_cast<std::size_t>(required_node(model, "Forearm"))].parent),
      forearm_(required_node(model, "Forearm")) {
  const std::vector<glm::mat4> rest = engine::rest_pose(model);
  const glm::dvec3 knob(rest[static_cast<std::size_t>(root_)][3]);
  wrist_at_ = glm::dvec3(rest[static_cast<std::size_t>(forearm_)][3]) - knob;
  wrist_turn_ =
      wrist_ == engine::kNone ? glm::dquat(1.0, 0.0, 0.0, 0.0) : turn_of(rest[static_cast<std::size_t>(wrist_)]);
  forearm_turn_ = turn_of(rest[static_cast<std::size_t>(forearm_)]);
  elbow_at_ = side == DriveSide::left ? kElbow : kElbow * glm::dvec3(-1.0, 1.0, 1.0);
  elbow_ = knob + elbow_at_;
}

void Hand::place(glm::dvec3 knob, const glm::dquat& lever, std::vector<engine::Node>& pose) const {
  const glm::dquat lean = glm::slerp(glm::dquat(1.0, 0.0, 0.0, 0.0), lever, kWristLeanFraction);
  engine::Node& root = pose[static_cast<std::size_t>(root_)];
  root.translation = glm::vec3(knob);
  root.rotation = glm::quat(lean);
  const glm::dvec3 at_rest = glm::normalize(elbow_at_ - wrist_at_);
  const glm::dvec3 now = glm::normalize(elbow_ - knob - lean * wrist_at_);
  const glm::dquat forearm = glm::rotation(at_rest, now) * forearm_turn_;
  pose[static_cast<std::size_t>(forearm_)].rotation = glm::quat(glm::inverse(lean * wrist_turn_) * forearm);
}

}  // namespace gearshift::cabin
