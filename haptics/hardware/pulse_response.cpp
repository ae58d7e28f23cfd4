#include "haptics/hardware/pulse_response.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "haptics/joystick/plant.h"

namespace gearshift::haptics {
namespace {

using glm::dvec4;  // damping, stiffness, delay, friction as a fraction of the full force

constexpr std::size_t kMinSamples = 20;
constexpr int kMaxSteps = 60;
// There are several starting points, because the Levenberg-Marquardt method can end in a minimum that is not the
// lowest.
constexpr std::array kFirstDampings{3.0, 30.0, 150.0};                             // [1/s]
constexpr std::array kFirstStiffnesses{20.0, 200.0, 1000.0, 4000.0};               // [1/s^2]
constexpr std::array kFirstDelays{0.0, 0.003, 0.007, 0.012, 0.020, 0.035, 0.060};  // [s]
constexpr std::array kFirstFrictions{0.0, 0.005, 0.02};                            // [1]
constexpr std::size_t kDescents = 6;
constexpr std::size_t kSampleStride = 8;  // the search for the best starting point uses every 8th sample
constexpr dvec4 kMinModel{0.0, 0.0, -0.005, 0.0}, kMaxModel{2000.0, 1e5, 0.2, 0.5};

// The lever's position under one pulse, at a gain of 1, at times that increase.
class PulseMotion {
 public:
  PulseMotion(const dvec4& model, const Pulse& pulse) : axis_{1.0, model.x, model.y}, delay_(model.z), pulse_(pulse) {
    limits_.coulomb_friction = model.w;
  }

  double at(double time) {
    for (; next_ < pulse_.steps.size() && pulse_.steps[next_].time + delay_ <= time; ++next_) {
      advance_to(pulse_.steps[next_].time + delay_);
      force_ = pulse_.steps[next_].force;
    }
    advance_to(time);
    return state_.position;
  }

 private:
  void advance_to(double time) {
    const double elapsed = time - time_;
    time_ = time;
    if (next_ == 0 || elapsed <= 0.0) return;  // at rest before the first step
    const double friction = std::copysign(limits_.coulomb_friction, state_.velocity);
    const AxisState next = stepper(elapsed).step(state_, force_ - friction);
    // In less than half an oscillation the motion reverses once at most, so it did not if its direction is the same.
    const bool keeps_on = next.velocity * state_.velocity > 0.0 && axis_.stiffness * elapsed * elapsed < 9.0;
    state_ = friction == 0.0 || keeps_on ? next : advance_limited(axis_, limits_, state_, force_, elapsed);
  }

  // Most samples have the same interval, and a new stepper takes most of the calibration's time.
  const AxisStepper& stepper(double period) {
    constexpr double kSame = 1e-12;  // [s]
    if (std::abs(period - period_) > kSame) stepper_ = AxisStepper(axis_, period_ = period);
    return stepper_;
  }

  AxisModel axis_;
  AxisLimits limits_;
  double delay_;
  const Pulse& pulse_;
  std::size_t next_ = 0;
  AxisState state_{};
  double force_ = 0.0, time_ = -1.0;
  double period_ = 0.0;  // [s] of the stepper
  AxisStepper stepper_{axis_, 0.0};
};

class PulseProblem {
 public:
  PulseProblem(std::span<const Pulse> pulses, std::size_t every) : pulses_(pulses), every_(every) {
    measured_ = centred([](const Pulse&) { return [](const PulseSample& sample) { return sample.position; }; });
    for (const double position : measured_) power_ += position * position;
  }

  std::size_t size() const noexcept { return measured_.size(); }
  bool has_motion() const noexcept { return power_ > 0.0; }

  struct Trial {
    dvec4 model{0.0};
    double gain = 0.0, error = 0.0;  // error: sum of the squared residuals
    std::vector<double> residuals;   // residuals: measured minus modelled
  };

  Trial try_model(const dvec4& model) const {
    Trial trial;
    trial.model = model;
    trial.residuals = responses(model);
    double product = 0.0, square = 0.0;
    for (std::size_t i = 0; i < measured_.size(); ++i) {
      product += trial.residuals[i] * measured_[i];
      square += trial.residuals[i] * trial.residuals[i];
    }
    trial.gain = square > 0.0 ? product / square : 0.0;
    for (std::size_t i = 0; i < measured_.size(); ++i) {
      trial.residuals[i] = measured_[i] - trial.gain * trial.residuals[i];
      trial.error += trial.residuals[i] * trial.residuals[i];
    }
    return trial;
  }

