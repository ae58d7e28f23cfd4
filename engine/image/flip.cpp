// This work is based on:
// Pontus Andersson, Jim Nilsson, Tomas Akenine-Möller, Magnus Oskarsson, Kalle Åström, Mark D. Fairchild.
// FLIP: A Difference Evaluator for Alternating Images. Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020
#include "engine/image/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace gearshift::engine {

namespace {

using glm::dvec3;
using std::numbers::pi;

// Constants from the paper: section 4.1.4 (error exponent and redistribution) and section 4.2 (feature width and
// exponent).
constexpr double kColourExponent = 0.7, kKneeIn = 0.4, kKneeOut = 0.95, kFeatureWidth = 0.082, kFeatureExponent = 0.5;

// Contrast sensitivity: sums of the Gaussians a * sqrt(pi / b) * exp(-(pi x)^2 / b), with x in degrees and the
// coefficients a and b of the paper's table 1 (section 4.1.1).
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr Sensitivity kLuminance{1.0, 0.0047, 0.0, 1e-5}, kRedGreen{1.0, 0.0053, 0.0, 1e-5},
    kBlueYellow{34.1, 0.04, 13.5, 0.025};
constexpr double kWidestSensitivity = 0.04;

// --- colour spaces ---

const glm::dmat3 xyz_of_rgb =
    glm::transpose(glm::dmat3(0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750, 0.0193339, 0.1191920,
                              0.9503041));  // IEC 61966-2-1, D65
const glm::dmat3 rgb_of_xyz = glm::inverse(xyz_of_rgb);
const dvec3 white = xyz_of_rgb * dvec3(1.0);

double linear_of(std::uint8_t srgb) {
  const double s = srgb / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

// Converts XYZ to opponent colours. They are linear in light, as the filters below require.
dvec3 ycc_of_xyz(dvec3 xyz) {
  const dvec3 n = xyz / white;
  return {116.0 * n.y - 16.0, 500.0 * (n.x - n.y), 200.0 * (n.y - n.z)};
}

dvec3 xyz_of_ycc(dvec3 ycc) {
  const double y = (ycc.x + 16.0) / 116.0;
  return dvec3(y + ycc.y / 500.0, y, y - ycc.z / 200.0) * white;
}

dvec3 lab_of_rgb(dvec3 rgb) {
  constexpr double knee = 6.0 / 29.0;
  const auto f = [](double t) { return t > knee * knee * knee ? std::cbrt(t) : t / (3.0 * knee * knee) + 4.0 / 29.0; };
  const dvec3 n = xyz_of_rgb * rgb / white;
  return {116.0 * f(n.y) - 16.0, 500.0 * (f(n.x) - f(n.y)), 200.0 * (f(n.y) - f(n.z))};
}

// Hunt effect: colours look less colourful in the dark (section 4.1.2).
dvec3 hunt(dvec3 lab) {
  return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}

// HyAB colour distance, which suits large differences (section 4.1.3).
double hyab(dvec3 a, dvec3 b) {
  return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

// --- separable filters; beyond the border, the outermost pixels are repeated ---

using Plane = std::vector<double>;

struct Size {
  int width = 0, height = 0;
  std::size_t index(int x, int y) const {
    const long row = std::clamp(y, 0, height - 1), column = std::clamp(x, 0, width - 1);
    return static_cast<std::size_t>(row * width + column);
  }
};

// Filter weights at offsets from -radius to radius.
using Kernel = std::vector<double>;

template <typename Weight>
Kernel kernel(int radius, Weight weight) {
  Kernel k;
  for (int i = -radius; i <= radius; ++i) k.push_back(weight(static_cast<double>(i)));
  return k;
}

double sum(const Kernel& k) {
  return std::accumulate(k.begin(), k.end(), 0.0);
}

Plane filtered(const Plane& in, Size size, const Kernel& along_x, const Kernel& along_y) {
  const auto pass = [size](const Plane& from, const Kernel& k, int dx, int dy) {
    const int radius = static_cast<int>(k.size()) / 2;
    Plane to(from.size());
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        double total = 0.0;
        int i = -radius;
        for (const double weight : k) {
          total += weight * from[size.index(x + i * dx, y + i * dy)];
          ++i;
        }
        to[size.index(x, y)] = total;
      }
    }
    return to;
  };
  return pass(pass(in, along_x, 1, 0), along_y, 0, 1);
}

Plane blurred(const Plane& in, Size size, const Sensitivity& s, double pixels_per_degree) {
  const int radius =
      static_cast<int>(std::ceil(3.0 * std::sqrt(kWidestSensitivity / (2.0 * pi * pi)) * pixels_per_degree));
  const auto gaussian = [&](double b) {
    return kernel(radius,
                  [=](double i) { return std::exp(-pi * pi * i * i / (pixels_per_degree * pixels_per_degree * b)); });
  };
  Plane out(in.size(), 0.0);
  double weight = 0.0;
  for (const auto& [a, b] : {std::pair(s.a1, s.b1), std::pair(s.a2, s.b2)}) {
    if (a == 0.0) continue;
    const Kernel k = gaussian(b);
    const double height = a * std::sqrt(pi / b);
    const Plane part = filtered(in, size, k, k);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += height * part[i];
    weight += height * sum(k) * sum(k);
  }
  for (double& value : out) value /= weight;
  return out;
}

// --- colour error (section 4.1) ---

struct Ycc {
  Plane y, cx, cz;
};

Ycc opponent(const Image& image) {
  double linear[256];
  for (int i = 0; i < 256; ++i) linear[i] = linear_of(static_cast<std::uint8_t>(i));
  Ycc out;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    const dvec3 rgb(linear[image.rgba[i]], linear[image.rgba[i + 1]], linear[image.rgba[i + 2]]);
    const dvec3 ycc = ycc_of_xyz(xyz_of_rgb * rgb);
    out.y.push_back(ycc.x);
    out.cx.push_back(ycc.y);
    out.cz.push_back(ycc.z);
  }
  return out;
}

