#include "app/lab/bench/driveline/methods.h"

#include <algorithm>
#include <cmath>

#include "app/vehicle/engine_control.h"
#include "app/vehicle/friction_chain.h"

namespace gearshift::lab {
namespace {

// Common part of the methods `impulses` and `tanh`. Uses the pedals at the middle of the step.
class PlainStepper {
 public:
  explicit PlainStepper(const Drive& drive) : drive_(drive), car_(drive.car), engine_(drive.car.engine) {
    speed_ = {drive.engine, drive.shaft, drive.road};
    chain_.inertia = {car_.engine.inertia, car_.clutch.disc_inertia, car_.body.mass + car_.body.rotating};
    const vehicle::DrivelineInput in = drive.input(0.0);
    const int gear = in.meshed != 0 ? in.meshed : in.cone_gear;
    chain_.per_road = vehicle::shaft_per_road(car_, gear);
    if (gear != 0) chain_.link = in.meshed != 0 ? vehicle::GearLink::dogs : vehicle::GearLink::cone;
    ratio_ = std::abs(chain_.per_road) * car_.body.wheel_radius / car_.gearbox.final_drive;
  }

  void impulses(double time, double h) {
    vehicle::ChainLoads loads = loads_at(time + 0.5 * h);
    for (std::size_t b = 0; b < 3; ++b) loads.push[b] += chain_.inertia[b] * speed_[b] / h;
    const vehicle::Solution s = vehicle::solve_modes(chain_, loads, {}, mode_);
    mode_ = s.mode;
    vehicle::PerBody to;
    for (std::size_t b = 0; b < 3; ++b) to[b] = h * s.motion.rate[b];
    finish_step(to, s.motion.clutch, s.motion.gear, h);
  }

  void tanh(double time, double h) {
    constexpr double kSoft = 10.0, kSoftRoad = 0.3;  // [rad/s], [m/s] (about 10 rad/s at the wheel)
    const vehicle::ChainLoads loads = loads_at(time + 0.5 * h);
    const double clutch = loads.clutch * std::tanh((speed_[0] - speed_[1]) / kSoft);
    const double cone = loads.cone * std::tanh(vehicle::cone_slip(chain_, speed_) / kSoft);
    vehicle::PerBody force;
    for (std::size_t b = 0; b < 3; ++b)
      force[b] = loads.push[b] - loads.ground[b] * std::tanh(speed_[b] / (b == 2 ? kSoftRoad : kSoft));
    force[0] -= clutch;
    force[1] += clutch - cone;
    force[2] += chain_.per_road * cone;
    vehicle::PerBody to = speed_;
    if (chain_.link == vehicle::GearLink::dogs) {
      const double ratio = chain_.per_road;
      to[2] += h * (force[2] + ratio * force[1]) / (chain_.inertia[2] + ratio * ratio * chain_.inertia[1]);
      to[1] = ratio * to[2];
    } else {
      to[1] += h * force[1] / chain_.inertia[1];
      to[2] += h * force[2] / chain_.inertia[2];
    }
    to[0] += h * force[0] / chain_.inertia[0];
    finish_step(to, clutch, cone, h);
  }

  ReferenceSample sample() const { return {speed_[0], speed_[1], speed_[2]}; }
  bool running() const { return engine_.running(); }
  double clutch_heat = 0.0, cone_heat = 0.0;

 private:
  vehicle::ChainLoads loads_at(double time) {
    const vehicle::DrivelineInput in = drive_.input(time);
    const vehicle::BodySpec& body = car_.body;
    vehicle::ChainLoads loads;
    loads.push = {engine_.torque(speed_[0], in.pedals.throttle), -car_.gearbox.drag_slope * speed_[1],
                  -(body.resistance_slope + body.resistance_square * std::abs(speed_[2])) * speed_[2] -
                      body.mass * kDriveGravity * std::sin(in.slope)};
    loads.ground = {
        vehicle::friction_torque(car_.engine, speed_[0]), car_.gearbox.drag,
        body.resistance + body.brake_force * in.pedals.brake + body.hand_brake_force * in.pedals.hand_brake};
    loads.clutch = vehicle::clutch_capacity(car_.clutch, in.pedals.clutch);
    loads.cone = chain_.link == vehicle::GearLink::cone ? in.cone_torque / ratio_ : 0.0;
    return loads;
  }

  void finish_step(const vehicle::PerBody& to, double clutch, double gear, double h) {
    vehicle::PerBody travel;
    for (std::size_t b = 0; b < 3; ++b) travel[b] = 0.5 * h * (speed_[b] + to[b]);
    clutch_heat += clutch * (travel[0] - travel[1]);
    cone_heat += gear * vehicle::cone_slip(chain_, travel);
    const vehicle::EngineState rate = engine_.state_rate(speed_[0], std::max(0.0, clutch), engine_.state());
    const vehicle::EngineState& now = engine_.state();
    engine_.set_state({now.integral + h * rate.integral, now.lift + h * rate.lift, now.cranked + h * rate.cranked});
    speed_ = to;
    engine_.update(speed_[0]);
  }

  const Drive& drive_;
  const vehicle::CarSpec& car_;
  vehicle::EngineControl engine_;
  vehicle::FrictionChain chain_;
  double ratio_ = 1.0;
  vehicle::PerBody speed_{};
  vehicle::FrictionMode mode_;
};

void add_sample(DriveOutcome& out, const ReferenceSample& sample) {
  out.samples.push_back(sample);
  out.engine_peak = std::max(out.engine_peak, sample.engine);
}

DriveOutcome by_events(const Drive& drive, double step, int steps) {
  DriveOutcome out;
  vehicle::Driveline line(drive.car);
  line.place(drive.engine, drive.shaft, drive.road, drive.running, false, {}, drive.temperature);
  line.step(drive.input(0.0), 0.0);
  add_sample(out, {drive.engine, drive.shaft, drive.road});
  for (int i = 1; i <= steps; ++i) {
    line.step(drive.input(i * step), step);
    add_sample(out, {line.state().engine_speed, line.state().shaft_speed, line.state().road_speed});
  }
  out.slip_energy = line.energy().clutch;
  out.cone_energy = line.energy().cone;
  out.temperature = line.state().clutch_temperature;
  out.running = line.state().running;
  return out;
}

}  // namespace

const char* to_string(DriveMethod method) {
  return method == DriveMethod::events ? "event midpoint" : method == DriveMethod::impulses ? "impulse clamp" : "tanh";
}

DriveOutcome drive_by(DriveMethod method, const Drive& drive, double step) {
  const int steps = static_cast<int>(std::lround(drive.duration / step));
  if (method == DriveMethod::events) return by_events(drive, step, steps);
  DriveOutcome out;
  PlainStepper plain(drive);
  add_sample(out, plain.sample());
  for (int i = 0; i < steps; ++i) {
    method == DriveMethod::impulses ? plain.impulses(i * step, step) : plain.tanh(i * step, step);
    add_sample(out, plain.sample());
  }
  out.slip_energy = plain.clutch_heat;
  out.cone_energy = plain.cone_heat;
  out.running = plain.running();
  return out;
}

}  // namespace gearshift::lab
