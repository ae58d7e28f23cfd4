// Compares the split-sum BRDF table with the published sum over Hammersley points (see hammersley_brdf.h).
#include <algorithm>
#include <cmath>
#include <random>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vec3.hpp>

#include "app/lab/bench/picture/hammersley_brdf.h"
#include "engine/light/environment.h"

using namespace gearshift::engine;
using namespace gearshift::lab;
using glm::dvec2;

namespace {

struct Error {
  double rms = 0.0, worst = 0.0;
};
template <class Method>
Error error_of(Method method) {
  Error error;
  int count = 0;
  for (int j = 0; j < 16; ++j) {
    for (int i = 0; i < 16; ++i) {
      const double n_dot_v = (i + 0.5) / 16.0, roughness = (j + 0.5) / 16.0;
      const dvec2 off = glm::abs(dvec2(method(n_dot_v, roughness)) - hammersley_sum(n_dot_v, roughness, 16384));
      error.rms += glm::dot(off, off);
      error.worst = std::max({error.worst, off.x, off.y});
      count += 2;
    }
  }
  error.rms = std::sqrt(error.rms / count);
  return error;
}

}  // namespace

TEST_CASE("128 evaluations beat 1024 Hammersley points against the 16,384-sample sum") {
  const Error quadrature = error_of([](double v, double r) { return environment_brdf(v, r, 128); });
  const Error hammersley = error_of([](double v, double r) { return hammersley_sum(v, r, 1024); });
  MESSAGE("rms and worst: " << quadrature.rms << " " << quadrature.worst << ", 1024 Hammersley points "
                            << hammersley.rms << " " << hammersley.worst);
  CHECK(quadrature.rms < 0.0010);
  CHECK(quadrature.rms < hammersley.rms);
}

TEST_CASE("the baked table, as a GPU filters it, is within .0010 RMS of the 16,384-sample sum") {
  const BrdfTable table = bake_brdf();
  const Error error = error_of([&](double v, double r) { return table.sample(float(v), float(r)); });
  MESSAGE("table " << table.side << "^2: rms " << error.rms << ", worst " << error.worst);
  CHECK(error.rms < 0.0010);
  // Random points also test the interpolation between the table's texel centres.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.02, 1.0);
  double squares = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double v = unit(random), r = unit(random);
    const dvec2 off = dvec2(table.sample(float(v), float(r))) - environment_brdf(v, r, 2048);
    squares += glm::dot(off, off) / 800.0;
  }
  CHECK(std::sqrt(squares) < 0.0010);
}

TEST_CASE("more evaluations converge") {
  double last = 1.0;
  for (const int samples : {8, 32, 128, 512}) {
    double squares = 0.0;
    for (int i = 0; i < 64; ++i) {
      const int column = i % 8, row = i / 8;
      const double v = (column + 0.5) / 8.0, r = (row + 0.5) / 8.0;
      const dvec2 off = environment_brdf(v, r, samples) - environment_brdf(v, r, 32768);
      squares += glm::dot(off, off) / 128.0;
    }
    CHECK(std::sqrt(squares) < 0.6 * last);
    last = std::sqrt(squares);
  }
}

TEST_CASE("a smooth surface reflects by Fresnel's term only; no surface reflects more light than it receives") {
  for (const double v : {0.1, 0.4, 0.9}) {
    const double fresnel = std::pow(1.0 - v, 5.0);
    const dvec2 mirror = environment_brdf(v, 0.0, 256);
    CHECK(mirror.x == doctest::Approx(1.0 - fresnel).epsilon(1e-3));
    CHECK(mirror.y == doctest::Approx(fresnel).epsilon(1e-2));
    double last = 1.1;
    for (const double r : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const dvec2 ab = environment_brdf(v, r, 256);
      CHECK(ab.x + ab.y <= 1.0 + 1e-9);
      CHECK(ab.x + ab.y < last);  // single scattering loses more energy at higher roughness
      last = ab.x + ab.y;
    }
  }
}
