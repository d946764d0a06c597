// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/ties/ties.hpp"

#include "dynamics/ties/cable_slide.hpp"
#include "geometry/base/state_archive.hpp"
#include "geometry/primitives/node_sets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace plekton::dynamics {
namespace {

using geometry::Positions;

/// Up to three nodes that are held together; -1 in place of those that are not needed.
using NodeSet = std::array<NodeId, 3>;
constexpr NodeId kNone{-1};

/// What bars, facets and sides of facets hold together.
geometry::NodeSets<3> carriers_of(const geometry::Elements& elements) {
  geometry::NodeSets<3> carriers;
  for (const geometry::Cylinder& cylinder : elements.cylinders)
    carriers.add({cylinder.nodes[0], cylinder.nodes[1], kNone});
  for (const geometry::Facet& facet : elements.facets) {
    carriers.add(facet.nodes);
    for (const auto& [a, b] : geometry::sides_of(facet)) carriers.add({a, b, kNone});
  }
  carriers.sort();
  return carriers;
}

/// Those that share in a point.
NodeSet nodes_of(const MaterialPoint& point) {
  NodeSet nodes;
  for (std::size_t k = 0; k < 3; ++k)
    nodes[k] = point.weights[static_cast<int>(k)] > 0.0 ? point.nodes[k] : kNone;
  return nodes;
}

NodeSet nodes_of(const Cable& cable, std::size_t segment) {
  return {cable.nodes[segment], cable.nodes[(segment + 1) % cable.nodes.size()], kNone};
}

}  // namespace

Ties::Ties(const Scene& scene)
    : cables_(scene.cables),
      ties_(scene.ties),
      is_on_element_(scene.ties.size(), 0),
      kept_(scene.ties.size()),
      points_(scene.ties.size(), MaterialPoint{{}, Vec3::Zero()}),
      forces_(scene.ties.size(), Vec3::Zero()) {
  if (ties_.empty()) return;
  const geometry::NodeSets<3> carriers = carriers_of(scene.elements);
  for (const Cable& cable : cables_) {
    is_there_.emplace_back(cable.segments(), char{1});
    is_carried_.emplace_back();
    for (std::size_t s = 0; s < cable.segments(); ++s)
      is_carried_.back().push_back(carriers.contains(nodes_of(cable, s)) ? 1 : 0);
  }
  for (std::size_t i = 0; i < ties_.size(); ++i) {
    if (const auto* const point = std::get_if<MaterialPoint>(&ties_[i].to)) {
      points_[i] = *point;
      is_on_element_[i] = carriers.contains(nodes_of(*point)) ? 1 : 0;
    } else if (const auto* const place = std::get_if<CablePlace>(&ties_[i].to)) {
      kept_[i].segment = place->segment;
      kept_[i].along = place->along;
      set_point(i, *place);
    }
  }
}

void Ties::set_point(std::size_t i, const CablePlace& on) {
  const Cable& cable = cables_[on.cable];
  const NodeId first = cable.nodes[kept_[i].segment];
  const NodeId second = cable.nodes[(kept_[i].segment + 1) % cable.nodes.size()];
  points_[i] = {{first, second, first}, Vec3(1.0 - kept_[i].along, kept_[i].along, 0.0)};
}

Vec3 Ties::way(std::size_t i, Positions x) const noexcept {
  if (const auto* const fixed = std::get_if<FixedPoint>(&ties_[i].to))
    return x[index_of(ties_[i].node)] - fixed->place;
  return beside_point(i, x);
}

Vec3 Ties::motion(std::size_t i, std::span<const Vec3> v) const noexcept {
  if (std::holds_alternative<FixedPoint>(ties_[i].to)) return v[index_of(ties_[i].node)];
  return beside_point(i, v);
}

