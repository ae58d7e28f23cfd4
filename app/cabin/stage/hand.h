// The hand on the knob: a gloved hand with wrist and forearm, as one skinned mesh.
#pragma once

#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "app/cabin/stage/drive_side.h"
#include "engine/model/model.h"

namespace gearshift::cabin {

inline constexpr double kWristLeanFraction = 0.5;  // [1] the hand leans by this fraction of the lever's lean

class Hand {
 public:
  // Adds hand_model (read from hand.glb) to the model below a new node "HandRoot" at `knob`, and a second node with the
  // same mesh, "GhostHand". knob: position of the upright lever's knob in the world. Throws std::runtime_error if a
  // node is missing.
  static void add_to(engine::Model& model, const engine::Model& hand_model, glm::vec3 knob);

  // Finds the nodes that add_to() has added. For DriveSide::right the model must be mirrored, because the hand is then
  // a left hand.
  explicit Hand(const engine::Model& model, DriveSide side = DriveSide::left);

  int skin_node() const noexcept { return skin_; }
  int ghost_node() const noexcept { return ghost_; }

  // Puts the hand on the knob. The hand leans by kWristLeanFraction of the lever's lean. The forearm turns about the
  // wrist, so that it points to an elbow that does not move.
  void place(glm::dvec3 knob, const glm::dquat& lever, std::vector<engine::Node>& pose) const;

 private:
  int root_ = engine::kNone, skin_ = engine::kNone, ghost_ = engine::kNone, wrist_ = engine::kNone,
      forearm_ = engine::kNone;
  // Pose at rest: position [m] relative to the knob, and rotations.
  glm::dvec3 wrist_at_{0.0};
  glm::dquat wrist_turn_{1.0, 0.0, 0.0, 0.0};
  glm::dquat forearm_turn_{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 elbow_at_{0.0};
  glm::dvec3 elbow_{0.0};  // [m] position of the elbow in the world
};

}  // namespace gearshift::cabin
