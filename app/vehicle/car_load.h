// The car behind the lever: driveline and synchroniser, stepped inside the haptic cycle.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/vehicle/car_spec.h"
#include "app/vehicle/driveline.h"
#include "app/vehicle/engine_shudder.h"
#include "app/vehicle/synchroniser.h"
#include "app/vehicle/vehicle_state.h"
#include "haptics/gate/gate.h"
#include "haptics/loop/lever_load.h"

namespace gearshift::vehicle {

struct CarStart {
  double road_speed = 0.0;
  int gear = haptics::kNeutralGear;  // gear engaged, with the lever in its slot
  bool running = true;
  bool stalled = false;  // the engine is off because it stalled, and the key is still on
  // [rad/s] default: idle, or the speed that gear and road speed require if that is higher
  std::optional<double> engine_speed;
  // [rad/s] default: the speed that the gear requires; in neutral the engine's speed
  std::optional<double> shaft_speed;
  double distance = 0.0;     // [m] driven before
  double slip_energy = 0.0;  // [J] dissipated in the clutch before
};

// A start that continues from this state.
CarStart start_from(const VehicleState& state) noexcept;

// Throws std::invalid_argument with one sentence if the gate has a gear that the car lacks.
void check_car_fits(const CarSpec& car, const haptics::Gate& gate);

class CarLoad final : public haptics::LeverLoad {
 public:
  // force_limit: largest force of the device at the knob [N], > 0; the lever's forces are scaled down to it, and the
  // state reports the scale. seed: for the random tooth position at each second bump. Throws like check_car_fits().
  CarLoad(const CarSpec& car, const haptics::Gate& gate, double force_limit, const CarStart& start = {},
          std::uint64_t seed = 1);

  haptics::LeverOutput step(const haptics::LeverInput& in, double period) noexcept override;
  // "car", the exact value of every constructor argument, and the whole car file: make_car_load() rebuilds the same
  // load.
  const char* replay_parameters() const noexcept override { return name_.c_str(); }
  const CarSpec& spec() const noexcept { return car_; }
  const VehicleState& state() const noexcept { return state_; }
  const Driveline& driveline() const noexcept { return driveline_; }

 private:
  struct SlotGear {
    int gear = haptics::kNeutralGear;
    double side = 1.0;      // of the slot: +1 forward, -1 back
    double per_road = 0.0;  // [rad/m] shaft speed per road speed
    double ratio = 1.0;     // [1] shaft to gear, > 0
  };

  SleeveInput sleeve_input(const haptics::LeverInput& in) const noexcept;
  double difference(const SlotGear& gear) const noexcept;
  void update_state(const haptics::DriverControls& controls, const SleeveInput& lever,
                    const SleeveOutput& sleeve) noexcept;

  CarSpec car_;
  haptics::Gate gate_;
  CarStart start_;
  std::string name_;
  std::array<SlotGear, haptics::kMaxSlots> gear_of_slot_{};
  Driveline driveline_;
  Synchroniser synchroniser_;
  LeverVibration vibration_;
  VehicleState state_;
};

// Rebuilds the load that replay_parameters() describes; null if the text describes no car. Throws FileError if the car file in it is
// rejected, std::invalid_argument if the car does not fit the gate.
std::unique_ptr<CarLoad> make_car_load(const std::string& name, const haptics::Gate& gate);

}  // namespace gearshift::vehicle
