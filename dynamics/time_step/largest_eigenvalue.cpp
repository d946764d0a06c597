// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/largest_eigenvalue.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace plekton::dynamics {
namespace {

using Eigen::VectorXd;

/// Of length 1, every component with a part in it; the same numbers with any standard library.
VectorXd start_vector(Eigen::Index size) {
  std::mt19937_64 random(1);
  VectorXd start(size);
  for (double& component : start)
    component = static_cast<double>(random() >> 11) * 0x1p-52 - 1.0;  // in [-1, 1)
  return start.normalized();
}

/// The matrix in the basis of Lanczos' vectors: symmetric, with nothing beside three diagonals.
class Tridiagonal {
 public:
  void add(double diagonal, double beside) {
    diagonal_.push_back(diagonal);
    beside_.push_back(beside);
  }
  int size() const noexcept { return static_cast<int>(diagonal_.size()); }

  /// The last entry of an eigenvector times the last entry beside the diagonal is the residual.
  LargestEigenvalue largest() const {
    const auto size = static_cast<Eigen::Index>(diagonal_.size());
    const VectorXd diagonal = VectorXd::Map(diagonal_.data(), size);
    const VectorXd beside = VectorXd::Map(beside_.data(), size - 1);
    // The solver takes what is beside the diagonal for zero by the square root of the diagonal: of
    // entries far from 1 it would never end, and what it then has is no eigenvalue.
    const double largest_entry =
        std::max(diagonal.cwiseAbs().maxCoeff(), size > 1 ? beside.maxCoeff() : 0.0);
    const double scale = largest_entry > 0.0 ? largest_entry : 1.0;
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
    solver.computeFromTridiagonal(diagonal / scale, beside / scale);
    const auto& values = solver.eigenvalues();  // ascending
    const Eigen::Index largest = -values[0] > values[size - 1] ? 0 : size - 1;
    const double last = solver.eigenvectors()(size - 1, largest);
    return {scale * std::abs(values[largest]), beside_.back() * std::abs(last), this->size()};
  }

 private:
  std::vector<double> diagonal_;
  std::vector<double> beside_;
};

}  // namespace

LargestEigenvalue largest_eigenvalue(const SymmetricProduct& matrix, double tolerance,
                                     int most_products) {
  constexpr int kBetweenLooks = 8;
  constexpr double kEps = std::numeric_limits<double>::epsilon();
  Tridiagonal reduced;
  VectorXd before = VectorXd::Zero(matrix.size);
  VectorXd now = matrix.size > 0 ? start_vector(matrix.size) : before;
  VectorXd next(matrix.size);
  double beside = 0.0;
  while (matrix.size > 0 && reduced.size() < most_products) {
    matrix.multiply(now, next);
    const double norm = next.norm();
    const double diagonal = now.dot(next);
    next -= diagonal * now + beside * before;
    beside = next.norm();
    reduced.add(diagonal, beside);
    // Nothing is left that the vectors so far do not span.
    const bool is_complete = !(beside > kEps * norm) || reduced.size() == matrix.size;
    if (is_complete || reduced.size() % kBetweenLooks == 0 || reduced.size() == most_products) {
      const LargestEigenvalue found = reduced.largest();
      const bool is_good = found.residual <= tolerance * found.value;
      if (is_complete || is_good || reduced.size() == most_products) return found;
    }
    before.swap(now);
    now = next / beside;
  }
  return {};
}

}  // namespace plekton::dynamics
