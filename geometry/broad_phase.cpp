// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/broad_phase.hpp"

#include "geometry/bunch_pairs.hpp"
#include "geometry/vector_width.hpp"

#include <fcl/broadphase/detail/hierarchy_tree_array.h>
#include <fcl/math/bv/AABB.h>
#include <fcl/narrowphase/collision_object.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <stdexcept>
#include <string>
#include <type_traits>

// The packaged FCL was compiled with Eigen's 16-byte alignment. With any other, as -march=native
// brings about, its collision objects have another layout here than there, and its managers crash
// or report no pair at all.
static_assert(
    sizeof(fcl::CollisionObjectd) == 224 && alignof(fcl::CollisionObjectd) == 16,
    "FCL was compiled with another alignment of Eigen's types: define EIGEN_MAX_ALIGN_BYTES=16");
// These are what is handed to FCL below.
static_assert(sizeof(fcl::AABBd) == 6 * sizeof(double) && alignof(fcl::AABBd) == alignof(double));

namespace plekton::geometry {
namespace {

/// FCL ranks boxes by squared diagonals, which must not overflow.
constexpr double kLargestCoordinate = 1e150;
/// Nodes on the longest way down, root and leaf included. A tree of 2^31 boxes has 32.
constexpr std::size_t kMaxHeight = 64;

fcl::AABBd to_fcl(const Box& box) {
  fcl::AABBd result;
  for (int axis = 0; axis < 3; ++axis) {
    // std::max and std::min return their first argument when the second is NaN.
    result.min_[axis] =
        std::min(kLargestCoordinate, std::max(-kLargestCoordinate, box.lower[axis]));
    result.max_[axis] =
        std::max(-kLargestCoordinate, std::min(kLargestCoordinate, box.upper[axis]));
  }
  return result;
}

/// Without branches, because every second answer surprises the processor.
bool overlap(const fcl::AABBd& p, const fcl::AABBd& q) {
  bool result = true;
  for (int axis = 0; axis < 3; ++axis) {
    result &= p.min_[axis] <= q.max_[axis];
    result &= q.min_[axis] <= p.max_[axis];
  }
  return result;
}

/// FCL's tree in one array: leaves in places [0, n), inner nodes in [n, 2 n - 1). A leaf keeps its
/// box's index where an inner node keeps its first child; FCL knows a leaf by its second child
/// alone. FCL refits the tree; the fresh tree is made here, because
/// HierarchyTree::init and balanceTopdown never give their memory back (FCL 0.7.0).
class Tree : public fcl::detail::implementation_array::HierarchyTree<fcl::AABBd> {
 public:
  using Place = std::uint32_t;
  static constexpr std::size_t kMaxHeight = geometry::kMaxHeight;

  Tree() = default;
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  const fcl::AABBd& box(std::size_t place) const { return nodes[place].bv; }
  bool is_leaf(std::size_t place) const { return place < n_leaves; }
  std::int32_t index(std::size_t leaf) const {
    return static_cast<std::int32_t>(nodes[leaf].children[0]);
  }
  Place child(std::size_t place, std::size_t k) const {
    return static_cast<Place>(nodes[place].children[k]);
  }
  Place root() const { return static_cast<Place>(root_node); }
  std::size_t leaf_end() const { return n_leaves; }
  std::size_t inner_end() const { return n_leaves == 0 ? 0 : 2 * n_leaves - 1; }

  bool overlap(Place x, Place y) const { return geometry::overlap(box(x), box(y)); }

  /// The tree down to bunches of leaves: the nodes above them, and bunches.
  std::span<const Place> nodes_above_bunches() const { return above_bunches_; }
  std::span<const BoxLanes> bunches() const { return bunches_; }
  /// The bunch that a node is the top of, or nullptr.
  const BoxLanes* bunch(Place place) const {
    const std::int32_t b = bunch_of_[place];
    return b < 0 ? nullptr : &bunches_[static_cast<std::size_t>(b)];
  }

