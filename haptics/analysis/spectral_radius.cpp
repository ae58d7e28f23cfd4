#include "haptics/analysis/spectral_radius.h"

#include <Eigen/Eigenvalues>
#include <limits>

namespace gearshift {

double largest_eigenvalue(std::span<const double> entries, int order) noexcept {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMostStates, kMostStates>;
  const Eigen::Map<const Eigen::MatrixXd> matrix(entries.data(), order, order);
  if (!matrix.allFinite()) return std::numeric_limits<double>::infinity();
  const Eigen::EigenSolver<Matrix> solver(Matrix(matrix), false);
  if (solver.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  return solver.eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace gearshift
