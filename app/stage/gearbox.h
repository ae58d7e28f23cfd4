// The cut-away gearbox: a rail with fork, sleeve, rings and gears for every column of the gate, side by side as the
// columns are, so that a hand sees which rail it takes and how far the sleeve has gone.
//
// Teaching model: a real box has the sets one behind the other on one shaft, and turns hundreds of times faster.
#pragma once

#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "app/vehicle/vehicle_state.h"
#include "engine/model/model.h"
#include "haptics/gate/gate.h"

namespace gearshift {

inline constexpr double kRailTravel = 0.009;   // [m] of a sleeve whose gear is in
inline constexpr double kSetDistance = 0.112;  // [m] between neighbours, before the box is scaled to its place
inline constexpr int kDogTeeth = 30;           // of sleeve, rings and dogs: a gear locks every 12 deg

// Where a column's set stands beside the middle of the box. [m] right +
double set_place(const Gate& gate, int column) noexcept;

// How far the column's rail is moved: from the aisle's wall to the gear's rest the lever takes it kRailTravel.
// [m] forward +
double rail_shift(const Gate& gate, int column, glm::dvec2 lever) noexcept;

// The finger's place beside the middle of the box: at a set where the lever is at its column. [m] right +
double finger_place(const Gate& gate, double select) noexcept;

class Gearbox {
 public:
  // Adds the sets of the gate to the model, below a root node "Gearbox". gear_model: the models' gearbox.glb. Throws
  // std::runtime_error where a node is missing.
  static void add_to(Model& model, const Model& gear_model, const Gate& gate);

  // Names of what moves: not to be merged with what stands still.
  static std::vector<std::string> moving_names(const Gate& gate);

  // Finds what add_to() made.
  Gearbox(const Model& model, const Gate& gate);

  // Sets translations and rotations in `pose`. time [s] never goes back by itself; where it does nothing turns.
  void place(const Gate& gate, glm::dvec2 lever, const VehicleState& car, double time, std::vector<Node>& pose);

 private:
  struct Set {
    int rail = kNone, sleeve = kNone, hub = kNone;
    int gear[2] = {kNone, kNone}, ring[2] = {kNone, kNone};  // forward, back
    double gear_angle[2] = {0.0, 0.0};                       // [rad]
  };
  void turn_gears(const Gate& gate, int column, double shift, const VehicleState& car, double step, Set& set,
                  std::vector<Node>& pose);

  std::vector<Set> sets_;
  std::vector<Node> rest_;
  int finger_ = kNone;
  double time_ = 0.0;
  double hub_angle_ = 0.0;  // [rad]
};

}  // namespace gearshift
