// The hand on the knob: gloved hand, wrist and forearm as one skinned mesh.
#pragma once

#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "app/cabin/stage/drive_side.h"
#include "engine/model/model.h"

namespace gearshift::cabin {

inline constexpr double kWristShare = 0.5;  // of the lever's lean that the hand follows

class Hand {
 public:
  // Adds hand.glb to the model below a new node "HandRoot" at the knob of the upright lever (world), and a second node
  // with the same mesh, "GhostHand". Throws std::runtime_error if a node is missing.
  static void add_to(engine::Model& model, const engine::Model& hand_model, glm::vec3 knob);

  // Finds the nodes that add_to() made. With the driver on the right, the model is mirrored: a left hand.
  explicit Hand(const engine::Model& model, DriveSide side = DriveSide::left);

  int skin_node() const noexcept { return skin_; }
  int ghost_node() const noexcept { return ghost_; }

  // Puts the root on the knob, leaning by kWristShare of the lever's lean. The forearm turns about the wrist so that it
  // points to a fixed elbow.
  void place(glm::dvec3 knob, const glm::dquat& lever, std::vector<engine::Node>& pose) const;

 private:
  int root_ = engine::kNone, skin_ = engine::kNone, ghost_ = engine::kNone, wrist_ = engine::kNone,
      forearm_ = engine::kNone;
  glm::dvec3 wrist_at_{0.0};                     // [m] from the knob, at rest
  glm::dquat wrist_turn_{1.0, 0.0, 0.0, 0.0};    // at rest
  glm::dquat forearm_turn_{1.0, 0.0, 0.0, 0.0};  // at rest
  glm::dvec3 elbow_at_{0.0};                     // [m] from the knob, at rest
  glm::dvec3 elbow_{0.0};                        // [m] world
};

}  // namespace gearshift::cabin