  void rebuild(std::span<const Box> boxes) {
    make_room(boxes.size());
    items_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) items_[i] = {to_fcl(boxes[i]).center(), i};
    above_bunches_.clear();
    first_leaves_.clear();
    bunch_of_.assign(2 * boxes.size(), -1);
    next_inner_ = n_leaves;
    root_node = n_leaves == 0 ? NULL_NODE : split(0, n_leaves);
    if (n_leaves > 0) nodes[root_node].parent = NULL_NODE;
    opath = 0;
    set_boxes(boxes);
    refit();
  }

  void follow(std::span<const Box> boxes) {
    set_boxes(boxes);
    refit();
  }

 private:
  struct Item {
    Vec3 centre;
    std::size_t index;
  };

  void make_room(std::size_t count) {
    const std::size_t needed = 2 * count;  // One is never used.
    if (needed > n_nodes_alloc) {
      auto* const room = new std::remove_pointer_t<decltype(nodes)>[needed];
      delete[] nodes;
      nodes = room;
      n_nodes_alloc = needed;
    }
    n_leaves = count;
    n_nodes = inner_end();
    freelist = inner_end();
    nodes[freelist].next = NULL_NODE;
  }

  /// A tree over the items [begin, end), halved at the median centre along the widest axis; returns
  /// its top.
  std::size_t split(std::size_t begin, std::size_t end, bool in_bunch = false) {
    const bool is_bunch = !in_bunch && end - begin <= BoxLanes::kLanes;
    const std::size_t top = split_below(begin, end, in_bunch || is_bunch);
    if (is_bunch) {
      bunch_of_[top] = static_cast<std::int32_t>(first_leaves_.size());
      first_leaves_.push_back(begin);
    } else if (!in_bunch) {
      above_bunches_.push_back(static_cast<Place>(top));
    }
    return top;
  }

