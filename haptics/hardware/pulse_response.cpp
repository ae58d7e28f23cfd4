#include "haptics/hardware/pulse_response.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "haptics/joystick/plant.h"

namespace gearshift::haptics {
namespace {

using glm::dvec3;  // damping, stiffness, delay

constexpr std::size_t kMinSamples = 20;
constexpr int kMaxSteps = 60;
// There are several starting points, because the Levenberg-Marquardt method can end in a minimum that is not the
// lowest.
constexpr std::array kFirstDampings{3.0, 30.0, 150.0};                             // [1/s]
constexpr std::array kFirstStiffnesses{20.0, 200.0, 1000.0, 4000.0};               // [1/s^2]
constexpr std::array kFirstDelays{0.0, 0.003, 0.007, 0.012, 0.020, 0.035, 0.060};  // [s]
constexpr std::size_t kDescents = 4;
constexpr std::size_t kSampleStride = 8;  // the search for the best starting point uses every 8th sample
constexpr dvec3 kMinModel{0.0, 0.0, -0.005}, kMaxModel{2000.0, 1e5, 0.2};

// Response to a unit step at time 0.
double step_response(const dvec3& model, double time) {
  if (time <= 0.0) return 0.0;
  return advance(AxisModel{1.0, model.x, model.y}, AxisState{}, 1.0, time).position;
}

double pulse_response(const dvec3& model, const Pulse& pulse, double time) {
  double position = 0.0, force = 0.0;
  for (const PulseStep& step : pulse.steps) {
    position += (step.force - force) * step_response(model, time - model.z - step.time);
    force = step.force;
  }
  return position;
}

class PulseProblem {
 public:
  PulseProblem(std::span<const Pulse> pulses, std::size_t every) : pulses_(pulses), every_(every) {
    measured_ = centred([](const Pulse&, const PulseSample& sample) { return sample.position; });
    for (const double position : measured_) power_ += position * position;
  }

  std::size_t size() const noexcept { return measured_.size(); }
  bool has_motion() const noexcept { return power_ > 0.0; }

  struct Trial {
    dvec3 model{0.0};
    double gain = 0.0, error = 0.0;  // error: sum of the squared residuals
    std::vector<double> residuals;   // residuals: measured minus modelled
  };

  Trial try_model(const dvec3& model) const {
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
  Trial descend(const dvec3& from) const {
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
  std::vector<double> responses(const dvec3& model) const {
    return centred(
        [&](const Pulse& pulse, const PulseSample& sample) { return pulse_response(model, pulse, sample.time); });
  }

  // Subtracts each pulse's mean from its values, so that the starting position, known only to one count, cancels out.
  std::vector<double> centred(const auto& value_of) const {
    std::vector<double> values;
    for (const Pulse& pulse : pulses_) {
      const std::size_t first = values.size();
      double sum = 0.0;
      for (std::size_t i = 0; i < pulse.samples.size(); i += every_)
        sum += values.emplace_back(value_of(pulse, pulse.samples[i]));
      const double mean = sum / static_cast<double>(std::max<std::size_t>(1, values.size() - first));
      for (std::size_t i = first; i < values.size(); ++i) values[i] -= mean;
    }
    return values;
  }

  dvec3 move(const Trial& trial, double lambda) const {
    static constexpr dvec3 kNudge{1e-3, 1e-2, 1e-6};
    std::array<std::vector<double>, 3> slope;
    for (int i = 0; i < 3; ++i) {
      dvec3 model = trial.model;
      model[i] += kNudge[i];
      slope[static_cast<std::size_t>(i)] = try_model(model).residuals;
    }
    glm::dmat3 normal(0.0);
    dvec3 gradient(0.0);
    for (std::size_t n = 0; n < measured_.size(); ++n) {
      dvec3 row;
      for (int i = 0; i < 3; ++i) row[i] = (slope[static_cast<std::size_t>(i)][n] - trial.residuals[n]) / kNudge[i];
      normal += glm::outerProduct(row, row);
      gradient += row * trial.residuals[n];
    }
    for (int i = 0; i < 3; ++i) normal[i][i] = normal[i][i] * (1.0 + lambda) + 1e-300;
    return -glm::inverse(normal) * gradient;
  }

  std::span<const Pulse> pulses_;
  std::size_t every_;  // uses every n-th sample
  std::vector<double> measured_;
  double power_ = 0.0;
};

// Searches for the lowest minimum with every 8th sample. The result is the starting point for the full fit.
dvec3 find_start(std::span<const Pulse> pulses) {
  const PulseProblem problem(pulses, kSampleStride);
  std::vector<PulseProblem::Trial> trials;
  for (const double damping : kFirstDampings)
    for (const double stiffness : kFirstStiffnesses)
      for (const double delay : kFirstDelays) trials.push_back(problem.try_model({damping, stiffness, delay}));
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
  return problem.try_model({known.damping, known.stiffness, known.delay}).gain;
}

PulseFit fit_pulses(std::span<const Pulse> pulses) {
  const PulseProblem problem(pulses, 1);
  require_motion(problem);
  const PulseProblem::Trial best = problem.descend(find_start(pulses));
  return {best.gain, best.model.x, best.model.y, best.model.z, problem.residual(best)};
}

}  // namespace gearshift::haptics