  // Minimises the error with the Levenberg-Marquardt method, starting from `from`. If `lambda` is large, the step is
  // short and follows the steepest descent.
  Trial descend(const dvec4& from) const {
    Trial best = try_model(from);
    double lambda = 1e-3;
    for (int step = 0; step < kMaxSteps && lambda < 1e9; ++step) {
      const Trial trial = try_model(glm::clamp(best.model + move(best, lambda), kMinModel, kMaxModel));
      const bool is_better = trial.error < best.error;
      const bool is_settled = is_better && best.error - trial.error < 1e-12 * best.error;
      lambda *= is_better ? 0.2 : 5.0;
      if (is_better) best = trial;
      if (is_settled) break;
    }
    return best;
  }

  double residual(const Trial& trial) const { return std::sqrt(trial.error / power_); }

 private:
  std::vector<double> responses(const dvec4& model) const {
    return centred([&](const Pulse& pulse) {
      return [motion = PulseMotion(model, pulse)](const PulseSample& sample) mutable { return motion.at(sample.time); };
    });
  }

  // Subtracts each pulse's mean from its values, so that the starting position, known only to one count, cancels out.
  std::vector<double> centred(const auto& value_of) const {
    std::vector<double> values;
    for (const Pulse& pulse : pulses_) {
      const std::size_t first = values.size();
      auto value = value_of(pulse);
      double sum = 0.0;
      for (std::size_t i = 0; i < pulse.samples.size(); i += every_)
        sum += values.emplace_back(value(pulse.samples[i]));
      const double mean = sum / static_cast<double>(std::max<std::size_t>(1, values.size() - first));
      for (std::size_t i = first; i < values.size(); ++i) values[i] -= mean;
    }
    return values;
  }

  dvec4 move(const Trial& trial, double lambda) const {
    static constexpr dvec4 kNudge{1e-3, 1e-2, 1e-6, 1e-6};
    std::array<std::vector<double>, 4> slope;
    for (int i = 0; i < 4; ++i) {
      dvec4 model = trial.model;
      model[i] += kNudge[i];
      slope[static_cast<std::size_t>(i)] = try_model(model).residuals;
    }
    glm::dmat4 normal(0.0);
    dvec4 gradient(0.0);
    for (std::size_t n = 0; n < measured_.size(); ++n) {
      dvec4 row;
      for (int i = 0; i < 4; ++i) row[i] = (slope[static_cast<std::size_t>(i)][n] - trial.residuals[n]) / kNudge[i];
      normal += glm::outerProduct(row, row);
      gradient += row * trial.residuals[n];
    }
    for (int i = 0; i < 4; ++i) normal[i][i] = normal[i][i] * (1.0 + lambda) + 1e-300;
    return -glm::inverse(normal) * gradient;
  }

  std::span<const Pulse> pulses_;
  std::size_t every_;  // uses every n-th sample
  std::vector<double> measured_;
  double power_ = 0.0;
};

// Searches for the lowest minimum with every 8th sample. The result is the starting point for the full fit.
dvec4 find_start(std::span<const Pulse> pulses) {
  const PulseProblem problem(pulses, kSampleStride);
  std::vector<PulseProblem::Trial> trials;
  for (const double damping : kFirstDampings)
    for (const double stiffness : kFirstStiffnesses)
      for (const double delay : kFirstDelays)
        for (const double friction : kFirstFrictions)
          trials.push_back(problem.try_model({damping, stiffness, delay, friction}));
  const auto better = [](const PulseProblem::Trial& a, const PulseProblem::Trial& b) { return a.error < b.error; };
  std::partial_sort(trials.begin(), trials.begin() + kDescents, trials.end(), better);
  PulseProblem::Trial best = trials.front();
  for (std::size_t i = 0; i < kDescents; ++i) best = std::min(best, problem.descend(trials[i].model), better);
  return best.model;
}

void require_motion(const PulseProblem& problem) {
  if (problem.size() < kMinSamples) throw std::invalid_argument("too few readings to identify the lever's motion");
  if (!problem.has_motion()) throw std::invalid_argument("the lever did not move");
}

}  // namespace

double gain_of(const Pulse& pulse, const PulseFit& known) {
  const PulseProblem problem({&pulse, 1}, 1);
  require_motion(problem);
  return problem.try_model({known.damping, known.stiffness, known.delay, known.friction}).gain;
}

PulseFit fit_pulses(std::span<const Pulse> pulses) {
  const PulseProblem problem(pulses, 1);
  require_motion(problem);
  const PulseProblem::Trial best = problem.descend(find_start(pulses));
  return {best.gain, best.model.x, best.model.y, best.model.z, best.model.w, problem.residual(best)};
}

}  // namespace gearshift::haptics
