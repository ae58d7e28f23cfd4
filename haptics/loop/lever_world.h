// The contract between the haptic cycle and whatever lies behind the lever: the driveline.
//
// The loop calls step() once per cycle, on the haptic thread, after the coupling and the gate's feel and
// before the guard, always in this order and never from two threads. The first call has period 0.
//
// step() must be noexcept, must not allocate, lock, wait or make a system call, and must depend on nothing
// but its own state, the input and the period: a recording replays it bit for bit.
//
// It may return any finite force: the guard makes it safe. Depth limits take effect in the next cycle and
// never move the lever: a limit inside which the lever does not lie is applied at the lever's depth.
//
// What shakes the lever on purpose it says in `shake`, so that the loop does not take it for a wall that chatters. Only
// what comes and goes at a rate of its own is a shake: a force that answers the lever's motion must not be in it.
//
//   LeverOutput NullWorld::step(const LeverInput&, double) noexcept { return {}; }  // nothing behind it
#pragma once

#include <limits>

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"

namespace gearshift {

// The driver's other controls, and what a lesson sets. Newest whole value from the frame.
struct DriverControls {
  double throttle = 0.0;    // [1] 0 to 1
  double brake = 0.0;       // [1] 0 to 1
  double clutch = 0.0;      // [1] 0 = pedal up (closed), 1 = fully pressed (open)
  double hand_brake = 0.0;  // [1] 0 to 1
  bool ignition = false;
  bool starter = false;
  double slope = 0.0;              // [rad] of the road, uphill +
  int guided_gear = kNeutralGear;  // where the teacher's guidance leads
  double guidance = 0.0;           // [1] 0 to 1: its strength; 0: there is none
};

struct LeverInput {
  glm::dvec2 position{0.0};  // [m] lever point
  glm::dvec2 velocity{0.0};  // [m/s] smoothed
  glm::dvec2 proxy{0.0};     // [m] drawn lever
  glm::dvec2 push{0.0};      // [N] of the hand on the knob, measured or estimated
  int slot = kNoSlot;        // the slot that the proxy is in
  double depth = 0.0;        // [m] of the proxy in that slot, from the aisle's centre line; 0 outside
  int gear = kNeutralGear;   // engaged
  DriverControls controls;
};

struct LeverOutput {
  glm::dvec2 force{0.0};       // [N] on the lever
  glm::dvec2 shake{0.0};       // [N] of it what comes and goes by itself, whatever the lever does: an engine that dies
  int limited_slot = kNoSlot;  // the slot whose depth is limited: a blocked synchroniser, a torque lock
  double depth_min = 0.0;      // [m]
  double depth_max = std::numeric_limits<double>::max();  // [m]
  double road_speed = 0.0;                                // [m/s] forward +; drives the speed lockout
};

class LeverWorld {
 public:
  virtual ~LeverWorld() = default;
  virtual LeverOutput step(const LeverInput& in, double period) noexcept = 0;  // period [s]
  // Names the model and its parameters in a trace; a replay refuses another one.
  virtual const char* name() const noexcept = 0;
};

class NullWorld final : public LeverWorld {
 public:
  LeverOutput step(const LeverInput&, double) noexcept override { return {}; }
  const char* name() const noexcept override { return "none"; }
};

}  // namespace gearshift
