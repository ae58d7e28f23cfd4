// The interface of every lever, simulated or real.
#pragma once

#include <algorithm>
#include <cstdint>

#include <glm/vec2.hpp>

#include "haptics/joystick/plant.h"

namespace gearshift::haptics {

inline constexpr int kMaxLoopDelay = 15;  // [cycles] largest device delay that the loop supports

// A device's properties. The configuration is checked against them.
struct DeviceSpec {
  glm::dvec2 max_force{31.7};          // [N] peak per axis, select and shift
  glm::dvec2 continuous_force{10.83};  // [N] force per axis that the motors can hold indefinitely
  glm::dvec2 workspace{0.0};           // [m] reach of the tip along each axis; less in the corners
  double yoke_radius = 0.0;            // [m] radius from the yoke's centre to the tip; 0: the tip moves in a plane
  double position_step = 0.0;          // [m] motion of the tip per encoder count
  int delay = 0;                       // [cycles] >= 0, from write() to the force's effect
  AxisModel axis_x = kPaperAxisX;      // bare handle, select
  AxisModel axis_y = kPaperAxisY;      // bare handle, shift
  // [N/m] per axis, stiffness of the walls that the device itself can render at its own rate (set_device_walls); 0:
  // none. Used only if both axes have it.
  glm::dvec2 device_wall_stiffness{0.0};
  // [N s/m] per axis, damping that the device itself can add inside these walls; 0: none. Used only if both axes have
  // it.
  glm::dvec2 device_wall_damping{0.0};
  bool measures_hand_force = false;  // has a force sensor at the handle
  bool simulated = false;            // may arm itself and run unstable tunings, which would be unsafe on a real device
};

// One sample of the lever. A reading is fresh if its sequence number differs from the last one's, so a dead sensor
// cannot be mistaken for a live one.
struct LeverReading {
  std::uint64_t sequence = 0;  // counts samples taken by the device
  std::int64_t time_ns = 0;    // [ns] monotonic, when the sample was taken
  glm::dvec2 position{0.0};    // [m] tip in the gate plane: select right +, shift forward +
  glm::dvec2 hand_force{0.0};  // [N] force of the hand on the knob, f_h of the paper's eq (4); 0 without a sensor
  // [N] force of the motors on the knob during the last cycle, device walls included: -f_a of the paper's eq (4)
  glm::dvec2 actuator_force{0.0};
  bool pressed_down = false;  // knob pushed down or reverse button held
  bool lifted = false;        // lift ring held
  bool stop = false;          // the device's panic button is held: motors off unconditionally
};

// Walls rendered by the device itself: no force between low and high; beyond them a spring of stiffness_fraction x
// device_wall_stiffness and a damper of damping_fraction x device_wall_damping.
struct LeverWalls {
  glm::dvec2 low{0.0}, high{0.0};   // [m] low <= high
  double stiffness_fraction = 0.0;  // [1] 0 to 1, scaled by the guard's ramp; 0: no wall
  double damping_fraction = 0.0;    // [1] 0 to 1, scaled by the guard's ramp; 0: no damper
  bool operator==(const LeverWalls&) const = default;
};

// Stiffness [N/m] and damping [N s/m] of the device walls that both axes can render.
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

  // Newest sample, without waiting. now_ns: deadline of this cycle on the loop's clock. Real-time safe.
  virtual LeverReading read(std::int64_t now_ns) noexcept = 0;

  // Turns the motors on before the first force. Called before write() in every cycle in which the guard outputs forces.
  // Real-time safe.
  virtual void switch_on() noexcept {}

  // Force on the knob in the gate plane, held until the next call. [N] Real-time safe.
  virtual void write(glm::dvec2 force) noexcept = 0;

  // Sets the device walls, held until the next call; ignored by a device without any (see spec()). Real-time safe.
  virtual void set_device_walls(const LeverWalls&) noexcept {}

  // Turns the motors off immediately and drops queued forces. Real-time safe; may be called repeatedly and in any
  // state. A later write() drives the motors again; the loop writes zero until it is armed.
  virtual void release() noexcept = 0;
};

}  // namespace gearshift::haptics
