// Engine, clutch, gearbox shaft and car as rigid inertias with Coulomb grips between them.
//
// Grips: clutch (capacity by the pedal), synchroniser's cone, rolling resistance with brakes where the car stands, the
// shaft's drag where it stands, and the engine, which does not turn backwards. Each slips or holds; the step is cut where
// one changes (event location), a grip that begins to hold conserves momentum, and inside a mode the step is the midpoint
// rule. More than a bounded number of changes in a step falls back to impulses over what is left of it.
#pragma once

#include <array>
#include <cstdint>

#include "app/vehicle/car_spec.h"
#include "app/vehicle/engine_control.h"
#include "app/vehicle/grip_chain.h"
#include "app/vehicle/vehicle_state.h"

namespace gearshift {

struct DrivelineInput {
  double throttle = 0.0, brake = 0.0, clutch = 0.0, hand_brake = 0.0;  // [1] 0 to 1
  bool ignition = true;
  bool starter = false;
  double slope = 0.0;        // [rad] uphill +
  int meshed = 0;            // gear whose dogs are in
  int cone_gear = 0;         // gear whose cone rubs; 0 none. Never together with meshed
  double cone_torque = 0.0;  // [N m] the most that the cone carries, at the gear's side, >= 0
};

// Where the energy went since the start: comes = goes to rounding. [J]
struct EnergyLedger {
  double engine = 0.0;    // combustion and starter
  double friction = 0.0;  // engine's own
  double clutch = 0.0;
  double cone = 0.0;
  double shaft_drag = 0.0;
  double rolling = 0.0;  // with air drag
  double brakes = 0.0;
  double slope = 0.0;  // lifted
  double teeth = 0.0;  // of the gear, by its efficiency
  double mesh = 0.0;   // lost when dogs met at unequal speeds
};

class Driveline {
 public:
  explicit Driveline(const CarSpec& car);
  // Moves on by `seconds` (0 to 0.5). noexcept, no allocation. What is not finite in the input is taken as 0.
  // `in` is how things stand at the end of the step: pedals, slope and cone go there in straight lines from the step
  // before (the first step and the first after place() have them so from the start); gear and key change at its start.
  // When dogs meet at unequal speeds, shaft and car share their momentum at once, and the clutch slips if it must.
  void step(const DrivelineInput& in, double seconds) noexcept;

  // Puts the car there at once, in neutral, and begins the ledger anew: for the start of a lesson and for tests.
  // stalled: of an engine that does not run, that it did.
  void place(double engine_speed, double shaft_speed, double road_speed, bool running, bool stalled = false) noexcept;

  const VehicleState& state() const noexcept { return state_; }  // engine, clutch, car; the lever's part is untouched
  const EnergyLedger& energy() const noexcept { return energy_; }
  double kinetic_energy() const noexcept;                          // [J]
  std::uint64_t fallbacks() const noexcept { return fallbacks_; }  // steps that needed the impulses

 private:
  struct Ramp {
    double from = 0.0, to = 0.0;
    double at(double share) const noexcept { return from + (to - from) * share; }
  };
  struct Loads {
    ChainLoads chain;
    double lift = 0.0, brakes = 0.0;  // [N] parts of push and ground
  };
  struct Reversed {
    bool clutch = false, cone = false;
    std::array<bool, 3> turn{};
    bool any() const noexcept { return clutch || cone || turn[0] || turn[1] || turn[2]; }
  };
  struct Trial {
    PerBody speed;
    Loads loads;
    ChainMotion motion;  // both half-way
    Settled end;
    bool changes;
  };

  void take(const DrivelineInput& in) noexcept;
  void mesh(int gear, int cone_gear) noexcept;
  double next_kink(double after) const noexcept;
  void advance(double seconds) noexcept;
  void advance_by_impulses(double seconds) noexcept;
  Loads loads_at(const PerBody& speed, double time) const noexcept;
  Trial tried(double seconds) const noexcept;
  Reversed reversed(const PerBody& speed, const Loads& loads) const noexcept;
  void accept(const Trial& trial, double seconds) noexcept;
  void snap(const Reversed& is) noexcept;
  void settle_here() noexcept;
  void book(const Loads& loads, const ChainMotion& motion, const PerBody& to, double seconds) noexcept;
  void show(double clutch_capacity) noexcept;

  CarSpec car_;
  EngineControl engine_;
  GripChain chain_;
  PerBody speed_{};
  Settled now_;  // mode, and motion at this moment
  Ramp throttle_, pedal_, brakes_, lift_, cone_;
  double time_ = 0.0, length_ = 1.0;  // [s] in this step, and of it
  int meshed_ = 0, cone_gear_ = 0;
  double cone_ratio_ = 1.0;  // [1] of its gear
  bool fresh_ = true;        // no step before this one
  VehicleState state_;
  EnergyLedger energy_;
  std::uint64_t fallbacks_ = 0;
};

}  // namespace gearshift
