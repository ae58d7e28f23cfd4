// The paper's joystick in simulation: exact plant, encoder, force sensor, motors, and a hand on it.
#pragma once

#include <array>
#include <cstdint>
#include <random>

#include "haptics/device/gaussian_noise.h"
#include "haptics/device/hand.h"
#include "haptics/device/haptic_device.h"
#include "haptics/device/joint_encoder.h"
#include "haptics/joystick/actuator.h"
#include "haptics/joystick/force_sensor.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/joystick/plane_pose.h"

namespace gearshift {

struct SimulatedLeverConfig {
  YokeGeometry yoke;
  AxisModel axis_x = kPaperAxisX;
  AxisModel axis_y = kPaperAxisY;
  double coulomb_friction = 0.0;  // [N] per axis, 0 = none
  // [counts/deg] 0 = no quantisation, else 1 to 1e6.
  // Table 2's 2250 counts over 80 deg are 74.5 um at the tip.
  // The 75.4 um quoted elsewhere are the bare encoder: 2500 lines x 4 = 10000 counts per turn = 27.8 per deg.
  double encoder_counts = 2250.0 / 80.0;
  ActuatorLimits actuator;
  ForceSensorModel force_sensor;
  int delay = 0;               // [cycles] 0 to 8, whole samples from write to effect
  double own_stiffness = 0.0;  // [N/m] 0 to 1e5 of walls that it keeps itself, on both axes; 0: it keeps none
  HandImpedance hand = kBareHand;
  // What no model knows, for hard cases. Drawn with the seed, evenly.
  double model_error = 0.0;    // [1] 0 to 0.5, true mass, damping and stiffness of each axis are off by up to this
  double period_jitter = 0.0;  // [1] 0 to 0.5, each period is this much shorter or longer
  std::uint64_t seed = 1;      // for sensor noise, model error and jitter
};

inline constexpr int kMaxDelay = 8;  // [cycles]
inline constexpr int kMaxPeriodsPerRead = 1000;
inline constexpr double kOwnWallRate = 4000.0;  // [Hz] at least

// Time moves only in whole periods of the loop: read(now) advances the plant by the periods since the last
// read, under the force then due. Deterministic for a given sequence of calls.
//
//   first read         the clock's origin; a fresh reading, nothing moves
//   now = last + n T   n periods and n sequence numbers on; n is rounded, at most kMaxPeriodsPerRead:
//                      the rest of a longer gap is dropped
//   n <= 0             the last reading again, stale
//
// Its own walls (hold_walls) are told with the delay of every command, and kept without any: a spring on the true
// position, sampled and held at kOwnWallRate by the depth in the middle of each sample, saturating with the motors. What
// the encoder of such a stick resolves is not modelled there.
//
// With period_jitter a period lasts a whole number of nanoseconds between T (1 - jitter) and T (1 + jitter), whatever
// the loop's clock says; time_ns of a reading tells how long it was.
class SimulatedLever final : public HapticDevice {
 public:
  // period_ns: the loop's period [ns], 1 to 1e9. The driver must outlive the lever.
  // Throws std::invalid_argument with one sentence: parameter, value and allowed range.
  SimulatedLever(const SimulatedLeverConfig& config, std::int64_t period_ns, HandDriver& driver);

  const DeviceSpec& spec() const noexcept override { return spec_; }
  LeverReading read(std::int64_t now_ns) noexcept override;
  void write(glm::dvec2 force) noexcept override;
  void hold_walls(const LeverWalls& walls) noexcept override;
  void release() noexcept override;

  // The truth behind the encoder, for tests and benches. [m], [m/s] in the gate plane
  glm::dvec2 true_position() const noexcept;
  glm::dvec2 true_velocity() const noexcept;

  // Puts the tip somewhere, at rest or moving. [m], [m/s] in the gate plane, moved to the nearest stop if it is out
  // of reach
  void place(glm::dvec2 position, glm::dvec2 velocity = glm::dvec2(0.0)) noexcept;

 private:
  // One joint along its arc: handle and hand together are one exactly stepped axis.
  struct Axis {
    AxisModel model;
    AxisStepper stepper;
    AxisLimits limits;
    Actuator actuator;
    JointEncoder encoder;
    AxisState state{};
    double hand_drive = 0.0;      // [N] of the hand's target: push + stiffness target + damping target velocity
    double actuator_force = 0.0;  // [N] delivered over the last cycle
  };

  // Where the hand wants to be, along the arcs.
  struct ArcTarget {
    glm::dvec2 position{0.0}, velocity{0.0};
  };

  // What it is told to do.
  struct Order {
    glm::dvec2 force{0.0};  // [N]
    LeverWalls walls;
  };

  Axis make_axis(const AxisModel& nominal, double limit);
  AxisModel true_model(const AxisModel& nominal);
  double off_by(double share) noexcept;
  std::uint64_t take_periods(std::int64_t now_ns) noexcept;
  void advance_period() noexcept;
  void lead_hand() noexcept;
  void take_time() noexcept;
  const Order& due_order() noexcept;
  void drive(const Order& order) noexcept;
  void drive_in_walls(const Order& order) noexcept;
  bool may_touch(const LeverWalls& walls) const noexcept;
  glm::dvec2 wall_force(const LeverWalls& walls, double ahead) const noexcept;
  void move(Axis& axis, double time) const noexcept;
  void find_pose() noexcept;
  void sample() noexcept;
  ArcTarget arc_target(const HandTarget& target) const noexcept;
  PlanePose reachable_pose(glm::dvec2 plane) const noexcept;
  double hand_force(const Axis& axis) const noexcept;
  double sensed(double force) noexcept;

  SimulatedLeverConfig config_;
  HandDriver& driver_;
  DeviceSpec spec_;
  std::uint64_t period_ns_;
  double period_;           // [s] nominal
  double length_;           // [s] that the period now passing really lasts
  std::mt19937_64 chance_;  // of model error and jitter
  double tan_theta_limit_, tan_phi_limit_;
  double reach_;  // [m] farthest the tip gets from the centre, in the corners
  Axis x_, y_;
  PlanePose pose_;  // of the true angles
  HandTarget target_;
  GaussianNoise noise_;

  std::array<Order, kMaxDelay + 1> queue_{};  // by period
  Order written_;
  std::uint64_t periods_ = 0;  // since the first read
  bool started_ = false;
  std::int64_t last_ns_ = 0;   // [ns] of the last sample, on the loop's clock
  std::int64_t drift_ns_ = 0;  // [ns] that this sample was really later than on that clock
  LeverReading reading_;
};

}  // namespace gearshift
