#include "haptics/analysis/identification.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace gearshift::haptics {
namespace {

using Complex = std::complex<double>;

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr std::size_t kMinPoints = 3;
constexpr int kMaxRounds = 12;  // of choosing the points and fitting them

using Parameters = glm::dvec4;  // mass, damping, stiffness, dry friction

AxisModel model_of(const Parameters& p) {
  return {p[0], p[1], p[2]};
}

std::vector<FrequencyPoint> measured_points(const FrequencyResponse& response) {
  std::vector<FrequencyPoint> points;
  std::copy_if(response.points.begin(), response.points.end(), std::back_inserter(points),
               [](const FrequencyPoint& point) { return point.end == PointEnd::measured; });
  if (points.size() < kMinPoints) {
    throw std::invalid_argument("fit_axis: mass, damping and stiffness need at least 3 measured points, not " +
                                std::to_string(points.size()));
  }
  return points;
}

// Frequency response of the position to a force that is held between samples: the discrete transfer function C (z -
// A)^-1 B of one step. It is divided by the hold's own response, which makes it comparable to compliance().
Complex held_compliance(const AxisModel& axis, double frequency, double period) {
  const AxisStepper stepper(axis, period);
  const AxisState of_x = stepper.step({1.0, 0.0}, 0.0), of_v = stepper.step({0.0, 1.0}, 0.0);
  const AxisState of_f = stepper.step({}, 1.0);
  const Complex jwt{0.0, kTwoPi * frequency * period}, z = std::exp(jwt);
  const Complex sampled = ((z - of_v.velocity) * of_f.position + of_v.position * of_f.velocity) /
                          ((z - of_x.position) * (z - of_v.velocity) - of_v.position * of_x.velocity);
  return sampled * jwt / (1.0 - 1.0 / z);
}

// Dry friction on a lever that swings at this point's frequency and amplitude: a square wave, whose higher harmonics move
// the lever, too, and so its turn by an angle against the first. Exact as long as the lever turns once per half period and
// does not stick (Den Hartog. Forced Vibrations with Combined Coulomb and Viscous Friction. 1931).
struct FrictionWave {
  double damping = 0.0;       // [N s/m] 4 F / (pi v): first harmonic over the speed
  double sine = 0.0;          // [1] of the angle of the turn
  bool turns_cleanly = true;  // false: sticks, or turns more than once
};

FrictionWave friction_wave(const AxisModel& axis, double friction, const FrequencyPoint& point) {
  constexpr int kHighest = 41;  // harmonics above see only the mass, so the rest of the sum has a closed form
  const double w = kTwoPi * point.frequency, speed = w * point.motion;
  if (friction == 0.0 || speed == 0.0) return {};
  FrictionWave wave{4.0 * friction / (std::numbers::pi * speed)};
  wave.sine = -wave.damping / (w * axis.mass) / (2.0 * (kHighest + 1));
  wave.turns_cleanly = axis.mass * w * speed > friction;
  for (int n = 3; n <= kHighest; n += 2) {
    const Complex mobility = Complex(0.0, n * w) * compliance(axis, n * point.frequency);
    wave.sine += wave.damping / n * mobility.imag();
    if (wave.damping * std::abs(mobility) > 1.0) wave.turns_cleanly = false;
  }
  return wave;
}

// The linear axis that responds at this point's frequency and amplitude like the axis with dry friction.
AxisModel with_friction(AxisModel axis, double friction, const FrequencyPoint& point) {
  const FrictionWave wave = friction_wave(axis, friction, point);
  const double sine = std::clamp(wave.sine, -1.0, 1.0);
  axis.damping += wave.damping * std::sqrt(1.0 - sine * sine);
  axis.stiffness += wave.damping * kTwoPi * point.frequency * sine;
  return axis;
}

// The response that a frequency sweep would report for this axis.
Complex expected_response(const Parameters& p, const FrequencyPoint& point, double period) {
  const AxisModel axis = with_friction(model_of(p), p[3], point);
  const Complex held = held_compliance(axis, point.frequency, period);
  return point.held * held + (1.0 - point.held) * compliance(axis, point.frequency);
}

// Initial guess of mass m, damping b and stiffness k, which ignores the sample-and-hold. The real part of 1/G is linear
// in k and m, and the imaginary part is linear in b.
Parameters linear_fit(const std::vector<FrequencyPoint>& points) {
  double s1 = 0.0, sw = 0.0, sww = 0.0, sz = 0.0, szw = 0.0, b_numerator = 0.0, b_denominator = 0.0;
  for (const FrequencyPoint& point : points) {
    const Complex z = 1.0 / point.response;
    const double weight = 1.0 / std::norm(z * point.deviation), w = kTwoPi * point.frequency, w2 = w * w;
    s1 += weight, sw += weight * w2, sww += weight * w2 * w2;
    sz += weight * z.real(), szw += weight * z.real() * w2;
    b_numerator += weight * w * z.imag(), b_denominator += weight * w2;
  }
  const double spread = s1 * sww - sw * sw;  // of the frequencies
  if (spread < 1e-9 * s1 * sww)
    throw std::invalid_argument(
        "fit_axis: points at one frequency do not determine mass and stiffness; measure at more");
  const double mass = (sz * sw - szw * s1) / spread;
  return {mass, b_numerator / b_denominator, (sz + mass * sw) / s1, 0.0};
}

// Sums of r^2, g r and g g^T over all residuals r with gradient g, for a least-squares step. Residuals are in units of
// their standard deviation.
struct NormalEquations {
  glm::dmat4 matrix{0.0};
  Parameters slope{0.0};
  double squares = 0.0;
  int residuals = 0;

