#include "tests/app/vehicle/cone_lever_reference.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "haptics/joystick/plant.h"

namespace gearshift::test {
namespace {

constexpr double kLocate = 1e-13;  // [s]

// Indices into the state: the lever's position and speed along its arc, its filtered speed (smooth), the speeds of the
// shaft and the car (road), and the cone's heat. `states` is their number.
enum { arc, speed, smooth, shaft, road, heat, states };
using Y = std::array<double, states>;

Y sum(Y y, double h, const Y& d) {
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += h * d[i];
  return y;
}

int side(double x) {
  return x > 0.0 ? 1 : x < 0.0 ? -1 : 0;
}

// A smooth step: rises from 0 at u = 0 to 1 at u = 1, with zero slope at both ends.
double rise(double u) {
  return u <= 0.0 ? 0.0 : u >= 1.0 ? 1.0 : 3.0 * u * u - 2.0 * u * u * u;
}

class Reference {
 public:
  Reference(const ConeLeverCase& reference_case, const ConeLeverStart& start)
      : case_(reference_case), car_(reference_case.car), slot_(reference_case.slot) {
    per_road_ = vehicle::shaft_per_road(car_, case_.gear);
    ratio_ = std::abs(per_road_) * car_.body.wheel_radius / car_.gearbox.final_drive;
    const vehicle::SynchroSpec& s = car_.synchro;
    const double sleeve_per_push = s.lever_ratio * s.efficiency / case_.force_scale;
    torque_per_push_ = s.cones * s.friction * s.radius / std::sin(s.cone_angle) * sleeve_per_push / ratio_;
    inertia_ = car_.clutch.disc_inertia + (case_.clutch_closed ? car_.engine.inertia : 0.0);
    const double at = case_.lever.arc(start.depth);
    y_ = {at, start.speed / case_.lever.slope(at), start.speed, start.shaft, start.road, 0.0};
    touches_ = depth(y_) > slot_.block;
    turn_ = side(y_[shaft]);
  }

  ConeLeverOutcome run() {
    ConeLeverOutcome out;
    const int steps = static_cast<int>(std::lround(case_.max_time / case_.step));
    const int each = static_cast<int>(std::lround(0.001 / case_.step));
    for (int i = 0; i < steps && out.open < 0.0; ++i) {
      if (i % each == 0) out.samples.push_back({depth(y_), push(y_, i * case_.step), y_[shaft], y_[road], y_[heat]});
      advance(i * case_.step, (i + 1) * case_.step, out);
    }
    out.heat = y_[heat];
    return out;
  }

 private:
  // [N] The gate's force at depth `at`: a bump at the mouth, a dip, the detent's crest, then the pull into the gear.
  double feel(double at) const {
    const RingSlot& s = slot_;
    const auto between = [at](double a, double from, double b, double to) {
      return from + (to - from) * rise((at - a) / (b - a));
    };
    const double dip = -std::min({s.aisle, s.resist, s.detent});
    if (at < s.mouth) return -s.aisle;
    if (at < s.bump) return between(s.mouth, -s.aisle, s.bump, -s.resist);
    if (at < s.low) return between(s.bump, -s.resist, s.low, dip);
    if (at < s.crest) return between(s.low, dip, s.crest, -s.detent);
    return between(s.crest, -s.detent, s.lock, s.pull);
  }

  double depth(const Y& y) const { return case_.lever.depth(y[arc]); }
  double slope_at(const Y& y) const { return case_.lever.slope(y[arc]); }

  // [N] The motor's force in the plane of the gate.
  double motor(const Y& y) const {
    const RingSlot& s = slot_;
    const double at = depth(y), pressed = s.wall_stiffness * (at - s.block) + s.wall_damping * slope_at(y) * y[speed];
    const double wall = touches_ ? std::max(0.0, pressed) : 0.0;
    const double fast = std::abs(y[smooth]), excess = std::max(0.0, fast - s.speed_limit);
    const double damping = s.aisle_damping + (excess > 0.0 ? s.limit_damping * excess / fast : 0.0);
    const double wanted = feel(std::min(at, s.block)) - wall - damping * y[smooth];
    return std::clamp(wanted, -s.max_motor_force, s.max_motor_force);
  }

  // [N] The hand's force along the arc, without the force that accelerates the hand's own mass.
  double drive(const Y& y, double t) const {
    const SlotHand& hand = case_.hand;
    if (hand.speed == 0.0) return hand.push * slope_at(y) - hand.grip.damping * y[speed];
    const double goal = case_.lever.arc(hand.place(t));
    const double goes = hand.place(t) < hand.to ? hand.speed / case_.lever.slope(goal) : 0.0;
    return hand.grip.stiffness * (goal - y[arc]) + hand.grip.damping * (goes - y[speed]);
  }

  // [m/s^2] The lever's acceleration along the arc.
  double acceleration(const Y& y, double t) const {
    const double passive = haptics::kPaperAxisY.damping * y[speed] + haptics::kPaperAxisY.stiffness * y[arc];
    return (drive(y, t) + slope_at(y) * motor(y) - passive) / (haptics::kPaperAxisY.mass + case_.hand.grip.mass);
  }

  // [N] The hand's force on the knob, in the plane of the gate.
  double push(const Y& y, double t) const {
    return (drive(y, t) - case_.hand.grip.mass * acceleration(y, t)) / slope_at(y);
  }

