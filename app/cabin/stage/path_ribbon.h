// The driven or ideal path of the knob, drawn as a thin luminous tube just above the knob's cap, where neither knob nor
// plate hides it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/model/model.h"
#include "haptics/joystick/kinematics.h"

namespace gearshift::cabin {

inline constexpr double kPathLift = 0.026;  // [m] height above the knob's centre; the knob's cap ends at 0.0213 m
inline constexpr int kPathRings = 320;      // number of rings in the tube's mesh, for a path of any length
inline constexpr int kPathSides = 6;

struct PathStyle {
  double radius = 0.001;         // [m] radius of the tube
  double dash = 0.0, gap = 0.0;  // [m] length along the path; gap = 0: a solid line
  glm::vec3 light{1.0f};         // emitted colour
};

// Node names and styles of the two displayed paths, driven (solid) and ideal (dashed), in the panel's colours.
inline constexpr const char* kDrivenPath = "DrivenWay";
inline constexpr const char* kIdealPath = "IdealWay";
inline constexpr PathStyle kDrivenStyle{0.0012, 0.0, 0.0, {0.60f, 0.07f, 0.28f}};
inline constexpr PathStyle kIdealStyle{0.0017, 0.004, 0.004, {0.25f, 0.42f, 0.03f}};

// Adds a node with the tube's mesh; shape_path() computes the mesh's vertices. pivot [m]: the lever's pivot in the
// world. Returns the node's index.
int add_path(engine::Model& model, const std::string& name, glm::vec3 pivot, const PathStyle& style);

// Computes the vertices of the tube's mesh. Ring i is at the fraction i / (kPathRings - 1) of the path's length. Its
// kPathSides vertices begin at number i * kPathSides and surround the point kPathLift above the knob's centre. path: in
// the gate plane [m]; non-finite points are left out. The ends of path and dashes are pointed. Returns false and leaves
// `out` unchanged if the path has no length.
bool shape_path(std::span<const glm::dvec2> path, const haptics::YokeGeometry& yoke, const PathStyle& style,
                std::vector<engine::Vertex>& out);

}  // namespace gearshift::cabin
