// Spectral radius of a small real matrix. The haptics library uses Eigen only here.
#pragma once

#include <span>

namespace gearshift::haptics {

inline constexpr int kMaxStates = 96;  // largest order

// Largest absolute value of the eigenvalues of a square matrix. entries: order x order values, column by column. order:
// 1 to kMaxStates, not checked. Returns infinity, which counts as unstable, if the eigenvalues cannot be computed, for
// example because an entry is not finite. Does not allocate.
double largest_eigenvalue(std::span<const double> entries, int order) noexcept;

}  // namespace gearshift::haptics
