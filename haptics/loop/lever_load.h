// Interface between the haptic cycle and the mechanical load on the lever, such as the driveline of a car.
//
// The loop calls step() once per cycle on the haptic thread, after the coupling and the gate's feel and before the
// guard. The first call has period 0.
//
// step() must not allocate, lock, wait or make a system call. Its result may depend only on its own state, the input
// and the period, so that a recording replays bit for bit.
//
// step() may return any finite force; the guard makes it safe. Depth limits take effect in the next cycle and never
// move the lever: if the lever is outside a limit, the limit is applied at the lever's depth.
//
// `vibration` is the part of the force that shakes the lever intentionally, so that the loop does not mistake it for
// chatter on a wall. It must not contain forces that react to the lever's motion.
//
// The simplest load:
//   LeverOutput NoLoad::step(const LeverInput&, double) noexcept { return {}; }
#pragma once

#include <limits>
#include <string>

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"

namespace gearshift::haptics {

// Positions of the pedals and the hand brake.
struct Pedals {
  double throttle = 0.0;    // [1] 0 to 1
  double brake = 0.0;       // [1] 0 to 1
  double clutch = 0.0;      // [1] 0 = pedal up (closed), 1 = fully pressed (open)
  double hand_brake = 0.0;  // [1] 0 to 1
};

// Keys that press a pedal and are held now. A load that models the pedals moves them, see LeverLoad::move_pedals().
struct PedalKeys {
  bool throttle = false, throttle_light = false, brake = false, clutch = false, clutch_hold = false;
  double slow_clutch = 0.0;    // [1] 0 to 1: how much longer the released clutch takes to come up where it bites
  double held_throttle = 0.0;  // [1] 0 to 1: where the foot holds the throttle while no key presses it further
  bool operator==(const PedalKeys&) const = default;
};

// The driver's controls except the lever, and the settings of a lesson. The frame thread writes them as one value.
struct DriverControls {
  Pedals pedals;
  bool ignition = false;
  bool starter = false;
  double slope = 0.0;              // [rad] slope of the road, uphill +
  int guided_gear = kNeutralGear;  // gear to which the guidance leads the hand
  double guidance = 0.0;           // [1] 0 to 1, strength of the guidance; 0: none
};

struct LeverInput {
  glm::dvec2 position{0.0};  // [m] lever point
  glm::dvec2 velocity{0.0};  // [m/s] smoothed
  glm::dvec2 proxy{0.0};     // [m] proxy
  glm::dvec2 push{0.0};      // [N] force of the hand on the knob, measured or estimated
  int slot = kNoSlot;        // slot of the proxy
  double depth = 0.0;        // [m] depth of the proxy in its slot, from the aisle's centre line; 0 outside all slots
  int gear = kNeutralGear;   // engaged gear
  DriverControls controls;
};

struct LeverOutput {
  glm::dvec2 force{0.0};  // [N] force on the lever
  // [N] part of `force` that vibrates independently of the lever's motion, such as the shaking of a stalling engine
  glm::dvec2 vibration{0.0};
  int limited_slot = kNoSlot;                             // slot with a depth limit, such as a blocking synchroniser
  double depth_min = 0.0;                                 // [m]
  double depth_max = std::numeric_limits<double>::max();  // [m]
  double road_speed = 0.0;                                // [m/s] positive forward; input of the speed lockout
};

class LeverLoad {
 public:
  virtual ~LeverLoad() = default;
  // Returns the pedals' positions after `period` [s]: those of the axes, or further down where keys press a pedal.
  // Called before step(), under the same rules. The trace contains the result and not the keys: a replay passes the
  // recorded positions without keys, so it must get the same positions back.
  // Without a model, only the brake's key moves a pedal, for lockouts that the brake opens.
  virtual Pedals move_pedals(const Pedals& axes, const PedalKeys& keys, double /*period*/) noexcept {
    Pedals pedals = axes;
    if (keys.brake) pedals.brake = 1.0;
    return pedals;
  }
  virtual LeverOutput step(const LeverInput& in, double period) noexcept = 0;  // period [s]
  // Text that identifies the model and its parameters in a trace; a replay rejects a different model.
  virtual const char* replay_parameters() const noexcept = 0;
  // The gear that a sequential gate is in before the first step. A replay gets it from the same text.
  virtual int start_gear() const noexcept { return kNeutralGear; }
};

class NoLoad final : public LeverLoad {
 public:
  explicit NoLoad(int start_gear = kNeutralGear)
      : start_gear_(start_gear),
        parameters_(start_gear == kNeutralGear ? "none" : "none " + std::to_string(start_gear)) {}
  LeverOutput step(const LeverInput&, double) noexcept override { return {}; }
  const char* replay_parameters() const noexcept override { return parameters_.c_str(); }
  int start_gear() const noexcept override { return start_gear_; }

 private:
  int start_gear_;
  std::string parameters_;  // "none", or "none 3" in third gear
};

}  // namespace gearshift::haptics
