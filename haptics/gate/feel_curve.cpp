#include "haptics/gate/feel_curve.h"

#include <algorithm>
#include <cstddef>

namespace gearshift::haptics {
namespace {

// Returns the piece of the curve that contains `at`. A linear scan is faster than a binary search, because the curve is
// short.
const FeelCurve::Piece& piece_at(const FeelCurve& curve, double at) noexcept {
  std::size_t i = 0;
  while (i + 1 < static_cast<std::size_t>(curve.pieces) && curve.piece[i + 1].from <= at) ++i;
  return curve.piece[i];
}

// Coefficients of the cubic through both knots that has the force and slope given at each knot. The cubic is in powers
// of u = at - a.at.
std::array<double, 4> hermite(const FeelKnot& a, const FeelKnot& b) noexcept {
  const double h = b.at - a.at;
  const double rise = (b.force - a.force) / h;
  return {a.force, a.slope, (3.0 * rise - 2.0 * a.slope - b.slope) / h, (a.slope + b.slope - 2.0 * rise) / (h * h)};
}

double piece_slope(const FeelCurve::Piece& piece, double u) noexcept {
  const auto& c = piece.c;
  return c[1] + u * (2.0 * c[2] + 3.0 * u * c[3]);
}

}  // namespace

FeelCurve make_feel_curve(std::span<const FeelKnot> knots) noexcept {
  FeelCurve curve;
  if (knots.empty()) return curve;
  curve.force_before = knots.front().force;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    FeelCurve::Piece& piece = curve.piece[i];
    piece.from = knots[i].at;
    const bool last = i + 1 == knots.size();
    piece.c = last ? std::array<double, 4>{knots[i].force, 0.0, 0.0, 0.0} : hermite(knots[i], knots[i + 1]);
  }
  curve.pieces = static_cast<int>(knots.size());
  return curve;
}

double feel_force(const FeelCurve& curve, double at) noexcept {
  if (curve.pieces == 0) return 0.0;
  if (at < curve.piece[0].from) return curve.force_before;
  const FeelCurve::Piece& piece = piece_at(curve, at);
  const double u = at - piece.from;
  return piece.c[0] + u * (piece.c[1] + u * (piece.c[2] + u * piece.c[3]));
}

SlopeRange slope_range(const FeelCurve& curve) noexcept {
  SlopeRange range;
  const auto include = [&range](double slope) {
    range.min = std::min(range.min, slope);
    range.max = std::max(range.max, slope);
  };
  for (std::size_t i = 0; i + 1 < static_cast<std::size_t>(curve.pieces); ++i) {
    const FeelCurve::Piece& piece = curve.piece[i];
    const double end = curve.piece[i + 1].from - piece.from;
    include(piece_slope(piece, 0.0));
    include(piece_slope(piece, end));
    // The slope of a cubic is a parabola. Its extreme is where the second derivative is zero.
    if (piece.c[3] == 0.0) continue;
    const double u = -piece.c[2] / (3.0 * piece.c[3]);
    if (u > 0.0 && u < end) include(piece_slope(piece, u));
  }
  return range;
}

}  // namespace gearshift::haptics
