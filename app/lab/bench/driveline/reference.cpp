#include "app/lab/bench/driveline/reference.h"

#include <algorithm>
#include <cmath>

namespace gearshift::lab {
namespace {

constexpr double kReferenceStep = 1e-5, kLocate = 1e-13;  // [s]
constexpr double kFiringAngle = 12.57;                    // [rad] two turns
constexpr double kLiftTime = 0.2;                         // [s] time constant of the idle control's set speed

int side(double x) {
  return x > 0.0 ? 1 : x < 0.0 ? -1 : 0;
}

// State of the simulation: speeds, and heat of clutch and synchroniser cone.
struct Y {
  double engine = 0.0, shaft = 0.0, road = 0.0, clutch_heat = 0.0, cone_heat = 0.0;
  double governor = 0.0, lift = 0.0;  // [1], [rad/s] the idle control's integral part and set speed above idle
  double turned = 0.0;                // [rad] by an engine that does not fire
  double temperature = 0.0;           // [C] of the clutch
};
Y sum(const Y& y, double h, const Y& d) {
  return {y.engine + h * d.engine,
          y.shaft + h * d.shaft,
          y.road + h * d.road,
          y.clutch_heat + h * d.clutch_heat,
          y.cone_heat + h * d.cone_heat,
          y.governor + h * d.governor,
          y.lift + h * d.lift,
          y.turned + h * d.turned,
          y.temperature + h * d.temperature};
}

class Reference {
 public:
  explicit Reference(const Drive& drive) : drive_(drive), car_(drive.car) {
    y_ = {drive.engine, drive.shaft, drive.road};
    y_.temperature = drive.temperature;
    running_ = drive.running;
    engine_ = side(y_.engine), engine_rests_ = engine_ == 0;
    const vehicle::DrivelineInput in = drive.input(0.0);
    dogs_ = in.meshed != 0;
    G_ = vehicle::shaft_per_road(car_, dogs_ ? in.meshed : in.cone_gear);
    cone_ratio_ = std::abs(G_) * car_.body.wheel_radius / car_.gearbox.final_drive;
    geared_ = dogs_;
    clutch_ = side(y_.engine - y_.shaft), cone_ = side(y_.shaft - G_ * y_.road);
    road_ = side(y_.road), shaft_ = side(y_.shaft);
    locked_ = clutch_ == 0;
    car_rests_ = road_ == 0;
  }

  DriveOutcome run() {
    DriveOutcome out;
    out.samples.push_back({y_.engine, y_.shaft, y_.road});
    const int steps = static_cast<int>(std::lround(drive_.duration / kReferenceStep));
    for (int i = 0; i < steps; ++i) {
      advance(i * kReferenceStep, (i + 1) * kReferenceStep);
      out.engine_peak = std::max(out.engine_peak, y_.engine);
      if ((i + 1) % 100 == 0) out.samples.push_back({y_.engine, y_.shaft, y_.road});
    }
    out.slip_energy = y_.clutch_heat;
    out.cone_energy = y_.cone_heat;
    out.temperature = y_.temperature;
    out.running = running_;
    return out;
  }

 private:
  struct Forces {
    double spark, friction, capacity, cone, shaft, air, hold;  // hold: rolling resistance and brakes
    double fires_at;                                           // [rad/s] engine speed
  };

