#include "haptics/analysis/sampled_loop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "haptics/analysis/spectral_radius.h"
#include "haptics/device/checked.h"
#include "haptics/device/haptic_device.h"

namespace gearshift {
namespace {

static_assert(2 + kMostWindow + 1 + 3 + kMostDelay + 1 <=
              kMostStates);          // lever, past positions, smooth velocity, estimate, queue
constexpr double kVanishing = 1e-7;  // [m / T^2] the softest wall that is tried
constexpr double kStiffest = 1e9;    // [N/m]
constexpr double kScanRatio = 1.25;  // between two stiffnesses tried
constexpr double kAccuracy = 1e-9;   // relative

void check(const AxisModel& handle, const HandImpedance& hand) {
  require_between("handle.mass", handle.mass, 1e-3, 1e3, "kg");
  require_between("handle.damping", handle.damping, 0.0, 1e4, "N s/m");
  require_between("handle.stiffness", handle.stiffness, 0.0, 1e6, "N/m");
  require_between("hand.mass", hand.mass, 0.0, 1e3, "kg");
  require_between("hand.damping", hand.damping, 0.0, 1e4, "N s/m");
  require_between("hand.stiffness", hand.stiffness, 0.0, 1e6, "N/m");
}

// One cycle of the loop in contact. Its state, in this order: the lever's position and velocity; the past positions
// that the velocity estimate reaches back over, newest first; the smooth velocity; the observer's position, velocity
// and hand; the forces under way, oldest first. What the law does not use is not in the state.
class ContactCycle {
 public:
  // The handle is what the observer knows of; the lever moves with the hand on it.
  ContactCycle(const AxisModel& handle, const HandImpedance& hand, const ContactLaw& law, double period)
      : law_(law),
        wall_{law.stiffness, std::max(law.damping, kObservedDamping), period, law.delay, law.hold},
        period_(period),
        horizon_(law.hold == ContactHold::zero_order ? 0.0 : period * (1 + 2 * law.delay)),
        plant_({handle.mass + hand.mass, handle.damping + hand.damping, handle.stiffness + hand.stiffness}, period),
        observer_(handle, observer_bandwidth(period), period),
        force_unit_((handle.mass + hand.mass) / (period * period)) {
    const bool filters = law.free_damping > 0.0;
    const bool observes = law.hold == ContactHold::observer;
    const bool differs = !observes && (law.damping > 0.0 || (horizon_ > 0.0 && law.stiffness > 0.0));
    past_ = filters || differs ? static_cast<std::size_t>(law.window) : 0;
    smooth_ = filters ? 1 : 0;
    estimate_ = observes ? 3 : 0;
    sent_ = static_cast<std::size_t>(law.delay) + (observes ? 1 : 0);
    blend_ = -std::expm1(-period / law.smoothing);
  }

  std::size_t order() const { return 2 + past_ + smooth_ + estimate_ + sent_; }

  void run(std::span<double> state) const {
    const AxisState lever{state[0], state[1]};
    const std::span<double> past = state.subspan(2, past_);
    const std::span<double> smooth = state.subspan(2 + past_, smooth_);
    const std::span<double> estimate = state.subspan(2 + past_ + smooth_, estimate_);
    const std::span<double> sent = state.last(sent_);

    const double velocity = past.empty() ? 0.0 : (lever.position - past.back()) / (law_.window * period_);
    remember(past, lever.position);
    const double damped = free_damping_force(smooth);  // of the cycle before
    for (double& v : smooth) v += blend_ * (velocity - v);
    const double wall = estimate.empty() ? sampled_force(lever.position, velocity)
                                         : observed_force(estimate, sent, lever.position, damped);
    const double force = wall + free_damping_force(smooth);
    const AxisState next = plant_.step(lever, send(sent, force));
    state[0] = next.position;
    state[1] = next.velocity;
  }

  // In which each part of the state is of like size, so that the eigenvalues keep their digits.
  double unit(std::size_t part) const {
    if (part < 2) return part == 0 ? 1.0 : 1.0 / period_;
    if (part < 2 + past_) return 1.0;
    const std::size_t rest = part - 2 - past_;
    if (rest < smooth_) return 1.0 / period_;
    if (rest < smooth_ + estimate_) return std::array{1.0, 1.0 / period_, force_unit_}[rest - smooth_];
    return force_unit_;
  }

 private:
  static void remember(std::span<double> past, double position) {
    std::shift_right(past.begin(), past.end(), 1);
    if (!past.empty()) past.front() = position;
  }

