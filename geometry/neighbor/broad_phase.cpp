// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neighbor/broad_phase.hpp"

#include "geometry/base/vector_width.hpp"
#include "geometry/neighbor/bunch_pairs.hpp"

#include <fcl/broadphase/detail/hierarchy_tree_array.h>
#include <fcl/math/bv/AABB.h>
#include <fcl/narrowphase/collision_object.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <functional>
#include <limits>
#include <numeric>
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
constexpr double kFarthest = 1e150;
/// Nodes on the longest way down, root and leaf included. A tree of 2^31 boxes has 29.
constexpr std::size_t kMaxHeight = 64;

/// NaN is unbounded. std::max and std::min return their first argument when the second is NaN.
double bounded_below(double lower) {
  return std::min(kFarthest, std::max(-kFarthest, lower));
}
double bounded_above(double upper) {
  return std::max(-kFarthest, std::min(kFarthest, upper));
}

fcl::AABBd to_fcl(const Box& box) {
  fcl::AABBd result;
  for (int axis = 0; axis < 3; ++axis) {
    result.min_[axis] = bounded_below(box.lower[axis]);
    result.max_[axis] = bounded_above(box.upper[axis]);
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

/// FCL's tree over bunches of 8 boxes (the last one may hold fewer), in one array: leaves, which
/// are the bunches, in places [0, n), inner nodes in [n, 2 n - 1). FCL refits the tree; the fresh
/// tree is made here, because HierarchyTree::init and balanceTopdown never give their memory back
/// (FCL 0.7.0).
class Tree : public fcl::detail::implementation_array::HierarchyTree<fcl::AABBd> {
 public:
  using Place = std::uint32_t;
  static constexpr std::size_t kMaxHeight = geometry::kMaxHeight;

  Tree() = default;
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  const fcl::AABBd& box(std::size_t place) const { return nodes[place].bv; }
  Place child(std::size_t place, std::size_t k) const {
    return static_cast<Place>(nodes[place].children[k]);
  }
  Place root() const { return static_cast<Place>(root_node); }
  std::size_t box_count() const { return box_count_; }
  std::size_t bunch_count() const { return n_leaves; }
  /// The bunch that a leaf is; nullptr of an inner node.
  const BoxLanes* bunch(Place place) const { return place < n_leaves ? &bunches_[place] : nullptr; }

  static bool overlap(const fcl::AABBd& p, const fcl::AABBd& q) { return geometry::overlap(p, q); }

  // Boxes are a list of them, or SphereBoxes.
  template <class Boxes>
  void rebuild(const Boxes& boxes) {
    box_count_ = boxes.size();
    order_.resize(boxes.size());
    std::iota(order_.begin(), order_.end(), 0);
    make_room((boxes.size() + kInBunch - 1) / kInBunch);
    next_inner_ = n_leaves;
    root_node = n_leaves == 0 ? NULL_NODE : split(0, boxes.size(), boxes);
    if (n_leaves > 0) nodes[root_node].parent = NULL_NODE;
    opath = 0;
    follow(boxes);
  }

  template <class Boxes>
  void follow(const Boxes& boxes) {
    for (std::size_t leaf = 0; leaf < n_leaves; ++leaf) set_boxes(leaf, boxes);
    refit();
  }

 private:
  static constexpr std::size_t kInBunch = BoxLanes::kLanes;

  void make_room(std::size_t count) {
    const std::size_t needed = 2 * count;  // One is never used.
    if (needed > n_nodes_alloc) {
      auto* const room = new std::remove_pointer_t<decltype(nodes)>[needed];
      delete[] nodes;
      nodes = room;
      n_nodes_alloc = needed;
    }
    bunches_.resize(count);
    n_leaves = count;
    n_nodes = count == 0 ? 0 : 2 * count - 1;
    freelist = n_nodes;
    nodes[freelist].next = NULL_NODE;
  }

  /// A tree over the boxes [begin, end) of the order, halved near the median centre along the
  /// widest axis, so that whole bunches remain; returns its top.
  template <class Boxes>
  std::size_t split(std::size_t begin, std::size_t end, const Boxes& boxes) {
    if (end - begin <= kInBunch) return make_bunch(begin, end);
    const std::size_t bunches = (end - begin + kInBunch - 1) / kInBunch;
    const std::size_t middle = begin + bunches / 2 * kInBunch;
    const int axis = widest_axis(begin, end, boxes);
    const auto at = [this](std::size_t k) {
      return order_.begin() + static_cast<std::ptrdiff_t>(k);
    };
    const auto place = [&](std::int32_t i) {
      return twice_centre(boxes, static_cast<std::size_t>(i), axis);
    };
    std::nth_element(at(begin), at(middle), at(end),
                     [&](std::int32_t i, std::int32_t j) { return place(i) < place(j); });
    const std::size_t top = next_inner_++;
    const std::array<std::size_t, 2> halves{split(begin, middle, boxes), split(middle, end, boxes)};
    for (std::size_t k = 0; k < 2; ++k) {
      nodes[top].children[k] = halves[k];
      nodes[halves[k]].parent = top;
    }
    return top;
  }

  std::size_t make_bunch(std::size_t begin, std::size_t end) {
    const std::size_t leaf = begin / kInBunch;
    bunches_[leaf].clear();
    for (std::size_t k = begin; k < end; ++k) bunches_[leaf].index[k - begin] = order_[k];
    nodes[leaf].children[0] = leaf;
    nodes[leaf].children[1] = NULL_NODE;
    return leaf;
  }

  static double twice_centre(std::span<const Box> boxes, std::size_t i, int axis) {
    return bounded_below(boxes[i].lower[axis]) + bounded_above(boxes[i].upper[axis]);
  }
  static double twice_centre(const SphereBoxes& boxes, std::size_t i, int axis) {
    const double centre = boxes.centre(i)[axis];
    return bounded_below(centre) + bounded_above(centre);
  }

  template <class Boxes>
  int widest_axis(std::size_t begin, std::size_t end, const Boxes& boxes) const {
    Vec3 lower = Vec3::Constant(std::numeric_limits<double>::max());
    Vec3 upper = -lower;
    for (std::size_t k = begin; k < end; ++k) {
      const auto i = static_cast<std::size_t>(order_[k]);
      const Vec3 centre(twice_centre(boxes, i, 0), twice_centre(boxes, i, 1),
                        twice_centre(boxes, i, 2));
      lower = lower.cwiseMin(centre);
      upper = upper.cwiseMax(centre);
    }
    int axis = 0;
    (upper - lower).maxCoeff(&axis);
    return axis;
  }

  template <class Boxes>
  void set_boxes(std::size_t leaf, const Boxes& boxes) {
    BoxLanes& bunch = bunches_[leaf];
    nodes[leaf].bv = fcl::AABBd();
    for (std::size_t lane = 0; lane < kInBunch && bunch.index[lane] >= 0; ++lane) {
      const std::int32_t index = bunch.index[lane];
      const fcl::AABBd box = to_fcl(boxes[static_cast<std::size_t>(index)]);
      bunch.set(lane, box.min_, box.max_, index);
      nodes[leaf].bv += box;
    }
  }

  std::size_t box_count_ = 0;
  std::vector<std::int32_t> order_;  ///< of the boxes, bunch by bunch
  std::vector<BoxLanes> bunches_;    ///< by leaf
  std::size_t next_inner_ = 0;
};

constexpr auto kKeepAll = [](const std::vector<IndexPair>&, std::size_t) {};

/// What bunches [begin, end) hold, and what meets across the inner nodes [begin, end): two boxes
/// part at exactly one node.
/// @param keep  (pairs, how many of them are old): leaves out what is not wanted of the new ones
template <class Keep>
void find_pairs(const Tree& tree, std::size_t begin, std::size_t end, const Keep& keep,
                std::vector<IndexPair>& pairs) {
  with_widest_vectors([&](auto width) __attribute__((always_inline)) {
    BunchPairs<width, Tree, true> bunch_pairs(tree, tree, pairs);
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t old = pairs.size();
      bunch_pairs.within(*tree.bunch(static_cast<Tree::Place>(k)));
      const auto node = static_cast<Tree::Place>(tree.bunch_count() + k);
      if (k + 1 < tree.bunch_count()) bunch_pairs.across(tree.child(node, 0), tree.child(node, 1));
      keep(pairs, old);
    }
  });
  // A list that varies a little soon has the room it needs.
  if (pairs.capacity() < pairs.size() + pairs.size() / 4)
    pairs.reserve(pairs.size() + pairs.size() / 2);
}

/// Counting sort by a. @param row_ends  where the pairs of each a end
void sort_by_a(std::span<const std::vector<IndexPair>> parts, std::size_t row_count,
               std::vector<std::size_t>& row_ends, std::vector<IndexPair>& sorted) {
  row_ends.assign(row_count + 1, 0);
  for (const std::vector<IndexPair>& part : parts)
    for (const IndexPair& pair : part) ++row_ends[static_cast<std::size_t>(pair.a) + 1];
  for (std::size_t row = 1; row <= row_count; ++row) row_ends[row] += row_ends[row - 1];
  sorted.resize(row_ends[row_count]);
  for (const std::vector<IndexPair>& part : parts)
    for (const IndexPair& pair : part) sorted[row_ends[static_cast<std::size_t>(pair.a)]++] = pair;
}

/// After sort_by_a: the pairs of each of some a by b.
void sort_rows(std::size_t begin, std::size_t end, std::span<const std::size_t> row_ends,
               std::vector<IndexPair>& sorted) {
  const auto at = [&](std::size_t k) { return sorted.begin() + static_cast<std::ptrdiff_t>(k); };
  for (std::size_t row = begin; row < end; ++row)
    std::sort(at(row == 0 ? 0 : row_ends[row - 1]), at(row_ends[row]));
}

}  // namespace

