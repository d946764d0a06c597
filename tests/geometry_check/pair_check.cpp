// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/geometry_check/pair_check.hpp"

#include "geometry/base/predicates.hpp"
#include "tests/support/closest_checks.hpp"
#include "tests/support/point_triangle_families.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace plekton::geometry_check {
namespace {

using geometry::ClosestPoints;
using geometry::Core;
using geometry::Vec3;

struct Query {
  Core a;
  Core b;
};

template <std::size_t kCount>
Core core_of(const std::array<Vec3, kCount>& x) {
  Core core;
  for (const Vec3& corner : x) core.x[core.count++] = corner;
  return core;
}

/// m, largest motion of a corner; adds to the corners a random step of this order.
double shake(Core& core, double step, test::Random& random) {
  double moved = 0.0;
  for (std::size_t k = 0; k < core.count; ++k) {
    const Vec3 before = core.x[k];
    core.x[k] += step * random.in_cube(1.0);
    moved = std::max(moved, (core.x[k] - before).norm());
  }
  return moved;
}

double size_of(const Query& query) {
  double size = 0.0;
  for (const Vec3& corner : query.a.corners())
    size = std::max(size, (corner - query.b.x[0]).norm());
  for (const Vec3& corner : query.b.corners())
    size = std::max(size, (corner - query.b.x[0]).norm());
  return size;
}

std::string described(const PairTally& row, const Query& query, const char* what) {
  std::string line = std::string(row.pair) + ", " + row.family + ": " + what + ":";
  for (const Core& core : {query.a, query.b}) {
    line += " [";
    for (const Vec3& corner : core.corners()) {
      std::array<char, 100> text{};
      std::snprintf(text.data(), text.size(), "(%a, %a, %a)", corner[0], corner[1], corner[2]);
      line += text.data();
    }
    line += "]";
  }
  return line;
}

class RowCheck {
 public:
  RowCheck(PairTally& row, const Kernel& kernel, std::uint64_t seed,
           std::vector<std::string>& examples)
      : row_(row), kernel_(kernel), random_(seed), examples_(examples) {}

  void ask(const Query& query) {
    const std::uint64_t before = row_.violations();
    const ClosestPoints answer = kernel_(query.a, query.b);
    ++row_.queries;
    judge(query, answer);
    row_.one_sided += !test::are_opposite(answer, kernel_(query.b, query.a));
    move(query, answer);
    if (row_.violations() > before && examples_.size() < 3)
      examples_.push_back(described(row_, query, what_));
  }

 private:
  void judge(const Query& query, const ClosestPoints& answer) {
    const test::Judgement judgement = test::judge(query.a.corners(), query.b.corners(), answer);
    row_.wrong_regions += judgement.wrong_region;
    row_.wrong_relations += judgement.wrong_relation;
    row_.not_numbers += judgement.not_a_number;
    // Points that touch up to underflow have no relative error.
    row_.largest_error = std::max(row_.largest_error, judgement.relative_error);
    row_.wrong_distances +=
        judgement.relative_error > kLargestError || judgement.mismatch > test::kWeightTolerance;
    what_ = judgement.wrong_region     ? "wrong region"
            : judgement.wrong_relation ? "wrong relation"
            : judgement.not_a_number   ? "not a number"
                                       : "wrong distance, one-sided or jumping";
  }

  /// A distance changes by at most as much as the bodies move.
  void move(const Query& query, const ClosestPoints& answer) {
    Query moved = query;
    const double step = size_of(query) * std::pow(10.0, random_.uniform(-16.0, -2.0));
    const double way = shake(moved.a, step, random_) + shake(moved.b, step, random_);
    const double distance = kernel_(moved.a, moved.b).distance;
    const double rounding = kLargestError * (distance + answer.distance);
    row_.jumps += !(std::abs(distance - answer.distance) <= way * (1.0 + 1e-12) + rounding);
  }

  PairTally& row_;
  const Kernel& kernel_;
  test::Random random_;
  std::vector<std::string>& examples_;
  const char* what_ = "";
};

template <std::size_t kCountA, std::size_t kCountB>
void ask_family(RowCheck& check, std::size_t family, std::uint64_t queries, std::uint64_t seed) {
  test::SimplexFamilies<kCountA, kCountB> families(seed);
  for (std::uint64_t i = 0; i < queries; ++i) {
    const auto [a, b] = families.draw(test::kPairFamilies[family]);
    check.ask({core_of(a), core_of(b)});
  }
}

void ask_point_triangles(RowCheck& check, std::size_t family, std::uint64_t queries,
                         std::uint64_t seed) {
  test::PointTriangleFamilies families(seed);
  for (std::uint64_t i = 0; i < queries; ++i) {
    const test::PointTriangle query = families.draw(test::kFamilies[family]);
    check.ask({core_of(std::array{query.p}), core_of(query.x)});
  }
}

template <std::size_t kCount>
std::size_t place_of(const char* name, const std::array<const char*, kCount>& names) {
  return static_cast<std::size_t>(
      std::find_if(names.begin(), names.end(),
                   [&](const char* one) { return std::strcmp(one, name) == 0; }) -
      names.begin());
}

const PairKind& kind_of(const PairTally& row) {
  for (const PairKind& kind : kPairKinds) {
    if (std::strcmp(kind.name, row.pair) == 0) return kind;
  }
  throw std::logic_error("a row of no pair");
}

/// Those of the point-triangle families whose name is no name of a pair family.
bool is_point_triangle_family(const char* family) {
  return place_of(family, test::kPairFamilyNames) == test::kPairFamilyNames.size();
}

}  // namespace

std::vector<PairTally> pair_rows() {
  std::vector<PairTally> rows;
  for (const PairKind& kind : kPairKinds) {
    for (const char* family : test::kPairFamilyNames) rows.push_back({kind.name, family});
    if (kind.corners_a != 1 || kind.corners_b != 3) continue;
    for (const char* family : test::kFamilyNames) {
      if (is_point_triangle_family(family)) rows.push_back({kind.name, family});
    }
  }
  return rows;
}

void check_pairs(PairTally& row, std::uint64_t queries, std::uint64_t seed, const Kernel& kernel,
                 std::vector<std::string>& examples) {
  const auto signs = geometry::sign_counters();
  const auto closest = geometry::closest_counters();
  RowCheck check(row, kernel, seed + 1, examples);
  const PairKind& kind = kind_of(row);
  if (is_point_triangle_family(row.family)) {
    ask_point_triangles(check, place_of(row.family, test::kFamilyNames), queries, seed);
  } else {
    const std::size_t family = place_of(row.family, test::kPairFamilyNames);
    switch (10 * kind.corners_a + kind.corners_b) {
      case 11:
        ask_family<1, 1>(check, family, queries, seed);
        break;
      case 12:
        ask_family<1, 2>(check, family, queries, seed);
        break;
      case 13:
        ask_family<1, 3>(check, family, queries, seed);
        break;
      case 22:
        ask_family<2, 2>(check, family, queries, seed);
        break;
      case 23:
        ask_family<2, 3>(check, family, queries, seed);
        break;
      default:
        ask_family<3, 3>(check, family, queries, seed);
    }
  }
  row.enumerated = geometry::closest_counters().enumerated - closest.enumerated;
  row.double_doubles = geometry::sign_counters().double_double - signs.double_double;
  row.intervals = geometry::sign_counters().interval - signs.interval;
  row.exact = geometry::sign_counters().exact - signs.exact;
}

}  // namespace plekton::geometry_check
