// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/wrapped_joints.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace plekton::contact::structure {
namespace {

Simplex simplex_at(const geometry::FeatureNodes& nodes, Positions x) {
  Simplex simplex;
  simplex.count = nodes.count;
  for (std::size_t i = 0; i < nodes.count; ++i) simplex.x[i] = x[geometry::index_of(nodes.ids[i])];
  return simplex;
}

/// The cell of a pair on one side of a term.
geometry::CellId cell_on(const Holder& holder, bool is_a,
                         std::span<const geometry::CellPair> pairs) {
  const geometry::CellPair& pair = pairs[holder.pair];
  return is_a ? holder.sides.first(pair.a, pair.b) : holder.sides.second(pair.a, pair.b);
}

std::uint8_t place_in(const PairTerm& term, NodeId node) {
  const auto* const in_a = std::find(term.a.begin(), term.a.end(), node);
  if (in_a != term.a.end()) return static_cast<std::uint8_t>(in_a - term.a.begin());
  const auto* const in_b = std::find(term.b.begin(), term.b.end(), node);
  return static_cast<std::uint8_t>(3 + (in_b - term.b.begin()));
}

void add_on(PairForces& forces, std::uint8_t place, const Vec3& force) {
  (place < 3 ? forces.on_a[place] : forces.on_b[place - 3U]) += force;
}

/// Where a separation leads to: a point of a simplex.
struct Foot {
  unsigned corners;  ///< that span the lowest feature that holds it
  Vec3 weights;
  Vec3 separation;  ///< m, from it to the joint; perpendicular to that feature
};

/// The separation is perpendicular to the facet. A needle does not turn.
Vec3 from_face(const Vec3& by_separation, const Simplex& facet, const Foot& foot,
               std::array<Vec3, 3>& on_other) {
  const Vec3 area_normal = area_normal_of(facet);
  const double area = area_normal.norm();
  if (is_needle(facet)) {
    for (std::size_t k = 0; k < 3; ++k)
      on_other[k] += foot.weights[static_cast<int>(k)] * by_separation;
    return -by_separation;
  }
  const Vec3 normal = area_normal / area;
  const Vec3 along_normal = by_separation.dot(normal) * normal;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 opposite = facet.x[(k + 2) % 3] - facet.x[(k + 1) % 3];
    const Vec3 by_weight = normal.cross(opposite) / area;  // 1/m, slope of the weight
    on_other[k] += foot.weights[static_cast<int>(k)] * along_normal +
                   by_separation.dot(by_weight) * foot.separation;
  }
  return -along_normal;
}

/// The separation is perpendicular to the edge between two corners.
Vec3 from_edge(const Vec3& by_separation, const Simplex& other, std::array<std::size_t, 2> ends,
               const Foot& foot, std::array<Vec3, 3>& on_other) {
  const Vec3 edge = other.x[ends[1]] - other.x[ends[0]];
  const double length = edge.norm();
  const Vec3 along = edge / length;
  const double by_turn = by_separation.dot(along) / length;
  const Vec3 across = by_separation - by_separation.dot(along) * along;
  for (const std::size_t end : ends) on_other[end] += foot.weights[static_cast<int>(end)] * across;
  on_other[ends[0]] -= by_turn * foot.separation;
  on_other[ends[1]] += by_turn * foot.separation;
  return -across;
}

/// Forces of an energy that depends on the separation of a joint from its nearest point.
/// @param on_other  gets those on the corners of the simplex
/// @returns the force on the joint
Vec3 separating_forces(const Vec3& by_separation, const Simplex& other, const Foot& foot,
                       std::array<Vec3, 3>& on_other) {
  const int count = std::popcount(foot.corners);
  if (count == 3) return from_face(by_separation, other, foot, on_other);
  const auto first = static_cast<std::size_t>(std::countr_zero(foot.corners));
  if (count == 2) {
    const auto last = static_cast<std::size_t>(std::bit_width(foot.corners)) - 1;
    return from_edge(by_separation, other, {first, last}, foot, on_other);
  }
  on_other[first] += by_separation;
  return -by_separation;
}

}  // namespace

void WrappedJoints::clear(std::size_t pairs) {
  first_joints_.assign(1, 0);
  joints_.clear();
  arms_.clear();
  bars_.clear();
  touched_.clear();
  has_ends_.assign(pairs, 0);
}

void WrappedJoints::add(const PairTerm& term, std::span<const Holder> holders,
                        std::span<const geometry::CellPair> pairs,
                        const geometry::Surface& surface) {
  if (term.a.count == 1) add_side(term, true, holders, pairs, surface);
  if (term.b.count == 1) add_side(term, false, holders, pairs, surface);
  first_joints_.push_back(static_cast<std::uint32_t>(joints_.size()));
}

