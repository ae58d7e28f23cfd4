// The car as a load on the lever: a driveline and a synchroniser, stepped once per haptic cycle.
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
  int gear = haptics::kNeutralGear;  // engaged gear; the lever is in this gear's slot
  bool running = true;
  bool stalled = false;  // the engine is off because it stalled, and the key is still on
  // [rad/s] If empty, a stopped engine has speed 0. A running engine has its idle speed, or the speed that follows from
  // gear and road speed if that is higher.
  std::optional<double> engine_speed;
  // [rad/s] If empty, the speed follows from gear and road speed; in neutral, it equals the engine's speed.
  std::optional<double> shaft_speed;
  double distance = 0.0;     // [m] distance driven before the start
  double slip_energy = 0.0;  // [J] heat dissipated in the clutch before the start
};

// Returns a start that continues from `state`.
CarStart start_from(const VehicleState& state) noexcept;

// Throws std::invalid_argument with one sentence if the gate has a gear that the car lacks.
void check_car_fits(const CarSpec& car, const haptics::Gate& gate);

class CarLoad final : public haptics::LeverLoad {
 public:
  // `force_limit`: largest force that the device can render at the knob [N], > 0. VehicleState::force_scale scales the
  // forces on the lever down to this limit. `seed`: seeds the random tooth positions of the second bump
  // (synchroniser.h). Throws like check_car_fits().
  CarLoad(const CarSpec& car, const haptics::Gate& gate, double force_limit, const CarStart& start = {},
          std::uint64_t seed = 1);

  haptics::LeverOutput step(const haptics::LeverInput& in, double period) noexcept override;
  // Returns "car", the exact value of every constructor argument and the text of the car file. make_car_load() rebuilds
  // the same load from this text.
  const char* replay_parameters() const noexcept override { return parameters_.c_str(); }
  const CarSpec& spec() const noexcept { return car_; }
  const VehicleState& state() const noexcept { return state_; }
  const Driveline& driveline() const noexcept { return driveline_; }

 private:
  struct SlotGear {
    int gear = haptics::kNeutralGear;
    double side = 1.0;      // side of the slot: +1 forward, -1 back
    double per_road = 0.0;  // [rad/m] shaft speed divided by road speed
    double ratio = 1.0;     // [1] shaft speed divided by the speed of the gear, > 0
  };

  SleeveInput sleeve_input(const haptics::LeverInput& in) const noexcept;
  double difference(const SlotGear& gear) const noexcept;
  void update_state(const haptics::DriverControls& controls, const SleeveInput& lever,
                    const SleeveOutput& sleeve) noexcept;

  CarSpec car_;
  haptics::Gate gate_;
  CarStart start_;
  std::string parameters_;
  std::array<SlotGear, haptics::kMaxSlots> gear_of_slot_{};
  Driveline driveline_;
  Synchroniser synchroniser_;
  LeverVibration vibration_;
  VehicleState state_;
};

// Rebuilds the load that replay_parameters() describes; returns null if the text does not describe a car. Throws
// FileError if the car file in the text is rejected, std::invalid_argument if the car does not fit the gate.
std::unique_ptr<CarLoad> make_car_load(const std::string& parameters, const haptics::Gate& gate);

}  // namespace gearshift::vehicle
