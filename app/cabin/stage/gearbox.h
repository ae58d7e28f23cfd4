// The cut-away gearbox: for every column of the gate a set of rail, fork, sleeve, rings and gears. The sets are side by
// side like the columns, to show which rail the lever moves and how far the sleeve has travelled.
//
// It is a teaching model: in a real gearbox the sets are one behind the other on one shaft and turn hundreds of times
// faster than here.
#pragma once

#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "app/vehicle/vehicle_state.h"
#include "engine/model/model.h"
#include "haptics/gate/gate.h"

namespace gearshift::cabin {

inline constexpr double kRailTravel = 0.009;   // [m] travel of a sleeve from neutral to an engaged gear
inline constexpr double kSetDistance = 0.112;  // [m] between neighbouring sets, before the gearbox is scaled to fit
inline constexpr int kDogTeeth = 30;           // number of teeth on each sleeve, ring and gear; they fit every 12 deg

// Lateral position [m] of a column's set, measured from the middle of the gearbox; positive to the right.
double set_x(const haptics::Gate& gate, int column) noexcept;

// Displacement [m] of the column's rail, positive forward. The rail moves by kRailTravel while the lever moves from the
// aisle's wall to the gear's rest position.
double rail_shift(const haptics::Gate& gate, int column, glm::dvec2 lever) noexcept;

// Lateral position [m] of the selector finger, positive to the right; equal to set_x() when the lever is at the centre
// of a column.
double finger_x(const haptics::Gate& gate, double select) noexcept;

class Gearbox {
 public:
  // Adds the sets for the gate to the model, below a root node "Gearbox". gear_model: the model read from gearbox.glb.
  // Throws std::runtime_error if a node is missing.
  static void add_to(engine::Model& model, const engine::Model& gear_model, const haptics::Gate& gate);

  // Names of the moving nodes, which must not be merged with static nodes.
  static std::vector<std::string> moving_names(const haptics::Gate& gate);

  // Finds the nodes that add_to() has added.
  Gearbox(const engine::Model& model, const haptics::Gate& gate);

  // Sets translations and rotations in `pose`. time [s]: in a call with a smaller time than in the previous call, the
  // free gears do not turn.
  void place(const haptics::Gate& gate, glm::dvec2 lever, const vehicle::VehicleState& car, double time,
             std::vector<engine::Node>& pose);

 private:
  struct Set {
    int rail = engine::kNone, sleeve = engine::kNone, hub = engine::kNone;
    int gear[2] = {engine::kNone, engine::kNone}, ring[2] = {engine::kNone, engine::kNone};  // front, back
    double gear_angle[2] = {0.0, 0.0};                                                       // [rad]
  };
  void turn_gears(const haptics::Gate& gate, int column, double shift, const vehicle::VehicleState& car, double step,
                  Set& set, std::vector<engine::Node>& pose);

  std::vector<Set> sets_;
  std::vector<engine::Node> rest_;
  int finger_ = engine::kNone;
  double time_ = 0.0;
  double hub_angle_ = 0.0;  // [rad]
};

}  // namespace gearshift::cabin
