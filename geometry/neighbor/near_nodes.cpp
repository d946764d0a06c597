// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neighbor/near_nodes.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace plekton::geometry {
namespace {

/// In radii. Half a turn takes pi of them; what is nearer than a diameter across a flat sheet is at
/// most 2 sqrt(2) away along the edges of a square grid. Both leave room for the two group radii by
/// which the distance between centres may be off.
constexpr double kSharpestFold = 4.0;
constexpr double kGroupRadius = 0.4;
static_assert(3.1416 + 2.0 * kGroupRadius <= kSharpestFold);
static_assert(2.0 * 1.4143 + 2.0 * kGroupRadius <= kSharpestFold);

/// Shortest ways along edges from one node (Dijkstra), again and again in the same memory.
class EdgeWays {
 public:
  EdgeWays(const Surface& surface, Positions x)
      : length_(surface.node_count(), std::numeric_limits<double>::infinity()) {
    first_.reserve(surface.node_count() + 1);
    first_.push_back(0);
    for (std::size_t n = 0; n < surface.node_count(); ++n) {
      const auto node = id_at<NodeId>(n);
      for (const EdgeId edge : surface.edges_of(node)) {
        const auto& ends = surface.nodes_of(edge);
        const NodeId other = ends[0] == node ? ends[1] : ends[0];
        links_.push_back({other, (x[index_of(other)] - x[n]).norm()});
      }
      first_.push_back(links_.size());
    }
  }

  /// Nodes at most a length away along edges, the start among them; in no order that means
  /// anything, and good until the next call.
  std::span<const NodeId> within(double reach, NodeId start) {
    for (const NodeId node : found_) length(node) = std::numeric_limits<double>::infinity();
    found_.clear();
    offer(start, 0.0);
    while (!open_.empty()) {
      std::pop_heap(open_.begin(), open_.end(), std::greater<>());
      const auto [so_far, node] = open_.back();
      open_.pop_back();
      if (so_far > length(node)) continue;  // A shorter way was found since.
      for (std::size_t i = first_[index_of(node)]; i < first_[index_of(node) + 1]; ++i) {
        const double further = so_far + links_[i].length;
        if (further <= reach) offer(links_[i].to, further);
      }
    }
    return found_;
  }

 private:
  struct Link {
    NodeId to;
    double length;  ///< m
  };

  double& length(NodeId node) { return length_[index_of(node)]; }

  void offer(NodeId node, double so_far) {
    if (!(so_far < length(node))) return;
    if (length(node) == std::numeric_limits<double>::infinity()) found_.push_back(node);
    length(node) = so_far;
    open_.emplace_back(so_far, node);
    std::push_heap(open_.begin(), open_.end(), std::greater<>());
  }

  std::vector<std::size_t> first_;               ///< by NodeId: where its links begin
  std::vector<Link> links_;                      ///< the edges, from both ends
  std::vector<double> length_;                   ///< m, by NodeId; infinite where no way has led
  std::vector<NodeId> found_;                    ///< those with a length
  std::vector<std::pair<double, NodeId>> open_;  ///< a heap, the shortest way on top
};

/// Puts every node of a cell into a group. @returns the centres
std::vector<NodeId> make_groups(const Surface& surface, EdgeWays& ways,
                                std::vector<std::int32_t>& group_of) {
  std::vector<NodeId> centres;
  for (std::size_t n = 0; n < group_of.size(); ++n) {
    const auto node = id_at<NodeId>(n);
    const StructureId structure = surface.structure_of(node);
    if (structure == StructureId{-1} || group_of[n] >= 0) continue;
    for (const NodeId member : ways.within(kGroupRadius * surface.radius(structure), node)) {
      std::int32_t& group = group_of[index_of(member)];
      if (group < 0) group = static_cast<std::int32_t>(centres.size());
    }
    centres.push_back(node);
  }
  return centres;
}

/// m, within which nodes are near each other.
double interaction_range_of(const Surface& surface, NodeId centre) {
  return kSharpestFold * surface.radius(surface.structure_of(centre));
}

/// A hundred groups tell at once what all of them will take.
/// @throws std::length_error
void require_few_pairs(const Surface& surface, std::span<const NodeId> centres,
                       const std::vector<std::int32_t>& group_of, std::size_t most_pairs,
                       EdgeWays& ways) {
  const auto all = static_cast<double>(centres.size());
  if (all * all <= static_cast<double>(most_pairs)) return;
  const std::size_t stride = std::max<std::size_t>(1, centres.size() / 100);
  double sampled = 0.0, near = 0.0, longest_reach = 0.0;
  for (std::size_t i = 0; i < centres.size(); i += stride) {
    const double reach = interaction_range_of(surface, centres[i]);
    for (const NodeId node : ways.within(reach, centres[i])) {
      const auto group = static_cast<std::size_t>(group_of[index_of(node)]);
      if (centres[group] == node) near += 1.0;
    }
    longest_reach = std::max(longest_reach, reach);
    sampled += 1.0;
  }
  const double count = near / sampled * all;
  if (count <= static_cast<double>(most_pairs)) return;
  std::ostringstream text;
  text << "self-contact: about " << count << " pairs of nodes are within two thicknesses ("
       << longest_reach << " m) of each other along edges; expected at most " << most_pairs
       << "; use fewer edges in a node, a thinner membrane, or no self-contact";
  throw std::length_error(text.str());
}

}  // namespace

NearNodes::NearNodes(const Surface& surface, Positions rest, std::size_t most_pairs)
    : group_(surface.node_count(), -1) {
  EdgeWays ways(surface, rest);
  const std::vector<NodeId> centres = make_groups(surface, ways, group_);
  require_few_pairs(surface, centres, group_, most_pairs, ways);
  first_.reserve(centres.size() + 1);
  first_.push_back(0);
  for (const NodeId centre : centres) {
    for (const NodeId node : ways.within(interaction_range_of(surface, centre), centre)) {
      const std::int32_t group = group_[index_of(node)];
      if (centres[static_cast<std::size_t>(group)] == node) near_.push_back(group);
    }
    std::sort(near_.begin() + static_cast<std::ptrdiff_t>(first_.back()), near_.end());
    first_.push_back(near_.size());
  }
}

bool NearNodes::are_groups_near(std::int32_t a, std::int32_t b) const noexcept {
  const auto near = groups_near(a);
  return std::binary_search(near.begin(), near.end(), b);
}

bool NearNodes::are_near(NodeId a, NodeId b) const noexcept {
  return are_groups_near(group_of(a), group_of(b));
}

}  // namespace plekton::geometry
