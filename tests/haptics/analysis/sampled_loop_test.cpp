// Compares the exact stability limit with closed forms, with the frequency response, and with runs of the real loop
// components.
#include "haptics/analysis/sampled_loop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <stdexcept>

#include <doctest/doctest.h>

#include "haptics/analysis/passivity.h"
#include "haptics/contact/lever_estimator.h"
#include "haptics/contact/lever_observer.h"
#include "haptics/contact/proxy.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/gate/plain_aisle.h"

using namespace gearshift::haptics;

namespace {

using Complex = std::complex<double>;

double any_between(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

double log_between(std::mt19937_64& random, double low, double high) {
  return std::exp(any_between(random, std::log(low), std::log(high)));
}

struct Case {
  AxisModel handle;
  HandImpedance hand;
  ContactLaw law;
  double period = 0.001;
};

// A random case with random device, rate, delay, hand, hold, window and damping. The damping is limited to what the
// rate allows.
Case random_case(std::mt19937_64& random, int i) {
  Case c;
  c.handle = {any_between(random, 0.05, 0.5), any_between(random, 0.5, 8.0), any_between(random, 0.0, 50.0)};
  if (i % 3 != 0)
    c.hand = {any_between(random, 0.0, 1.0), any_between(random, 0.0, 15.0), any_between(random, 0.0, 800.0)};
  c.period = log_between(random, 2.5e-4, 1e-2);
  c.law.hold = i % 2 == 0 ? ContactHold::half_sample : ContactHold::zero_order;
  c.law.delay = i % 7 < 5 ? i % 7 : 0;
  c.law.window = i % 4 == 3 ? 2 + i % 9 : 1;
  const double mass = c.handle.mass + c.hand.mass;
  const int lag = c.law.delay + c.law.window;
  c.law.damping = any_between(random, 0.0, 0.5) * mass / (c.period * lag);
  c.law.free_damping = i % 5 == 4 ? any_between(random, 0.0, 0.1) * mass / (c.period * lag) : 0.0;
  return c;
}

double limit_of(const Case& c) {
  return stiffness_limit(c.handle, c.hand, c.law, c.period);
}

// Zero-order-hold transfer function of 1 / (m s^2 + b s + k), computed from its two poles: 1/k plus, for each pole p,
// (residue at p) (z - 1) / (z - exp(p T)). Requires b^2 != 4 m k.
Complex held_plant(const AxisModel& lever, double period, Complex z) {
  const Complex root = std::sqrt(Complex(lever.damping * lever.damping - 4.0 * lever.mass * lever.stiffness));
  const Complex p = (-lever.damping + root) / (2.0 * lever.mass), q = (-lever.damping - root) / (2.0 * lever.mass);
  const Complex at_p = 1.0 / (lever.mass * p * (p - q)), at_q = 1.0 / (lever.mass * q * (q - p));
  return 1.0 / lever.stiffness + at_p * (z - 1.0) / (z - std::exp(p * period)) +
         at_q * (z - 1.0) / (z - std::exp(q * period));
}

// Smallest |1 + E G| over all frequencies, for wall E and plant G. It is 0 if an eigenvalue of the loop lies on the
// unit circle.
double distance_to_unit_circle(const Case& c) {
  const AxisModel lever{c.handle.mass + c.hand.mass, c.handle.damping + c.hand.damping,
                        c.handle.stiffness + c.hand.stiffness};
  const Environment wall = contact_environment(c.law, c.period);
  const auto distance = [&](double angle) {
    const Complex z = std::polar(1.0, angle);
    return std::abs(1.0 + wall(z) * held_plant(lever, c.period, z));
  };
  double best = 1e300, at = 0.0, step = 1e-3;
  for (int n = 1; n * step <= std::numbers::pi; ++n) {
    if (distance(n * step) < best) best = distance(at = n * step);
  }
  while (step > 1e-12) {
    step *= 0.5;
    for (const double next : {at - step, at + step}) {
      if (distance(next) < best) best = distance(at = next);
    }
  }
  return best;
}

Coupling coupling_of(const ContactLaw& law, double stiffness, double period) {
  Coupling coupling;
  coupling.hold = law.hold;
  coupling.stiffness = stiffness;
  coupling.damping = law.damping;
  coupling.period = period;
  coupling.delay = law.delay;
  return coupling;
}

// A wall under a constant push, rendered by the real estimator, proxy and coupling on one exactly stepped axis. The
// lever starts slightly off its rest position. The ratio of late to early amplitude shows whether the motion grows or
// decays.
class PushedWall {
 public:
  PushedWall(const Case& c, double stiffness)
      : law_(c.law),
        coupling_(coupling_of(c.law, stiffness, c.period)),
        gate_(plain_aisle(0.05, kWall)),
        passage_(open_passage(gate_)),
        estimator_({c.law.smoothing, 1000.0, c.law.window}, c.period),
        plant_({c.handle.mass + c.hand.mass, c.handle.damping + c.hand.damping, c.handle.stiffness + c.hand.stiffness},
               c.period),
        push_(stiffness * kDepth + (c.handle.stiffness + c.hand.stiffness) * kRest),
        period_ns_(std::llround(1e9 * c.period)) {
    queue_.fill(-stiffness * kDepth);
    proxy_ = place_proxy(gate_, {0.0, lever_.position});
  }

  double max_distance(int cycles) {
    double largest = 0.0;
    for (int i = 0; i < cycles; ++i) {
      step();
      largest = std::max(largest, std::abs(lever_.position - kRest));
    }
    return largest;
  }

 private:
  static constexpr double kWall = 0.010, kDepth = 0.005, kRest = kWall + kDepth;  // [m]

  void step() {
    LeverReading reading;
    reading.sequence = ++cycle_;
    reading.time_ns = static_cast<std::int64_t>(cycle_) * period_ns_;
    reading.position = {0.0, lever_.position};
    const LeverMotion motion = estimator_.update(reading);
    proxy_ = move_proxy(gate_, passage_, proxy_, motion.position, 0.0);
    const double wall = contact_force(coupling_, gate_, passage_, proxy_, motion).force.y;
    queue_[cycle_ % queue_.size()] = wall - law_.free_damping * motion.smooth_velocity.y;
    const auto delay = static_cast<std::uint64_t>(law_.delay);
    const double due = queue_[(cycle_ + queue_.size() - delay) % queue_.size()];
    lever_ = plant_.step(lever_, due + push_);
  }

  ContactLaw law_;
  Coupling coupling_;
  Gate gate_;
  Passage passage_;
  LeverEstimator estimator_;
  AxisStepper plant_;
  double push_;  // [N]
  std::int64_t period_ns_;
  AxisState lever_{kRest + 1e-8, 0.0};
  Proxy proxy_;
  std::array<double, kMaxLoopDelay + 1> queue_{};  // [N]
  std::uint64_t cycle_ = 0;
};

// Number of cycles in which the motion grows or decays by a factor of about e^5, enough for a clear result.
int decisive_cycles(Case c, double stiffness) {
  c.law.stiffness = stiffness;
  const double rate = std::abs(std::log(spectral_radius(c.handle, c.hand, c.law, c.period)));
  return static_cast<int>(std::clamp(5.0 / rate, 1000.0, 3e6));
}

// Factor by which the amplitude of the motion grows within decisive_cycles().
double growth(const Case& c, double stiffness) {
  PushedWall wall(c, stiffness);
  const double early = wall.max_distance(500);
  wall.max_distance(decisive_cycles(c, stiffness));
  return wall.max_distance(500) / early;
}

// Pushes the simulated lever into the upper wall. The push starts when the wall's first force takes effect, so that
// push and wall force balance and the lever starts at rest.
class PushingHand final : public HandDriver {
 public:
  PushingHand(glm::dvec2 rest, double push, int delay) : push_(push), wait_(delay) { target_.position = rest; }
  HandTarget next(double, glm::dvec2) noexcept override {
    if (wait_-- == 0) target_.push.y = push_;
    return target_;
  }

 private:
  HandTarget target_;
  double push_;  // [N]
  int wait_;     // [cycles]
};

// The complete simulated lever at the wall of a test case, along y, without encoder quantisation.
class SimulatedWall {
 public:
  // Starts with a soft wall and stiffens it slowly to 0.98 of the limit. A sudden stiff wall would throw the lever out
  // of the wall.
  SimulatedWall(const Case& c, double limit)
      : case_(c),
        stiffness_(0.3 * limit),
        driver_(kRest, stiffness_ * kDepth + c.handle.stiffness * kRest.y, c.law.delay),
        period_ns_(std::llround(1e9 * c.period)),
        lever_(config_of(c), period_ns_, driver_),
        gate_(plain_aisle(0.05, kWall)),
        passage_(open_passage(gate_)),
        estimator_({c.law.smoothing, 1000.0, c.law.window}, c.period),
        observer_(lever_.spec(), c.period) {
    lever_.place(kRest + glm::dvec2(0.0, 1e-7));
    proxy_ = place_proxy(gate_, kRest);
    max_speed(3000);
    for (const double from = stiffness_; stiffness_ < 0.98 * limit; stiffness_ += 1e-4 * from) max_speed(1);
    max_speed(3000);
  }

  // Factor by which the motion grows after the stiffness is changed to `stiffness`. The change itself excites the
  // motion.
  double growth(double stiffness) {
    stiffness_ = stiffness;
    max_speed(50);
    const double early = max_speed(200);
    max_speed(decisive_cycles(case_, stiffness) / 2);
    return max_speed(200) / early;
  }

 private:
  static constexpr double kWall = 0.001, kDepth = 0.001;  // [m] near the centre, where arc and plane positions agree
  static constexpr glm::dvec2 kRest{0.0, kWall + kDepth};

  static SimulatedLeverConfig config_of(const Case& c) {
    SimulatedLeverConfig config;
    config.axis_y = c.handle;
    config.encoder_counts = 0.0;
    config.actuator = {1e4, 1e4, 1.0};
    config.delay = c.law.delay;
    config.hand = c.hand;
    return config;
  }

  double max_speed(int cycles) {
    double largest = 0.0;
    for (int i = 0; i < cycles; ++i) {
      step();
      largest = std::max(largest, std::abs(lever_.true_velocity().y));
    }
    return largest;
  }

  void step() {
    Coupling coupling = coupling_of(case_.law, stiffness_, case_.period);
    const bool is_observed = coupling.hold == ContactHold::observer;
    const LeverMotion motion = estimator_.update(lever_.read(now_ns_ += period_ns_));
    ObservedMotion observed = observer_.update(motion, command_);
    observed.end += observed.compliance * damping_;
    proxy_ = move_proxy(gate_, passage_, proxy_, motion.position, 0.0);
    damping_ = -case_.law.free_damping * motion.smooth_velocity;
    const ContactForce contact = is_observed ? contact_force(coupling, gate_, passage_, proxy_, observed)
                                             : contact_force(coupling, gate_, passage_, proxy_, motion);
    command_ = contact.force + damping_;
    lever_.write(command_);
  }

  Case case_;
  double stiffness_;  // [N/m]
  PushingHand driver_;
  std::int64_t period_ns_, now_ns_ = 0;
  SimulatedLever lever_;
  Gate gate_;
  Passage passage_;
  LeverEstimator estimator_;
  LeverObserver observer_;
  Proxy proxy_;
  glm::dvec2 damping_{0.0}, command_{0.0};  // [N] force of the free damping, total commanded force
};

}  // namespace

// The limit follows from Jury's conditions for the loop's characteristic polynomial
//   z^3 + (q/2 - 2) z^2 + (1 + k/2) z - h/2
// with k = K T^2 / m, h = B T / m, q = k + h (stiffness K, damping B, mass m, period T).
TEST_CASE("a free mass: K T^2 / m < 2 h (2 - h) / (2 + h), h = B T / m, at most 0.686 at 0.83, 0 from 2 on") {
  for (const double period : {0.01, 0.001, 0.0001}) {
    const double mass = 0.3;
    ContactLaw law;
    law.hold = ContactHold::zero_order;
    for (const double h : {0.01, 0.3, 2.0 * std::numbers::sqrt2 - 2.0, 1.0, 1.5, 1.99}) {
      law.damping = h * mass / period;
      CAPTURE(h);
      CHECK(stiffness_limit({mass, 0.0, 0.0}, kBareHand, law, period) * period * period / mass ==
            doctest::Approx(2.0 * h * (2.0 - h) / (2.0 + h)).epsilon(1e-8));
    }
    law.damping = 2.001 * mass / period;
    CHECK(stiffness_limit({mass, 0.0, 0.0}, kBareHand, law, period) == 0.0);
    law.damping = 0.0;
    CHECK(stiffness_limit({mass, 0.0, 0.0}, kBareHand, law, period) == 0.0);
  }
}

// The half-sample hold replaces B by B + K T / 2 in the polynomial of the test case above. With k and h as there, this
// gives the condition k^2 + 3 h k + 2 h^2 - 4 h < 0.
TEST_CASE("a free mass under the half-sample hold: K T^2 / m < (sqrt(h^2 + 16 h) - 3 h) / 2") {
  const double mass = 0.3, period = 0.001;
  ContactLaw law;
  for (const double h : {0.01, 0.1, 0.3, 0.6, 1.0, 1.8}) {
    law.damping = h * mass / period;
    CAPTURE(h);
    CHECK(stiffness_limit({mass, 0.0, 0.0}, kBareHand, law, period) * period * period / mass ==
          doctest::Approx(0.5 * (std::sqrt(h * h + 16.0 * h) - 3.0 * h)).epsilon(1e-8));
  }
  law.hold = ContactHold::automatic;
  CHECK(stiffness_limit({mass, 0.0, 0.0}, kBareHand, law, period) > 0.0);
}

TEST_CASE("without a wall the radius is the plant's slower pole, and 1 for a free mass") {
  const double root = std::sqrt(9.0 - 4.0 * 0.095 * 14.8);
  CHECK(spectral_radius(kPaperAxisX, kBareHand, {}, 0.001) ==
        doctest::Approx(std::exp((-3.0 + root) / (2.0 * 0.095) * 0.001)).epsilon(1e-13));
  CHECK(spectral_radius({0.3, 0.0, 0.0}, kBareHand, {}, 0.001) == doctest::Approx(1.0).epsilon(1e-7));
}

TEST_CASE("as T -> 0: K (T/2 + d T) -> b + B") {
  for (int delay = 0; delay <= kMaxLoopDelay; ++delay) {
    for (const double damping : {0.0, 2.0, 5.0}) {
      ContactLaw law;
      law.hold = ContactHold::zero_order;
      law.damping = damping;
      law.delay = delay;
      const double period = 2e-6;
      const double limit = stiffness_limit(kPaperAxisX, kBareHand, law, period);
      CHECK(limit * period * (0.5 + delay) == doctest::Approx(3.0 + damping).epsilon(0.01));
    }
  }
}

TEST_CASE("handle and hand are one lever") {
  ContactLaw law;
  law.damping = 12.0;
  law.delay = 1;
  const AxisModel together{0.095 + 0.15, 3.0 + 10.0, 14.8 + 500.0};
  CHECK(stiffness_limit(kPaperAxisX, kGripHand, law, 0.002) ==
        doctest::Approx(stiffness_limit(together, kBareHand, law, 0.002)).epsilon(1e-9));
}

TEST_CASE("a limit beyond 1e9 N/m is infinite, and invalid arguments are rejected") {
  CHECK(std::isinf(stiffness_limit({1e3, 1e4, 1e6}, kBareHand, {}, 1e-6)));
  const auto check_rejected = [](const AxisModel& handle, const HandImpedance& hand, const ContactLaw& law,
                                 double period) {
    CHECK_THROWS_AS(spectral_radius(handle, hand, law, period), std::invalid_argument);
    CHECK_THROWS_AS(stiffness_limit(handle, hand, law, period), std::invalid_argument);
  };
  check_rejected({0.0, 3.0, 14.8}, kBareHand, {}, 0.001);
  check_rejected({-0.1, 3.0, 14.8}, kBareHand, {}, 0.001);
  check_rejected({0.1, std::nan(""), 14.8}, kBareHand, {}, 0.001);
  check_rejected(kPaperAxisX, {-1.0, 0.0, 0.0}, {}, 0.001);
  check_rejected(kPaperAxisX, kBareHand, {}, 0.0);
  ContactLaw law;
  law.window = 0;
  check_rejected(kPaperAxisX, kBareHand, law, 0.001);
  law = {};
  law.delay = kMaxLoopDelay + 1;
  check_rejected(kPaperAxisX, kBareHand, law, 0.001);
  law = {};
  law.damping = -1.0;
  check_rejected(kPaperAxisX, kBareHand, law, 0.001);
}

TEST_CASE("at the limit an eigenvalue lies on the unit circle, by the frequency response of plant and wall") {
  std::mt19937_64 random(4);
  int checked_cases = 0;
  for (int i = 0; i < 120; ++i) {
    Case c = random_case(random, i);
    c.law.stiffness = limit_of(c);
    if (c.law.stiffness == 0.0 || std::isinf(c.law.stiffness)) continue;
    CAPTURE(i);
    CHECK(distance_to_unit_circle(c) < 1e-6);
    ++checked_cases;
  }
  CHECK(checked_cases > 80);
}

TEST_CASE("the shipped coupling converges just below the limit and diverges just above") {
  std::mt19937_64 random(5);
  int checked_cases = 0;
  for (int i = 0; i < 100; ++i) {
    const Case c = random_case(random, i);
    const double limit = limit_of(c);
    if (limit == 0.0 || std::isinf(limit)) continue;
    CAPTURE(i);
    CAPTURE(limit);
    CHECK(growth(c, 0.995 * limit) < 0.5);
    CHECK(growth(c, 1.005 * limit) > 2.0);
    ++checked_cases;
  }
  CHECK(checked_cases > 60);
}

TEST_CASE("the simulated lever does the same, with every hold and hand, within 1 %") {
  int checked_cases = 0;
  for (const ContactHold hold : {ContactHold::zero_order, ContactHold::half_sample, ContactHold::observer}) {
    for (const NamedHand& named : kNamedHands) {
      for (const int delay : {0, 1, 3}) {
        Case c{kPaperAxisY, named.hand, {}};
        c.law.hold = hold;
        c.law.delay = delay;
        c.law.damping = 12.0;  // [N s/m]
        c.law.window = delay == 3 ? 2 : 1;
        c.law.free_damping = delay == 1 ? 5.0 : 0.0;
        const double limit = limit_of(c);
        CAPTURE(named.name);
        CAPTURE(delay);
        CAPTURE(limit);
        if (std::isinf(limit)) continue;  // with an exact model, the observer hold is stable on any wall
        ++checked_cases;
        SimulatedWall wall(c, limit);
        CHECK(wall.growth(0.99 * limit) < 0.5);
        CHECK(wall.growth(1.01 * limit) > 2.0);
      }
    }
  }
  CHECK(checked_cases >= 30);
}
