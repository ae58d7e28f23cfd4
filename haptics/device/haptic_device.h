// The one interface for every lever, simulated or not.
#pragma once

#include <algorithm>
#include <cstdint>

#include <glm/vec2.hpp>

#include "haptics/joystick/plant.h"

namespace gearshift {

inline constexpr int kMostDelay = 15;  // [cycles] that the loop can account for

// What a device can do. The configuration is checked against it.
struct DeviceSpec {
  glm::dvec2 max_force{31.7};          // [N] peak per axis, select and shift
  glm::dvec2 continuous_force{10.83};  // [N] per axis, for ever
  glm::dvec2 workspace{0.0};           // [m] how far the tip reaches along each axis; less in the corners
  double yoke_radius = 0.0;            // [m] centre of the yoke to the tip; 0: the tip moves in the plane
  double position_step = 0.0;          // [m] encoder quantum at the tip
  int delay = 0;                       // [cycles] whole samples between write and effect, >= 0
  AxisModel axis_x = kPaperAxisX;      // bare handle, select
  AxisModel axis_y = kPaperAxisY;      // bare handle, shift
  // [N/m] per axis of the walls that the device keeps by itself, at its own rate (hold_walls); 0: it keeps none. Used
  // where both axes have it.
  glm::dvec2 own_stiffness{0.0};
  // [N s/m] per axis of the dampers that it turns on in these walls; 0: none. Used where both axes have them.
  glm::dvec2 own_damping{0.0};
  bool measures_hand_force = false;  // a force sensor at the handle
  bool simulated = false;            // arms itself; may run studies that a person must not touch
};

// One sample of the lever. A reading is fresh when its sequence number differs from the last one's:
// a dead sensor cannot be taken for a live one.
struct LeverReading {
  std::uint64_t sequence = 0;  // counts samples taken by the device
  std::int64_t time_ns = 0;    // [ns] monotonic, when the sample was taken
  glm::dvec2 position{0.0};    // [m] tip in the gate plane: select right +, shift forward +
  glm::dvec2 hand_force{0.0};  // [N] of the hand on the knob, f_h of eq (4); 0 without a sensor
  // [N] of the motors on the knob over the last cycle, walls that the device keeps itself included (= -f_a of eq (4))
  glm::dvec2 actuator_force{0.0};
  bool pressed_down = false;  // knob pushed down or reverse button held
  bool lifted = false;        // lift ring held
  bool stop = false;          // the panic button of the device is held: motors off, whatever the program does
};

// Walls that the device may keep by itself: nothing is felt between low and high, a spring of share x own_stiffness
// beyond, and a damper of damping x own_damping there.
struct LeverWalls {
  glm::dvec2 low{0.0}, high{0.0};  // [m] low <= high
  double share = 0.0;              // [1] 0 to 1, of own_stiffness: of all that is wanted, the guard's ramp; 0: no wall
  double damping = 0.0;            // [1] the same, of own_damping
  bool operator==(const LeverWalls&) const = default;
};

// [N/m], [N s/m] of the device's own walls that is counted on: what both axes have.
inline double own_wall_stiffness(const DeviceSpec& spec) noexcept {
  return std::min(spec.own_stiffness.x, spec.own_stiffness.y);
}
inline double own_wall_damping(const DeviceSpec& spec) noexcept {
  return std::min(spec.own_damping.x, spec.own_damping.y);
}

class HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  virtual const DeviceSpec& spec() const noexcept = 0;  // one and the same for as long as the device lives

  // Newest sample. now_ns is the deadline of this cycle on the loop's clock; it never waits. Real-time safe.
  virtual LeverReading read(std::int64_t now_ns) noexcept = 0;

  // Forces may follow: in every cycle in which the guard lets them through, before write(). So that the first newton finds
  // the motors on. Real-time safe.
  virtual void switch_on() noexcept {}

  // Force on the knob from now on, in the gate plane. [N] Real-time safe.
  virtual void write(glm::dvec2 force) noexcept = 0;

  // Walls from now on, where spec() says that the device keeps any. Real-time safe.
  virtual void hold_walls(const LeverWalls&) noexcept {}

  // Motors off, now, queued forces included. Real-time safe; may be called in any state and twice. A later write()
  // drives them again; the loop writes zero until it is armed.
  virtual void release() noexcept = 0;
};

}  // namespace gearshift
