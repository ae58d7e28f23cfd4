// The car as a load on the lever: pedals that keys press, a driveline, a synchroniser, and an instructor's guidance of
// the hand, stepped once per haptic cycle.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/vehicle/car_spec.h"
#include "app/vehicle/driveline.h"
#include "app/vehicle/engine_shudder.h"
#include "app/vehicle/hand_guidance.h"
#include "app/vehicle/shift_drum.h"
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
  EngineState engine;
  double clutch_temperature = kAirTemperature;  // [C]
};

// Returns a start that continues from `state`.
CarStart start_from(const VehicleState& state) noexcept;

// Throws std::invalid_argument with one sentence if the gate has a gear that the car lacks.
void check_car_fits(const CarSpec& car, const haptics::Gate& gate);

// Actuator model of the pedals that keys press. It moves them in every cycle of the car's clock, so that no pedal jumps
// at a low frame rate. `throttle` presses the throttle to the floor, `throttle_light` by a fifth of the travel, and
// otherwise it stays at `held_throttle`. These two ease off while the clutch is open or slips and the engine turns faster
// than this throttle needs to move off. The released clutch pedal rises fast, but slowly in the bite zone until the
// clutch has gripped in a gear; there it waits while the clutch pulls the engine down, and yields before the engine stalls.
// It stops while `clutch_hold` is held. With `slow_clutch` at 1, it slips for kSlowClutch
// times as long: help for a learner who lets the clutch up too fast. The hand brake does not move.
inline constexpr double kSlowClutch = 1.5;  // [1] engineering value: 6 s instead of 4 s
class KeyboardPedals {
 public:
  KeyboardPedals(const PedalTiming& timing, const ClutchSpec& clutch) noexcept : timing_(timing), clutch_(clutch) {}

  void place(const haptics::Pedals& pedals) noexcept { pedals_ = pedals; }
  const haptics::Pedals& pedals() const noexcept { return pedals_; }

  // Moves the pedals by `seconds` of the car's time (negative counts as 0) and returns their positions.
  // `engine_speed`: [rad/s]. `coupled`: the engine turns with the wheels, without slip. Real-time safe.
  const haptics::Pedals& move(const haptics::PedalKeys& keys, double seconds, double engine_speed,
                              bool coupled) noexcept;

 private:
  PedalTiming timing_;
  ClutchSpec clutch_;
  haptics::Pedals pedals_;
};

class CarLoad final : public haptics::LeverLoad {
 public:
  // `force_limit`: largest force that the device can render at the knob [N], > 0. VehicleState::force_scale scales the
  // forces on the lever down to this limit. `seed`: seeds the random tooth positions of the second bump
  // (synchroniser.h). Throws like check_car_fits().
  CarLoad(const CarSpec& car, const haptics::Gate& gate, double force_limit, const CarStart& start = {},
          std::uint64_t seed = 1, const PedalTiming& timing = {});

  // Sets the pedals that keys press, e.g. to those of the car that this one replaces. Real-time safe.
  void place_pedals(const haptics::Pedals& keyboard) noexcept;
  // The pedals that keys press, without the pedal axes.
  const haptics::Pedals& keyboard() const noexcept { return keyboard_.pedals(); }
  // The axes' positions, at least those of keyboard(). Negative positions become 0.
  haptics::Pedals move_pedals(const haptics::Pedals& axes, const haptics::PedalKeys& keys,
                              double period) noexcept override;
  haptics::LeverOutput step(const haptics::LeverInput& in, double period) noexcept override;
  // Returns "car", the exact values from which make_car_load() rebuilds this load, and the text of the car file. Pedals
  // that keys press are left out, see LeverLoad::move_pedals().
  const char* replay_parameters() const noexcept override { return parameters_.c_str(); }
  int start_gear() const noexcept override { return start_.gear; }
  const CarSpec& spec() const noexcept { return car_; }
  const VehicleState& state() const noexcept { return state_; }
  const Driveline& driveline() const noexcept { return driveline_; }

 private:
  struct SlotGear {
    int gear = haptics::kNeutralGear;
    double per_road = 0.0;  // [rad/m] shaft speed divided by road speed
    double ratio = 1.0;     // [1] shaft speed divided by the speed of the gear, > 0
  };

  SleeveInput sleeve_input(const haptics::LeverInput& in, const ShiftDrum::Sleeve& sleeve) const noexcept;
  void limit_lever(const SleeveOutput& sleeve, double way, haptics::LeverOutput& out) const noexcept;
  double difference(const SlotGear& gear) const noexcept;
  void update_state(const haptics::DriverControls& controls, const SleeveInput& lever,
                    const SleeveOutput& sleeve) noexcept;

  CarSpec car_;
  haptics::Gate gate_;
  CarStart start_;
  std::string parameters_;
  ShiftDrum drum_;
  std::array<SlotGear, haptics::kMaxSlots> gear_of_slot_{};  // by slot of sleeves_of()
  KeyboardPedals keyboard_;
  Driveline driveline_;
  Synchroniser synchroniser_;
  LeverVibration vibration_;
  HandGuidance guidance_;
  VehicleState state_;
};

// Rebuilds the load that replay_parameters() describes; returns null if the text does not describe a car. Throws
// FileError if the car file in the text is rejected, std::invalid_argument if the car does not fit the gate.
std::unique_ptr<CarLoad> make_car_load(const std::string& parameters, const haptics::Gate& gate);

}  // namespace gearshift::vehicle