  double free_damping_force(std::span<const double> smooth) const {
    return smooth.empty() ? 0.0 : -law_.free_damping * smooth.front();
  }

  double sampled_force(double position, double velocity) const {
    return -law_.stiffness * (position + 0.5 * horizon_ * velocity) - law_.damping * velocity;
  }

  // As LeverObserver, HapticLoop and couple() do it. sent: the force of the last period, then those under way; beside:
  // what else is commanded [N].
  double observed_force(std::span<double> estimate, std::span<const double> sent, double position,
                        double beside) const {
    const AxisEstimate before{estimate[0], estimate[1], estimate[2]};
    const AxisEstimate now = observer_.correct(observer_.predict(before, sent.front()), position);
    estimate[0] = now.position;
    estimate[1] = now.velocity;
    estimate[2] = now.hand;
    AxisEstimate begin = now;
    for (const double force : sent.subspan(1)) begin = observer_.predict(begin, force);
    return -solved_force_inside(wall_, begin.position, observer_.predict(begin, beside).position,
                                observer_.compliance());
  }

  // The force that acts now, written `delay` cycles ago. An observer keeps that one, too, for the next cycle.
  double send(std::span<double> sent, double force) const {
    if (sent.empty()) return force;
    const double oldest = sent.front();
    std::shift_left(sent.begin(), sent.end(), 1);
    sent.back() = force;
    return estimate_ == 0 ? oldest : sent.front();
  }

  ContactLaw law_;
  Coupling wall_;
  double period_;
  double horizon_;  // [s] over whose middle the position is predicted
  AxisStepper plant_;
  AxisObserver observer_;
  double force_unit_;  // [N] moves the lever by about a metre in a period
  std::size_t past_ = 0, smooth_ = 0, estimate_ = 0, sent_ = 0;
  double blend_ = 0.0;  // [1] of the newest velocity in the smooth one
};

// The cycle is linear: its matrix is what it makes of each unit vector.
double radius_of(const ContactCycle& cycle) {
  const std::size_t n = cycle.order();
  std::array<double, std::size_t{kMostStates} * kMostStates> matrix;
  for (std::size_t column = 0; column < n; ++column) {
    const std::span<double> state(matrix.data() + column * n, n);
    std::fill(state.begin(), state.end(), 0.0);
    state[column] = cycle.unit(column);
    cycle.run(state);
    for (std::size_t row = 0; row < n; ++row) state[row] /= cycle.unit(row);
  }
  return largest_eigenvalue({matrix.data(), n * n}, static_cast<int>(n));
}

}  // namespace

void check_contact(const ContactLaw& law, double period) {
  require_between("wall.stiffness", law.stiffness, 0.0, kStiffest, "N/m");
  require_between("wall.damping", law.damping, 0.0, 1e6, "N s/m");
  require_between("window", law.window, 1, kMostWindow, "samples");
  require_between("free_damping", law.free_damping, 0.0, 1e6, "N s/m");
  require_between("smoothing", law.smoothing, 1e-6, 1e3, "s");
  require_between("delay", law.delay, 0, kMostDelay, "samples");
  require_between("period", period, 1e-6, 1.0, "s");
}

double spectral_radius(const AxisModel& handle, const HandImpedance& hand, const ContactLaw& law, double period) {
  check(handle, hand);
  check_contact(law, period);
  return radius_of(ContactCycle(handle, hand, law, period));
}

double stiffness_limit(const AxisModel& handle, const HandImpedance& hand, const ContactLaw& law, double period) {
  check(handle, hand);
  check_contact(law, period);
  const auto is_stable = [&](double stiffness) {
    ContactLaw wall = law;
    wall.stiffness = stiffness;
    return radius_of(ContactCycle(handle, hand, wall, period)) < 1.0;
  };
  double stable = kVanishing * (handle.mass + hand.mass) / (period * period), unstable = stable;
  while (is_stable(unstable)) {
    if (unstable >= kStiffest) return std::numeric_limits<double>::infinity();
    stable = unstable;
    unstable = std::min(unstable * kScanRatio, kStiffest);
  }
  if (unstable == stable) return 0.0;
  while (unstable > stable * (1.0 + kAccuracy)) {
    const double middle = std::sqrt(stable * unstable);
    (is_stable(middle) ? stable : unstable) = middle;
  }
  return stable;
}

}  // namespace gearshift
