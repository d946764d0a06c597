// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/sheet_facets.hpp"

#include "dynamics/structure/membrane_force.hpp"
#include "dynamics/structure/sheet_bending.hpp"
#include "dynamics/structure/sheet_kernel.hpp"
#include "geometry/base/problems.hpp"
#include "geometry/base/state_archive.hpp"

#include <sstream>
#include <string>

namespace plekton::dynamics {

SheetSpring spring_of(const SheetFacet& facet) noexcept {
  const SheetSection& section = facet.section;
  const double nu = section.poisson_ratio;
  return {facet.corners,
          shape_gradients(facet.corners),
          section.tensile_stiffness / (1.0 - nu * nu),
          nu,
          (1.0 - nu) * section.bending_stiffness,
          plate_bending(facet.corners, section),
          facet.rest};
}

SheetFacets::SheetFacets(std::span<const SheetFacet> facets, std::size_t node_count)
    : reactions_(facets.size()), broken_(facets.size(), 0) {
  std::ostringstream problems;
  for (std::size_t i = 0; i < facets.size(); ++i)
    list_problems(facets[i], node_count, "sheet facet " + std::to_string(i), problems);
  geometry::throw_if_any(problems);

  std::vector<NodeId> corners;
  corners.reserve(3 * facets.size());
  nodes_.reserve(facets.size());
  springs_.reserve(facets.size());
  bounds_.reserve(facets.size());
  for (const SheetFacet& facet : facets) {
    nodes_.push_back(facet.nodes);
    springs_.push_back(spring_of(facet));
    bounds_.push_back(bounds_of(facet, springs_.back()));
    corners.insert(corners.end(), facet.nodes.begin(), facet.nodes.end());
    if (facet.section.strength == SheetSection::kNever) continue;
    limited_.push_back(nodes_.size() - 1);
    strength_.push_back(facet.section.strength * facet.section.thickness);
  }
  lost_.assign(limited_.size(), 0.0);
  tears_.assign(limited_.size(), 0);
  just_broken_.reserve(limited_.size());
  if (!facets.empty()) corners_ = by_node(corners, node_count);
}

void SheetFacets::advance(const NodeState& state, double drift, geometry::ThreadPool& pool) {
  pool.for_each_range(limited_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) lost_[i] = lost_by_break(limited_[i], state, drift);
  });
  pool.for_each_range(springs_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      if (is_broken(i)) continue;
      reactions_[i] = sheet_reaction(springs_[i], pose_of(springs_[i], nodes_[i], state));
    }
  });
  just_broken_.clear();
}

void SheetFacets::tear(geometry::Positions positions, geometry::ThreadPool& pool) {
  if (limited_.empty()) return;
  pool.for_each_range(limited_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      const Mat3 force = membrane_force(limited_[i], positions);
      tears_[i] = principal_forces(force).largest > strength_[i];
    }
  });
  for (std::size_t i = 0; i < limited_.size(); ++i) {
    if (tears_[i] == 0 || is_broken(limited_[i])) continue;
    take_out(limited_[i], lost_[i]);
    just_broken_.push_back(limited_[i]);
  }
}

void SheetFacets::break_facet(std::size_t facet, const NodeState& state, double drift) {
  if (!is_broken(facet)) take_out(facet, lost_by_break(facet, state, drift));
}

double SheetFacets::lost_by_break(std::size_t facet, const NodeState& state,
                                  double drift) const noexcept {
  const SheetReaction& reaction = reactions_[facet];
  double power = 0.0;  // W
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t node = index_of(nodes_[facet][i]);
    power += reaction.force[i].dot(state.velocity[node]) +
             reaction.torque[i].dot(state.angular_velocity[node]);
  }
  return reaction.energy - 0.5 * drift * power;
}

void SheetFacets::take_out(std::size_t facet, double lost) {
  broken_[facet] = 1;
  dissipated_ += lost;
  reactions_[facet] = SheetReaction{};
}

void SheetFacets::add_forces(NodeForces& forces, geometry::ThreadPool& pool) const {
  if (springs_.empty()) return;
  pool.for_each_range(corners_.start.size() - 1, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t node = begin; node < end; ++node) {
      for (std::uint32_t k = corners_.start[node]; k < corners_.start[node + 1]; ++k) {
        const std::uint32_t corner = corners_.numbers[k];
        forces.force[node] += reactions_[corner / 3].force[corner % 3];
        forces.torque[node] += reactions_[corner / 3].torque[corner % 3];
      }
    }
  });
}

double SheetFacets::elastic_energy() const noexcept {
  double energy = 0.0;
  for (const SheetReaction& reaction : reactions_) energy += reaction.energy;
  return energy;
}

Mat3 SheetFacets::membrane_force(std::size_t facet, geometry::Positions positions) const noexcept {
  std::array<Vec3, 3> x;
  for (std::size_t i = 0; i < 3; ++i) x[i] = positions[index_of(nodes_[facet][i])];
  const auto f = deformation_gradient(springs_[facet].shape, x);
  const double area_ratio = f.col(0).cross(f.col(1)).norm();
  if (!(area_ratio > 0.0)) return Mat3::Zero();
  const Vec3& s = reactions_[facet].stress;
  Eigen::Matrix2d stress;
  stress << s[0], s[2], s[2], s[1];
  return f * (stress / area_ratio) * f.transpose();
}

void SheetFacets::add_to(NodalStiffness& stiffness, const NodeState& state) const {
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    if (!is_broken(i)) add_to(stiffness, state, i);
  }
}

void SheetFacets::add_to(NodalStiffness& stiffness, const NodeState& state,
                         std::size_t facet) const {
  add_stiffness(springs_[facet], bounds_[facet], nodes_[facet], state, stiffness);
}

void SheetFacets::exchange(const geometry::StateArchive& archive) {
  const std::size_t count = size();
  archive.fixed("broken", broken_, "facets of sheets");
  archive.rows("reactions", reactions_, [](geometry::RowFields& row, SheetReaction& reaction) {
    row("force", reaction.force);
    row("torque", reaction.torque);
    row("stress", reaction.stress);
    row("energy", reaction.energy);
  });
  archive("dissipated", dissipated_);
  if (reactions_.size() != count)
    throw geometry::StateMismatch("the facets of sheets in the state are damaged");
}

}  // namespace plekton::dynamics
