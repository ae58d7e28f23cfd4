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
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace gearshift::haptics {
namespace {

using Complex = std::complex<double>;

constexpr double kTwoPi = 2.0 * std::numbers::pi;

AxisModel model_of(glm::dvec3 p) {
  return {p[0], p[1], p[2]};
}

std::vector<FrequencyPoint> measured_points(const FrequencyResponse& response) {
  std::vector<FrequencyPoint> points;
  std::copy_if(response.points.begin(), response.points.end(), std::back_inserter(points),
               [](const FrequencyPoint& point) { return point.end == PointEnd::measured; });
  if (points.size() < 3) {
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

// The response that a frequency sweep would report for this axis.
Complex expected_response(const AxisModel& axis, const FrequencyPoint& point, double period) {
  const Complex held = held_compliance(axis, point.frequency, period);
  return point.held * held + (1.0 - point.held) * compliance(axis, point.frequency);
}

// Initial guess of mass m, damping b and stiffness k, which ignores the sample-and-hold. The real part of 1/G is linear
// in k and m, and the imaginary part is linear in b.
glm::dvec3 linear_fit(const std::vector<FrequencyPoint>& points) {
  double s1 = 0.0, sw = 0.0, sww = 0.0, sz = 0.0, szw = 0.0, b_numerator = 0.0, b_denominator = 0.0;
  for (const FrequencyPoint& point : points) {
    const Complex z = 1.0 / point.response;
    const double weight = 1.0 / std::norm(z * point.deviation), w = kTwoPi * point.frequency, w2 = w * w;
    s1 += weight, sw += weight * w2, sww += weight * w2 * w2;
    sz += weight * z.real(), szw += weight * z.real() * w2;
    b_numerator += weight * w * z.imag(), b_denominator += weight * w2;
  }
  const double mass = (sz * sw - szw * s1) / (s1 * sww - sw * sw);
  return {mass, b_numerator / b_denominator, (sz + mass * sw) / s1};
}

// Sums of r^2, g r and g g^T over all residuals r with gradient g, for a least-squares step. Residuals are in units of
// their standard deviation.
struct NormalEquations {
  glm::dmat3 matrix{0.0};
  glm::dvec3 slope{0.0};
  double squares = 0.0;

  void add(double residual, glm::dvec3 gradient) {
    matrix += glm::outerProduct(gradient, gradient);
    slope += gradient * residual;
    squares += residual * residual;
  }
};

NormalEquations normal_equations(const std::vector<FrequencyPoint>& points, glm::dvec3 p, double period) {
  NormalEquations sum;
  for (const FrequencyPoint& point : points) {
    const auto residual = [&](glm::dvec3 at) {
      return (expected_response(model_of(at), point, period) / point.response - 1.0) / point.deviation;
    };
    const Complex here = residual(p);
    glm::dvec3 real{0.0}, imaginary{0.0};
    for (int i = 0; i < 3; ++i) {
      glm::dvec3 shifted = p;
      const double step = 1e-6 * std::max(std::abs(p[i]), 1e-6);
      shifted[i] += step;
      const Complex slope = (residual(shifted) - here) / step;
      real[i] = slope.real(), imaginary[i] = slope.imag();
    }
    sum.add(here.real(), real);
    sum.add(here.imag(), imaginary);
  }
  return sum;
}

double misfit_of(const NormalEquations& sum, std::size_t points) {
  const double degrees_of_freedom = 2.0 * static_cast<double>(points) - 3.0;
  return std::sqrt(sum.squares / degrees_of_freedom);
}

bool has_mass(glm::dvec3 p) {
  return p[0] > 0.0 && std::isfinite(p[0] + p[1] + p[2]);
}

}  // namespace

Complex compliance(const AxisModel& axis, double frequency) noexcept {
  const double w = kTwoPi * frequency;
  return 1.0 / Complex(axis.stiffness - axis.mass * w * w, axis.damping * w);
}

AxisFit fit_axis(const FrequencyResponse& response) {
  constexpr int kMaxIterations = 30;
  constexpr double kConvergence =
      1e-6;  // [1] largest final step, in standard deviations; a relative limit would fail for a parameter of 0
  const std::vector<FrequencyPoint> points = measured_points(response);
  glm::dvec3 p = linear_fit(points);
  NormalEquations sum;
  double change = 1.0;
  for (int iteration = 0; iteration < kMaxIterations && !(change <= kConvergence) && has_mass(p); ++iteration) {
    sum = normal_equations(points, p, response.period);
    const glm::dvec3 step = glm::inverse(sum.matrix) * sum.slope;
    p -= step;
    change = std::sqrt(glm::dot(step, sum.slope)) / std::max(1.0, misfit_of(sum, points.size()));
  }
  if (!has_mass(p)) throw std::invalid_argument("fit_axis: no axis with positive mass has this response");
  if (!(change <= kConvergence))
    throw std::invalid_argument(
        "fit_axis: no axis fits this response, because the fit did not converge in 30 iterations");

  const double misfit = misfit_of(sum, points.size());
  const glm::dmat3 covariance = glm::inverse(sum.matrix);
  glm::dvec3 deviation;
  for (int i = 0; i < 3; ++i) deviation[i] = std::max(1.0, misfit) * std::sqrt(covariance[i][i]);
  return {model_of(p), model_of(deviation), misfit, static_cast<int>(points.size())};
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