  std::size_t split_below(std::size_t begin, std::size_t end, bool in_bunch) {
    if (end - begin == 1) {
      nodes[begin].children[0] = items_[begin].index;
      nodes[begin].children[1] = NULL_NODE;
      return begin;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const int axis = widest_axis(begin, end);
    const auto item = [this](std::size_t k) {
      return items_.begin() + static_cast<std::ptrdiff_t>(k);
    };
    std::nth_element(item(begin), item(middle), item(end), [axis](const Item& p, const Item& q) {
      return p.centre[axis] < q.centre[axis];
    });
    const std::size_t top = next_inner_++;
    const std::array<std::size_t, 2> halves{split(begin, middle, in_bunch),
                                            split(middle, end, in_bunch)};
    for (std::size_t k = 0; k < 2; ++k) {
      nodes[top].children[k] = halves[k];
      nodes[halves[k]].parent = top;
    }
    return top;
  }

  int widest_axis(std::size_t begin, std::size_t end) const {
    Vec3 lower = items_[begin].centre;
    Vec3 upper = lower;
    for (std::size_t k = begin + 1; k < end; ++k) {
      lower = lower.cwiseMin(items_[k].centre);
      upper = upper.cwiseMax(items_[k].centre);
    }
    int axis = 0;
    (upper - lower).maxCoeff(&axis);
    return axis;
  }

  void set_boxes(std::span<const Box> boxes) {
    for (std::size_t leaf = 0; leaf < n_leaves; ++leaf) {
      nodes[leaf].bv = to_fcl(boxes[static_cast<std::size_t>(index(leaf))]);
    }
    bunches_.resize(first_leaves_.size());
    for (std::size_t b = 0; b < bunches_.size(); ++b) {
      bunches_[b].clear();
      const std::size_t first = first_leaves_[b];
      const std::size_t end = b + 1 < bunches_.size() ? first_leaves_[b + 1] : n_leaves;
      for (std::size_t leaf = first; leaf < end; ++leaf)
        bunches_[b].set(leaf - first, box(leaf).min_, box(leaf).max_, index(leaf));
    }
  }

  std::vector<Item> items_;
  std::vector<Place> above_bunches_;
  std::vector<std::size_t> first_leaves_;  ///< by bunch
  std::vector<std::int32_t> bunch_of_;     ///< by node; -1 of others than tops of bunches
  std::vector<BoxLanes> bunches_;
  std::size_t next_inner_ = 0;
};

/// Calls emit(index in p, index in q) for every overlapping pair of a leaf below place x of p and
/// one below y of q.
template <class Emit>
void descend(const Tree& p, Tree::Place x, const Tree& q, Tree::Place y, const Emit& emit) {
  struct Places {
    Tree::Place x, y;
  };
  // Pairs of nodes that overlap and wait. Each one taken brings at most 3 more than it was, and is
  // one level deeper.
  std::array<Places, 3 * kMaxHeight + 4> waiting;
  std::size_t count = 0;
  const auto add = [&](Tree::Place below_x, Tree::Place below_y) {
    waiting[count] = {below_x, below_y};
    count += overlap(p.box(below_x), q.box(below_y));
  };
  add(x, y);
  while (count > 0) {
    const auto [s, t] = waiting[--count];
    if (p.is_leaf(s) && q.is_leaf(t)) {
      emit(p.index(s), q.index(t));
    } else if (p.is_leaf(s)) {
      add(s, q.child(t, 0));
      add(s, q.child(t, 1));
    } else if (q.is_leaf(t)) {
      add(p.child(s, 0), t);
      add(p.child(s, 1), t);
    } else {
      add(p.child(s, 0), q.child(t, 0));
      add(p.child(s, 0), q.child(t, 1));
      add(p.child(s, 1), q.child(t, 0));
      add(p.child(s, 1), q.child(t, 1));
    }
  }
}

/// Part [begin, end) of the nodes above bunches and then the bunches: two leaves part at exactly
/// one of them.
void find_pairs(const Tree& tree, std::size_t begin, std::size_t end,
                std::vector<IndexPair>& pairs) {
  pairs.clear();
  const auto nodes = tree.nodes_above_bunches();
  with_widest_vectors([&](auto width) __attribute__((always_inline)) {
    BunchPairs<width, Tree> bunch_pairs(tree, pairs);
    for (std::size_t k = begin; k < end; ++k) {
      if (k < nodes.size()) {
        bunch_pairs.across(nodes[k]);
      } else {
        bunch_pairs.within(tree.bunches()[k - nodes.size()]);
      }
    }
  });
  // A list that varies a little soon has the room it needs.
  if (pairs.capacity() < pairs.size() + pairs.size() / 4)
    pairs.reserve(pairs.size() + pairs.size() / 2);
}

/// Counting sort by a, then each row by b. row_ends is scratch.
void sort_pairs(std::span<const std::vector<IndexPair>> parts, std::size_t row_count,
                std::vector<std::size_t>& row_ends, std::vector<IndexPair>& sorted) {
  row_ends.assign(row_count + 1, 0);
  for (const std::vector<IndexPair>& part : parts)
    for (const IndexPair& pair : part) ++row_ends[static_cast<std::size_t>(pair.a) + 1];
  for (std::size_t row = 1; row <= row_count; ++row) row_ends[row] += row_ends[row - 1];
  sorted.resize(row_ends[row_count]);
  for (const std::vector<IndexPair>& part : parts)
    for (const IndexPair& pair : part) sorted[row_ends[static_cast<std::size_t>(pair.a)]++] = pair;
  // The start of each row has moved to its end.
  auto begin = sorted.begin();
  for (std::size_t row = 0; row < row_count; ++row) {
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(row_ends[row]);
    std::sort(begin, end);
    begin = end;
  }
}

}  // namespace

struct BroadPhase::Implementation {
  Tree tree;
  /// One for each thread; they keep their room.
  std::span<std::vector<IndexPair>> lists(std::size_t count) {
    if (found.size() < count) found.resize(count);
    return std::span(found).first(count);
  }

