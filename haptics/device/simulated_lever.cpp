#include "haptics/device/simulated_lever.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "haptics/files/parameter_file.h"
#include "haptics/files/range_check.h"
#include "haptics/joystick/finite.h"

namespace gearshift::haptics {
namespace {

// Limits beyond any real hand. They keep the simulation finite whatever a hand driver returns.
constexpr double kMaxPush = 1e4;   // [N]
constexpr double kMaxSpeed = 1e2;  // [m/s]

constexpr double kTurnRate = 0.1;  // [1] longest turn of an elastic hand, times the rate at which its grip moves

constexpr std::uint64_t kRandomSeedMask = 0x9e3779b97f4a7c15;  // makes random_() differ from the sensor noise

const SimulatedLeverConfig& validated(const SimulatedLeverConfig& config, std::int64_t period_ns) {
  each_section(config, [](std::string_view section, const auto& part) { check_parameters(part, section); });
  check_parameters(config.hand, "lever.hand");
  if (config.encoder_counts != 0.0)
    require_between("lever.encoder_counts_per_deg other than 0", config.encoder_counts, 1.0, 1e6);
  if (config.hand.is_elastic())
    require_between("lever.hand.mass_kg of an elastic hand", config.hand.mass, kMinElasticMass, 1e3);
  require_between("period_ns", static_cast<double>(period_ns), 1.0, 1e9);
  return config;
}

DeviceSpec make_spec(const SimulatedLeverConfig& config) {
  const YokeGeometry& yoke = config.yoke;
  DeviceSpec spec;
  spec.max_force = glm::dvec2(config.actuator.peak_force);
  spec.continuous_force = glm::dvec2(config.actuator.continuous_force);
  spec.workspace = workspace_half_extent(yoke);
  const double quantum = std::numbers::pi / 180.0 / config.encoder_counts;  // [rad]
  spec.yoke_radius = yoke.radius;
  spec.position_step = config.encoder_counts > 0.0 ? yoke.radius * quantum : 0.0;
  spec.delay = config.delay;
  spec.axis_x = config.axis_x;
  spec.axis_y = config.axis_y;
  spec.device_wall_stiffness = glm::dvec2(config.device_wall_stiffness);
  spec.measures_hand_force = true;
  spec.simulated = true;
  return spec;
}

// The part of the hand that moves with the handle.
HandImpedance attached_part(const HandImpedance& hand) {
  if (!hand.is_elastic()) return hand;
  return {hand.finger_mass, hand.grip_damping, hand.grip_stiffness};
}

// Number of turns per period. Lever and hand swing against each other with the mass 1 / (1/m + 1/m_h).
double turn_count(const AxisModel& lever, const AxisModel& hand, const HandImpedance& grip, double period) {
  const double inverse_mass = 1.0 / lever.mass + 1.0 / hand.mass;
  const double rate = std::sqrt(grip.grip_stiffness * inverse_mass) + grip.grip_damping * inverse_mass;
  return std::ceil(period * rate / kTurnRate);
}

}  // namespace

// A random factor, uniformly distributed between 1 - fraction and 1 + fraction; exactly 1 if fraction is 0.
double SimulatedLever::random_factor(double fraction) noexcept {
  constexpr double kStep = 1.0 / 4503599627370496.0;  // 2^-52
  return 1.0 + fraction * (static_cast<double>(random_() >> 11) * kStep - 1.0);
}

// The handle's true model. It differs from the model in spec() by the model error.
AxisModel SimulatedLever::true_model(const AxisModel& nominal) {
  const double mass = nominal.mass * random_factor(config_.model_error);
  const double damping = nominal.damping * random_factor(config_.model_error);
  return {mass, damping, nominal.stiffness * random_factor(config_.model_error)};
}

SimulatedLever::Axis SimulatedLever::make_axis(const AxisModel& nominal, double limit) {
  const AxisModel handle = true_model(nominal);
  const AxisModel model{handle.mass + attached_.mass, handle.damping + attached_.damping,
                        handle.stiffness + attached_.stiffness};
  const AxisLimits limits{config_.yoke.radius * limit, config_.coulomb_friction};
  const HandImpedance& hand = config_.hand;
  const AxisModel hand_model{std::max(hand.mass, kMinElasticMass), hand.damping + hand.grip_damping,
                             hand.stiffness + hand.grip_stiffness};
  const double turn = hand.is_elastic() ? period_ / turn_count(model, hand_model, hand, period_) : period_;
  return {model,
          AxisStepper(model, turn),
          limits,
          Actuator(config_.actuator),
          JointEncoder(config_.encoder_counts),
          hand_model,
          AxisStepper(hand_model, 0.5 * turn),
          turn};
}

SimulatedLever::SimulatedLever(const SimulatedLeverConfig& config, std::int64_t period_ns, HandDriver& driver)
    : config_(validated(config, period_ns)),
      attached_(attached_part(config.hand)),
      driver_(driver),
      spec_(make_spec(config)),
      period_ns_(static_cast<std::uint64_t>(period_ns)),
      period_(static_cast<double>(period_ns) * 1e-9),
      actual_period_(period_),
      random_(config.seed ^ kRandomSeedMask),
      tan_theta_limit_(std::tan(config.yoke.theta_limit)),
      tan_phi_limit_(std::tan(config.yoke.phi_limit)),
      reach_(glm::length(plane_position(plane_pose(tan_theta_limit_, tan_phi_limit_), config.yoke.radius))),
      x_(make_axis(config.axis_x, config.yoke.theta_limit)),
      y_(make_axis(config.axis_y, config.yoke.phi_limit)),
      noise_(config.seed) {
  update_pose();
}

LeverReading SimulatedLever::read(std::int64_t now_ns) noexcept {
  if (!started_) {
    started_ = true;
    last_ns_ = now_ns;
    sample();
    return reading_;
  }
  for (std::uint64_t n = consume_periods(now_ns); n > 0; --n) advance_period();
  return reading_;
}

// Advances last_ns_ by the whole number of periods that brings it nearest to now_ns. Returns this number, limited to
// kMaxPeriodsPerRead: the lever must move by so many periods.
std::uint64_t SimulatedLever::consume_periods(std::int64_t now_ns) noexcept {
  if (now_ns <= last_ns_) return 0;
  const std::uint64_t behind = static_cast<std::uint64_t>(now_ns) - static_cast<std::uint64_t>(last_ns_);
  const std::uint64_t periods = (behind + period_ns_ / 2) / period_ns_;
  last_ns_ = static_cast<std::int64_t>(static_cast<std::uint64_t>(last_ns_) + periods * period_ns_);
  return std::min<std::uint64_t>(periods, kMaxPeriodsPerRead);
}

void SimulatedLever::advance_period() noexcept {
  update_hand();
  draw_period();
  const MotorCommand& command = due_command();
  if (may_reach_walls(command.walls))
    drive_in_walls(command);
  else
    drive(command);
  ++periods_;
  update_pose();
  sample();
}

// Queries the hand driver and converts its target into a constant force along each arc. The axis model already contains
// the hand's mass, damping and stiffness. The force consists of the hand's push and the pull towards the target.
void SimulatedLever::update_hand() noexcept {
  const glm::dvec2 here = plane_position(pose_, config_.yoke.radius);
  const double drift = static_cast<double>(drift_ns_) * 1e-9;
  const HandTarget target = driver_.next(static_cast<double>(periods_) * period_ + drift, here);
  const bool rests = target.position == target_.position && target.velocity == target_.velocity;
  if (!rests || periods_ == 0 || !is_finite(target.position)) wanted_ = arc_target(target);
  target_ = target;

  const glm::dvec2 push = is_finite(target_.push) ? glm::clamp(target_.push, -kMaxPush, kMaxPush) : glm::dvec2(0.0);
  glm::dvec2 drive = arc_force(pose_, push);
  if (config_.hand.stiffness > 0.0 || config_.hand.damping > 0.0)
    drive += config_.hand.stiffness * wanted_.position + config_.hand.damping * wanted_.velocity;
  x_.hand_drive = drive.x;
  y_.hand_drive = drive.y;
}

// Replaces a target that is not finite by the lever's position, and a target out of reach by a point at rest at the
// stop.
SimulatedLever::ArcTarget SimulatedLever::arc_target(const HandTarget& target) const noexcept {
  if (!is_finite(target.position)) return {{x_.state.position, y_.state.position}, {}};
  const PlanePose pose = reachable_pose(target.position);
  const JointAngles q{std::atan(pose.a), std::atan(pose.b)};
  const bool inside = std::abs(pose.a) < tan_theta_limit_ && std::abs(pose.b) < tan_phi_limit_;
  const bool moves = inside && is_finite(target.velocity);
  const glm::dvec2 velocity = moves ? glm::clamp(target.velocity, -kMaxSpeed, kMaxSpeed) : glm::dvec2(0.0);
  return {arc_position(config_.yoke, q), arc_velocity(pose, velocity)};
}

// Exact inverse kinematics: the tangents of the joint angles, limited to the joints' stops.
PlanePose SimulatedLever::reachable_pose(glm::dvec2 plane) const noexcept {
  plane = glm::clamp(plane, -config_.yoke.radius, config_.yoke.radius);
  const double distance = glm::length(plane);
  if (distance > reach_) plane *= reach_ / distance;
  const double z = std::sqrt(config_.yoke.radius * config_.yoke.radius - glm::dot(plane, plane));
  return plane_pose(std::clamp(plane.x / z, -tan_theta_limit_, tan_theta_limit_),
                    std::clamp(-plane.y / z, -tan_phi_limit_, tan_phi_limit_));
}

// Draws the true length of this period: a whole number of nanoseconds, so that time stamps are exact.
void SimulatedLever::draw_period() noexcept {
  if (config_.period_jitter == 0.0) return;
  const std::int64_t length_ns = std::llround(static_cast<double>(period_ns_) * random_factor(config_.period_jitter));
  actual_period_ = static_cast<double>(length_ns) * 1e-9;
  drift_ns_ += length_ns - static_cast<std::int64_t>(period_ns_);
}

// Returns the command that was written `delay` periods ago and takes effect now.
const SimulatedLever::MotorCommand& SimulatedLever::due_command() noexcept {
  queue_[periods_ % queue_.size()] = written_;
  const std::uint64_t due = periods_ + queue_.size() - static_cast<std::uint64_t>(config_.delay);
  return queue_[due % queue_.size()];
}

// Moves the lever for one period without device walls. The force of each motor is limited on its own joint.
void SimulatedLever::drive(const MotorCommand& command) noexcept {
  const glm::dvec2 wanted = arc_force(pose_, command.force);
  x_.actuator_force = x_.actuator.deliver(wanted.x, actual_period_);
  y_.actuator_force = y_.actuator.deliver(wanted.y, actual_period_);
  reading_.actuator_force = plane_force(pose_, {x_.actuator_force, y_.actuator_force});
  move(x_, actual_period_);
  move(y_, actual_period_);
}

// Moves the lever for one period with device walls. Splits the period into parts, and computes the wall force again for
// each part.
void SimulatedLever::drive_in_walls(const MotorCommand& command) noexcept {
  const double parts = std::ceil(actual_period_ * kDeviceWallRate), part = actual_period_ / parts;
  const glm::dvec2 commanded = arc_force(pose_, command.force);
  glm::dvec2 sum{0.0, 0.0};
  for (double n = 0.0; n < parts; n += 1.0) {
    const glm::dvec2 wanted = commanded + wall_force(command.walls, 0.5 * part);
    x_.actuator_force = x_.actuator.deliver(wanted.x, part);
    y_.actuator_force = y_.actuator.deliver(wanted.y, part);
    sum += glm::dvec2{x_.actuator_force, y_.actuator_force};
    move(x_, part);
    move(y_, part);
  }
  reading_.actuator_force = plane_force(pose_, sum / parts);
}

// True if the lever may reach a wall within this period. The margin is twice the travel at the present speed, plus
// kMargin for the travel that acceleration adds.
bool SimulatedLever::may_reach_walls(const LeverWalls& walls) const noexcept {
  constexpr double kMargin = 0.001;  // [m]
  if (walls.stiffness_fraction == 0.0 || config_.device_wall_stiffness == 0.0) return false;
  const glm::dvec2 here = true_position();
  const glm::dvec2 margin = kMargin + 2.0 * actual_period_ * glm::abs(true_velocity());
  return !glm::all(glm::greaterThan(here - margin, walls.low)) || !glm::all(glm::lessThan(here + margin, walls.high));
}

// Wall force [N] along the arcs, at the position extrapolated by `ahead` [s].
glm::dvec2 SimulatedLever::wall_force(const LeverWalls& walls, double ahead) const noexcept {
  const auto tangent = [&](const Axis& axis) {
    return std::tan((axis.state.position + ahead * axis.state.velocity) / config_.yoke.radius);
  };
  const PlanePose pose = plane_pose(tangent(x_), -tangent(y_));
  const glm::dvec2 there = plane_position(pose, config_.yoke.radius);
  const glm::dvec2 back = glm::clamp(there, walls.low, walls.high) - there;
  const glm::dvec2 spring = walls.stiffness_fraction * config_.device_wall_stiffness * back;
  return arc_force(pose, glm::clamp(spring, -config_.actuator.peak_force, config_.actuator.peak_force));
}

// Force of the hand on the lever at x = 0. [N]
double SimulatedLever::lever_drive(const Axis& axis) const noexcept {
  if (!config_.hand.is_elastic()) return axis.hand_drive;
  return attached_.stiffness * axis.hand.position + attached_.damping * axis.hand.velocity;
}

// Moves the axis for `time` [s].
void SimulatedLever::move(Axis& axis, double time) const noexcept {
  if (!config_.hand.is_elastic()) {
    if (time == axis.turn) return move_lever(axis, axis.hand_drive + axis.actuator_force, axis.stepper, time);
    return move_lever(axis, axis.hand_drive + axis.actuator_force, AxisStepper(axis.model, time), time);
  }
  const double turns = std::ceil(time / axis.turn * (1.0 - 1e-9)), turn = time / turns;
  const bool is_nominal = time == period_;
  const AxisStepper lever = is_nominal ? axis.stepper : AxisStepper(axis.model, turn);
  const AxisStepper hand = is_nominal ? axis.hand_stepper : AxisStepper(axis.hand_model, 0.5 * turn);
  const auto move_hand = [&] {
    axis.hand = hand.step(axis.hand, axis.hand_drive + attached_.stiffness * axis.state.position +
                                         attached_.damping * axis.state.velocity);
  };
  for (double n = 0.0; n < turns; n += 1.0) {
    move_hand();
    move_lever(axis, lever_drive(axis) + axis.actuator_force, lever, turn);
    move_hand();
  }
}

// Away from the stops and without dry friction, one step of the linear model is the exact solution.
void SimulatedLever::move_lever(Axis& axis, double force, const AxisStepper& stepper, double time) const noexcept {
  if (axis.limits.coulomb_friction == 0.0) {
    const AxisState next = stepper.step(axis.state, force);
    const double speed = std::max(std::abs(axis.state.velocity), std::abs(next.velocity));
    const double farthest = std::max(std::abs(axis.state.position), std::abs(next.position)) + speed * time;
    if (farthest < axis.limits.stop) {
      axis.state = next;
      return;
    }
  }
  axis.state = advance_limited(axis.model, axis.limits, axis.state, force, time);
}

void SimulatedLever::update_pose() noexcept {
  x_.encoder.read(x_.state.position / config_.yoke.radius);
  y_.encoder.read(-y_.state.position / config_.yoke.radius);
  pose_ = plane_pose(x_.encoder.true_tangent(), y_.encoder.true_tangent());
}

void SimulatedLever::sample() noexcept {
  const double a = x_.encoder.read_tangent(), b = y_.encoder.read_tangent();
  if (a != read_pose_.a || b != read_pose_.b || reading_.sequence == 0) {
    read_pose_ = plane_pose(a, b);
    reading_.position = plane_position(read_pose_, config_.yoke.radius);
  }
  const glm::dvec2 measured{measure(hand_force(x_)), measure(hand_force(y_))};
  ++reading_.sequence;
  reading_.time_ns = last_ns_ + drift_ns_;
  reading_.hand_force = plane_force(pose_, measured);
  reading_.pressed_down = target_.pressed_down;
  reading_.lifted = target_.lifted;
}

// Force of the hand on the lever: f_h = m a + b v + k x - f, with the handle's mass m, damping b and stiffness k and
// the actuator force f. The part of the hand that moves with it has m_h, b_h and k_h, and `drive` is lever_drive(). The
// axis moves by (m + m_h) a = drive + f - (b + b_h) v - (k + k_h) x, so f_h = drive - k_h x - b_h v - m_h a. The second
// form also holds at a stop and under dry friction.
double SimulatedLever::hand_force(const Axis& axis) const noexcept {
  const double drive = lever_drive(axis);
  const double massless = drive - attached_.stiffness * axis.state.position - attached_.damping * axis.state.velocity;
  if (attached_.mass == 0.0) return massless;
  const double force = drive + axis.actuator_force;
  const double inertial = inertial_force(axis.model, axis.limits, axis.state, force);
  return massless - attached_.mass / axis.model.mass * inertial;
}

double SimulatedLever::measure(double force) noexcept {
  const ForceSensorModel& sensor = config_.force_sensor;
  const double noise = sensor.noise_gw > 0.0 ? sensor.noise_gw * noise_.next() : 0.0;
  return force_from_reading(sensor, sensor_reading(sensor, force, noise));
}

void SimulatedLever::write(glm::dvec2 force) noexcept {
  written_.force = force;
}

void SimulatedLever::set_device_walls(const LeverWalls& walls) noexcept {
  const bool is_valid = is_finite(walls.low) && is_finite(walls.high) && std::isfinite(walls.stiffness_fraction);
  written_.walls = is_valid ? walls : LeverWalls{};
}

void SimulatedLever::release() noexcept {
  written_ = {};
  queue_.fill({});
}

glm::dvec2 SimulatedLever::true_position() const noexcept {
  return plane_position(pose_, config_.yoke.radius);
}

glm::dvec2 SimulatedLever::true_velocity() const noexcept {
  return plane_velocity(pose_, {x_.state.velocity, y_.state.velocity});
}

void SimulatedLever::place(glm::dvec2 position, glm::dvec2 velocity) noexcept {
  if (!is_finite(position) || !is_finite(velocity)) return;
  const PlanePose pose = reachable_pose(position);
  const glm::dvec2 arc = arc_position(config_.yoke, {std::atan(pose.a), std::atan(pose.b)});
  const glm::dvec2 speed = arc_velocity(pose, velocity);
  x_.state = x_.hand = {arc.x, speed.x};
  y_.state = y_.hand = {arc.y, speed.y};
  x_.hand_drive = config_.hand.stiffness * arc.x;  // the hand's target rests at the new lever position
  y_.hand_drive = config_.hand.stiffness * arc.y;
  update_pose();
}

}  // namespace gearshift::haptics