struct BroadPhase::Implementation {
  Tree tree;
  /// An empty one for each thread; they keep their room.
  std::span<std::vector<IndexPair>> lists(std::size_t count) {
    if (found.size() < count) found.resize(count);
    for (std::vector<IndexPair>& pairs : found) pairs.clear();
    return std::span(found).first(count);
  }

  void sort(std::span<const std::vector<IndexPair>> parts, std::vector<IndexPair>& sorted) {
    sort_by_a(parts, tree.box_count(), row_ends, sorted);
    sort_rows(0, tree.box_count(), row_ends, sorted);
  }
  void sort(std::span<const std::vector<IndexPair>> parts, std::vector<IndexPair>& sorted,
            ThreadPool& pool) {
    sort_by_a(parts, tree.box_count(), row_ends, sorted);
    pool.for_each_range(tree.box_count(), [&](std::size_t begin, std::size_t end, int) {
      sort_rows(begin, end, row_ends, sorted);
    });
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
  rebuild_of(boxes);
}
void BroadPhase::rebuild(const SphereBoxes& boxes) {
  rebuild_of(boxes);
}
void BroadPhase::refit(std::span<const Box> boxes) {
  refit_of(boxes);
}
void BroadPhase::refit(const SphereBoxes& boxes) {
  refit_of(boxes);
}

template <class Boxes>
void BroadPhase::rebuild_of(const Boxes& boxes) {
  assert(boxes.size() <= std::size_t{1} << 30);  // Indices of pairs are 32-bit.
  implementation_->tree.rebuild(boxes);
}

template <class Boxes>
void BroadPhase::refit_of(const Boxes& boxes) {
  if (boxes.size() != size()) {
    throw std::invalid_argument("BroadPhase::refit: got " + std::to_string(boxes.size()) +
                                " boxes, expected " + std::to_string(size()) +
                                " as in the last rebuild; call rebuild when boxes come or go");
  }
  implementation_->tree.follow(boxes);
}

std::size_t BroadPhase::size() const noexcept {
  return implementation_->tree.box_count();
}

void BroadPhase::self_pairs(std::vector<IndexPair>& pairs) const {
  const Tree& tree = implementation_->tree;
  const std::span found = implementation_->lists(1);
  find_pairs(tree, 0, tree.bunch_count(), kKeepAll, found[0]);
  implementation_->sort(found, pairs);
}

void BroadPhase::self_pairs(std::vector<IndexPair>& pairs, ThreadPool& pool) const {
  const Tree& tree = implementation_->tree;
  const std::span found = implementation_->lists(static_cast<std::size_t>(pool.thread_count()));
  pool.for_each_range(tree.bunch_count(), [&](std::size_t begin, std::size_t end, int worker) {
    find_pairs(tree, begin, end, kKeepAll, found[static_cast<std::size_t>(worker)]);
  });
  implementation_->sort(found, pairs, pool);
}

void BroadPhase::self_pairs(std::vector<IndexPair>& pairs, ThreadPool& pool,
                            const std::function<bool(const IndexPair&)>& is_wanted,
                            const SearchShare& share) const {
  const Tree& tree = implementation_->tree;
  const std::span found = implementation_->lists(static_cast<std::size_t>(pool.thread_count()));
  const auto keep_wanted = [&](std::vector<IndexPair>& all, std::size_t old) {
    const auto news = all.begin() + static_cast<std::ptrdiff_t>(old);
    all.erase(std::remove_if(news, all.end(), std::not_fn(std::cref(is_wanted))), all.end());
  };
  const std::size_t first = share.part * tree.bunch_count() / share.count;
  const std::size_t last = (share.part + 1) * tree.bunch_count() / share.count;
  pool.for_each_range(last - first, [&](std::size_t begin, std::size_t end, int worker) {
    find_pairs(tree, first + begin, first + end, keep_wanted,
               found[static_cast<std::size_t>(worker)]);
  });
  implementation_->sort(found, pairs, pool);
}

void BroadPhase::pairs_with(const BroadPhase& other, std::vector<IndexPair>& pairs) const {
  const Tree& tree = implementation_->tree;
  const Tree& other_tree = other.implementation_->tree;
  const std::span found = implementation_->lists(1);
  if (size() > 0 && other.size() > 0) {
    with_widest_vectors([&](auto width) __attribute__((always_inline)) {
      BunchPairs<width, Tree, false>(tree, other_tree, found[0])
          .across(tree.root(), other_tree.root());
    });
  }
  implementation_->sort(found, pairs);
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
  with_widest_vectors([&](auto width) __attribute__((always_inline)) {
    while (count > 0) {
      const Tree::Place place = waiting[--count];
      if (const BoxLanes* const bunch = tree.bunch(place)) {
        for (unsigned bits = bunch->overlaps<width>(wanted.min_, wanted.max_); bits != 0;
             bits &= bits - 1)
          indices.push_back(bunch->index[static_cast<std::size_t>(std::countr_zero(bits))]);
      } else {
        add(tree.child(place, 0));
        add(tree.child(place, 1));
      }
    }
  });
  std::sort(indices.begin(), indices.end());
}

}  // namespace plekton::geometry
