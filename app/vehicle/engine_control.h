// Decides whether the engine fires: key, starter, idle control, rev limiter and stall speed.
#pragma once

#include "app/vehicle/car_spec.h"

namespace gearshift::vehicle {

// The state of the engine's control that changes continuously.
struct EngineState {
  double integral = 0.0;  // [1] load that the integral part of the idle control adds, 0 to 1
  double lift = 0.0;      // [rad/s] how far the idle control's set speed is above EngineSpec::idle
  double cranked = 0.0;   // [rad] forward rotation of an engine that does not fire, since it stood still or died
};

class EngineControl {
 public:
  explicit EngineControl(const EngineSpec& spec) noexcept;

  void turn_key(bool ignition, bool starter) noexcept;
  // Sets the state directly. `stalled`: the engine is off because it stalled, and the key is still on; ignored if
  // `running`.
  void set(bool running, bool stalled) noexcept;
  // Applies the effects of speed [rad/s] and key. Below its stall speed the engine dies, and stays off until it has been
  // turned far and fast enough: by the starter, or by the car at the stall speed or faster (a bump start). If the key is
  // released before the engine runs by itself, the engine dies again. The limiter cuts the fuel until the speed has
  // fallen by limiter_band.
  void update(double speed) noexcept;
  bool would_change(double speed, const EngineState& at) const noexcept { return !(next(speed, at) == firing_); }

  // The idle control adds load below its set speed: in proportion to the missing speed, plus the integral of it, which
  // is never negative. While a slipping clutch slows the engine, the set speed rises: a torque reserve for moving off.
  // Returns the rates of change of the state at this speed [rad/s]. `slip_torque`: torque with which a slipping
  // clutch slows the engine [N m], otherwise 0.
  EngineState state_rate(double speed, double slip_torque, const EngineState& at) const noexcept;
  const EngineState& state() const noexcept { return state_; }
  void set_state(const EngineState& state) noexcept { state_ = state; }

  bool running() const noexcept { return firing_.running; }
  // True if the engine has run by itself, died with the key on, and has not run by itself since.
  bool stalled() const noexcept { return stalled_; }
  bool ignition() const noexcept { return ignition_; }
  bool fuel_cut() const noexcept { return firing_.cut; }
  bool is_cranking_at(double speed) const noexcept { return starter_ && speed < spec_.starter_speed; }
  // Fraction of the available torque [1], 0 to 1, at this speed [rad/s] and pedal position [1]. 0 while fuel is cut.
  double load(double speed, double pedal, const EngineState& at) const noexcept;
  double load(double speed, double pedal) const noexcept { return load(speed, pedal, state_); }
  // Torque from combustion and starter [N m]; engine friction is not subtracted.
  double torque(double speed, double pedal, const EngineState& at) const noexcept;
  double torque(double speed, double pedal) const noexcept { return torque(speed, pedal, state_); }

 private:
  enum class Integral { held_low, free, held_high };
  struct FiringState {
    bool running = true, cut = false;
    Integral integral = Integral::free;
    bool operator==(const FiringState&) const = default;
  };
  FiringState next(double speed, const EngineState& at) const noexcept;
  Integral next_integral(double speed, const EngineState& at) const noexcept;
  double combustion_torque(double speed) const noexcept;  // [N m] at full throttle

  EngineSpec spec_;
  double idle_load_;      // [1] load that balances the friction at idle
  double idle_friction_;  // [N m]
  bool ignition_ = true, starter_ = false;
  FiringState firing_;
  EngineState state_;
  bool has_run_ = true, stalled_ = false;  // since the ignition was switched on
};

}  // namespace gearshift::vehicle