  Forces forces(const Y& y, double t) const {
    const vehicle::DrivelineInput in = drive_.input(t);
    Forces f;
    f.friction = vehicle::friction_torque(car_.engine, y.engine);
    const vehicle::EngineSpec& e = car_.engine;
    const double full_load = vehicle::full_torque(e, std::max(y.engine, e.full_load[0].speed)) + f.friction;
    const double th0 =
        vehicle::friction_torque(e, e.idle) / (vehicle::full_torque(e, e.idle) + vehicle::friction_torque(e, e.idle));
    const double idling =
        std::clamp(th0 + e.idle_gain * (e.idle + y.lift - y.engine) + std::clamp(y.governor, 0.0, 1.0), 0.0, 1.0);
    const double opening = 1.0 - (1.0 - in.pedals.throttle) * (1.0 - idling);
    f.spark = running_ && !cut_ ? opening * full_load : 0.0;
    if (in.starter && y.engine < e.starter_speed)
      f.spark += e.starter_torque * std::min(1.0, 1.0 - y.engine / e.starter_speed);
    const vehicle::ClutchSpec& clutch = car_.clutch;
    const double left = (500.0 - y.temperature) / 200.0;
    f.capacity = vehicle::clutch_capacity(clutch, in.pedals.clutch) * std::clamp(left, 0.0, 1.0);
    f.fires_at = in.starter ? std::min(e.stall, 0.5 * e.starter_speed) : e.stall;
    f.cone = dogs_ || G_ == 0.0 ? 0.0 : in.cone_torque / cone_ratio_;
    f.shaft = -car_.gearbox.drag_slope * y.shaft;
    f.air = -car_.body.resistance_slope * y.road - car_.body.resistance_square * y.road * std::abs(y.road) -
            car_.body.mass * kDriveGravity * std::sin(in.slope);
    f.hold = car_.body.resistance + car_.body.brake_force * in.pedals.brake +
             car_.body.hand_brake_force * in.pedals.hand_brake;
    return f;
  }

  // Acceleration of the car [m/s^2]. `force` acts on the car, `torque` on the shaft, and `inertia` rotates with the
  // shaft. The gear teeth dissipate a fraction of the power that they transmit, in either direction.
  double through_teeth(double force, double torque, double inertia) const {
    const double m = car_.body.mass + car_.body.rotating;
    const auto solved = [&](double passed) {
      return (force + passed * G_ * torque) / (m + passed * G_ * G_ * inertia);
    };
    const double driven = solved(teeth_efficiency());
    const bool drives = (torque - inertia * G_ * driven) * G_ * road_ >= 0.0;
    return drives ? driven : solved(1.0 / teeth_efficiency());
  }
  double teeth_efficiency() const { return dogs_ ? car_.gearbox.efficiency : 1.0; }

  // Time derivative of the state. Also stores the torques of clutch and gear in carried_clutch_ and carried_gear_.
  Y slope(const Y& y, double t) {
    const Forces f = forces(y, t);
    const double je = car_.engine.inertia, js = car_.clutch.disc_inertia, m = car_.body.mass + car_.body.rotating;
    const double drag = car_.gearbox.drag;
    const double te = f.spark - f.friction * engine_;
    const double ts = f.shaft - drag * shaft_;
    const double fr = f.air - f.hold * road_;
    double tc = clutch_ * f.capacity, tk = cone_ * f.cone;
    Y d;
    if (car_rests_ && geared_) {
      d.engine = engine_rests_ || locked_ ? 0.0 : (te - tc) / je;
      tk = tc;
    } else if (!locked_ && !geared_) {
      d.engine = engine_rests_ ? 0.0 : (te - tc) / je;
      d.shaft = shaft_rests_ ? 0.0 : (ts + tc - tk) / js;
      d.road = car_rests_ ? 0.0 : (fr + G_ * tk) / m;
    } else if (!locked_) {
      d.engine = engine_rests_ ? 0.0 : (te - tc) / je;
      d.road = through_teeth(fr, ts + tc, js);
      d.shaft = G_ * d.road;
      tk = ts + tc - js * d.shaft;
    } else if (!geared_) {
      d.engine = d.shaft = (te + ts - tk) / (je + js);
      d.road = car_rests_ ? 0.0 : (fr + G_ * tk) / m;
      tc = te - je * d.engine;
    } else {
      d.road = through_teeth(fr, ts + te, js + je);
      d.engine = d.shaft = G_ * d.road;
      tc = te - je * d.engine;
      tk = ts + tc - js * d.shaft;
    }
    if (running_) {
      const vehicle::EngineSpec& e = car_.engine;
      const double error = e.idle + y.lift - y.engine;
      const bool is_full = error > 0.0 ? y.governor >= 1.0 : y.governor <= 0.0;
      d.governor = is_full ? 0.0 : e.idle_integral_gain * error;
      const double loaded = locked_ || clutch_ < 0 ? 0.0 : f.capacity / vehicle::friction_torque(e, e.idle);
      d.lift = (std::min(1.0, loaded) * e.idle_lift - y.lift) / kLiftTime;
    }
    d.clutch_heat = locked_ ? 0.0 : tc * (y.engine - y.shaft);
    if (!running_) d.turned = std::max(0.0, y.engine);
    const vehicle::ClutchSpec& clutch = car_.clutch;
    d.temperature =
        (d.clutch_heat - clutch.cooling * (y.temperature - vehicle::kAirTemperature)) / clutch.heat_capacity;
    d.cone_heat = dogs_ || geared_ ? 0.0 : tk * (y.shaft - G_ * y.road);
    carried_clutch_ = tc, carried_gear_ = tk;
    return d;
  }

