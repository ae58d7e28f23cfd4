// Force along one axis as a function of position: piecewise cubic, continuous in force and slope.
#pragma once

#include <array>
#include <span>

namespace gearshift {

struct FeelKnot {
  double at = 0.0;     // [m]
  double force = 0.0;  // [N] along the axis
  double slope = 0.0;  // [N/m]
};

inline constexpr int kMaxFeelKnots = 16;

// Cubic Hermite pieces between knots; before the first and after the last knot the force is constant.
// Trivially copyable: part of a compiled Gate.
struct FeelCurve {
  struct Piece {
    double from = 0.0;          // [m]
    std::array<double, 4> c{};  // force = c0 + c1 u + c2 u^2 + c3 u^3, u = at - from
    double work = 0.0;          // [J] integral of the force from the first knot to `from`
  };
  int pieces = 0;  // the last piece is the constant after the last knot
  std::array<Piece, kMaxFeelKnots> piece{};
  double before = 0.0;  // [N] force before the first knot
};

// 1 to kMaxFeelKnots knots with strictly rising positions.
FeelCurve make_feel_curve(std::span<const FeelKnot> knots) noexcept;

double feel_force(const FeelCurve& curve, double at) noexcept;  // [N]
double feel_slope(const FeelCurve& curve, double at) noexcept;  // [N/m] dF/dx
double feel_work(const FeelCurve& curve,
                 double at) noexcept;  // [J] integral of the force from the first knot
double stiffest_slope(
    const FeelCurve& curve) noexcept;  // [N/m] largest restoring stiffness max(-dF/dx), >= 0

}  // namespace gearshift
