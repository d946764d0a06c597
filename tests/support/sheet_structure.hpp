// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/scene.hpp"
#include "dynamics/state/rotation_step.hpp"
#include "dynamics/structure/sheet_facets.hpp"
#include "dynamics/structure/sheet_kernel.hpp"
#include "tests/support/linear_algebra.hpp"

#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

/// Statics of sheets, from the forces of the library alone. A displacement has six entries for each
/// node: translation (m), then rotation vector (rad) in world axes.
namespace plekton::test {

using dynamics::Held;
using dynamics::NodeState;
using dynamics::Scene;
using dynamics::SheetFacets;
using geometry::NodeId;
using geometry::Vec3;

/// The state after a displacement; rotations are exact.
inline NodeState moved(NodeState state, const Eigen::VectorXd& displacement) {
  for (std::size_t i = 0; i < state.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(6 * i);
    state.position[i] += displacement.segment<3>(k);
    state.orientation[i] =
        dynamics::turned(state.orientation[i], displacement.segment<3>(k + 3), 1.0).normalized();
  }
  return state;
}

/// Forces (N) and torques (N m) of the sheets on the nodes.
inline Eigen::VectorXd sheet_forces(SheetFacets& sheets, const NodeState& state, int threads = 1) {
  geometry::ThreadPool pool(threads);
  contact::NodeForces forces(state.size());
  sheets.advance(state, 0.0, pool);
  sheets.add_forces(forces, pool);
  Eigen::VectorXd stacked(static_cast<Eigen::Index>(6 * state.size()));
  for (std::size_t i = 0; i < state.size(); ++i)
    stacked.segment<6>(static_cast<Eigen::Index>(6 * i)) << forces.force[i], forces.torque[i];
  return stacked;
}

/// Dead loads, and a pressure (Pa) on the front of all facets that follows them: p A / 3 n on each
/// corner.
struct SheetLoads {
  Eigen::VectorXd dead;  ///< N and N m; empty if there are none
  double pressure = 0.0;
};

/// Newton's method with a line search for a scene of sheets. Matrices from central differences of
/// one facet after the other.
class SheetStatics {
 public:
  explicit SheetStatics(Scene& scene)
      : scene_(scene), sheets_(scene.sheet_facets, scene.state.size()) {
    for (const auto& facet : scene.sheet_facets) springs_.push_back(dynamics::spring_of(facet));
    for (const Held held : scene.properties.held) {
      for (int k = 0; k < 6; ++k)
        is_free_.push_back(k < 3 ? !holds_translation(held) : !holds_rotation(held));
    }
  }

  /// Moves the nodes of the scene to where they balance the loads.
  /// @throws std::runtime_error if it does not converge
  void balance(const SheetLoads& loads) {
    for (int iteration = 0; iteration < 200; ++iteration) {
      const Eigen::VectorXd residual = free_part(forces(scene_.state, loads));
      const Eigen::VectorXd change = solve(matrix(loads), residual);
      const double length = shorten(change, residual, loads);
      scene_.state = moved(scene_.state, length * change);
      if (change.lpNorm<Eigen::Infinity>() < 1e-9) return;
    }
    throw std::runtime_error("the sheet does not come to rest");
  }

  SheetFacets& sheets() { return sheets_; }

 private:
  Eigen::VectorXd forces(const NodeState& state, const SheetLoads& loads) {
    Eigen::VectorXd result = sheet_forces(sheets_, state);
    if (loads.dead.size() > 0) result += loads.dead;
    for (const auto& facet : scene_.sheet_facets) {
      const Vec3 push = pressure_on(facet, state, loads.pressure);
      for (const NodeId node : facet.nodes)
        result.segment<3>(static_cast<Eigen::Index>(6 * index_of(node))) += push;
    }
    return result;
  }

  static Vec3 pressure_on(const dynamics::SheetFacet& facet, const NodeState& state,
                          double pressure) {
    const Vec3& x0 = state.position[index_of(facet.nodes[0])];
    return pressure / 6.0 *
           (state.position[index_of(facet.nodes[1])] - x0)
               .cross(state.position[index_of(facet.nodes[2])] - x0);
  }

  Eigen::VectorXd free_part(Eigen::VectorXd all) const {
    for (std::size_t i = 0; i < is_free_.size(); ++i)
      if (!is_free_[i]) all[static_cast<Eigen::Index>(i)] = 0.0;
    return all;
  }

