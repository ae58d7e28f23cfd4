// Decides whether the engine fires: key, starter, idle control, rev limiter and stall speed.
#pragma once

#include "app/vehicle/car_spec.h"

namespace gearshift::vehicle {

class EngineControl {
 public:
  explicit EngineControl(const EngineSpec& spec) noexcept;

  void turn_key(bool ignition, bool starter) noexcept;
  // Adds crankshaft rotation [rad], counted only while the starter is on. A stopped engine fires only after enough
  // rotation.
  void add_crank_angle(double angle) noexcept { cranked_ += starter_ ? angle : 0.0; }
  // Sets the state directly. `stalled`: the engine is off because it stalled, and the key is still on; ignored if
  // `running`.
  void set(bool running, bool stalled) noexcept;
  // Applies the effects of speed [rad/s] and key. Below its stall speed the engine dies, and stays off until the
  // starter has turned it far and fast enough. If the key is released before the engine runs by itself, the engine dies
  // again. The limiter cuts the fuel until the speed has fallen by limiter_band.
  void update(double speed) noexcept;
  bool would_change(double speed) const noexcept { return !(next(speed) == firing_); }

  bool running() const noexcept { return firing_.running; }
  // True if the engine has run by itself, died with the key on, and has not run by itself since.
  bool stalled() const noexcept { return stalled_; }
  bool ignition() const noexcept { return ignition_; }
  bool fuel_cut() const noexcept { return firing_.cut; }
  bool is_cranking_at(double speed) const noexcept { return starter_ && speed < spec_.starter_speed; }
  // Fraction of the available torque [1], 0 to 1, at this speed [rad/s] and pedal position [1]. 0 while fuel is cut.
  double load(double speed, double pedal) const noexcept;
  // Torque from combustion and starter [N m]; engine friction is not subtracted.
  double torque(double speed, double pedal) const noexcept;

 private:
  struct FiringState {
    bool running = true, cut = false;
    bool operator==(const FiringState&) const = default;
  };
  FiringState next(double speed) const noexcept;
  double combustion_torque(double speed) const noexcept;  // [N m] at full throttle

  EngineSpec spec_;
  double idle_load_;  // [1] load that balances the friction at idle
  bool ignition_ = true, starter_ = false;
  double cranked_ = 0.0;  // [rad] rotation since the starter was switched on
  FiringState firing_;
  bool has_run_ = true, stalled_ = false;  // since the ignition was switched on
};

}  // namespace gearshift::vehicle
