// Simulation of the joystick in the paper by W.-C. Lin and K.-Y. Young (Design of Force-Reflection Joystick System for
// VR-Based Simulation): exact plant, encoder, force sensor, motors and a hand on the knob.
#pragma once

#include <array>
#include <cstdint>
#include <random>

#include "haptics/device/gaussian_noise.h"
#include "haptics/device/hand.h"
#include "haptics/device/haptic_device.h"
#include "haptics/device/joint_encoder.h"
#include "haptics/files/parameter.h"
#include "haptics/joystick/actuator.h"
#include "haptics/joystick/force_sensor.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/joystick/plane_pose.h"

namespace gearshift::haptics {

inline constexpr int kMaxSimulatedDelay = 8;  // [cycles]

struct SimulatedLeverConfig {
  YokeGeometry yoke;
  AxisModel axis_x = kPaperAxisX;
  AxisModel axis_y = kPaperAxisY;
  double coulomb_friction = 0.0;  // [N] dry friction per axis; 0: none
  // [counts/deg] 0: no quantisation. Table 2 of the paper gives 2250 counts over 80 deg, which are 74.5
  // um per count at the tip. The value of 75.4 um in gate_layout.h is for the encoder alone: 2500 lines x 4 = 10000
  // counts per turn = 27.8 counts/deg.
  double encoder_counts = 2250.0 / 80.0;
  ActuatorLimits actuator;
  ForceSensorModel force_sensor;
  int delay = 0;                       // [cycles] time from write() to the effect of the force
  double device_wall_stiffness = 0.0;  // [N/m] stiffness of the device walls on both axes; 0: none
  HandImpedance hand = kBareHand;
  // Random deviations from spec(), for difficult test cases. They are uniformly distributed and determined by the seed.
  double model_error = 0.0;    // [1] largest relative error of each axis's mass, damping and stiffness
  double period_jitter = 0.0;  // [1] largest relative error of each period
  std::uint64_t seed = 1;      // seed of sensor noise, model error and jitter
  bool operator==(const SimulatedLeverConfig&) const = default;
};
// The hand and the parts that are structs have tables or keys of their own.
template <>
inline constexpr Parameter<SimulatedLeverConfig> kParameters<SimulatedLeverConfig>[] = {
    {&SimulatedLeverConfig::encoder_counts, "encoder_counts", "encoder_counts_per_deg", FileRange{0.0, 1e6},
     "Table 2: 2250 counts over 80 deg, 74.5 um at the tip; 0: no quantisation."},
    {&SimulatedLeverConfig::coulomb_friction, "coulomb_friction", "coulomb_friction_n", FileRange{0.0, 1e3},
     "Dry friction on each axis; the paper gives none."},
    {&SimulatedLeverConfig::delay, "delay", "delay_cycles", FileRange{0.0, kMaxSimulatedDelay},
     "Delay from writing a force to its effect."},
    {&SimulatedLeverConfig::device_wall_stiffness, "device_wall_stiffness", "own_wall_stiffness_n_per_m",
     FileRange{0.0, 1e5}, "Stiffness of walls that the device renders itself, like a stick's springs."},
    {&SimulatedLeverConfig::model_error, "model_error", "model_error", FileRange{0.0, 0.5},
     "True mass, damping and stiffness differ by up to this fraction."},
    {&SimulatedLeverConfig::period_jitter, "period_jitter", "period_jitter", FileRange{0.0, 0.5},
     "True periods differ by up to this fraction."},
    {&SimulatedLeverConfig::seed, "seed", "seed", FileRange{0.0, 9007199254740992.0},
     "For sensor noise, model error and jitter."},
};
static_assert(describes_all(&SimulatedLeverConfig::yoke, &SimulatedLeverConfig::axis_x, &SimulatedLeverConfig::axis_y,
                            &SimulatedLeverConfig::actuator, &SimulatedLeverConfig::force_sensor,
                            &SimulatedLeverConfig::hand));

// Calls visit(section, part) for each section of a preset that describes the lever, and the struct that it sets.
template <class Config>
requires std::is_same_v<std::remove_const_t<Config>, SimulatedLeverConfig>
constexpr void each_section(Config& lever, auto&& visit) {
  visit("lever", lever);
  visit("lever", lever.actuator);
  visit("lever.yoke", lever.yoke);
  visit("lever.axis_x", lever.axis_x);
  visit("lever.axis_y", lever.axis_y);
  visit("lever.force_sensor", lever.force_sensor);
}

inline constexpr int kMaxPeriodsPerRead = 1000;
inline constexpr double kDeviceWallRate = 4000.0;  // [Hz] lowest sampling rate of the device walls

// Time advances only in whole periods T of the loop: read(now) moves the plant by the periods since the last read,
// under the forces that take effect in these periods. The same sequence of calls always gives the same result.
//
//   first read         sets the clock's origin; returns a fresh reading, nothing moves
//   now = last + n T   advances n periods and n sequence numbers; n is rounded and at most kMaxPeriodsPerRead:
//                      the rest of a longer gap is dropped
//   n <= 0             returns the last reading again, stale
//
// A new setting of the device walls (set_device_walls) takes effect with the same delay as a force. The walls
// themselves respond without delay: they are a spring on the true position. Its force is sampled and held at
// kDeviceWallRate, and computed from the depth in the middle of each sample. Each axis's spring yields at the motors' peak
// force, like a PID condition at its saturation, and the motors limit the sum with the command. The encoder resolution
// that a real stick would use for its walls is not modelled.
//
// With period_jitter each period lasts a whole number of nanoseconds between T (1 - jitter) and T (1 + jitter),
// independent of the loop's clock. A reading's time_ns includes this jitter.
class SimulatedLever final : public HapticDevice {
 public:
  // `period_ns`: period of the loop [ns], 1 to 1e9. `driver` must outlive the lever. Throws std::invalid_argument with
  // one sentence that states parameter, value and allowed range.
  SimulatedLever(const SimulatedLeverConfig& config, std::int64_t period_ns, HandDriver& driver);

