// Eigenvalues of a small real matrix, so that no other file includes Eigen.
#pragma once

#include <span>

namespace gearshift {

inline constexpr int kMostStates = 96;  // largest order

// Largest absolute value of the eigenvalues of a square matrix. entries: column by column, order x order of them,
// order 1 to kMostStates, not checked. Infinite where they are not found, as for entries that are
// not finite: to be taken for unstable. Allocates nothing.
double largest_eigenvalue(std::span<const double> entries, int order) noexcept;

}  // namespace gearshift
