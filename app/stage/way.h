// A way that the knob took, or should have: a thin tube of light over the gate, just above the knob's cap, where
// neither knob nor plate hides it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/model/model.h"
#include "haptics/joystick/kinematics.h"

namespace gearshift {

inline constexpr double kWayLift = 0.026;  // [m] beyond the knob's centre, away from the pivot: the cap ends at 0.0213
inline constexpr int kWayRings = 320;      // a way of any length is drawn with so many
inline constexpr int kWaySides = 6;

struct WayLook {
  double radius = 0.001;         // [m]
  double dash = 0.0, gap = 0.0;  // [m] along the way; without a gap it is one piece
  glm::vec3 light{1.0f};         // emission
};

// Names of the stage's two, and how they look, in the colours of the panel: what was driven, and dashes about it where it
// should have gone.
inline constexpr const char* kDrivenWay = "DrivenWay";
inline constexpr const char* kIdealWay = "IdealWay";
inline constexpr WayLook kDrivenLook{0.0012, 0.0, 0.0, {0.60f, 0.07f, 0.28f}};
inline constexpr WayLook kIdealLook{0.0017, 0.004, 0.004, {0.25f, 0.42f, 0.03f}};

// Adds a node of that name at the lever's pivot [m, world], whose mesh shape_way() fills. Returns the node.
int add_way(Model& model, const std::string& name, glm::vec3 pivot, const WayLook& look);

// Vertices of that mesh: ring i, kWaySides of them from i * kWaySides on, about the lever's axis kWayLift above the
// knob's centre where the knob is over the point after i / (kWayRings - 1) of the way's length. way: in the gate plane
// [m]; points that are no numbers are left out. Its ends and a dash's are pointed. False, and `out` as it was, where
// it has no length.
bool shape_way(std::span<const glm::dvec2> way, const YokeGeometry& yoke, const WayLook& look,
               std::vector<Vertex>& out);

}  // namespace gearshift
