// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/structure/sheet_spring.hpp"

/// The arithmetic of one facet of a sheet. The formulas are derived at SheetFacets.
namespace plekton::dynamics {

inline ShapeGradients shape_gradients(const std::array<Vec2, 3>& corners) noexcept {
  const Vec2 e1 = corners[1] - corners[0];
  const Vec2 e2 = corners[2] - corners[0];
  const double twice_area = e1.x() * e2.y() - e1.y() * e2.x();
  const Vec2 g1 = Vec2(e2.y(), -e2.x()) / twice_area;
  const Vec2 g2 = Vec2(-e1.y(), e1.x()) / twice_area;
  return {{-g1 - g2, g1, g2}, 0.5 * twice_area};
}

/// Where the nodes of a facet are, and the facet's frame as each of them carries it.
struct SheetPose {
  std::array<Vec3, 3> x;       ///< m
  std::array<Mat3, 3> frames;  ///< columns: two axes in the plane, normal
};

inline SheetPose pose_of(const SheetSpring& spring, const std::array<NodeId, 3>& nodes,
                         const NodeState& state) noexcept {
  SheetPose pose;
  for (std::size_t i = 0; i < 3; ++i) {
    pose.x[i] = state.position[index_of(nodes[i])];
    pose.frames[i] = (state.orientation[index_of(nodes[i])] * spring.rest[i]).toRotationMatrix();
  }
  return pose;
}

/// Columns: where the facet's two axes have gone, stretched.
inline Eigen::Matrix<double, 3, 2> deformation_gradient(const ShapeGradients& shape,
                                                        const std::array<Vec3, 3>& x) noexcept {
  return (x[1] - x[0]) * shape.gradients[1].transpose() +
         (x[2] - x[0]) * shape.gradients[2].transpose();
}

inline void add_stretching(const SheetSpring& spring, const SheetPose& pose,
                           SheetReaction& reaction) noexcept {
  const auto f = deformation_gradient(spring.shape, pose.x);
  const Vec3 f1 = f.col(0), f2 = f.col(1);
  const double e11 = 0.5 * (f1.squaredNorm() - 1.0);
  const double e22 = 0.5 * (f2.squaredNorm() - 1.0);
  const double e12 = 0.5 * f1.dot(f2);
  const double nu = spring.poisson_ratio;
  const double n11 = spring.tensile_stiffness * (e11 + nu * e22);
  const double n22 = spring.tensile_stiffness * (e22 + nu * e11);
  const double n12 = spring.tensile_stiffness * (1.0 - nu) * e12;
  const Vec3 p1 = spring.shape.area * (n11 * f1 + n12 * f2);
  const Vec3 p2 = spring.shape.area * (n12 * f1 + n22 * f2);
  for (std::size_t i = 1; i < 3; ++i) {
    const Vec2& g = spring.shape.gradients[i];
    const Vec3 pull = g.x() * p1 + g.y() * p2;
    reaction.force[i] -= pull;
    reaction.force[0] += pull;
  }
  reaction.stress = {n11, n22, n12};
  reaction.energy += 0.5 * spring.shape.area * (n11 * e11 + n22 * e22 + 2.0 * n12 * e12);
}

inline void add_bending(const SheetSpring& spring, const SheetPose& pose,
                        SheetReaction& reaction) noexcept {
  std::array<Vec3, 6> edges;
  Eigen::Matrix<double, 6, 1> openings;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t side = 0; side < 2; ++side) {
      const std::size_t k = 2 * i + side;
      edges[k] = pose.x[(i + 1 + side) % 3] - pose.x[i];
      openings[static_cast<Eigen::Index>(k)] = pose.frames[i].col(2).dot(edges[k]);
    }
  }
  const Eigen::Matrix<double, 6, 1> p = spring.bending * openings;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(2 * i);
    const Vec3 normal = pose.frames[i].col(2);
    reaction.force[(i + 1) % 3] -= p[k] * normal;
    reaction.force[(i + 2) % 3] -= p[k + 1] * normal;
    reaction.force[i] += (p[k] + p[k + 1]) * normal;
    reaction.torque[i] += (p[k] * edges[2 * i] + p[k + 1] * edges[2 * i + 1]).cross(normal);
  }
  reaction.energy += 0.5 * p.dot(openings);
}

inline void add_turning(const SheetSpring& spring, const SheetPose& pose,
                        SheetReaction& reaction) noexcept {
  const double per_area = 0.25 / spring.shape.area;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    const auto axes = pose.frames[i].leftCols<2>();
    const Vec3 rest_j = axes * (spring.corners[j] - spring.corners[i]);
    const Vec3 rest_k = axes * (spring.corners[k] - spring.corners[i]);
    const Vec3 edge_j = pose.x[j] - pose.x[i];
    const Vec3 edge_k = pose.x[k] - pose.x[i];
    const double turn = per_area * (rest_j.dot(edge_k) - rest_k.dot(edge_j));
    const double moment = spring.turning * turn;
    const double pull = per_area * moment;
    reaction.force[k] -= pull * rest_j;
    reaction.force[j] += pull * rest_k;
    reaction.force[i] += pull * (rest_j - rest_k);
    reaction.torque[i] -= pull * (rest_j.cross(edge_k) - rest_k.cross(edge_j));
    reaction.energy += 0.5 * moment * turn;
  }
}

inline SheetReaction sheet_reaction(const SheetSpring& spring, const SheetPose& pose) noexcept {
  SheetReaction reaction;
  add_stretching(spring, pose, reaction);
  add_bending(spring, pose, reaction);
  add_turning(spring, pose, reaction);
  return reaction;
}

}  // namespace plekton::dynamics