  /// Forces (18) on the corners of a facet alone.
  Eigen::Matrix<double, 18, 1> facet_forces(std::size_t i, const NodeState& corners,
                                            double pressure) const {
    constexpr std::array<NodeId, 3> kCorners{NodeId{0}, NodeId{1}, NodeId{2}};
    const auto reaction =
        dynamics::sheet_reaction(springs_[i], dynamics::pose_of(springs_[i], kCorners, corners));
    dynamics::SheetFacet facet = scene_.sheet_facets[i];
    facet.nodes = kCorners;
    const Vec3 push = pressure_on(facet, corners, pressure);
    Eigen::Matrix<double, 18, 1> result;
    for (std::size_t a = 0; a < 3; ++a)
      result.segment<6>(static_cast<Eigen::Index>(6 * a)) << reaction.force[a] + push,
          reaction.torque[a];
    return result;
  }

  Eigen::Matrix<double, 18, 18> facet_matrix(std::size_t i, const SheetLoads& loads) const {
    NodeState corners;
    const auto& facet = scene_.sheet_facets[i];
    for (const NodeId node : facet.nodes) {
      corners.position.push_back(scene_.state.position[index_of(node)]);
      corners.orientation.push_back(scene_.state.orientation[index_of(node)]);
      corners.velocity.push_back(Vec3::Zero());
      corners.angular_velocity.push_back(Vec3::Zero());
    }
    const double size = std::sqrt(dynamics::area_of(facet));
    Eigen::Matrix<double, 18, 18> result;
    for (Eigen::Index k = 0; k < 18; ++k) {
      const double step = 1e-6 * (k % 6 < 3 ? size : 1.0);
      const Eigen::VectorXd change = step * Eigen::VectorXd::Unit(18, k);
      result.col(k) = (facet_forces(i, moved(corners, -change), loads.pressure) -
                       facet_forces(i, moved(corners, change), loads.pressure)) /
                      (2.0 * step);
    }
    return 0.5 * (result + result.transpose());
  }

  Eigen::SparseMatrix<double> matrix(const SheetLoads& loads) const {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t i = 0; i < springs_.size(); ++i) {
      const auto part = facet_matrix(i, loads);
      for (std::size_t a = 0; a < 18; ++a) {
        const std::size_t row = 6 * index_of(scene_.sheet_facets[i].nodes[a / 6]) + a % 6;
        for (std::size_t b = 0; b < 18; ++b) {
          const std::size_t column = 6 * index_of(scene_.sheet_facets[i].nodes[b / 6]) + b % 6;
          if (is_free_[row] && is_free_[column])
            entries.emplace_back(static_cast<int>(row), static_cast<int>(column),
                                 part(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)));
        }
      }
    }
    for (std::size_t i = 0; i < is_free_.size(); ++i)
      if (!is_free_[i]) entries.emplace_back(static_cast<int>(i), static_cast<int>(i), 1.0);
    const auto size = static_cast<Eigen::Index>(is_free_.size());
    Eigen::SparseMatrix<double> result(size, size);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

  /// With more on the diagonal until the matrix is positive definite.
  static Eigen::VectorXd solve(Eigen::SparseMatrix<double> matrix,
                               const Eigen::VectorXd& residual) {
    const Eigen::VectorXd diagonal = matrix.diagonal().cwiseAbs();
    for (double share = 0.0; share < 1e3; share = std::max(1e-9, 10.0 * share)) {
      Eigen::SparseMatrix<double> trial = matrix;
      trial.diagonal() += share * diagonal;
      if (const auto solution = solve_positive_definite(trial, residual)) return *solution;
    }
    throw std::runtime_error("no matrix of the sheet is positive definite");
  }

  /// How far to go along a change so that what is left of the force along it falls; all the way
  /// where no short way does: thin sheets that turn by much have to pass through large stretches.
  double shorten(const Eigen::VectorXd& change, const Eigen::VectorXd& residual,
                 const SheetLoads& loads) {
    const double before = residual.dot(change);
    for (double length = 1.0; length > 0.05; length *= 0.5) {
      const Eigen::VectorXd after = free_part(forces(moved(scene_.state, length * change), loads));
      if (std::abs(after.dot(change)) <= 0.9 * before || before < 1e-14) return length;
    }
    return 1.0;
  }

  Scene& scene_;
  SheetFacets sheets_;
  std::vector<dynamics::SheetSpring> springs_;
  std::vector<bool> is_free_;
};

}  // namespace plekton::test