// Returns the picture as the eye resolves it, in L*a*b* after the Hunt adjustment.
std::vector<dvec3> perceived(const Ycc& in, Size size, double pixels_per_degree) {
  const Plane y = blurred(in.y, size, kLuminance, pixels_per_degree);
  const Plane cx = blurred(in.cx, size, kRedGreen, pixels_per_degree);
  const Plane cz = blurred(in.cz, size, kBlueYellow, pixels_per_degree);
  std::vector<dvec3> out;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const dvec3 rgb = rgb_of_xyz * xyz_of_ycc({y[i], cx[i], cz[i]});
    out.push_back(hunt(lab_of_rgb(glm::clamp(rgb, 0.0, 1.0))));
  }
  return out;
}

// Maps a colour distance to a value between 0 and 1. Small distances get most of this range (section 4.1.4). The
// largest distance is that between green and blue.
double redistributed(double distance) {
  static const double max_distance =
      std::pow(hyab(hunt(lab_of_rgb({0, 1, 0})), hunt(lab_of_rgb({0, 0, 1}))), kColourExponent);
  const double error = std::pow(distance, kColourExponent), knee = kKneeIn * max_distance;
  return error < knee ? kKneeOut * error / knee : kKneeOut + (1.0 - kKneeOut) * (error - knee) / (max_distance - knee);
}

// --- feature error (section 4.2): edges and points in the luminance, detected with the derivatives of a Gaussian ---

struct Features {
  Plane edge, point;
};

// Scales the positive weights to a sum of 1 and the negative ones to a sum of -1.
Kernel balanced(Kernel k) {
  double positive = 0.0, negative = 0.0;
  for (const double w : k) (w > 0.0 ? positive : negative) += std::abs(w);
  for (double& w : k) w /= w > 0.0 ? positive : negative;
  return k;
}

Features features(const Plane& luminance, Size size, double pixels_per_degree) {
  const double sigma = 0.5 * kFeatureWidth * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3.0 * sigma));
  const auto g = [=](double i) { return std::exp(-i * i / (2.0 * sigma * sigma)); };
  Kernel smooth = kernel(radius, g);
  const double total = sum(smooth);
  for (double& w : smooth) w /= total;
  const Kernel first = balanced(kernel(radius, [&](double i) { return -i * g(i); }));
  const Kernel second = balanced(kernel(radius, [&](double i) { return (i * i / (sigma * sigma) - 1.0) * g(i); }));
  Plane grey(luminance.size());
  std::transform(luminance.begin(), luminance.end(), grey.begin(), [](double y) { return (y + 16.0) / 116.0; });
  const auto strength = [&](const Kernel& k) {
    const Plane x = filtered(grey, size, k, smooth), y = filtered(grey, size, smooth, k);
    Plane out(x.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::hypot(x[i], y[i]);
    return out;
  };
  return {strength(first), strength(second)};
}

}  // namespace

FlipError flip(const Image& reference, const Image& test, double pixels_per_degree) {
  if (reference.width != test.width || reference.height != test.height || reference.rgba.empty()) {
    throw std::invalid_argument("flip: the images differ in size, or are empty");
  }
  const Size size{reference.width, reference.height};
  const Ycc a = opponent(reference), b = opponent(test);
  const std::vector<dvec3> colour_a = perceived(a, size, pixels_per_degree);
  const std::vector<dvec3> colour_b = perceived(b, size, pixels_per_degree);
  const Features feature_a = features(a.y, size, pixels_per_degree), feature_b = features(b.y, size, pixels_per_degree);
  FlipError error;
  for (std::size_t i = 0; i < colour_a.size(); ++i) {
    const double colour = redistributed(hyab(colour_a[i], colour_b[i]));
    const double feature =
        std::max(std::abs(feature_a.edge[i] - feature_b.edge[i]), std::abs(feature_a.point[i] - feature_b.point[i]));
    const double sharpened = std::pow(feature / std::numbers::sqrt2, kFeatureExponent);
    error.map.push_back(std::pow(colour, 1.0 - sharpened));  // section 4.3
  }
  error.mean = std::accumulate(error.map.begin(), error.map.end(), 0.0) / static_cast<double>(error.map.size());
  return error;
}

}  // namespace gearshift::engine
