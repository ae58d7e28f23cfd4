// The hand on the knob: gloved hand, wrist and forearm as one skin.
#pragma once

#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "app/stage/drive_side.h"
#include "engine/model/model.h"

namespace gearshift {

inline constexpr double kWristShare = 0.5;  // of the lever's lean: the rest is taken by the wrist

class Hand {
 public:
  // Adds hand.glb to the model below a new node "HandRoot" at the knob of the upright lever (world), and a twin of its
  // skin, "GhostHand". Throws std::runtime_error where a node is missing.
  static void add_to(Model& model, const Model& hand_model, glm::vec3 knob);

  // Finds what add_to() made; on the right, mirrored: a left hand.
  explicit Hand(const Model& model, DriveSide side = DriveSide::left);

  int skin_node() const noexcept { return skin_; }
  int ghost_node() const noexcept { return ghost_; }

  // Root on the knob, leaning kWristShare of the lever's lean; the forearm turns about the wrist so that it points to
  // an elbow that stays where it is.
  void place(glm::dvec3 knob, const glm::dquat& lever, std::vector<Node>& pose) const;

 private:
  int root_ = kNone, skin_ = kNone, ghost_ = kNone, wrist_ = kNone, forearm_ = kNone;
  glm::dvec3 wrist_at_{0.0};                     // [m] from the knob, at rest
  glm::dquat wrist_turn_{1.0, 0.0, 0.0, 0.0};    // at rest
  glm::dquat forearm_turn_{1.0, 0.0, 0.0, 0.0};  // at rest
  glm::dvec3 elbow_at_{0.0};                     // [m] from the knob, at rest
  glm::dvec3 elbow_{0.0};                        // [m] world
};

}  // namespace gearshift
