// What makes the engine fire: key, starter, idle control, limiter, and the speed below which it dies.
#pragma once

#include "app/vehicle/car_spec.h"

namespace gearshift {

class EngineControl {
 public:
  explicit EngineControl(const EngineSpec& spec) noexcept;

  void turn_key(bool ignition, bool starter) noexcept;
  // It has turned so far [rad]. What it turns under the starter counts: an engine must first find its cylinders.
  void turn(double angle) noexcept { cranked_ += starter_ ? angle : 0.0; }
  // At once. One that does not run may have stalled: it ran before, and the key is on.
  void set(bool running, bool stalled) noexcept;
  // What speed [rad/s] and key change: it dies below its stall speed and stays dead until the starter has turned it far
  // and fast enough; let go before it runs by itself, it dies again; the limiter cuts the fuel until the speed has
  // fallen by its band.
  void update(double speed) noexcept;
  bool would_change(double speed) const noexcept { return !(next(speed) == fires_); }

  bool running() const noexcept { return fires_.running; }
  // It ran by itself, died with the key on, and has not run by itself since.
  bool stalled() const noexcept { return stalled_; }
  bool ignition() const noexcept { return ignition_; }
  bool fuel_cut() const noexcept { return fires_.cut; }
  bool cranks(double speed) const noexcept { return starter_ && speed < spec_.starter_speed; }
  // [1] 0 to 1: share of the torque that it could give, at that speed [rad/s] and pedal [1]; 0 where the fuel is cut.
  double load(double speed, double pedal) const noexcept;
  // [N m] of combustion and starter, friction not taken off.
  double torque(double speed, double pedal) const noexcept;

 private:
  struct Fires {
    bool running = true, cut = false;
    bool operator==(const Fires&) const = default;
  };
  Fires next(double speed) const noexcept;
  double full(double speed) const noexcept;  // [N m] of combustion, throttle open

  EngineSpec spec_;
  double idle_load_;  // [1] that gives back the friction at idle
  bool ignition_ = true, starter_ = false;
  double cranked_ = 0.0;  // [rad] since the starter began
  Fires fires_;
  bool has_run_ = true, stalled_ = false;  // since the key was turned on
};

}  // namespace gearshift