  Y integrated(double t, double h) {
    const Y a = slope(y_, t), b = slope(sum(y_, 0.5 * h, a), t + 0.5 * h), c = slope(sum(y_, 0.5 * h, b), t + 0.5 * h);
    const Y d = slope(sum(y_, h, c), t + h);
    Y y = sum(sum(sum(sum(y_, h / 6.0, a), h / 3.0, b), h / 3.0, c), h / 6.0, d);
    if (geared_) y.shaft = G_ * y.road;
    if (locked_) y.engine = y.shaft;
    return y;
  }

  enum class Event {
    none,
    clutch_locks,
    clutch_slips,
    cone_locks,
    cone_slips,
    car_stops,
    car_starts,
    shaft_stops,
    shaft_starts,
    engine_stops,
    engine_starts,
    stalls,
    fires,
    limiter_cuts,
    limiter_releases
  };

  Event event_at(const Y& y, double t) {
    const Forces f = forces(y, t);
    slope(y, t);
    const double tc = carried_clutch_, tk = carried_gear_;
    if (running_ && y.engine < f.fires_at) return Event::stalls;
    if (!running_ && y.turned >= kFiringAngle && y.engine >= f.fires_at) return Event::fires;
    if (running_ && !cut_ && y.engine > car_.engine.limiter) return Event::limiter_cuts;
    if (cut_ && y.engine < car_.engine.limiter - car_.engine.limiter_band) return Event::limiter_releases;
    if (!engine_rests_ && !locked_ && engine_ * y.engine < 0.0) return Event::engine_stops;
    if (engine_rests_ && !locked_ && std::abs(f.spark - tc) > f.friction) return Event::engine_starts;
    if (!locked_ && f.capacity > 0.0 && clutch_ * (y.engine - y.shaft) < 0.0) return Event::clutch_locks;
    if (locked_ && !car_rests_ && std::abs(tc) > f.capacity) return Event::clutch_slips;
    if (!geared_ && f.cone > 0.0 && cone_ * (y.shaft - G_ * y.road) < 0.0) return Event::cone_locks;
    if (geared_ && !dogs_ && std::abs(tk) > f.cone) return Event::cone_slips;
    if (!car_rests_ && road_ * y.road < 0.0) return Event::car_stops;
    if (car_rests_ && !locked_ && std::abs(pull(f)) > grip(f)) return Event::car_starts;
    if (!geared_ && !shaft_rests_ && !locked_ && shaft_ * y.shaft < 0.0) return Event::shaft_stops;
    if (shaft_rests_ && std::abs(tc - tk) > car_.gearbox.drag) return Event::shaft_starts;
    return Event::none;
  }

  // Force that tries to move the stationary car. [N]
  double pull(const Forces& f) const {
    return f.air + G_ * (geared_ ? teeth_efficiency() * clutch_ * f.capacity : cone_ * f.cone);
  }
  // Largest force that can hold the stationary car. [N]
  double grip(const Forces& f) const {
    return f.hold + (geared_ ? teeth_efficiency() * std::abs(G_) * car_.gearbox.drag : 0.0);
  }

