// The car behind the lever: driveline and synchroniser, stepped inside the haptic cycle.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/vehicle/car_spec.h"
#include "app/vehicle/driveline.h"
#include "app/vehicle/shudder.h"
#include "app/vehicle/synchroniser.h"
#include "app/vehicle/vehicle_state.h"
#include "haptics/gate/gate.h"
#include "haptics/loop/lever_world.h"

namespace gearshift {

struct CarStart {
  double road_speed = 0.0;  // [m/s]
  int gear = kNeutralGear;  // that the lever stands in
  bool running = true;
  bool stalled = false;                // it does not run, but did, and the key is on
  std::optional<double> engine_speed;  // [rad/s] else idle, or what gear and road speed ask for where that is more
  std::optional<double> shaft_speed;   // [rad/s] else the gear's, in neutral the engine's
  double distance = 0.0;               // [m] driven before
  double slip_energy = 0.0;            // [J] before
};

// Where that car goes on from.
CarStart start_from(const VehicleState& state) noexcept;

// Throws std::invalid_argument with one sentence where the gate has a gear that the car lacks.
void check_car_fits(const CarSpec& car, const Gate& gate);

class CarWorld final : public LeverWorld {
 public:
  // force_limit: what the device can give at the knob [N], > 0; the lever's forces are scaled to it and the scale shown.
  // seed: of the tooth phase at each second bump. Throws as check_car_fits().
  CarWorld(const CarSpec& car, const Gate& gate, double force_limit, const CarStart& start = {},
           std::uint64_t seed = 1);

  LeverOutput step(const LeverInput& in, double period) noexcept override;
  // "car", everything above by its exact value, and the car's whole file: make_car_world() makes the same again.
  const char* name() const noexcept override { return name_.c_str(); }
  const CarSpec& spec() const noexcept { return car_; }
  const VehicleState& state() const noexcept { return state_; }
  const Driveline& driveline() const noexcept { return driveline_; }

 private:
  struct SlotGear {
    int gear = kNeutralGear;
    double side = 1.0;      // of the slot
    double per_road = 0.0;  // [rad/m] of the shaft
    double ratio = 1.0;     // [1] shaft to gear, > 0
  };

  SleeveInput sleeve_input(const LeverInput& in) const noexcept;
  double difference(const SlotGear& gear) const noexcept;
  void take_state(const DriverControls& controls, const SleeveInput& lever, const SleeveOutput& sleeve) noexcept;

  CarSpec car_;
  Gate gate_;
  CarStart start_;
  std::string name_;
  std::array<SlotGear, kMaxSlots> gear_of_slot_{};
  Driveline driveline_;
  Synchroniser synchroniser_;
  LeverShake shake_;
  VehicleState state_;
};

// The world of that name, or nothing where it names no car. Throws FileError where the car in it is refused,
// std::invalid_argument where it does not fit the gate.
std::unique_ptr<CarWorld> make_car_world(const std::string& name, const Gate& gate);

}  // namespace gearshift