  void add(double residual, const Parameters& gradient) {
    matrix += glm::outerProduct(gradient, gradient);
    slope += gradient * residual;
    squares += residual * residual;
    ++residuals;
  }
};

// Steps of the parameters that change the response by about 1e-6 of itself, also where a parameter is 0.
Parameters derivative_steps(const std::vector<FrequencyPoint>& points, const Parameters& p) {
  const auto slowest = std::min_element(points.begin(), points.end(),
                                        [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
  const double w = kTwoPi * slowest->frequency;
  return 1e-6 * glm::max(glm::abs(p), Parameters(p[0], p[0] * w, p[0] * w * w, 1e-2));
}

NormalEquations normal_equations(const std::vector<FrequencyPoint>& points, const Parameters& p, double period) {
  const Parameters steps = derivative_steps(points, p);
  NormalEquations sum;
  for (const FrequencyPoint& point : points) {
    const auto residual = [&](const Parameters& at) {
      const Complex error = expected_response(at, point, period) / point.response - 1.0;
      return Complex(error.real() / std::hypot(point.deviation, point.rounding), error.imag() / point.deviation);
    };
    const Complex here = residual(p);
    Parameters real{0.0}, imaginary{0.0};
    for (int i = 0; i < 4; ++i) {
      Parameters shifted = p;
      shifted[i] += steps[i];
      const Complex slope = (residual(shifted) - here) / steps[i];
      real[i] = slope.real(), imaginary[i] = slope.imag();
    }
    sum.add(here.real(), real);
    sum.add(here.imag(), imaginary);
  }
  return sum;
}

// Throws if the points do not tell a parameter from the others: if its variance is more than kMaxInflation times as large
// as it would be with the others known. The derivatives' rounding hides inflations above about 1e11.
void require_told_apart(const NormalEquations& sum) {
  constexpr double kMaxInflation = 1e8;
  constexpr const char* kReasons[] = {"the mass; measure at higher frequencies, too",
                                      "the damping; measure at frequencies and amplitudes that lie further apart",
                                      "the stiffness; measure at lower frequencies, too",
                                      "the dry friction; measure at more amplitudes"};
  const glm::dmat4 inverse = glm::inverse(sum.matrix);
  int worst = 0;
  double most = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double inflation = sum.matrix[i][i] * inverse[i][i];
    if (inflation <= most) continue;
    worst = i;  // also if it is not a number
    most = inflation;
  }
  for (int i = 0; i < 4; ++i) worst = sum.matrix[i][i] == 0.0 ? i : worst;
  if (!(most < kMaxInflation) && std::isfinite(sum.squares))
    throw std::invalid_argument(std::string("fit_axis: these points do not determine ") + kReasons[worst]);
}

double misfit_of(const NormalEquations& sum) {
  return std::sqrt(sum.squares / std::max(1.0, sum.residuals - 4.0));
}

bool has_mass(const Parameters& p) {
  return p[0] > 0.0 && std::isfinite(p[0] + p[1] + p[2] + p[3]);
}

// Points at which the lever turns once per half period, without sticking.
std::vector<FrequencyPoint> turning_points(const std::vector<FrequencyPoint>& points, const Parameters& p) {
  std::vector<FrequencyPoint> turning;
  std::copy_if(points.begin(), points.end(), std::back_inserter(turning),
               [&](const FrequencyPoint& point) { return friction_wave(model_of(p), p[3], point).turns_cleanly; });
  return turning;
}

struct LeastSquares {
  Parameters parameters{0.0};
  NormalEquations sum;
  bool converged = false;
};

LeastSquares fit_points(const std::vector<FrequencyPoint>& points, double period, Parameters p) {
  constexpr int kMaxIterations = 30;
  constexpr double kConvergence =
      1e-6;  // [1] largest final step, in standard deviations; a relative limit would fail for a parameter of 0
  LeastSquares fit;
  for (int iteration = 0; iteration < kMaxIterations && !fit.converged && has_mass(p); ++iteration) {
    fit.sum = normal_equations(points, p, period);
    require_told_apart(fit.sum);
    const Parameters step = glm::inverse(fit.sum.matrix) * fit.sum.slope;
    p -= step;
    fit.converged = std::sqrt(glm::dot(step, fit.sum.slope)) <= kConvergence * std::max(1.0, misfit_of(fit.sum));
  }
  if (!has_mass(p)) throw std::invalid_argument("fit_axis: no axis with positive mass has this response");
  fit.parameters = p;
  return fit;
}

// Standard uncertainty of the parameters. A misfit beyond chance scales it. Rounding changes the gain of all points that
// have the same amplitude by the same factor, and this factor scales every parameter.
Parameters deviation_of(const std::vector<FrequencyPoint>& points, const NormalEquations& sum, const Parameters& p) {
  const double misfit = misfit_of(sum), chance = 1.0 + 3.0 / std::sqrt(2.0 * sum.residuals);
  const auto widest =
      std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.motion < b.motion; });
  const glm::dmat4 covariance = glm::inverse(sum.matrix);
  Parameters deviation;
  for (int i = 0; i < 4; ++i)
    deviation[i] = std::hypot((misfit > chance ? misfit : 1.0) * std::sqrt(covariance[i][i]), widest->rounding * p[i]);
  return deviation;
}

}  // namespace