  void apply(Event event, double t) {
    const double je = car_.engine.inertia, js = car_.clutch.disc_inertia, m = car_.body.mass + car_.body.rotating;
    if (event == Event::stalls) running_ = false, y_.turned = 0.0;
    if (event == Event::fires) running_ = true, y_.governor = y_.lift = 0.0;
    if (event == Event::limiter_cuts) cut_ = true;
    if (event == Event::limiter_releases) cut_ = false;
    if (event == Event::engine_stops)
      y_.engine = y_.turned = 0.0, engine_ = 0, engine_rests_ = true, clutch_ = side(-y_.shaft);
    if (event == Event::engine_starts) engine_rests_ = false, engine_ = side(forces(y_, t).spark - carried_clutch_);
    if (event == Event::clutch_locks) {
      const double jr = geared_ ? js + m / (G_ * G_) : js;
      y_.engine = y_.shaft = (je * y_.engine + jr * y_.shaft) / (je + jr);
      if (geared_) y_.road = y_.shaft / G_;
      locked_ = true;
      engine_ = side(y_.engine);
      slope(y_, t);
      if (std::abs(carried_clutch_) > forces(y_, t).capacity) locked_ = false, clutch_ = -clutch_;
    }
    if (event == Event::clutch_slips) clutch_ = side(carried_clutch_), locked_ = false;
    if (event == Event::cone_locks) {
      const double jl = locked_ ? js + je : js;
      y_.road = (jl * G_ * y_.shaft + m * y_.road) / (jl * G_ * G_ + m);
      y_.shaft = G_ * y_.road;
      if (locked_) y_.engine = y_.shaft;
      geared_ = true;
      slope(y_, t);
      if (std::abs(carried_gear_) > forces(y_, t).cone) geared_ = false, cone_ = -cone_;
    }
    if (event == Event::cone_slips) cone_ = side(carried_gear_), geared_ = false;
    if (event == Event::car_stops) {
      y_.road = 0.0;
      if (geared_) y_.shaft = 0.0;
      if (locked_ && geared_) y_.engine = 0.0;
      const Forces f = forces(y_, t);
      car_rests_ = std::abs(locked_ ? f.air : pull(f)) <= grip(f);
      road_ = car_rests_ ? 0 : side(pull(f));
      if (geared_) shaft_ = side(G_) * road_;
    }
    if (event == Event::car_starts) {
      car_rests_ = false;
      road_ = side(pull(forces(y_, t)));
      if (geared_) shaft_ = side(G_) * road_;
    }
    if (event == Event::shaft_stops) y_.shaft = 0.0, shaft_rests_ = true, shaft_ = 0;
    if (event == Event::shaft_starts) shaft_rests_ = false, shaft_ = side(carried_clutch_ - carried_gear_);
  }

  void advance(double t, double end) {
    while (t < end) {
      double h = end - t;
      Y next = integrated(t, h);
      Event event = event_at(next, end);
      if (event != Event::none) {
        double low = 0.0;
        while (h - low > kLocate) {
          const double middle = 0.5 * (low + h);
          const Y y = integrated(t, middle);
          const Event w = event_at(y, t + middle);
          if (w == Event::none) {
            low = middle;
          } else {
            h = middle, next = y, event = w;
          }
        }
      }
      y_ = next;
      t = event == Event::none ? end : t + h;
      apply(event, t);
    }
  }

  const Drive& drive_;
  const vehicle::CarSpec& car_;
  Y y_;
  double G_ = 0.0, cone_ratio_ = 1.0;
  bool dogs_ = false;                     // the dog teeth of the gear are engaged
  bool locked_ = false, geared_ = false;  // locked_: the clutch does not slip; geared_: shaft and gear turn together
  bool car_rests_ = false, shaft_rests_ = false, engine_rests_ = false;
  int clutch_ = 0, cone_ = 0, road_ = 0, shaft_ = 0, engine_ = 0;  // directions
  bool running_ = true, cut_ = false;
  double carried_clutch_ = 0.0, carried_gear_ = 0.0;
};

}  // namespace

DriveOutcome reference_of(const Drive& drive) {
  return Reference(drive).run();
}

}  // namespace gearshift::lab
