// Force along one axis as a function of position: piecewise cubic with continuous force and slope.
#pragma once

#include <array>
#include <span>

namespace gearshift::haptics {

struct FeelKnot {
  double at = 0.0;     // [m] position
  double force = 0.0;  // [N] along the axis
  double slope = 0.0;  // [N/m]
};

inline constexpr int kMaxFeelKnots = 16;

// Cubic Hermite pieces between knots; constant before the first and after the last knot. Trivially copyable, because
// the curve is part of a compiled Gate.
struct FeelCurve {
  struct Piece {
    double from = 0.0;          // [m]
    std::array<double, 4> c{};  // force = c0 + c1 u + c2 u^2 + c3 u^3, u = at - from
    double work = 0.0;          // [J] integral of the force from the first knot to `from`
  };
  int pieces = 0;  // the last piece is the constant after the last knot
  std::array<Piece, kMaxFeelKnots> piece{};
  double force_before = 0.0;  // [N] force before the first knot
};

// knots: 1 to kMaxFeelKnots, at strictly increasing positions.
FeelCurve make_feel_curve(std::span<const FeelKnot> knots) noexcept;

// The force, its slope dF/dx, and its integral from the first knot. [N], [N/m], [J]
double feel_force(const FeelCurve& curve, double at) noexcept;
double feel_slope(const FeelCurve& curve, double at) noexcept;
double feel_work(const FeelCurve& curve, double at) noexcept;

// Exact extremes of dF/dx on the whole curve. A restoring force, such as a spring, has stiffness -min.
struct SlopeRange {
  double min = 0.0;  // [N/m] <= 0
  double max = 0.0;  // [N/m] >= 0
};
SlopeRange slope_range(const FeelCurve& curve) noexcept;

}  // namespace gearshift::haptics
