#include "haptics/analysis/sampled_loop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>

#include "haptics/analysis/spectral_radius.h"
#include "haptics/device/haptic_device.h"
#include "haptics/files/range_check.h"

namespace gearshift::haptics {
namespace {

static_assert(2 + kMaxWindow + 1 + 3 + kMaxLoopDelay + 1 <=
              kMaxStates);                    // terms: lever, past positions, smooth velocity, estimate, queue
constexpr double kMinStiffnessFactor = 1e-7;  // softest wall tested, in units of m / T^2 (mass m, period T)
constexpr double kMaxStiffness = 1e9;         // [N/m]
constexpr double kScanRatio = 1.25;           // ratio between one tested stiffness and the next
constexpr double kAccuracy = 1e-9;            // relative

void check(const AxisModel& handle, const HandImpedance& hand) {
  require_between("handle.mass", handle.mass, 1e-3, 1e3, "kg");
  require_between("handle.damping", handle.damping, 0.0, 1e4, "N s/m");
  require_between("handle.stiffness", handle.stiffness, 0.0, 1e6, "N/m");
  require_between("hand.mass", hand.mass, 0.0, 1e3, "kg");
  require_between("hand.damping", hand.damping, 0.0, 1e4, "N s/m");
  require_between("hand.stiffness", hand.stiffness, 0.0, 1e6, "N/m");
  if (hand.is_elastic()) throw std::invalid_argument("hand: stability limits are known only for rigid hands");
}

// One cycle of the loop in contact, as a linear map of its state. The state holds, in this order: the lever's position
// and velocity; the past positions used by the velocity estimate, newest first; the smooth velocity; the observer's
// position, velocity and hand force; the delayed forces, oldest first. Parts that the law does not use are omitted.
class ContactCycle {
 public:
  // The observer models only the handle. The simulated lever has the impedance of handle and hand together.
  ContactCycle(const AxisModel& handle, const HandImpedance& hand, const ContactLaw& law, double period)
      : law_(law),
        wall_{law.stiffness, law.damping, period, law.delay, law.hold},
        period_(period),
        horizon_(law.hold == ContactHold::zero_order ? 0.0 : period * (1 + 2 * law.delay)),
        plant_({handle.mass + hand.mass, handle.damping + hand.damping, handle.stiffness + hand.stiffness}, period),
        observer_(handle, period),
        gain_(observer_gain(handle, observer_bandwidth(period), period)),
        force_scale_((handle.mass + hand.mass) / (period * period)) {
    const bool uses_smooth = law.free_damping > 0.0;
    const bool is_observed = law.hold == ContactHold::observer;
    const bool uses_velocity = !is_observed && (law.damping > 0.0 || (horizon_ > 0.0 && law.stiffness > 0.0));
    past_size_ = uses_smooth || uses_velocity ? static_cast<std::size_t>(law.window) : 0;
    smooth_size_ = uses_smooth ? 1 : 0;
    estimate_size_ = is_observed ? 3 : 0;
    queue_size_ = static_cast<std::size_t>(law.delay) + (is_observed ? 1 : 0);
    blend_ = -std::expm1(-period / law.smoothing);
  }

  std::size_t order() const { return 2 + past_size_ + smooth_size_ + estimate_size_ + queue_size_; }

  void run(std::span<double> state) const {
    const AxisState lever{state[0], state[1]};
    const std::span<double> past = state.subspan(2, past_size_);
    const std::span<double> smooth = state.subspan(2 + past_size_, smooth_size_);
    const std::span<double> estimate = state.subspan(2 + past_size_ + smooth_size_, estimate_size_);
    const std::span<double> queue = state.last(queue_size_);

    const double velocity = past.empty() ? 0.0 : (lever.position - past.back()) / (law_.window * period_);
    shift_in(past, lever.position);
    const double previous_damping = free_damping_force(smooth);
    for (double& v : smooth) v += blend_ * (velocity - v);
    const double wall = estimate.empty() ? sampled_force(lever.position, velocity)
                                         : observed_force(estimate, queue, lever.position, previous_damping);
    const double force = wall + free_damping_force(smooth);
    const AxisState next = plant_.step(lever, advance_queue(queue, force));
    state[0] = next.position;
    state[1] = next.velocity;
  }