void WrappedJoints::add_side(const PairTerm& term, bool is_a, std::span<const Holder> holders,
                             std::span<const geometry::CellPair> pairs,
                             const geometry::Surface& surface) {
  const auto find = [&](bool side, std::vector<geometry::CellId>& cells) {
    cells.clear();
    for (const Holder& holder : holders) cells.push_back(cell_on(holder, side, pairs));
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells.size();
  };
  const std::size_t count = find(is_a, cells_);
  if (count < 2 || count * find(!is_a, opposite_) != holders.size()) return;
  const bool are_bars = std::all_of(cells_.begin(), cells_.end(), [&](geometry::CellId cell) {
    return surface.nodes_of(cell).size() == 2;
  });
  if (!are_bars) return;
  // The weight of a joint of bars is 1 less their number.
  Joint joint{is_a, -term.weight / static_cast<double>(count - 1),
              static_cast<std::uint32_t>(arms_.size()), static_cast<std::uint32_t>(count)};
  const NodeId node = (is_a ? term.a : term.b).ids[0];
  for (const geometry::CellId bar : cells_) {
    const auto ends = surface.nodes_of(bar);
    const auto holder = std::find_if(holders.begin(), holders.end(), [&](const Holder& of) {
      return cell_on(of, is_a, pairs) == bar;
    });
    arms_.push_back({ends[0] == node ? ends[1] : ends[0], holder->pair, 0});
    bars_.emplace_back();
  }
  joints_.push_back(joint);
}

void WrappedJoints::finish(std::span<const PairTerm> terms,
                           std::span<const std::uint32_t> term_of_pair) {
  for (Arm& arm : arms_) arm.place = place_in(terms[term_of_pair[arm.pair]], arm.end);
  ends_.resize(joints_.empty() ? 0 : has_ends_.size());
  pulled_ends_.resize(ends_.size());
}

double WrappedJoints::evaluate(std::size_t term, const PairTerm& features,
                               const TermProximity& found, const NormalSpring& spring, Positions x,
                               bool pulls, PairForces& to) {
  double push = 0.0;
  for (std::uint32_t j = first_joints_[term]; j < first_joints_[term + 1]; ++j) {
    Joint& joint = joints_[j];
    const geometry::ClosestPoints& points = found.cores.points;
    const NodeId node = (joint.is_a ? features.a : features.b).ids[0];
    const Vec3& at = x[index_of(node)];
    const Foot foot = joint.is_a ? Foot{points.corners_b, points.weights_b, -points.separation}
                                 : Foot{points.corners_a, points.weights_a, points.separation};
    const auto bars = std::span(bars_).subspan(joint.first, joint.count);
    for (std::uint32_t m = 0; m < joint.count; ++m)
      bars[m].bar = x[index_of(arms_[joint.first + m].end)] - at;
    const WrapShare wrap = wrap_share(foot.separation, spring.range(), bars);
    if (!pulls) joint.contacts = wrap.contacts;
    if (!(wrap.contacts > 0.0)) continue;
    const double distance = foot.separation.norm();
    const double energy = spring.energy(distance);
    const Vec3 by_separation = energy * wrap.by_separation -
                               wrap.contacts * spring.force(distance) / distance * foot.separation;
    const Simplex other = simplex_at(joint.is_a ? features.b : features.a, x);
    std::array<Vec3, 3> on_other{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    Vec3 on_node = separating_forces(by_separation, other, foot, on_other);
    push += (joint.is_a ? -joint.weight : joint.weight) * on_node.dot(found.cores.normal);
    for (std::uint32_t m = 0; m < joint.count; ++m) {
      Arm& arm = arms_[joint.first + m];
      on_node += energy * bars[m].by_bar;
      (pulls ? arm.pull : arm.push) = -joint.weight * energy * bars[m].by_bar;
    }
    to.energy += joint.weight * wrap.contacts * energy;
    (joint.is_a ? to.on_a : to.on_b)[0] += joint.weight * on_node;
    for (std::size_t k = 0; k < other.count; ++k)
      (joint.is_a ? to.on_b : to.on_a)[k] += joint.weight * on_other[k];
  }
  return push;
}

void WrappedJoints::gather(std::span<const std::uint32_t> acting) {
  for (const std::uint32_t pair : touched_) has_ends_[pair] = 0;
  touched_.clear();
  if (joints_.empty()) return;
  for (const std::uint32_t term : acting) {
    for (std::uint32_t j = first_joints_[term]; j < first_joints_[term + 1]; ++j) {
      if (!(joints_[j].contacts > 0.0)) continue;
      for (std::uint32_t m = 0; m < joints_[j].count; ++m) {
        const Arm& arm = arms_[joints_[j].first + m];
        if (has_ends_[arm.pair] == 0) {
          has_ends_[arm.pair] = 1;
          touched_.push_back(arm.pair);
          ends_[arm.pair] = pulled_ends_[arm.pair] = {};
        }
        add_on(ends_[arm.pair], arm.place, arm.push);
        add_on(pulled_ends_[arm.pair], arm.place, arm.pull);
      }
    }
  }
}

}  // namespace plekton::contact::structure