/// What its node has more than its point, on nodes.
Vec3 Ties::beside_point(std::size_t i, std::span<const Vec3> of_nodes) const noexcept {
  const auto& [nodes, weights] = points_[i];
  // Differences first: so that it is exact far from the origin.
  const Vec3& origin = of_nodes[index_of(nodes[0])];
  Vec3 more = of_nodes[index_of(ties_[i].node)] - origin;
  for (int k = 1; k < 3; ++k)
    if (weights[k] > 0.0)
      more -= weights[k] * (of_nodes[index_of(nodes[static_cast<std::size_t>(k)])] - origin);
  return more;
}

/// m, of its spring.
double Ties::stretch(std::size_t i, double distance) const noexcept {
  const Tie& tie = ties_[i];
  const bool is_brake = tie.brake_force < Tie::kNever;
  const double stretch = distance - tie.rest_length - (is_brake ? kept_[i].slip : 0.0);
  return tie.pushes ? stretch : std::max(0.0, stretch);
}

void Ties::advance(Positions x) {
  for (std::size_t i = 0; i < ties_.size(); ++i)
    if (!kept_[i].is_broken) advance(i, x);
}

void Ties::advance(std::size_t i, Positions x) {
  const Tie& tie = ties_[i];
  Kept& kept = kept_[i];
  if (const auto* const on = std::get_if<CablePlace>(&tie.to)) slide(i, *on, x);
  const Vec3 to_node = way(i, x);
  const double distance = to_node.norm();
  const double asked = stretch(i, distance);
  const double before = kept.dissipated;
  const double stretched = pay_out(tie, kept, asked);
  const double pull = tie.stiffness * stretched;
  if (kept.is_lost || pull > tie.strength) {
    // In the step before it took the work of its force of then over half of the way, and does none
    // now: nor has a brake paid out against one.
    kept.dissipated = before + kept.elastic + 0.5 * kept.pull * (asked - kept.pull / tie.stiffness);
    kept.is_broken = true;
    kept.pull = kept.along_cable = kept.elastic = 0.0;
    forces_[i].setZero();
    return;
  }
  kept.pull = pull;
  kept.elastic = 0.5 * pull * stretched;
  forces_[i] = distance > 0.0 ? Vec3((-pull / distance) * to_node) : Vec3::Zero();
}

/// @returns the stretch (m) that is left to the spring
double Ties::pay_out(const Tie& tie, Kept& kept, double stretch) const noexcept {
  const double above = stretch - tie.brake_force / tie.stiffness;
  const double paid = std::min(above, tie.stroke - kept.slip);
  if (!(paid > 0.0) || !(tie.brake_force < Tie::kNever)) return stretch;
  kept.slip += paid;
  kept.dissipated += 0.5 * (kept.pull + tie.stiffness * (stretch - paid)) * paid;
  return stretch - paid;
}

void Ties::slide(std::size_t i, const CablePlace& on, Positions x) {
  const Tie& tie = ties_[i];
  Kept& kept = kept_[i];
  const CableShape cable(cables_[on.cable], is_there_[on.cable], x);
  const Vec3& node = x[index_of(tie.node)];
  const CablePosition from{kept.segment, kept.along};
  const bool is_smooth = tie.friction == 0.0 && tie.slip_force == 0.0;
  const Slide slid =
      is_smooth ? slide_to_nearest(cable, node, from) : slide_with_friction(cable, tie, node, from);
  kept.segment = slid.to.segment;
  kept.along = slid.to.along;
  kept.slip += std::abs(slid.distance);
  set_point(i, on);
  if (is_smooth) return;
  const Vec3 to_node = way(i, x);
  const double distance = to_node.norm();
  const Vec3 chord = cable.chord(kept.segment);
  const double product = distance * chord.norm();
  const double pull = tie.stiffness * stretch(i, distance);
  const double along = product > 0.0 ? pull * to_node.dot(chord) / product : 0.0;
  kept.dissipated += 0.5 * (kept.along_cable + along) * slid.distance;
  kept.along_cable = along;
}

