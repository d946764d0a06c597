// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/sheet_bounds.hpp"

#include "dynamics/stiffness/nodal_stiffness.hpp"
#include "dynamics/stiffness/small_eigenvalue.hpp"
#include "dynamics/structure/sheet_kernel.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::dynamics {
namespace {

/// Stiffness matrix (N/m) against motion in the plane, two displacements a node. To stretching is
/// added what the springs against turning take of it: 1/2 c (w - u)² <= c w² + c u² for each of the
/// three corners, u the rotation of the facet.
Mat6 in_plane_stiffness(const SheetSpring& spring) {
  Eigen::Matrix<double, 3, 6> strain;
  Eigen::Matrix<double, 6, 1> rotation;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2& g = spring.shape.gradients[i];
    const auto k = static_cast<Eigen::Index>(2 * i);
    strain.col(k) << g.x(), 0.0, g.y();
    strain.col(k + 1) << 0.0, g.y(), g.x();
    rotation.segment<2>(k) << -0.5 * g.y(), 0.5 * g.x();
  }
  const double nu = spring.poisson_ratio;
  Mat3 elastic;
  elastic << 1.0, nu, 0.0, nu, 1.0, 0.0, 0.0, 0.0, 0.5 * (1.0 - nu);
  return (spring.shape.area * spring.tensile_stiffness) * (strain.transpose() * elastic * strain) +
         (6.0 * spring.turning) * (rotation * rotation.transpose());
}

/// Stiffness matrix (N/m) against motion along the normal (3) and rotations across it (2 a node),
/// these times the radius of gyration.
Eigen::Matrix<double, 9, 9> bending_stiffness(const SheetSpring& spring, double gyration) {
  Eigen::Matrix<double, 6, 9> openings = Eigen::Matrix<double, 6, 9>::Zero();
  const double per_radius = 1.0 / std::sqrt(gyration);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t side = 0; side < 2; ++side) {
      const std::size_t j = (i + 1 + side) % 3;
      const Vec2 edge = spring.corners[j] - spring.corners[i];
      const auto row = static_cast<Eigen::Index>(2 * i + side);
      openings(row, static_cast<Eigen::Index>(j)) = 1.0;
      openings(row, static_cast<Eigen::Index>(i)) = -1.0;
      openings(row, static_cast<Eigen::Index>(3 + 2 * i)) = -edge.y() * per_radius;
      openings(row, static_cast<Eigen::Index>(4 + 2 * i)) = edge.x() * per_radius;
    }
  }
  return openings.transpose() * spring.bending * openings;
}

}  // namespace

SheetBounds bounds_of(const SheetFacet& facet, const SheetSpring& spring) {
  // Of a ball of the thickness, as nodes have it (lumped_mass.hpp). Any other radius gives a bound
  // as well, but a looser one.
  const double gyration = 0.1 * facet.section.thickness * facet.section.thickness;
  Mat3 slopes;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      slopes(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          spring.shape.gradients[i].dot(spring.shape.gradients[j]);
    }
  }
  return {largest_eigenvalue(in_plane_stiffness(spring)),
          largest_eigenvalue(bending_stiffness(spring, gyration)), 2.0 * spring.turning, gyration,
          spring.shape.area * largest_eigenvalue(slopes)};
}

// Stretching acts on F^T du, which is longer than du by at most the largest stretch s: its matrix
// is below s² times that at rest, plus the tension times the gradients of the shape functions. A
// lever of bending is an edge, which is longer by s at most as well.
void add_stiffness(const SheetSpring& spring, const SheetBounds& bounds,
                   const std::array<NodeId, 3>& nodes, const NodeState& state,
                   NodalStiffness& stiffness) {
  const SheetPose pose = pose_of(spring, nodes, state);
  const auto f = deformation_gradient(spring.shape, pose.x);
  const Eigen::Matrix2d metric = f.transpose() * f;
  const double stretch = std::max(1.0, larger_eigenvalue(metric));  // squared
  SheetReaction reaction;
  add_stretching(spring, pose, reaction);
  Eigen::Matrix2d stress;
  stress << reaction.stress[0], reaction.stress[2], reaction.stress[2], reaction.stress[1];
  const double tension = bounds.tension * std::max(0.0, larger_eigenvalue(stress));
  const double in_plane = stretch * bounds.in_plane + tension;
  const double across = stretch * bounds.across + tension;

  const Vec3 area = f.col(0).cross(f.col(1));
  const bool has_area = area.norm() > 0.0;
  const Vec3 n = area.stableNormalized();
  const auto about_normal = [&](double along, double beside) -> Mat3 {
    if (!has_area) return std::max(along, beside) * Mat3::Identity();
    return along_and_across(n, along, beside);
  };
  const Mat3 translation = about_normal(across, in_plane);
  const Mat3 rotation =
      about_normal(stretch * bounds.turning, bounds.gyration * stretch * bounds.across);
  for (const NodeId node : nodes) stiffness.add_to_node(node, translation, rotation);
}

}  // namespace plekton::dynamics