  // Scales the parts of the state to similar magnitudes, so that the eigenvalues stay accurate.
  double scale(std::size_t part) const {
    if (part < 2) return part == 0 ? 1.0 : 1.0 / period_;
    if (part < 2 + past_size_) return 1.0;
    const std::size_t index = part - 2 - past_size_;
    if (index < smooth_size_) return 1.0 / period_;
    if (index < smooth_size_ + estimate_size_)
      return std::array{1.0, 1.0 / period_, force_scale_}[index - smooth_size_];
    return force_scale_;
  }

 private:
  static void shift_in(std::span<double> past, double position) {
    std::shift_right(past.begin(), past.end(), 1);
    if (!past.empty()) past.front() = position;
  }

  double free_damping_force(std::span<const double> smooth) const {
    return smooth.empty() ? 0.0 : -law_.free_damping * smooth.front();
  }

  double sampled_force(double position, double velocity) const {
    return -law_.stiffness * (position + 0.5 * horizon_ * velocity) - law_.damping * velocity;
  }

  // Computes the force as LeverObserver, HapticLoop and contact_force() do. queue: the force of the previous period,
  // then the delayed forces. other_force: force [N] commanded in addition to the wall's force.
  double observed_force(std::span<double> estimate, std::span<const double> queue, double position,
                        double other_force) const {
    const AxisEstimate before{estimate[0], estimate[1], estimate[2]};
    const AxisEstimate now = AxisObserver::correct(observer_.predict(before, queue.front()), gain_, position);
    estimate[0] = now.position;
    estimate[1] = now.velocity;
    estimate[2] = now.hand;
    AxisEstimate begin = now;
    for (const double force : queue.subspan(1)) begin = observer_.predict(begin, force);
    return -solved_force_inside(wall_, begin.position, observer_.predict(begin, other_force).position,
                                observer_.compliance());
  }

  // Queues the new force and returns the force that acts now, which was computed `delay` cycles ago. With an observer,
  // the returned force also stays in the queue for one more cycle.
  double advance_queue(std::span<double> queue, double force) const {
    if (queue.empty()) return force;
    const double oldest = queue.front();
    std::shift_left(queue.begin(), queue.end(), 1);
    queue.back() = force;
    return estimate_size_ == 0 ? oldest : queue.front();
  }

  ContactLaw law_;
  Coupling wall_;
  double period_;
  double horizon_;  // [s] the position is predicted to the middle of this time span
  AxisStepper plant_;
  AxisObserver observer_;
  ObserverGain gain_;
  double force_scale_;  // [N] force that moves the lever by about one metre per period
  std::size_t past_size_ = 0, smooth_size_ = 0, estimate_size_ = 0, queue_size_ = 0;
  double blend_ = 0.0;  // [1] weight of the newest velocity in the smooth velocity
};

// Spectral radius of the cycle's matrix. The cycle is linear, so the columns of the matrix are the images of the unit
// vectors.
double radius_of(const ContactCycle& cycle) {
  const std::size_t n = cycle.order();
  std::array<double, std::size_t{kMaxStates} * kMaxStates> matrix;
  for (std::size_t column = 0; column < n; ++column) {
    const std::span<double> state(matrix.data() + column * n, n);
    std::fill(state.begin(), state.end(), 0.0);
    state[column] = cycle.scale(column);
    cycle.run(state);
    for (std::size_t row = 0; row < n; ++row) state[row] /= cycle.scale(row);
  }
  return largest_eigenvalue({matrix.data(), n * n}, static_cast<int>(n));
}

}  // namespace

void check_contact(const ContactLaw& law, double period) {
  require_between("wall.stiffness", law.stiffness, 0.0, kMaxStiffness, "N/m");
  require_between("wall.damping", law.damping, 0.0, 1e6, "N s/m");
  require_between("window", law.window, 1, kMaxWindow, "samples");
  require_between("free_damping", law.free_damping, 0.0, 1e6, "N s/m");
  require_between("smoothing", law.smoothing, 1e-6, 1e3, "s");
  require_between("delay", law.delay, 0, kMaxLoopDelay, "samples");
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
  double stable = kMinStiffnessFactor * (handle.mass + hand.mass) / (period * period), unstable = stable;
  while (is_stable(unstable)) {
    if (unstable >= kMaxStiffness) return std::numeric_limits<double>::infinity();
    stable = unstable;
    unstable = std::min(unstable * kScanRatio, kMaxStiffness);
  }
  if (unstable == stable) return 0.0;
  while (unstable > stable * (1.0 + kAccuracy)) {
    const double middle = std::sqrt(stable * unstable);
    (is_stable(middle) ? stable : unstable) = middle;
  }
  return stable;
}

}  // namespace gearshift::haptics
