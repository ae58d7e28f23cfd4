#include "app/training/clutch_release.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/training/fault_rules.h"

namespace gearshift {
namespace {

constexpr double kLongest = 5.0;  // [s] after which a clutch that slips on is no longer one release [engineering value]
constexpr double kBrakeJerks = 0.05;  // [1] pedal: then it is the brake that jerks
constexpr double kLaunchTakes = 3.0;  // [s] as people do it [engineering value]
constexpr double kGravity = 9.81;     // [m/s^2]
constexpr double kHoldsHill = 1.05;   // [s] at the bite point, until the hand brake is off [engineering value]

}  // namespace

namespace {

// [kg] that the car has on the road, the parts behind the clutch with it
double mass_in(const CarSpec& car, double per_road) noexcept {
  return car.body.mass + car.body.rotating + car.clutch.disc_inertia * per_road * per_road;
}

}  // namespace

double jerk_limit(const CarSpec& car, int gear) noexcept {
  const double per_road = shaft_per_road(car, gear);
  const double acceleration =
      car.clutch.capacity * std::abs(per_road) * car.gearbox.efficiency / mass_in(car, per_road);
  return std::max(kLeastJerk, kJerkShare * kJerkOfStep * acceleration);
}

double burn_limit(const CarSpec& car, int gear, double slope) noexcept {
  const double per_road = shaft_per_road(car, gear), speed = car.engine.shift_high;
  const double road_speed = speed / per_road;
  const double hill = std::max(0.0, kGravity * car.body.mass * std::sin(slope) / (per_road * car.gearbox.efficiency));
  return 0.5 * mass_in(car, per_road) * road_speed * road_speed + speed * hill * (0.5 * kLaunchTakes + kHoldsHill);
}

ClutchRelease::ClutchRelease(const CarSpec& car) : car_(car), pedal_(car.clutch.bite) {}

std::optional<DriveFault> ClutchRelease::add(const DriveSample& sample, double dt) {
  pedal_.update(sample.car.clutch, sample.time());
  const double jerk = std::abs(filter_.update(sample.car.acceleration, dt));
  if (!open_ && pedal_.went_up() && sample.car.gear != kNeutralGear) {
    open_ = true;
    stalled_ = false;
    gear_ = sample.car.gear;
    slope_ = sample.controls.slope;
    begin_ = pedal_.up_at();
    closed_at_ = locked_at_ = slip_peak_ = heat_ = jerk_peak_ = 0.0;
  }
  if (!open_) return std::nullopt;
  stalled_ = stalled_ || !sample.car.running;
  slip_peak_ = std::max(slip_peak_, sample.car.slip_power);
  heat_ += sample.car.slip_power * dt;
  if (sample.car.brake < kBrakeJerks) jerk_peak_ = std::max(jerk_peak_, jerk);
  if (closed_at_ == 0.0 && sample.car.clutch <= car_.clutch.closed) closed_at_ = sample.time();
  if (!is_over(sample)) return std::nullopt;
  open_ = false;
  return judge();
}

std::optional<DriveFault> ClutchRelease::finish() noexcept {
  return std::exchange(open_, false) ? judge() : std::nullopt;
}

bool ClutchRelease::is_over(const DriveSample& sample) noexcept {
  const double time = sample.time();
  if (locked_at_ == 0.0 && sample.car.clutch_locked) locked_at_ = time;
  if (pedal_.is_down() || sample.car.gear == kNeutralGear || time - begin_ > kLongest) return true;
  return locked_at_ > 0.0 && time - std::max(locked_at_, closed_at_) >= kJerkSettles;
}

std::optional<DriveFault> ClutchRelease::judge() const noexcept {
  const bool fast = closed_at_ > 0.0 && closed_at_ - begin_ < kFastRelease;
  if (fast && slip_peak_ >= fault_rule(FaultKind::clutch_dump).raise) {
    return DriveFault{FaultKind::clutch_dump, fault_severity(FaultKind::clutch_dump, slip_peak_), begin_, slip_peak_};
  }
  const double burnt = heat_ / burn_limit(car_, gear_, slope_);
  if (!stalled_ && burnt >= fault_rule(FaultKind::clutch_burn).raise) {
    return DriveFault{FaultKind::clutch_burn, fault_severity(FaultKind::clutch_burn, burnt), begin_, heat_};
  }
  const double share = jerk_peak_ / jerk_limit(car_, gear_);
  if (!stalled_ && share >= fault_rule(FaultKind::jerk).raise) {
    return DriveFault{FaultKind::jerk, fault_severity(FaultKind::jerk, share), begin_, jerk_peak_};
  }
  return std::nullopt;
}

}  // namespace gearshift
