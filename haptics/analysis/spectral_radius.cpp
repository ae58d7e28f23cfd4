#include "haptics/analysis/spectral_radius.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace gearshift::haptics {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxStates, kMaxStates>;

// Absolute value of the conjugate pair of eigenvalues of the 2x2 block that starts at i, computed without overflow.
double pair_size(const Matrix& blocks, Eigen::Index i) {
  const double p = 0.5 * (blocks(i, i) - blocks(i + 1, i + 1)), low = blocks(i + 1, i), high = blocks(i, i + 1);
  const double unit = std::max({std::abs(p), std::abs(low), std::abs(high)});
  const double imaginary = unit * std::sqrt(std::abs(p / unit * (p / unit) + low / unit * (high / unit)));
  return std::hypot(blocks(i + 1, i + 1) + p, imaginary);
}

}  // namespace

// Computes the same eigenvalues as Eigen::EigenSolver, bit for bit. That class also computes eigenvectors, which are
// not needed here and double the compile time.
double largest_eigenvalue(std::span<const double> entries, int order) noexcept {
  constexpr double kNotFound = std::numeric_limits<double>::infinity();
  const Eigen::Map<const Eigen::MatrixXd> matrix(entries.data(), order, order);
  if (!matrix.allFinite()) return kNotFound;
  const double scale = matrix.cwiseAbs().maxCoeff();
  if (scale < std::numeric_limits<double>::min()) return 0.0;
  const Eigen::HessenbergDecomposition<Matrix> hessenberg(Matrix(matrix / scale));
  Eigen::RealSchur<Matrix> schur(order);
  schur.computeFromHessenberg(hessenberg.matrixH(), Matrix(), false);
  if (schur.info() != Eigen::Success) return kNotFound;
  const Matrix blocks = schur.matrixT() * scale;  // diagonal blocks: 1x1 for a real eigenvalue, 2x2 for a pair
  double largest = 0.0;
  for (Eigen::Index i = 0; i < order; ++i) {
    const bool is_pair = i + 1 < order && blocks(i + 1, i) != 0.0;
    const double size = is_pair ? pair_size(blocks, i) : std::abs(blocks(i, i));
    if (!std::isfinite(size)) return kNotFound;
    largest = std::max(largest, size);
    if (is_pair) ++i;
  }
  return largest;
}

}  // namespace gearshift::haptics