void Ties::add_force(std::size_t i, const Vec3& force, NodeForces& forces) const {
  forces.force[index_of(ties_[i].node)] += force;
  const auto& [nodes, weights] = points_[i];
  for (int k = 0; k < 3; ++k)
    if (weights[k] > 0.0)
      forces.force[index_of(nodes[static_cast<std::size_t>(k)])] -= weights[k] * force;
}

void Ties::add_forces(NodeForces& forces) const {
  for (std::size_t i = 0; i < ties_.size(); ++i)
    if (!kept_[i].is_broken) add_force(i, forces_[i], forces);
}

void Ties::add_forces_at(Positions x, NodeForces& forces) const {
  for (std::size_t i = 0; i < ties_.size(); ++i) {
    if (kept_[i].is_broken) continue;
    const Vec3 to_node = way(i, x);
    const double distance = to_node.norm();
    if (!(distance > 0.0)) continue;
    add_force(i, (-ties_[i].stiffness * stretch(i, distance) / distance) * to_node, forces);
  }
}

void Ties::follow(const geometry::Elements& left) {
  if (ties_.empty()) return;
  const geometry::NodeSets<3> carriers = carriers_of(left);
  for (std::size_t c = 0; c < cables_.size(); ++c) {
    for (std::size_t s = 0; s < cables_[c].segments(); ++s)
      if (is_carried_[c][s] != 0)
        is_there_[c][s] = carriers.contains(nodes_of(cables_[c], s)) ? 1 : 0;
  }
  for (std::size_t i = 0; i < ties_.size(); ++i) {
    if (const auto* const on = std::get_if<CablePlace>(&ties_[i].to))
      kept_[i].is_lost = is_there_[on->cable][kept_[i].segment] == 0;
    else if (is_on_element_[i] != 0)
      kept_[i].is_lost = !carriers.contains(nodes_of(points_[i]));
  }
}

double Ties::elastic_energy() const noexcept {
  double sum = 0.0;
  for (const Kept& kept : kept_) sum += kept.elastic;
  return sum;
}

double Ties::dissipated() const noexcept {
  double sum = 0.0;
  for (const Kept& kept : kept_) sum += kept.dissipated;
  return sum;
}

std::size_t Ties::broken() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(kept_.begin(), kept_.end(), [](const Kept& kept) { return kept.is_broken; }));
}

void Ties::forget_dissipated() noexcept {
  for (Kept& kept : kept_) kept.dissipated = 0.0;
}

void Ties::add_to(NodalStiffness& stiffness) const {
  for (std::size_t i = 0; i < ties_.size(); ++i) add_to(stiffness, i);
}

/// Along its line it has its stiffness, and across that pull / distance: no more while it pulls, and
/// less than none while it pushes. The same in all directions.
void Ties::add_to(NodalStiffness& stiffness, std::size_t i) const {
  if (kept_[i].is_broken) return;
  const double k = ties_[i].stiffness;
  add_spring(i, {Vec3::UnitX(), k, k, 0.0, 0.0}, stiffness);
}

void Ties::exchange(const geometry::StateArchive& archive) {
  const std::size_t count = kept_.size();
  archive.rows("ties", kept_, [](geometry::RowFields& row, Kept& kept) {
    row("is_broken", kept.is_broken);
    row("is_lost", kept.is_lost);
    row("segment", kept.segment);
    row("along", kept.along);
    row("slip", kept.slip);
    row("pull", kept.pull);
    row("along_cable", kept.along_cable);
    row("elastic", kept.elastic);
    row("dissipated", kept.dissipated);
  });
  if (kept_.size() != count)
    throw geometry::StateMismatch("the state has " + std::to_string(kept_.size()) +
                                  " ties, the scene " + std::to_string(count));
  for (std::size_t i = 0; i < count; ++i) {
    const auto* const on = std::get_if<CablePlace>(&ties_[i].to);
    if (on == nullptr) continue;
    archive.require(kept_[i].segment < cables_[on->cable].segments(), "segment");
    set_point(i, *on);
  }
}

}  // namespace plekton::dynamics
