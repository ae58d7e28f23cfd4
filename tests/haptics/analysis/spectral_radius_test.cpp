// Tests with matrices whose eigenvalues are known.
#include "haptics/analysis/spectral_radius.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

using namespace gearshift::haptics;

TEST_CASE("a scaled rotation by any angle has its scale as radius") {
  for (const double angle : {0.0, 0.3, 1.5, 3.1}) {
    const double c = 0.97 * std::cos(angle), s = 0.97 * std::sin(angle);
    const std::array<double, 4> turn{c, s, -s, c};
    CHECK(largest_eigenvalue(turn, 2) == doctest::Approx(0.97).epsilon(1e-14));
  }
}

TEST_CASE("the companion of z^n = 2 has the nth root of 2, up to the largest order") {
  for (const int n : {1, 2, 5, 17, kMaxStates}) {
    const auto order = static_cast<std::size_t>(n);
    std::vector<double> companion(order * order, 0.0);
    for (std::size_t i = 0; i + 1 < order; ++i) companion[i * order + i + 1] = 1.0;
    companion[(order - 1) * order] = 2.0;
    CHECK(largest_eigenvalue(companion, n) == doctest::Approx(std::pow(2.0, 1.0 / n)).epsilon(1e-12));
  }
}

TEST_CASE("entries that are not finite count as unstable") {
  const std::array<double, 4> broken{0.5, std::numeric_limits<double>::quiet_NaN(), 0.0, 0.5};
  CHECK(std::isinf(largest_eigenvalue(broken, 2)));
}
