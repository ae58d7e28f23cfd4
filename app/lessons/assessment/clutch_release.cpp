#include "app/lessons/assessment/clutch_release.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gearshift::lessons {
namespace {

// A release that takes less than this time from the bite point to fully up is a clutch dump, if its slip power reaches
// the threshold of `clutch_dump`.
constexpr double kFastRelease = 0.15;    // [s] engineering value
constexpr double kMaxReleaseTime = 5.0;  // [s] longest duration of one clutch release (engineering value)
constexpr double kLaunchTime = 3.0;      // [s] duration of a typical launch (engineering value)
constexpr double kGravity = 9.81;        // [m/s^2]
constexpr double kHillHoldTime = 1.05;   // [s] time for which the clutch holds the car on a hill (engineering value)

}  // namespace

namespace {

// Effective mass of the car in a gear [kg], including the inertia of wheels, clutch disc and input shaft.
double mass_in(const vehicle::CarSpec& car, double per_road) noexcept {
  return car.body.mass + car.body.rotating + car.clutch.disc_inertia * per_road * per_road;
}

}  // namespace

double jerk_limit(const vehicle::CarSpec& car, int gear) noexcept {
  const double per_road = vehicle::shaft_per_road(car, gear);
  const double acceleration =
      car.clutch.capacity * std::abs(per_road) * car.gearbox.efficiency / mass_in(car, per_road);
  return std::max(kMinJerkLimit, kJerkFraction * kJerkPerStep * acceleration);
}

double hill_torque(const vehicle::CarSpec& car, int gear, double slope) noexcept {
  return kGravity * car.body.mass * std::sin(slope) / (vehicle::shaft_per_road(car, gear) * car.gearbox.efficiency);
}

double burn_limit(const vehicle::CarSpec& car, int gear, double slope) noexcept {
  const double per_road = vehicle::shaft_per_road(car, gear), speed = car.engine.shift_high;
  const double road_speed = speed / per_road;
  const double hill = std::max(0.0, hill_torque(car, gear, slope));
  return 0.5 * mass_in(car, per_road) * road_speed * road_speed + speed * hill * (0.5 * kLaunchTime + kHillHoldTime);
}

ClutchRelease::ClutchRelease(const vehicle::CarSpec& car) : car_(car), pedal_(car.clutch.bite) {}

std::optional<DrivingError> ClutchRelease::add(const vehicle::DriveSample& sample, double dt) {
  pedal_.update(sample.car.pedals.clutch, sample.time());
  const double jerk = std::abs(filter_.update(sample.car.acceleration, dt));
  if (!open_ && pedal_.went_up() && sample.car.gear != haptics::kNeutralGear) {
    open_ = true;
    stalled_ = burnt_ = false;
    gear_ = sample.car.gear;
    slope_ = sample.controls.slope;
    begin_ = pedal_.up_at();
    closed_at_ = locked_at_ = slip_peak_ = heat_ = jerk_peak_ = 0.0;
  }
  heat_ += sample.car.slip_power * dt;
  if (begins_to_smell(sample)) return burn_error(sample.time());
  if (!open_) return std::nullopt;
  stalled_ = stalled_ || !sample.car.running;
  slip_peak_ = std::max(slip_peak_, sample.car.slip_power);
  if (sample.car.pedals.brake < kMaxBrakeForJerk) jerk_peak_ = std::max(jerk_peak_, jerk);
  if (closed_at_ == 0.0 && sample.car.pedals.clutch <= car_.clutch.closed) closed_at_ = sample.time();
  if (!is_over(sample)) return std::nullopt;
  open_ = false;
  return judge();
}

std::optional<DrivingError> ClutchRelease::finish() noexcept {
  return std::exchange(open_, false) ? judge() : std::nullopt;
}

bool ClutchRelease::is_over(const vehicle::DriveSample& sample) noexcept {
  const double time = sample.time();
  if (locked_at_ == 0.0 && sample.car.clutch_locked) locked_at_ = time;
  if (pedal_.is_down() || sample.car.gear == haptics::kNeutralGear || time - begin_ > kMaxReleaseTime) return true;
  return locked_at_ > 0.0 && time - std::max(locked_at_, closed_at_) >= kJerkSettlingTime;
}

bool ClutchRelease::begins_to_smell(const vehicle::DriveSample& sample) noexcept {
  const bool smelt = std::exchange(smells_, sample.car.clutch_smells);
  return smells_ && !smelt && !burnt_;
}

DrivingError ClutchRelease::burn_error(double time) noexcept {
  burnt_ = true;
  const double burnt = heat_ / burn_limit(car_, gear_, slope_);
  return make_driving_error(ErrorKind::clutch_burn, error_severity(ErrorKind::clutch_burn, burnt), time, heat_);
}

std::optional<DrivingError> ClutchRelease::judge() noexcept {
  const bool fast = closed_at_ > 0.0 && closed_at_ - begin_ < kFastRelease;
  if (fast && slip_peak_ >= error_rule(ErrorKind::clutch_dump).raise) {
    return make_driving_error(ErrorKind::clutch_dump, error_severity(ErrorKind::clutch_dump, slip_peak_), begin_,
                              slip_peak_);
  }
  if (stalled_ || burnt_) return std::nullopt;
  if (heat_ >= error_rule(ErrorKind::clutch_burn).raise * burn_limit(car_, gear_, slope_)) return burn_error(begin_);
  const double jerk_ratio = jerk_peak_ / jerk_limit(car_, gear_);
  if (jerk_ratio >= error_rule(ErrorKind::jerk).raise) {
    return make_driving_error(ErrorKind::jerk, error_severity(ErrorKind::jerk, jerk_ratio), begin_, jerk_peak_);
  }
  return std::nullopt;
}

}  // namespace gearshift::lessons