  double slip(const Y& y) const { return y[shaft] - per_road_ * y[road]; }

  // [N m] The cone's torque at the shaft. Only a fraction of the push presses on the ring. The fraction rises from 0 at
  // the end of the mouth to 1 at the depth where the ring blocks.
  double cone(const Y& y, double t) const {
    const double fraction = rise((depth(y) - slot_.mouth) / (slot_.block - slot_.mouth));
    return torque_per_push_ * std::max(0.0, push(y, t)) * fraction;
  }

  double engine(double w) const {
    if (!case_.clutch_closed) return 0.0;
    const vehicle::EngineSpec& e = car_.engine;
    const double friction = vehicle::friction_torque(e, w), at_idle = vehicle::friction_torque(e, e.idle);
    const double base = at_idle / (vehicle::full_torque(e, e.idle) + at_idle);
    const double opened = std::clamp(base + e.idle_gain * (e.idle - w), 0.0, 1.0);
    return opened * (vehicle::full_torque(e, w) + friction) - friction;
  }

  // [N m] The torque on the shaft without its Coulomb drag.
  double shaft_torque(const Y& y, double t) const {
    return engine(y[shaft]) - side(slip(y)) * cone(y, t) - car_.gearbox.drag_slope * y[shaft];
  }

  Y slope(const Y& y, double t) const {
    const vehicle::BodySpec& body = car_.body;
    const double v = std::abs(y[road]), carried = cone(y, t);
    const double holds = body.resistance + body.resistance_slope * v + body.resistance_square * v * v;
    Y d{};
    d[arc] = y[speed];
    d[speed] = acceleration(y, t);
    d[smooth] = (slope_at(y) * y[speed] - y[smooth]) / slot_.smoothing;
    d[shaft] = turn_ == 0 ? 0.0 : (shaft_torque(y, t) - turn_ * car_.gearbox.drag) / inertia_;
    d[road] = (side(slip(y)) * per_road_ * carried - side(y[road]) * holds) / (body.mass + body.rotating);
    d[heat] = carried * std::abs(slip(y));
    return d;
  }

  Y moved(double t, double h) const {
    const Y a = slope(y_, t), b = slope(sum(y_, 0.5 * h, a), t + 0.5 * h), c = slope(sum(y_, 0.5 * h, b), t + 0.5 * h);
    const Y d = slope(sum(y_, h, c), t + h);
    return sum(sum(sum(sum(y_, h / 6.0, a), h / 3.0, b), h / 3.0, c), h / 6.0, d);
  }

  bool ring_opens(const Y& y) const { return std::abs(slip(y)) <= car_.synchro.dog_speed * ratio_; }
  bool reverses(const Y& y, double t) const {
    if (turn_ == 0) return std::abs(shaft_torque(y, t)) > car_.gearbox.drag;
    return turn_ * y[shaft] < 0.0;
  }
  bool changes(const Y& y, double t) const {
    return (depth(y) > slot_.block) != touches_ || reverses(y, t) || ring_opens(y);
  }

  void advance(double t, double end, ConeLeverOutcome& out) {
    while (t < end && out.open < 0.0) {
      double low = 0.0, high = end - t;
      if (changes(moved(t, high), end)) {
        while (high - low > kLocate) {
          const double middle = 0.5 * (low + high);
          (changes(moved(t, middle), t + middle) ? high : low) = middle;
        }
      }
      y_ = moved(t, high);
      t = low == 0.0 && high == end - t ? end : t + high;
      update_outcome(t, out);
    }
  }

  void update_outcome(double t, ConeLeverOutcome& out) {
    touches_ = depth(y_) > slot_.block;
    if (touches_ && out.touch < 0.0) out.touch = t;
    if (ring_opens(y_)) out.open = t;
    if (!reverses(y_, t)) return;
    const double torque = shaft_torque(y_, t);
    if (turn_ != 0) y_[shaft] = 0.0;
    turn_ = std::abs(torque) > car_.gearbox.drag ? side(torque) : 0;
  }

  const ConeLeverCase& case_;
  const vehicle::CarSpec& car_;
  const RingSlot& slot_;
  double per_road_ = 0.0, ratio_ = 1.0;  // [rad/m] shaft angle per distance driven; [1] shaft speed / gear speed
  double torque_per_push_ = 0.0;         // [m] cone torque at the shaft / push
  double inertia_ = 0.0;                 // [kg m^2]
  Y y_{};
  bool touches_ = false;
  int turn_ = 0;  // sign of the shaft's speed; 0 if the shaft is held by its drag
};

}  // namespace

double LeverArc::depth(double arc_length) const {
  return radius > 0.0 ? width * std::sin(arc_length / radius) : arc_length;
}

double LeverArc::arc(double at) const {
  return radius > 0.0 ? radius * std::asin(at / width) : at;
}

double LeverArc::slope(double arc_length) const {
  return radius > 0.0 ? width / radius * std::cos(arc_length / radius) : 1.0;
}

double SlotHand::place(double time) const {
  return std::min(from + speed * time, to);
}

ConeLeverOutcome cone_lever_reference(const ConeLeverCase& reference_case, const ConeLeverStart& start) {
  return Reference(reference_case, start).run();
}

}  // namespace gearshift::test
