// A car that rolls, for the cabin alone: revs, speed and distance that follow pedals and gear. It gives no force to the
// lever: the driveline behind the lever is a LeverWorld.
//
// Flat road, no wheel slip. Engine and car are two masses; between them the clutch carries at most what it is closed
// for, and what it can carry it holds. Begins with the engine at idle.
#pragma once

#include <array>

#include "app/vehicle/vehicle_state.h"
#include "haptics/gate/gate.h"
#include "haptics/loop/lever_world.h"

namespace gearshift {

struct RollingCarConfig {
  double idle = 84.0;                // [rad/s] 800 rpm
  double start_speed = 0.0;          // [m/s] that it rolls at first
  double limiter = 680.0;            // [rad/s] 6500 rpm
  double engine_inertia = 0.15;      // [kg m^2]
  double peak_torque = 150.0;        // [N m]
  double friction_torque = 25.0;     // [N m] at the limiter; 0.4 of it at rest
  double clutch_capacity = 280.0;    // [N m] closed
  double mass = 1200.0;              // [kg]
  double wheel_radius = 0.30;        // [m]
  double final_drive = 4.1;          // [1]
  double drag_area = 0.68;           // [m^2] drag coefficient times frontal area
  double rolling = 0.012;            // [1]
  double brake_force = 9000.0;       // [N]
  double hand_brake_force = 4000.0;  // [N]
  std::array<double, kMaxGear> ratio{3.45, 1.95, 1.30, 1.00, 0.80, 0.67, 0.58, 0.51, 0.45};  // [1] first to ninth
  double reverse_ratio = 3.30;                                                               // [1]
};

// What the engine gives with the throttle open, at that speed [rad/s]. [N m] The most at 0.55 of the limiter.
double full_torque(const RollingCarConfig& config, double engine_speed) noexcept;

// What the engine itself takes, at that speed [rad/s]. [N m]
double friction_torque(const RollingCarConfig& config, double engine_speed) noexcept;

class RollingCar {
 public:
  explicit RollingCar(const RollingCarConfig& config = {});
  // Moves on by `seconds` (0 to 0.25; in steps of at most 2 ms). gear as engaged.
  void step(const DriverControls& controls, int gear, double seconds) noexcept;
  const VehicleState& state() const noexcept { return state_; }

 private:
  void take(const DriverControls& controls, int gear) noexcept;
  void mesh() noexcept;
  void run_engine() noexcept;
  double engine_torque() noexcept;
  void move(double seconds) noexcept;
  double shaft_per_road() const noexcept;  // [rad/m] clutch shaft turned per metre driven, reverse -, neutral 0
  double clutch_torque() const noexcept;   // [N m] the most that the clutch carries now

  RollingCarConfig config_;
  VehicleState state_;
  bool starter_ = false;
  bool runs_ = true;    // the engine fires
  bool meshed_ = true;  // the dogs of the gear are in
};

}  // namespace gearshift
