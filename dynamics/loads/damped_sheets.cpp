// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/damped_sheets.hpp"

#include "dynamics/stiffness/small_eigenvalue.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace plekton::dynamics {
namespace {

std::vector<std::array<NodeId, 3>> nodes_of(const SheetDamping& damping,
                                            std::span<const SheetFacet> facets) {
  std::vector<std::array<NodeId, 3>> nodes;
  for (const std::size_t facet : damping.facets) nodes.push_back(facets[facet].nodes);
  return nodes;
}

/// Sides at rest, from corner k to the next.
std::array<Vec2, 3> sides_of(const SheetFacet& facet) {
  const auto& [a, b, c] = facet.corners;
  return {b - a, c - b, a - c};
}

/// N/m³, energy = 1/2 w^T K w for changes w of half the squared lengths of the sides.
Mat3 stretching_stiffness(const SheetFacet& facet) {
  const double nu = facet.section.poisson_ratio;
  Mat3 elasticity;
  elasticity << 1.0, nu, 0.0, nu, 1.0, 0.0, 0.0, 0.0, 0.5 * (1.0 - nu);
  elasticity *= facet.section.tensile_stiffness / (1.0 - nu * nu);
  Mat3 of_strain;
  int row = 0;
  for (const Vec2& side : sides_of(facet))
    of_strain.row(row++) << side[0] * side[0], side[1] * side[1], side[0] * side[1];
  const Mat3 strain = of_strain.inverse();
  return area_of(facet) * strain.transpose() * elasticity * strain;
}

/// m²/kg, how fast forces along the sides, over their lengths, change w.
Mat3 mobility(const SheetFacet& facet, const NodeProperties& properties) {
  const std::array<Vec2, 3> sides = sides_of(facet);
  Mat3 mobility = Mat3::Zero();
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const std::size_t node = index_of(facet.nodes[corner]);
    if (holds_translation(properties.held[node])) continue;
    // It is the start of one side and the end of the one before.
    const std::size_t before = (corner + 2) % 3;
    const auto i = static_cast<Eigen::Index>(corner), k = static_cast<Eigen::Index>(before);
    const double lightness = 1.0 / properties.mass[node];
    mobility(i, i) += lightness * sides[corner].squaredNorm();
    mobility(k, k) += lightness * sides[before].squaredNorm();
    mobility(i, k) -= lightness * sides[corner].dot(sides[before]);
    mobility(k, i) -= lightness * sides[corner].dot(sides[before]);
  }
  return mobility;
}

/// rad²/s², the largest eigenvalue of K G, which is that of L^T G L with K = L L^T.
double highest_frequency_squared(const Mat3& stiffness, const Mat3& mobility) {
  const Mat3 root = stiffness.llt().matrixL();
  const Mat3 symmetric = root.transpose() * mobility * root;
  return largest_eigenvalue(symmetric);
}

}  // namespace

FacetDashpot dashpot_of(const SheetFacet& facet, double ratio, const NodeProperties& properties) {
  const Mat3 stiffness = stretching_stiffness(facet);
  const double squared = highest_frequency_squared(stiffness, mobility(facet, properties));
  if (!(squared > 0.0)) return {};
  const double time = 2.0 * ratio / std::sqrt(squared);
  return {time * stiffness, time};
}

DampedSheets::DampedSheets(const SheetDamping& damping, std::span<const SheetFacet> facets,
                           const NodeProperties& properties)
    : facets_(damping.facets),
      members_(nodes_of(damping, facets)),
      nodes_(members_.nodes()),
      forces_(damping.facets.size()) {
  for (const std::size_t facet : damping.facets) {
    const FacetDashpot dashpot = dashpot_of(facets[facet], damping.ratio, properties);
    resistances_.push_back(dashpot.resistance);
    relaxation_time_ = std::max(relaxation_time_, dashpot.relaxation_time);
  }
}

void DampedSheets::follow(const SheetFacets& facets) {
  for (std::size_t i = 0; i < facets_.size(); ++i) {
    if (facets.is_broken(facets_[i])) resistances_[i].setZero();
  }
}

LoadedNodes& DampedSheets::act(const LoadStep&, const NodeState& state,
                               geometry::ThreadPool& pool) {
  pool.for_each_range(forces_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& nodes = members_.groups()[i];
      std::array<Vec3, 3> sides;
      Vec3 rates;  // m²/s
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t a = index_of(nodes[k]), b = index_of(nodes[(k + 1) % 3]);
        sides[k] = state.position[b] - state.position[a];
        rates[static_cast<int>(k)] = sides[k].dot(state.velocity[b] - state.velocity[a]);
      }
      const Vec3 pulls = resistances_[i] * rates;  // N/m
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t before = (k + 2) % 3;
        forces_[i][k] =
            pulls[static_cast<int>(k)] * sides[k] - pulls[static_cast<int>(before)] * sides[before];
      }
    }
  });
  nodes_.set(pool, [&](std::size_t i) {
    Vec3 force = Vec3::Zero();
    for (const auto& member : members_.of(i)) force += forces_[member.group][member.place];
    return LoadedNodes::Force{force};
  });
  return nodes_;
}

}  // namespace plekton::dynamics
