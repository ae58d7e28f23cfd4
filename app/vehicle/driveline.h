// Engine, clutch, gearbox shaft and car as rigid inertias with Coulomb friction between them.
//
// Friction elements: the clutch (capacity set by the pedal), the synchroniser's cone, rolling resistance and brakes at
// the car, drag at the shaft, and friction and compression in the engine. Each element sticks or slips. A
// step is split where an element starts to stick or to slip (event location). An element that starts to stick conserves
// momentum. Between events the midpoint rule is used. After kMaxEvents events in a substep, the rest of the substep is
// solved by impulses.
#pragma once

#include <array>
#include <cstdint>

#include "app/vehicle/car_spec.h"
#include "app/vehicle/engine_control.h"
#include "app/vehicle/friction_chain.h"
#include "app/vehicle/vehicle_state.h"

namespace gearshift::vehicle {

// Largest torque that the clutch can transmit [N m]. `pedal` is 0 when released and 1 when fully pressed.
double clutch_capacity(const ClutchSpec& clutch, double pedal) noexcept;

// Fraction of its capacity that the clutch has at this temperature [C].
double clutch_fade(double temperature) noexcept;

struct DrivelineInput {
  haptics::Pedals pedals;
  bool ignition = true;
  bool starter = false;
  double slope = 0.0;        // [rad] uphill is positive
  int meshed = 0;            // gear whose dogs are engaged
  int cone_gear = 0;         // gear whose synchroniser cone rubs; 0: none. Always 0 while a gear is meshed
  double cone_torque = 0.0;  // [N m] capacity of the cone, measured at the gear, >= 0
};

// Energies since place() [J]. Supplied energy equals losses plus the rise of stored energy, up to rounding.
struct EnergyLedger {
  double engine = 0.0;    // combustion and starter
  double friction = 0.0;  // inside the engine
  double clutch = 0.0;
  double cone = 0.0;
  double shaft_drag = 0.0;
  double rolling = 0.0;  // including air drag
  double brakes = 0.0;
  double slope = 0.0;  // potential energy gained by climbing
  double teeth = 0.0;  // lost in the gear's teeth (efficiency)
  double mesh = 0.0;   // lost when dogs engaged at unequal speeds
};

class Driveline {
 public:
  explicit Driveline(const CarSpec& car);
  // Advances by `seconds` (at most 0.5). Does not allocate. Inputs that are not finite count as 0. `in` holds the
  // values at the end of the step. Pedals, slope and cone torque change linearly from the previous step's values; they
  // are constant in the first step after construction or place(). Gear and key change at the start of the step. If dogs
  // engage at unequal speeds, shaft and car exchange momentum at once, and the clutch slips if necessary.
  void step(const DrivelineInput& in, double seconds) noexcept;

  // Sets the speeds directly, in neutral, and resets the energy ledger. Used at the start of a lesson and in tests.
  // `stalled`: the engine is off because it stalled; ignored if `running`.
  void place(double engine_speed, double shaft_speed, double road_speed, bool running, bool stalled = false,
             const EngineState& engine = {}, double clutch_temperature = kAirTemperature) noexcept;

  // State of engine, clutch and car. Fields that the synchroniser determines keep their defaults.
  const VehicleState& state() const noexcept { return state_; }
  const EnergyLedger& energy() const noexcept { return energy_; }
  double kinetic_energy() const noexcept;                          // [J]
  std::uint64_t fallbacks() const noexcept { return fallbacks_; }  // number of substeps that used impulses

 private:
  struct Ramp {
    double from = 0.0, to = 0.0;
    double at(double fraction) const noexcept { return from + (to - from) * fraction; }
  };
  struct Loads {
    ChainLoads chain;
    double lift = 0.0, brakes = 0.0;  // [N] parts due to gravity (in chain.push) and to brakes (in chain.ground)
  };
  struct Reversed {
    bool clutch = false, cone = false;
    std::array<bool, 3> turn{};
    bool any() const noexcept { return clutch || cone || turn[0] || turn[1] || turn[2]; }
  };
  struct Trial {
    PerBody speed;
    Loads loads;
    ChainMotion motion;  // motion and loads are those at the step's midpoint
    Solution end;
    EngineState engine;
    bool ends_mode;
  };

  void set_input(const DrivelineInput& in) noexcept;
  void mesh(int gear, int cone_gear) noexcept;
  double next_kink(double after) const noexcept;
  double max_substep() const noexcept;
  void advance(double seconds) noexcept;
  void advance_by_impulses(double seconds) noexcept;
  Loads loads_at(const PerBody& speed, double time, const EngineState& engine) const noexcept;
  Loads present_loads() const noexcept { return loads_at(speed_, time_, engine_.state()); }
  EngineState engine_after(double seconds, const PerBody& speed, const Loads& loads,
                           const EngineState& at) const noexcept;
  Trial try_step(double seconds) const noexcept;
  Reversed reversed(const PerBody& speed, const Loads& loads) const noexcept;
  void accept(const Trial& trial, double seconds) noexcept;
  void snap(const Reversed& elements) noexcept;
  void update_modes() noexcept;
  void account_energy(const Loads& loads, const ChainMotion& motion, const PerBody& to, double seconds) noexcept;
  void heat_clutch(double heat, double seconds) noexcept;
  void publish_state(double clutch_capacity) noexcept;

  CarSpec car_;
  EngineControl engine_;
  FrictionChain chain_;
  PerBody speed_{};
  Solution now_;  // current mode and motion
  Ramp throttle_, pedal_, brakes_, lift_, cone_;
  double time_ = 0.0, length_ = 1.0;  // [s] time since the step began; the step's length
  int meshed_ = 0, cone_gear_ = 0;
  double temperature_ = kAirTemperature, heating_ = 0.0;  // [C], [K/s] of the clutch
  double cone_ratio_ = 1.0;                               // [1] ratio of the gear whose cone rubs
  bool is_first_step_ = true;
  VehicleState state_;
  EnergyLedger energy_;
  std::uint64_t fallbacks_ = 0;
};

}  // namespace gearshift::vehicle
