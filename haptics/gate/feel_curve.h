// Force along one axis as a function of position: piecewise cubic with continuous force and slope.
#pragma once

#include <array>
#include <span>

namespace gearshift::haptics {

struct FeelKnot {
  double at = 0.0;     // [m] position
  double force = 0.0;  // [N] positive along the axis
  double slope = 0.0;  // [N/m]
};

inline constexpr int kMaxFeelKnots = 16;

// Cubic Hermite pieces between knots. The force is constant before the first knot and after the last. Trivially
// copyable, because a Gate contains such curves and must be trivially copyable.
struct FeelCurve {
  struct Piece {
    double from = 0.0;          // [m]
    std::array<double, 4> c{};  // force = c0 + c1 u + c2 u^2 + c3 u^3 with u = at - from
  };
  int pieces = 0;  // number of pieces, including the constant piece after the last knot
  std::array<Piece, kMaxFeelKnots> piece{};
  double force_before = 0.0;  // [N] force before the first knot
};

// `knots`: 1 to kMaxFeelKnots knots at strictly increasing positions.
FeelCurve make_feel_curve(std::span<const FeelKnot> knots) noexcept;

// The force [N] at position `at`.
double feel_force(const FeelCurve& curve, double at) noexcept;

// Exact extremes of the slope dF/dx on the whole curve. A restoring force, for example a spring, has a negative slope,
// and its stiffness is -min.
struct SlopeRange {
  double min = 0.0;  // [N/m] <= 0
  double max = 0.0;  // [N/m] >= 0
};
SlopeRange slope_range(const FeelCurve& curve) noexcept;

}  // namespace gearshift::haptics