Complex compliance(const AxisModel& axis, double frequency) noexcept {
  const double w = kTwoPi * frequency;
  return 1.0 / Complex(axis.stiffness - axis.mass * w * w, axis.damping * w);
}

AxisFit fit_axis(const FrequencyResponse& response) {
  const std::vector<FrequencyPoint> measured = measured_points(response);
  std::vector<FrequencyPoint> points = measured;
  LeastSquares fit = fit_points(points, response.period, linear_fit(points));
  for (int round = 0; round < kMaxRounds; ++round) {
    // In the last rounds points are only removed, so that the fit ends.
    const std::vector<FrequencyPoint> turning =
        turning_points(round < kMaxRounds / 2 ? measured : points, fit.parameters);
    if (turning.size() < kMinPoints)
      throw std::invalid_argument("fit_axis: dry friction holds the lever at each turn, at nearly every frequency");
    if (turning.size() == points.size()) break;
    points = turning;
    fit = fit_points(points, response.period, fit.parameters);
  }
  if (!fit.converged)
    throw std::invalid_argument(
        "fit_axis: no axis fits this response, because the fit did not converge in 30 iterations");
  const Parameters &p = fit.parameters, deviation = deviation_of(points, fit.sum, p);
  return {model_of(p), model_of(deviation), p[3], deviation[3], misfit_of(fit.sum), static_cast<int>(points.size())};
}

// Solves |1/G|^2 = 1 / gain^2 for w^2; |1/G|^2 = m^2 w^4 + (b^2 - 2 m k) w^2 + k^2 is quadratic in w^2.
double frequency_at_gain(const AxisModel& axis, double gain) noexcept {
  const double m = axis.mass, b = axis.damping, k = axis.stiffness;
  const double middle = b * b - 2.0 * m * k, rest = k * k - 1.0 / (gain * gain);
  const double root = middle * middle - 4.0 * m * m * rest;
  if (root < 0.0) return 0.0;
  const double w2 = (std::sqrt(root) - middle) / (2.0 * m * m);
  return w2 > 0.0 ? std::sqrt(w2) / kTwoPi : 0.0;
}

double bandwidth(const AxisModel& axis) noexcept {
  return axis.stiffness > 0.0 ? frequency_at_gain(axis, 1.0 / (std::numbers::sqrt2 * axis.stiffness)) : 0.0;
}

double damping_ratio(const AxisModel& axis) noexcept {
  if (axis.stiffness <= 0.0) return std::numeric_limits<double>::infinity();
  return axis.damping / (2.0 * std::sqrt(axis.mass * axis.stiffness));
}

std::array<Complex, 2> poles(const AxisModel& axis) noexcept {
  const double a = 0.5 * axis.damping / axis.mass;
  const Complex root = std::sqrt(Complex(a * a - axis.stiffness / axis.mass));
  return {-a + root, -a - root};
}

DeviceRow device_row(const DeviceSpec& spec) noexcept {
  constexpr double kDegree = std::numbers::pi / 180.0;
  DeviceRow row;
  row.continuous_force = std::min(spec.continuous_force.x, spec.continuous_force.y);
  row.step = spec.position_step;
  if (spec.yoke_radius <= 0.0) return row;
  for (int i = 0; i < 2; ++i) {
    row.range_deg[i] = 2.0 * std::asin(std::min(1.0, spec.workspace[i] / spec.yoke_radius)) / kDegree;
  }
  if (spec.position_step > 0.0) row.counts_per_deg = spec.yoke_radius * kDegree / spec.position_step;
  return row;
}

}  // namespace gearshift::haptics
