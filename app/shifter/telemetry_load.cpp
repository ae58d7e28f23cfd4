#include "app/shifter/telemetry_load.h"

#include <algorithm>
#include <cmath>

#include "app/vehicle/driveline.h"
#include "haptics/gate/feel_curve.h"

namespace gearshift::shifter {
namespace {

constexpr double kMinMeasuredSpeed = 3.0;  // [m/s] at lower speeds a rounded speed falsifies the ratio
constexpr double kMeasureTime = 0.5;       // [s] time constant with which a ratio is measured
constexpr double kMaxRatioError = 3.0;     // [1] a ratio further off than this factor is that of a slipping wheel

bool is_clutch_open(const vehicle::CarSpec& car, const Telemetry& now) noexcept {
  return vehicle::clutch_capacity(car.clutch, now.car.clutch) <= 0.0;
}

}  // namespace

TelemetryLoad::TelemetryLoad(const vehicle::CarSpec& car, const haptics::Gate& gate, double force_limit,
                             haptics::LatestValue<Telemetry>& telemetry)
    : car_(car),
      gate_(gate),
      telemetry_(telemetry),
      force_scale_(std::min(1.0, force_limit / vehicle::kMaxHandForce)),
      synchroniser_(car.synchro, gate, force_scale_, haptics::kNeutralGear, 1) {
  const double tallest = vehicle::shaft_per_road(car, 1);
  for (int i = 0; i < gate.slot_count; ++i) {
    const int gear = haptics::slot_of(gate, i).gear;
    const double per_road = vehicle::shaft_per_road(car, gear);
    // A gear that the car file does not have: each gear turns the engine at 0.8 of the speed in the one below.
    per_road_[index_of(i)] = per_road != 0.0 ? per_road : tallest * std::pow(0.8, std::max(0, gear - 1));
  }
}

double TelemetryLoad::ratio(int slot) const noexcept {
  return std::abs(per_road_[index_of(slot)]) * car_.body.wheel_radius / car_.gearbox.final_drive;
}

// OutGauge's speed has no sign, so the sign of the ratio in reverse does not matter while reversing.
void TelemetryLoad::follow_shaft(const Telemetry& now, double period) noexcept {
  if (meshed_slot_ != haptics::kNoSlot) {
    shaft_speed_ = std::abs(per_road_[index_of(meshed_slot_)]) * now.car.speed;
  } else if (!is_clutch_open(car_, now)) {
    shaft_speed_ = now.car.engine_speed;
  } else {
    const double drag = car_.gearbox.drag + car_.gearbox.drag_slope * std::abs(shaft_speed_);
    const double step = period / car_.clutch.disc_inertia;
    const auto pull = [&](double towards, double torque) {
      shaft_speed_ += std::clamp(towards - shaft_speed_, -torque * step, torque * step);
    };
    pull(0.0, drag);
    if (cone_slot_ != haptics::kNoSlot)
      pull(per_road_[index_of(cone_slot_)] * now.car.speed, sleeve_.cone_torque / ratio(cone_slot_));
  }
}

void TelemetryLoad::measure_ratio(const Telemetry& now, double period) noexcept {
  if (meshed_slot_ == haptics::kNoSlot || is_clutch_open(car_, now) || now.car.speed < kMinMeasuredSpeed) return;
  if (now.car.gear != haptics::slot_of(gate_, meshed_slot_).gear || now.car.clutch > car_.clutch.closed) return;
  double& known = per_road_[index_of(meshed_slot_)];
  const double measured = std::copysign(now.car.engine_speed / now.car.speed, known);
  const double error = measured / known;
  if (error > kMaxRatioError || error < 1.0 / kMaxRatioError) return;
  known += (measured - known) * -std::expm1(-period / kMeasureTime);
}

vehicle::SleeveInput TelemetryLoad::sleeve_input(const haptics::LeverInput& in, const Telemetry& now) const noexcept {
  vehicle::SleeveInput lever;
  lever.slot = in.slot;
  lever.clutch_open = is_clutch_open(car_, now);
  if (in.slot == haptics::kNoSlot) return lever;
  const haptics::Slot& slot = haptics::slot_of(gate_, in.slot);
  const double into = static_cast<int>(slot.side);
  lever.depth = in.depth;
  lever.push = std::isfinite(in.push.y) ? into * in.push.y : 0.0;
  lever.feel = haptics::feel_force(slot.feel, in.depth);
  lever.difference = (shaft_speed_ - per_road_[index_of(in.slot)] * now.car.speed) / ratio(in.slot);
  if (in.slot == meshed_slot_ && !lever.clutch_open) {
    const double speed = now.car.engine_speed, full = vehicle::full_torque(car_.engine, speed);
    const double drag = vehicle::friction_torque(car_.engine, speed);
    lever.load = ratio(in.slot) * (now.car.throttle * (full + drag) - drag);
  }
  return lever;
}

haptics::LeverOutput TelemetryLoad::step(const haptics::LeverInput& in, double period) noexcept {
  telemetry_.update();
  const Telemetry& now = telemetry_.value();
  haptics::LeverOutput out;
  const bool begins = now.is_live && !was_live_;
  was_live_ = now.is_live;
  if (!now.is_live) return out;
  out.road_speed = now.car.speed;
  if (haptics::is_mechanism(gate_) || haptics::is_sequential(gate_)) return out;
  if (begins) {  // the gear that the lever is in is in
    synchroniser_ = vehicle::Synchroniser(car_.synchro, gate_, force_scale_, in.gear, 1);
    meshed_slot_ = haptics::slot_of_gear(gate_, in.gear);
    cone_slot_ = haptics::kNoSlot;
    shaft_speed_ = now.car.engine_speed;
  }
  follow_shaft(now, period);
  measure_ratio(now, period);
  sleeve_ = synchroniser_.step(sleeve_input(in, now), period);
  meshed_slot_ = haptics::slot_of_gear(gate_, sleeve_.meshed);
  cone_slot_ = haptics::slot_of_gear(gate_, sleeve_.cone_gear);
  if (in.slot == haptics::kNoSlot) return out;
  const double into = static_cast<int>(haptics::slot_of(gate_, in.slot).side);
  out.force.y = into * sleeve_.force;
  out.vibration.y = into * sleeve_.rattle;
  out.limited_slot = in.slot;
  out.depth_min = sleeve_.depth_min;
  out.depth_max = sleeve_.depth_max;
  return out;
}

}  // namespace gearshift::shifter
