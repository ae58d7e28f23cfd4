// The interface to every lever, simulated or real. "The paper" in this file is W.-C. Lin, K.-Y. Young: Design of
// Force-Reflection Joystick System for VR-Based Simulation.
#pragma once

#include <algorithm>
#include <cstdint>

#include <glm/vec2.hpp>

#include "haptics/joystick/plant.h"

namespace gearshift::haptics {

inline constexpr int kMaxLoopDelay = 15;  // [cycles] largest device delay that the loop supports

// A device's properties. The program checks its configuration against them.
struct DeviceSpec {
  glm::dvec2 max_force{31.7};          // [N] peak force per axis: select, shift
  glm::dvec2 continuous_force{10.83};  // [N] force per axis that the motors can hold indefinitely
  glm::dvec2 workspace{0.0};           // [m] reach of the tip along each axis; the reach is less in the corners
  double yoke_radius = 0.0;            // [m] distance from the yoke's centre to the tip; 0: the tip moves in a plane
  double position_step = 0.0;          // [m] motion of the tip per encoder count
  int delay = 0;                       // [cycles] >= 0, time from write() to the effect of the force
  AxisModel axis_x = kPaperAxisX;      // bare handle, select
  AxisModel axis_y = kPaperAxisY;      // bare handle, shift
  // [N/m] per axis: stiffness of the walls that the device itself can render at its own rate (see set_device_walls); 0:
  // none. Used only if both axes have it.
  glm::dvec2 device_wall_stiffness{0.0};
  // [N s/m] per axis: damping that the device itself can add inside its own walls; 0: none. Used only if both axes have
  // it.
  glm::dvec2 device_wall_damping{0.0};
  bool measures_hand_force = false;  // a force sensor at the handle measures the hand force
  bool simulated = false;            // a simulated device may arm itself and run unstable tunings
  bool operator==(const DeviceSpec&) const = default;
};

// One sample of the lever. A reading is fresh if its sequence number differs from that of the previous reading. This
// distinguishes a dead sensor, which repeats its last sample, from a lever at rest.
struct LeverReading {
  std::uint64_t sequence = 0;  // number of samples the device has taken
  std::int64_t time_ns = 0;    // [ns] time of the sample, on a monotonic clock
  glm::dvec2 position{0.0};    // [m] tip in the gate plane: x = select (right +), y = shift (forward +)
  glm::dvec2 hand_force{0.0};  // [N] force of the hand on the knob (f_h in eq (4) of the paper); 0 without a sensor
  // [N] force of the motors on the knob during the last cycle, device walls included (-f_a in eq (4) of the paper)
  glm::dvec2 actuator_force{0.0};
  bool pressed_down = false;  // the knob is pushed down or the reverse button is held
  bool lifted = false;        // lift ring held
  bool stop = false;          // the device's panic button is held: motors off unconditionally
};

// Walls rendered by the device itself. There is no force between `low` and `high`. Beyond these limits act a spring of
// `stiffness_fraction` x `device_wall_stiffness` and a damper of `damping_fraction` x `device_wall_damping`.
struct LeverWalls {
  glm::dvec2 low{0.0}, high{0.0};   // [m] position of the walls; low <= high
  double stiffness_fraction = 0.0;  // [1] 0 to 1, includes the guard's ramp; 0: no wall
  double damping_fraction = 0.0;    // [1] 0 to 1, includes the guard's ramp; 0: no damper
  bool operator==(const LeverWalls&) const = default;
};

// Stiffness [N/m] and damping [N s/m] that the device walls can render on both axes.
inline double usable_wall_stiffness(const DeviceSpec& spec) noexcept {
  return std::min(spec.device_wall_stiffness.x, spec.device_wall_stiffness.y);
}
inline double usable_wall_damping(const DeviceSpec& spec) noexcept {
  return std::min(spec.device_wall_damping.x, spec.device_wall_damping.y);
}

class HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  virtual const DeviceSpec& spec() const noexcept = 0;  // constant during the device's lifetime

  // Returns the newest sample without waiting. now_ns: deadline of this cycle on the loop's clock. Real-time safe.
  virtual LeverReading read(std::int64_t now_ns) noexcept = 0;

  // Turns the motors on. Called before write() in every cycle in which the guard outputs forces. Real-time safe.
  virtual void switch_on() noexcept {}

  // Sets the force on the knob in the gate plane [N]. The device holds it until the next call. Real-time safe.
  virtual void write(glm::dvec2 force) noexcept = 0;

  // Sets the device walls, which stay until the next call. A device that cannot render walls (see spec()) ignores the
  // call. Real-time safe.
  virtual void set_device_walls(const LeverWalls&) noexcept {}

  // Turns the motors off immediately and drops queued forces. Real-time safe; may be called repeatedly and in any
  // state. A later write() drives the motors again; the haptic loop writes only zero until it is armed.
  virtual void release() noexcept = 0;
};

}  // namespace gearshift::haptics