  const DeviceSpec& spec() const noexcept override { return spec_; }
  LeverReading read(std::int64_t now_ns) noexcept override;
  void write(glm::dvec2 force) noexcept override;
  void set_device_walls(const LeverWalls& walls) noexcept override;
  void release() noexcept override;

  // True position [m] and velocity [m/s] in the gate plane, without encoder quantisation; for tests and benches.
  glm::dvec2 true_position() const noexcept;
  glm::dvec2 true_velocity() const noexcept;

  // Sets the tip's position [m] and velocity [m/s] in the gate plane. A position out of reach is moved to the stop.
  void place(glm::dvec2 position, glm::dvec2 velocity = glm::dvec2(0.0)) noexcept;

 private:
  // One joint along its arc. The handle and the hand that moves with it form one axis, which is stepped exactly. The mass of an
  // elastic hand is a second one: each is stepped exactly while the other stands still, in turns of `turn` seconds (G.
  // Strang. On the Construction and Comparison of Difference Schemes. 1968), so the error falls with the turn's square.
  struct Axis {
    AxisModel model;
    AxisStepper stepper;  // for a whole turn
    AxisLimits limits;
    Actuator actuator;
    JointEncoder encoder;
    AxisModel hand_model;      // an elastic hand's mass
    AxisStepper hand_stepper;  // for half a turn
    double turn;               // [s]
    AxisState state{};
    AxisState hand{};
    double hand_drive = 0.0;      // [N] hand force at x = 0: push + stiffness * target + damping * target velocity
    double actuator_force = 0.0;  // [N] force delivered during the last cycle
  };

  // The hand's target, converted to positions and velocities along the arcs.
  struct ArcTarget {
    glm::dvec2 position{0.0}, velocity{0.0};
  };

  // A command received from the loop.
  struct MotorCommand {
    glm::dvec2 force{0.0};  // [N]
    LeverWalls walls;
  };

  Axis make_axis(const AxisModel& nominal, double limit);
  AxisModel true_model(const AxisModel& nominal);
  double random_factor(double fraction) noexcept;
  std::uint64_t consume_periods(std::int64_t now_ns) noexcept;
  void advance_period() noexcept;
  void update_hand() noexcept;
  void draw_period() noexcept;
  const MotorCommand& due_command() noexcept;
  void drive(const MotorCommand& command) noexcept;
  void drive_in_walls(const MotorCommand& command) noexcept;
  bool may_reach_walls(const LeverWalls& walls) const noexcept;
  glm::dvec2 wall_force(const LeverWalls& walls, double ahead) const noexcept;
  void move(Axis& axis, double time) const noexcept;
  void move_lever(Axis& axis, double force, const AxisStepper& stepper, double time) const noexcept;
  double lever_drive(const Axis& axis) const noexcept;
  void update_pose() noexcept;
  void sample() noexcept;
  ArcTarget arc_target(const HandTarget& target) const noexcept;
  PlanePose reachable_pose(glm::dvec2 plane) const noexcept;
  double hand_force(const Axis& axis) const noexcept;
  double measure(double force) noexcept;

  SimulatedLeverConfig config_;
  HandImpedance attached_;  // rigidly moves with the handle: the hand, or the fingers and grip of an elastic one
  HandDriver& driver_;
  DeviceSpec spec_;
  std::uint64_t period_ns_;
  double period_;           // [s] nominal
  double actual_period_;    // [s] length of the current period, jitter included
  std::mt19937_64 random_;  // random numbers for model error and jitter
  double tan_theta_limit_, tan_phi_limit_;
  double reach_;  // [m] largest distance of the tip from the centre; reached in the corners
  Axis x_, y_;
  PlanePose pose_;       // pose at the true angles, without encoder quantisation
  PlanePose read_pose_;  // pose of the last reading
  HandTarget target_;
  ArcTarget wanted_;  // of target_
  GaussianNoise noise_;

  std::array<MotorCommand, kMaxSimulatedDelay + 1> queue_{};  // delay line of commands, indexed by period number
  MotorCommand written_;
  std::uint64_t periods_ = 0;  // number of periods since the first read
  bool started_ = false;
  std::int64_t last_ns_ = 0;   // [ns] time of the last sample, on the loop's clock
  std::int64_t drift_ns_ = 0;  // [ns] true time of the last sample minus last_ns_, caused by jitter
  LeverReading reading_;
};

}  // namespace gearshift::haptics