  std::vector<std::vector<IndexPair>> found;  ///< by thread
  std::vector<std::size_t> row_ends;
};

namespace {

bool finds_an_overlap(BroadPhase& broad_phase) {
  const std::array<Box, 2> boxes{Box{Vec3(0, 0, 0), Vec3(2, 2, 2)},
                                 Box{Vec3(1, 1, 1), Vec3(3, 3, 3)}};
  broad_phase.rebuild(boxes);
  std::vector<IndexPair> pairs;
  broad_phase.self_pairs(pairs);
  broad_phase.rebuild({});
  return pairs == std::vector<IndexPair>{{0, 1}};
}

}  // namespace

BroadPhase::BroadPhase() : implementation_(std::make_unique<Implementation>()) {
  static const bool works = finds_an_overlap(*this);
  if (!works) {
    throw std::logic_error(
        "BroadPhase: FCL found no pair for two overlapping boxes. It was probably compiled with "
        "another alignment of "
        "Eigen's types than this program, as -march=native does it: compile everything that "
        "includes Eigen with "
        "-DEIGEN_MAX_ALIGN_BYTES=16, or FCL with the flags of this program");
  }
}

BroadPhase::BroadPhase(BroadPhase&&) noexcept = default;
BroadPhase& BroadPhase::operator=(BroadPhase&&) noexcept = default;
BroadPhase::~BroadPhase() = default;

void BroadPhase::rebuild(std::span<const Box> boxes) {
  assert(boxes.size() <= std::size_t{1} << 30);  // Places of the tree are 32-bit.
  implementation_->tree.rebuild(boxes);
}

void BroadPhase::refit(std::span<const Box> boxes) {
  if (boxes.size() != size()) {
    throw std::invalid_argument("BroadPhase::refit: got " + std::to_string(boxes.size()) +
                                " boxes, expected " + std::to_string(size()) +
                                " as in the last rebuild; call rebuild when boxes come or go");
  }
  implementation_->tree.follow(boxes);
}

std::size_t BroadPhase::size() const noexcept {
  return implementation_->tree.leaf_end();
}

void BroadPhase::self_pairs(std::vector<IndexPair>& pairs) const {
  const Tree& tree = implementation_->tree;
  const std::span found = implementation_->lists(1);
  find_pairs(tree, 0, tree.nodes_above_bunches().size() + tree.bunches().size(), found[0]);
  sort_pairs(found, size(), implementation_->row_ends, pairs);
}

void BroadPhase::self_pairs(std::vector<IndexPair>& pairs, ThreadPool& pool) const {
  const Tree& tree = implementation_->tree;
  const std::span found = implementation_->lists(static_cast<std::size_t>(pool.thread_count()));
  const std::size_t count = tree.nodes_above_bunches().size() + tree.bunches().size();
  pool.for_each_range(count, [&](std::size_t begin, std::size_t end, int worker) {
    find_pairs(tree, begin, end, found[static_cast<std::size_t>(worker)]);
  });
  sort_pairs(found, size(), implementation_->row_ends, pairs);
}

void BroadPhase::pairs_with(const BroadPhase& other, std::vector<IndexPair>& pairs) const {
  const Tree& tree = implementation_->tree;
  const Tree& other_tree = other.implementation_->tree;
  const std::span found = implementation_->lists(1);
  found[0].clear();
  if (size() > 0 && other.size() > 0) {
    descend(tree, tree.root(), other_tree, other_tree.root(), [&](std::int32_t i, std::int32_t j) {
      found[0].push_back({i, j});
    });
  }
  sort_pairs(found, size(), implementation_->row_ends, pairs);
}

void BroadPhase::query(const Box& box, std::vector<std::int32_t>& indices) const {
  const Tree& tree = implementation_->tree;
  indices.clear();
  if (size() == 0) return;
  const fcl::AABBd wanted = to_fcl(box);
  std::array<Tree::Place, kMaxHeight + 2> waiting;
  std::size_t count = 0;
  const auto add = [&](Tree::Place place) {
    waiting[count] = place;
    count += overlap(tree.box(place), wanted);
  };
  add(tree.root());
  while (count > 0) {
    const Tree::Place place = waiting[--count];
    if (tree.is_leaf(place)) {
      indices.push_back(tree.index(place));
    } else {
      add(tree.child(place, 0));
      add(tree.child(place, 1));
    }
  }
  std::sort(indices.begin(), indices.end());
}

}  // namespace plekton::geometry
